// glTF through tinygltf, which parses and decodes; what the clips need is checked here: tinygltf does not look whether
// accessors lie inside their buffers. This is the only file that includes it.

#include <surefoot/base/error.h>
#include <surefoot/host/files.h>
#include <surefoot/io/gltf.h>
#include <surefoot/io/joint_names.h>
#include <surefoot/io/node_scene.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#endif
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_INCLUDE_JSON
#include <tiny_gltf.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace surefoot {

namespace {

using Json = nlohmann::json;

constexpr const char* k_again = "export the file again";
constexpr std::size_t k_deepest_json = 128;         // scenes nest some ten deep; readers recurse
constexpr std::size_t k_most_buffers = 64;          // each is held in memory
constexpr std::size_t k_most_sparse = 4u << 20;     // elements of an accessor that has no bytes of its own
constexpr std::uint32_t k_json_chunk = 0x4e4f534a;  // "JSON"

/// The JSON text of a GLB or glTF file, with the container checked.
std::string_view json_text(std::string_view bytes, bool binary, const std::string& where) {
    if (bytes.empty()) throw Error("the file is empty", where, k_again);
    if (!binary) return bytes;
    const auto word = [&](std::size_t at) {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < 4; ++i)
            value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
        return value;
    };
    if (bytes.size() < 20)
        throw Error("the GLB file ends inside its header, at byte " + std::to_string(bytes.size()), where,
                    "copy or export it again");
    if (word(4) != 2)
        throw Error("GLB version " + std::to_string(word(4)) + " is not supported", where, "export glTF 2.0");
    if (word(8) > bytes.size())
        throw Error("the GLB file is cut off: its header speaks of " + std::to_string(word(8)) + " bytes, it has " +
                        std::to_string(bytes.size()),
                    where, "copy or export it again");
    if (word(16) != k_json_chunk || word(12) > bytes.size() - 20)
        throw Error("the first chunk of the GLB file is not a whole JSON text", where, "copy or export it again");
    return bytes.substr(20, word(12));
}

/// Refuses what would make recursive readers run out of stack.
void check_depth(std::string_view json, const std::string& where) {
    std::size_t depth = 0;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (c == '"') {
            for (++i; i < json.size() && json[i] != '"'; ++i)
                if (json[i] == '\\') ++i;
        } else if (c == '{' || c == '[') {
            if (++depth > k_deepest_json)
                throw Error("the JSON text nests deeper than " + std::to_string(k_deepest_json) + " levels",
                            where + ": byte " + std::to_string(i), k_again);
        } else if ((c == '}' || c == ']') && depth > 0) {
            --depth;
        }
    }
}

Json parse_json(std::string_view text, const std::string& where) {
    check_depth(text, where);
    try {
        Json json = Json::parse(text.begin(), text.end());
        if (json.is_object()) return json;
    } catch (const Json::exception& error) {
        throw Error(std::string("not a glTF file: ") + error.what(), where, "check the file's format and extension");
    }
    throw Error("not a glTF file: its JSON text is not an object", where, "check the file's format and extension");
}

/// A list of the file, or an empty one.
const Json& list(const Json& json, const char* key) {
    static const Json empty = Json::array();
    const auto at = json.find(key);
    return at != json.end() && at->is_array() ? *at : empty;
}

/// What must be known before the whole is decoded.
void check_before(const Json& json, bool binary, const std::string& where) {
    for (const Json& extension : list(json, "extensionsRequired")) {
        const std::string name = extension.is_string() ? extension.get<std::string>() : "";
        if (name == "KHR_draco_mesh_compression" || name.find("meshopt_compression") != std::string::npos)
            throw Error("the file needs " + name + ", which is not supported", where,
                        "export without compression, or unpack it (gltf-transform copy)");
    }
    const Json& buffers = list(json, "buffers");
    if (buffers.size() > k_most_buffers)
        throw Error("the file has " + std::to_string(buffers.size()) + " buffers; at most " +
                        std::to_string(k_most_buffers) + " are read",
                    where, "pack it into one .glb");
    for (std::size_t i = 0; i < buffers.size(); ++i)
        if (buffers[i].is_object() && !buffers[i].contains("uri") && (!binary || i > 0))
            throw Error("buffer " + std::to_string(i) + " has no data", where, k_again);
}

/// Files that a .gltf may read: those in its own folder or below, nothing else.
struct Folder {
    std::filesystem::path path;
    std::string problem;
};

bool is_inside(const std::string& name, const Folder& folder) {
    std::error_code code;
    const auto base = std::filesystem::weakly_canonical(folder.path.empty() ? "." : folder.path, code);
    if (code) return false;
    const auto file = std::filesystem::weakly_canonical(name, code);
    if (code) return false;
    return std::mismatch(base.begin(), base.end(), file.begin(), file.end()).first == base.end();
}

tinygltf::FsCallbacks folder_access(Folder& folder) {
    tinygltf::FsCallbacks access;
    access.FileExists = [](const std::string& name, void* data) {
        std::error_code code;
        return is_inside(name, *static_cast<Folder*>(data)) && std::filesystem::is_regular_file(name, code);
    };
    access.ExpandFilePath = [](const std::string& name, void*) { return name; };
    access.ReadWholeFile = [](std::vector<unsigned char>* out, std::string* err, const std::string& name, void* data) {
        Folder& own = *static_cast<Folder*>(data);
        if (!is_inside(name, own)) {
            if (err) *err += "'" + name + "' lies outside the file's folder";
            return false;
        }
        try {
            const std::string bytes = read_file(name);
            out->assign(bytes.begin(), bytes.end());
            return true;
        } catch (const Error& error) {
            if (err) *err += error.what();
            return false;
        }
    };
    access.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
        return false;
    };
    access.user_data = &folder;
    return access;
}

tinygltf::Model decode(std::string_view bytes, bool binary, const std::string& where) {
    if (bytes.size() > 0xffffffffu) throw Error("the file is larger than 4 GiB", where, "split it");
    tinygltf::TinyGLTF loader;
    Folder folder{std::filesystem::path(where).parent_path(), ""};
    loader.SetFsCallbacks(folder_access(folder));
    loader.SetImageLoader([](tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*,
                             int, void*) { return true; },
                          nullptr);
    tinygltf::Model model;
    std::string problem, warning;
    const auto size = static_cast<unsigned int>(bytes.size());
    bool read = false;
    try {
        read = binary
                   ? loader.LoadBinaryFromMemory(&model, &problem, &warning,
                                                 reinterpret_cast<const unsigned char*>(bytes.data()), size,
                                                 folder.path.string())
                   : loader.LoadASCIIFromString(&model, &problem, &warning, bytes.data(), size, folder.path.string());
    } catch (const Json::exception& error) {
        problem = error.what();
    }
    if (read) return model;
    std::replace(problem.begin(), problem.end(), '\n', ' ');
    while (!problem.empty() && problem.back() == ' ') problem.pop_back();
    throw Error("not a sound glTF file: " + (problem.empty() ? "it cannot be decoded" : problem), where, k_again);
}

/// Accessors as floats, each decoded once.
class Accessors {
  public:
    Accessors(const tinygltf::Model& model, const std::string& where) : model_(model), where_(where) {}

    std::shared_ptr<const std::vector<float>> read(int index, int type, const std::string& user);

  private:
    [[noreturn]] void fail(int index, const std::string& problem, const std::string& user) const {
        throw Error("accessor " + std::to_string(index) + " " + problem + " (used by " + user + ")", where_, k_again);
    }
    /// The first of `count` elements of `size` bytes, checked to lie inside their buffer; the stride goes to `stride`.
    const unsigned char* bytes(int index, int view, std::size_t offset, std::size_t count, std::size_t size,
                               std::size_t& stride, const std::string& user) const;
    void add_sparse(int index, const tinygltf::Accessor& accessor, std::size_t components, std::vector<float>& values,
                    const std::string& user) const;
    void convert(const tinygltf::Accessor& accessor, const unsigned char* from, float* to,
                 std::size_t components) const;

    const tinygltf::Model& model_;
    const std::string& where_;
    std::map<int, std::shared_ptr<const std::vector<float>>> known_;
};

const unsigned char* Accessors::bytes(int index, int view_index, std::size_t offset, std::size_t count,
                                      std::size_t size, std::size_t& stride, const std::string& user) const {
    if (view_index < 0 || static_cast<std::size_t>(view_index) >= model_.bufferViews.size())
        fail(index, "names buffer view " + std::to_string(view_index) + ", which does not exist", user);
    const tinygltf::BufferView& view = model_.bufferViews[static_cast<std::size_t>(view_index)];
    if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model_.buffers.size())
        fail(index, "names buffer " + std::to_string(view.buffer) + ", which does not exist", user);
    const std::vector<unsigned char>& data = model_.buffers[static_cast<std::size_t>(view.buffer)].data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
        fail(index, "has a buffer view that reaches beyond its buffer of " + std::to_string(data.size()) + " bytes",
             user);
    stride = view.byteStride > 0 ? view.byteStride : size;
    // In doubles: the numbers are the file's and may be anything.
    const double needed = static_cast<double>(offset) + static_cast<double>(count - 1) * static_cast<double>(stride) +
                          static_cast<double>(size);
    if (needed > static_cast<double>(view.byteLength))
        fail(index, "reaches beyond its buffer view of " + std::to_string(view.byteLength) + " bytes", user);
    return data.data() + view.byteOffset + offset;
}

void Accessors::convert(const tinygltf::Accessor& accessor, const unsigned char* from, float* to,
                        std::size_t components) const {
    const auto integers = [&](auto sample, float most) {
        for (std::size_t i = 0; i < components; ++i) {
            std::memcpy(&sample, from + i * sizeof(sample), sizeof(sample));
            const float value = static_cast<float>(sample);
            to[i] = accessor.normalized ? std::fmax(value / most, -1.0f) : value;
        }
    };
    switch (accessor.componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return integers(std::int8_t{}, 127);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return integers(std::uint8_t{}, 255);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return integers(std::int16_t{}, 32767);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return integers(std::uint16_t{}, 65535);
        default:
            std::memcpy(to, from, components * sizeof(float));
    }
}

void Accessors::add_sparse(int index, const tinygltf::Accessor& accessor, std::size_t components,
                           std::vector<float>& values, const std::string& user) const {
    if (accessor.sparse.count <= 0) return fail(index, "is sparse with no elements", user);
    const auto count = static_cast<std::size_t>(accessor.sparse.count);
    const int index_type = accessor.sparse.indices.componentType;
    const std::size_t index_size = index_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE    ? 1
                                   : index_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? 2
                                   : index_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT   ? 4
                                                                                          : 0;
    if (index_size == 0) fail(index, "has sparse indices of an unknown type", user);
    const std::size_t size =
        components *
        static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType)));
    if (accessor.sparse.indices.byteOffset < 0 || accessor.sparse.values.byteOffset < 0)
        fail(index, "has sparse data before its buffer view", user);
    std::size_t index_stride = 0, stride = 0;
    const unsigned char* indices =
        bytes(index, accessor.sparse.indices.bufferView, static_cast<std::size_t>(accessor.sparse.indices.byteOffset),
              count, index_size, index_stride, user);
    const unsigned char* replaced =
        bytes(index, accessor.sparse.values.bufferView, static_cast<std::size_t>(accessor.sparse.values.byteOffset),
              count, size, stride, user);
    for (std::size_t i = 0; i < count; ++i) {
        std::size_t at = 0;
        for (std::size_t b = 0; b < index_size; ++b)
            at |= static_cast<std::size_t>(indices[i * index_stride + b]) << (8 * b);
        if (at >= accessor.count) fail(index, "has a sparse index beyond its end", user);
        convert(accessor, replaced + i * stride, values.data() + at * components, components);
    }
}

std::shared_ptr<const std::vector<float>> Accessors::read(int index, int type, const std::string& user) {
    if (index < 0 || static_cast<std::size_t>(index) >= model_.accessors.size()) fail(index, "does not exist", user);
    const tinygltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(index)];
    if (accessor.type != type) fail(index, "is not of the type that is needed", user);
    if (const auto found = known_.find(index); found != known_.end()) return found->second;
    const int component = accessor.componentType;
    if (component != TINYGLTF_COMPONENT_TYPE_FLOAT &&
        (component < TINYGLTF_COMPONENT_TYPE_BYTE || component > TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT))
        fail(index, "has a component type that is not allowed here", user);
    if (accessor.count == 0) fail(index, "is empty", user);
    const auto components =
        static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
    const std::size_t size =
        components * static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component)));
    auto values = std::make_shared<std::vector<float>>();
    if (accessor.bufferView >= 0) {
        std::size_t stride = 0;
        const unsigned char* from =
            bytes(index, accessor.bufferView, accessor.byteOffset, accessor.count, size, stride, user);
        values->resize(accessor.count * components);
        for (std::size_t i = 0; i < accessor.count; ++i)
            convert(accessor, from + i * stride, values->data() + i * components, components);
    } else {
        if (accessor.count > k_most_sparse) fail(index, "promises more elements than it has data for", user);
        values->resize(accessor.count * components);
    }
    if (accessor.sparse.isSparse) add_sparse(index, accessor, components, *values, user);
    for (const float value : *values)
        if (!std::isfinite(value)) fail(index, "holds a number that is not finite", user);
    known_[index] = values;
    return values;
}

Vec3 vector_of(const std::vector<double>& v, Vec3 otherwise) {
    if (v.size() != 3) return otherwise;
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

/// A rotation as the file has it where it is a unit, mended where it is nearly one.
Quat rotation_of(const std::vector<double>& v) {
    if (v.size() != 4) return {};
    const Quat q{static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]),
                 static_cast<float>(v[3])};
    return std::fabs(dot(q, q) - 1) < 1e-6f ? q : normalized(q);
}

/// Our own notes on an object of the file: extras.surefoot.
const Json& notes(const Json& object) {
    static const Json none = Json::object();
    if (!object.is_object() || !object.contains("extras") || !object["extras"].is_object()) return none;
    const auto at = object["extras"].find("surefoot");
    return at != object["extras"].end() && at->is_object() ? *at : none;
}

double number(const Json& object, const char* key, double otherwise) {
    const auto at = object.find(key);
    return at != object.end() && at->is_number() ? at->get<double>() : otherwise;
}
bool flag(const Json& object, const char* key) {
    const auto at = object.find(key);
    return at != object.end() && at->is_boolean() && at->get<bool>();
}

SceneNode read_node(const tinygltf::Node& from, const Json& json, const std::string& where) {
    SceneNode node;
    node.name = from.name;
    node.children = from.children;
    node.translation = vector_of(from.translation, {});
    node.scale = vector_of(from.scale, {1, 1, 1});
    node.rotation = rotation_of(from.rotation);
    node.has_mesh = from.mesh >= 0;
    bool finite = is_finite(node.translation) && is_finite(node.scale) && is_finite(node.rotation);
    if (from.matrix.size() == 16) {
        const std::vector<double>& m = from.matrix;  // column by column
        node.matrix = Affine{m[0], m[4], m[8], m[12], m[1], m[5], m[9], m[13], m[2], m[6], m[10], m[14]};
        for (const double value : *node.matrix) finite = finite && std::isfinite(value);
    }
    if (!finite) throw Error("node " + shown(from.name) + " has a number that is not finite", where, k_again);
    const Json& own = notes(json);
    node.root_motion = flag(own, "root_motion");
    const Json& tip = list(own, "tip");
    if (tip.size() == 3 && tip[0].is_number() && tip[1].is_number() && tip[2].is_number())
        node.tip = {tip[0].get<float>(), tip[1].get<float>(), tip[2].get<float>()};
    if (!is_finite(node.tip)) node.tip = {};
    return node;
}

/// One channel and its sampler, or nothing where it moves no joint (morph weights).
std::optional<NodeTrack> read_track(const tinygltf::Animation& animation, std::size_t channel_index,
                                    Accessors& accessors, const std::string& where) {
    const tinygltf::AnimationChannel& channel = animation.channels[channel_index];
    const std::string user = "animation " + shown(animation.name) + ", channel " + std::to_string(channel_index);
    NodeTrack track;
    if (channel.target_node < 0) return {};
    track.node = channel.target_node;
    if (channel.target_path == "translation")
        track.path = NodeTrack::Path::translation;
    else if (channel.target_path == "rotation")
        track.path = NodeTrack::Path::rotation;
    else if (channel.target_path == "scale")
        track.path = NodeTrack::Path::scale;
    else
        return {};
    if (channel.sampler < 0 || static_cast<std::size_t>(channel.sampler) >= animation.samplers.size())
        throw Error(user + " names sampler " + std::to_string(channel.sampler) + ", which does not exist", where,
                    k_again);
    const tinygltf::AnimationSampler& sampler = animation.samplers[static_cast<std::size_t>(channel.sampler)];
    if (sampler.interpolation == "STEP") track.curve = NodeTrack::Curve::step;
    if (sampler.interpolation == "CUBICSPLINE") track.curve = NodeTrack::Curve::cubic;
    const bool rotation = track.path == NodeTrack::Path::rotation;
    track.times = accessors.read(sampler.input, TINYGLTF_TYPE_SCALAR, user);
    track.values = accessors.read(sampler.output, rotation ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3, user);
    const std::size_t needed =
        track.times->size() * (rotation ? 4 : 3) * (track.curve == NodeTrack::Curve::cubic ? 3 : 1);
    if (track.values->size() != needed)
        throw Error(user + " has " + std::to_string(track.times->size()) + " key times but values for " +
                        std::to_string(track.values->size() * track.times->size() / std::max<std::size_t>(needed, 1)),
                    where, k_again);
    if (!std::is_sorted(track.times->begin(), track.times->end()))
        throw Error(user + " has key times that run backwards", where, k_again);
    return track;
}

NodeClip read_clip(const tinygltf::Animation& animation, const Json& json, Accessors& accessors,
                   const std::string& where) {
    NodeClip clip;
    clip.name = animation.name;
    for (std::size_t c = 0; c < animation.channels.size(); ++c)
        if (auto track = read_track(animation, c, accessors, where)) clip.tracks.push_back(std::move(*track));
    const Json& own = notes(json);
    clip.fps = number(own, "fps", 0);
    const double frames = number(own, "frames", 0);
    const bool usable = std::isfinite(clip.fps) && clip.fps > 1e-3 && clip.fps < 1e5 && frames >= 1 && frames < 1e9;
    clip.frames = usable ? static_cast<int>(frames) : 0;
    clip.cyclic = flag(own, "cyclic");
    if (own.contains("root_yaw"))
        clip.root_yaw = accessors.read(static_cast<int>(std::clamp(number(own, "root_yaw", -1), -1.0, 1e9)),
                                       TINYGLTF_TYPE_SCALAR, "root motion of animation " + shown(clip.name));
    if (json.is_object() && json.contains("extras") && json["extras"].is_object()) {
        Json extras = json["extras"];
        extras.erase("surefoot");
        if (!extras.empty()) clip.extras = extras.dump(-1, ' ', false, Json::error_handler_t::replace);
    }
    return clip;
}

}  // namespace

std::vector<LoadedClip> read_gltf(std::string_view bytes, const std::string& where, const LoadOptions& options) {
    const bool binary = bytes.starts_with("glTF");
    const Json json = parse_json(json_text(bytes, binary, where), where);
    check_before(json, binary, where);
    const tinygltf::Model model = decode(bytes, binary, where);
    const auto at = [](const Json& all, std::size_t i) -> const Json& {
        static const Json none;
        return i < all.size() ? all[i] : none;
    };
    NodeScene scene;
    scene.ours = flag(notes(json.value("asset", Json())), "written");
    for (std::size_t n = 0; n < model.nodes.size(); ++n)
        scene.nodes.push_back(read_node(model.nodes[n], at(list(json, "nodes"), n), where));
    for (const tinygltf::Skin& skin : model.skins) scene.skins.push_back(skin.joints);
    Accessors accessors(model, where);
    for (std::size_t a = 0; a < model.animations.size(); ++a) {
        NodeClip clip = read_clip(model.animations[a], at(list(json, "animations"), a), accessors, where);
        if (!clip.tracks.empty()) scene.clips.push_back(std::move(clip));
    }
    return clips_from_nodes(scene, where, options);
}

}  // namespace surefoot
