#ifndef __EMSCRIPTEN__

#include <surefoot/base/error.h>
#include <surefoot/io/assimp_import.h>
#include <surefoot/io/joint_names.h>
#include <surefoot/io/node_skeleton.h>

#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/scene.h>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <stdexcept>

// Debian's assimp is built with its assertions on, and broken files can bring them about: it would end the program.
// This definition takes the place of the library's own (it has no handler to set); ReadFile turns the exception into an
// error text.
namespace Assimp {
void aiAssertViolation(const char* condition, const char* file, int line);
void aiAssertViolation(const char* condition, const char*, int) {
    throw std::runtime_error(std::string("a check of assimp's failed: ") + condition);
}
}  // namespace Assimp

namespace surefoot {

namespace {

constexpr std::size_t k_largest_file = std::size_t{1} << 30;  // assimp takes some ten times a file's size
constexpr std::size_t k_deepest = 256;                        // assimp recurses; skeletons nest some forty deep
constexpr const char* k_pivot_mark = "_$AssimpFbx$_";

/// Files may not name other files: there are none.
class NoFiles : public Assimp::IOSystem {
  public:
    bool Exists(const char*) const override { return false; }
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char*, const char*) override { return nullptr; }
    void Close(Assimp::IOStream*) override {}
};

[[noreturn]] void fail_depth(const std::string& where) {
    throw Error("the file nests deeper than " + std::to_string(k_deepest) + " levels", where, "export it again");
}

/// Depth of an XML text or of an ASCII FBX, counted without reading it.
void check_text_depth(std::string_view text, const std::string& where) {
    const bool xml = text.find("<COLLADA") != std::string_view::npos;
    std::size_t depth = 0;
    bool quoted = false;
    for (std::size_t i = 0; i + 1 < text.size(); ++i) {
        const char c = text[i];
        bool opens = false, closes = false;
        if (xml) {
            opens = c == '<' && text[i + 1] != '/' && text[i + 1] != '!' && text[i + 1] != '?';
            closes = (c == '<' && text[i + 1] == '/') || (c == '/' && text[i + 1] == '>');
        } else {
            if (c == '"') quoted = !quoted;
            opens = c == '{' && !quoted;
            closes = c == '}' && !quoted;
        }
        if (opens && ++depth > k_deepest) fail_depth(where);
        if (closes && depth > 0) --depth;
    }
}

/// Depth of a binary FBX: records that hold records, each beginning with the offset of its end.
void check_binary_depth(std::string_view bytes, const std::string& where) {
    const auto number = [&](std::size_t at, std::size_t size) {
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < size; ++i)
            value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
        return value;
    };
    constexpr std::size_t k_header = 27, k_version_at = 23;
    if (bytes.size() < k_header) return;
    const std::size_t size = number(k_version_at, 4) >= 7500 ? 8 : 4;  // of each of a record's three numbers
    std::vector<std::uint64_t> ends;
    for (std::uint64_t at = k_header; at + 3 * size + 1 <= bytes.size();) {
        while (!ends.empty() && at >= ends.back()) ends.pop_back();
        const auto head = static_cast<std::size_t>(at);
        const std::uint64_t end = number(head, size), values = number(head + 2 * size, size);
        const std::uint64_t name = number(head + 3 * size, 1), body = at + 3 * size + 1 + name + values;
        if (end == 0) {
            at += 3 * size + 1;  // the empty record that closes a list
        } else if (end <= at || end > bytes.size() || values > bytes.size() || body > end) {
            return;  // not sound: assimp will say so
        } else if (body < end) {
            ends.push_back(end);
            if (ends.size() > k_deepest) fail_depth(where);
            at = body;
        } else {
            at = end;
        }
    }
}

void keep_only(Assimp::Importer& importer, const char* extension) {
    for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
        const aiImporterDesc* about = importer.GetImporterInfo(i);
        const std::string extensions = about ? about->mFileExtensions : "";
        if (extensions.find(extension) == std::string::npos) importer.UnregisterLoader(importer.GetImporter(i));
    }
}

std::shared_ptr<std::vector<float>> key_times(std::size_t count, double ticks_per_second, const auto& time_of) {
    auto times = std::make_shared<std::vector<float>>();
    for (std::size_t i = 0; i < count; ++i) times->push_back(static_cast<float>(time_of(i) / ticks_per_second));
    return times;
}

/// Fills a NodeScene from what assimp read.
class Import {
  public:
    Import(const aiScene& from, const std::string& where) : from_(from), where_(where) {}

    NodeScene read() {
        add_nodes();
        for (unsigned m = 0; m < from_.mNumMeshes; ++m) add_skin(*from_.mMeshes[m]);
        for (unsigned a = 0; a < from_.mNumAnimations; ++a) add_clip(*from_.mAnimations[a]);
        fold_pivots();
        return std::move(scene_);
    }

  private:
    void add_nodes();
    void set_rest(SceneNode& node, const Affine& matrix) const;
    void add_skin(const aiMesh& mesh);
    void add_clip(const aiAnimation& animation);
    void fold_pivots();
    void add_tracks(NodeClip& clip, const aiNodeAnim& channel, double ticks_per_second);
    void add_track(NodeClip& clip, int node, NodeTrack::Path path, std::shared_ptr<std::vector<float>> times,
                   std::shared_ptr<std::vector<float>> values);

    const aiScene& from_;
    const std::string& where_;
    NodeScene scene_;
    std::map<std::string, int> by_name_;
};

Affine affine(const aiMatrix4x4& m) {
    const float all[12] = {m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4};
    Affine matrix;
    std::copy(std::begin(all), std::end(all), matrix.begin());
    return matrix;
}

Affine rest_of(const SceneNode& node) {
    return node.matrix ? *node.matrix : to_affine({node.rotation, node.translation}, node.scale);
}

void Import::add_nodes() {
    struct Open {
        const aiNode* node;
        int parent;
    };
    std::vector<Open> open{{from_.mRootNode, k_no_joint}};
    while (!open.empty()) {
        const auto [from, parent] = open.back();
        open.pop_back();
        const int index = static_cast<int>(scene_.nodes.size());
        SceneNode& node = scene_.nodes.emplace_back();
        node.name = from->mName.C_Str();
        node.has_mesh = from->mNumMeshes > 0;
        node.helper = node.name.find(k_pivot_mark) != std::string::npos;
        set_rest(node, affine(from->mTransformation));
        by_name_.emplace(node.name, index);
        if (parent != k_no_joint) scene_.nodes[static_cast<std::size_t>(parent)].children.push_back(index);
        for (unsigned c = from->mNumChildren; c-- > 0;) open.push_back({from->mChildren[c], index});
    }
}

/// Translation, rotation and scale where the matrix is made of these; as a matrix where it has shear or is flat.
void Import::set_rest(SceneNode& node, const Affine& matrix) const {
    for (const double value : matrix)
        if (!std::isfinite(value))
            throw Error("node " + shown(node.name) + " has a number that is not finite", where_, "export it again");
    const auto at = [&](std::size_t i) { return static_cast<float>(matrix[i]); };
    const aiMatrix4x4 m(at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7), at(8), at(9), at(10), at(11), 0, 0, 0,
                        1);
    aiVector3D scale, position;
    aiQuaternion turn;
    m.Decompose(scale, turn, position);
    node.translation = {position.x, position.y, position.z};
    node.rotation = normalized(Quat{turn.x, turn.y, turn.z, turn.w});
    node.scale = {scale.x, scale.y, scale.z};
    node.matrix.reset();
    const float slack = 1e-5f * (1 + std::fabs(scale.x) + std::fabs(scale.y) + std::fabs(scale.z));
    if (!is_finite(node.rotation) || !m.Equal(aiMatrix4x4(scale, turn, position), slack)) node.matrix = matrix;
}

void Import::add_skin(const aiMesh& mesh) {
    std::vector<int> joints;
    for (unsigned b = 0; b < mesh.mNumBones; ++b)
        if (const auto at = by_name_.find(mesh.mBones[b]->mName.C_Str()); at != by_name_.end())
            joints.push_back(at->second);
    std::sort(joints.begin(), joints.end());  // nodes are in the file's own order, depth first
    joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
    // Where a file has no mesh, assimp makes one that hangs on every node from the scene's top down: not a skin.
    if (!joints.empty() && joints.front() != 0) scene_.skins.push_back(std::move(joints));
}

void Import::add_track(NodeClip& clip, int node, NodeTrack::Path path, std::shared_ptr<std::vector<float>> times,
                       std::shared_ptr<std::vector<float>> values) {
    const auto finite = [](float v) { return std::isfinite(v); };
    if (!std::all_of(times->begin(), times->end(), finite) || !std::all_of(values->begin(), values->end(), finite))
        throw Error("animation " + shown(clip.name) + " has a key of node " +
                        shown(scene_.nodes[static_cast<std::size_t>(node)].name) + " that is not a finite number",
                    where_, "export it again");
    if (!std::is_sorted(times->begin(), times->end()))
        throw Error("animation " + shown(clip.name) + " has key times that run backwards", where_, "export it again");
    clip.tracks.push_back({node, path, NodeTrack::Curve::linear, std::move(times), std::move(values)});
}

void Import::add_tracks(NodeClip& clip, const aiNodeAnim& channel, double ticks_per_second) {
    const auto at = by_name_.find(channel.mNodeName.C_Str());
    if (at == by_name_.end()) return;
    const auto vectors = [&](NodeTrack::Path path, unsigned count, const aiVectorKey* keys) {
        if (count == 0) return;
        auto values = std::make_shared<std::vector<float>>();
        for (unsigned k = 0; k < count; ++k)
            values->insert(values->end(), {keys[k].mValue.x, keys[k].mValue.y, keys[k].mValue.z});
        add_track(clip, at->second, path,
                  key_times(count, ticks_per_second, [&](std::size_t k) { return keys[k].mTime; }), std::move(values));
    };
    vectors(NodeTrack::Path::translation, channel.mNumPositionKeys, channel.mPositionKeys);
    vectors(NodeTrack::Path::scale, channel.mNumScalingKeys, channel.mScalingKeys);
    if (channel.mNumRotationKeys == 0) return;
    auto values = std::make_shared<std::vector<float>>();
    for (unsigned k = 0; k < channel.mNumRotationKeys; ++k) {
        const aiQuaternion& q = channel.mRotationKeys[k].mValue;
        values->insert(values->end(), {q.x, q.y, q.z, q.w});
    }
    add_track(clip, at->second, NodeTrack::Path::rotation,
              key_times(channel.mNumRotationKeys, ticks_per_second,
                        [&](std::size_t k) { return channel.mRotationKeys[k].mTime; }),
              std::move(values));
}

void Import::add_clip(const aiAnimation& animation) {
    NodeClip clip;
    clip.name = animation.mName.C_Str();
    const double rate = animation.mTicksPerSecond > 0 ? animation.mTicksPerSecond : 1;
    for (unsigned c = 0; c < animation.mNumChannels; ++c) add_tracks(clip, *animation.mChannels[c], rate);
    if (!clip.tracks.empty()) scene_.clips.push_back(std::move(clip));
}

/// Where a joint has only pre- and post-rotations, assimp splits the joint into pivot nodes, but gives tracks for the
/// whole of it. Its pivots then go into its rest transform and stand still.
void Import::fold_pivots() {
    std::vector<char> whole(scene_.nodes.size());
    for (const NodeClip& clip : scene_.clips)
        for (const NodeTrack& track : clip.tracks) whole[static_cast<std::size_t>(track.node)] = 1;
    std::vector<int> parents(scene_.nodes.size(), k_no_joint);
    for (std::size_t n = 0; n < scene_.nodes.size(); ++n)
        for (const int child : scene_.nodes[n].children) parents[static_cast<std::size_t>(child)] = static_cast<int>(n);
    for (std::size_t n = 0; n < scene_.nodes.size(); ++n) {
        SceneNode& joint = scene_.nodes[n];
        if (!whole[n] || joint.helper) continue;
        Affine rest = rest_of(joint);
        bool folded = false;
        for (int p = parents[n]; p != k_no_joint; p = parents[static_cast<std::size_t>(p)]) {
            SceneNode& pivot = scene_.nodes[static_cast<std::size_t>(p)];
            if (!pivot.helper || !pivot.name.starts_with(joint.name + k_pivot_mark)) break;
            rest = product(rest_of(pivot), rest);
            pivot.matrix.reset();
            pivot.translation = {}, pivot.rotation = {}, pivot.scale = {1, 1, 1};
            folded = true;
        }
        if (folded) set_rest(joint, rest);
    }
}

/// FBX files say which of their axes is up; assimp hands that on.
void turn_axes(const aiScene& from, NodeScene& scene) {
    std::int32_t up = 1, sign = 1;
    if (!from.mMetaData || !from.mMetaData->Get("UpAxis", up)) return;
    from.mMetaData->Get("UpAxisSign", sign);
    if (up == 1 && sign == 1) return;
    const float half = 0.70710678f;  // of a quarter turn
    Quat turn;
    if (up == 2) turn = {sign > 0 ? -half : half, 0, 0, half};
    if (up == 0) turn = {0, 0, sign > 0 ? half : -half, half};
    if (up == 1) turn = {1, 0, 0, 0};
    SceneNode top;
    top.name = "axes";
    top.helper = true;
    top.rotation = normalized(turn);
    top.children = {0};
    scene.nodes.push_back(std::move(top));
}

}  // namespace

std::vector<LoadedClip> read_fbx_or_collada(std::string_view bytes, const std::string& where,
                                            const LoadOptions& options) {
    if (bytes.empty()) throw Error("the file is empty", where, "export it again");
    if (bytes.size() > k_largest_file) throw Error("the file is larger than 1 GiB", where, "split it");
    const bool binary = bytes.starts_with("Kaydara FBX Binary");
    binary ? check_binary_depth(bytes, where) : check_text_depth(bytes, where);
    const bool collada = !where.empty() && (where.back() == 'e' || where.back() == 'E');

    Assimp::Importer importer;
    keep_only(importer, collada ? "dae" : "fbx");
    importer.SetIOHandler(new NoFiles);  // the importer owns it
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, true);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_TEXTURES, false);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_MATERIALS, false);
    const aiScene* scene = nullptr;
    std::string problem;
    try {
        scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, collada ? "dae" : "fbx");
        if (!scene) problem = importer.GetErrorString();
    } catch (const std::exception& error) {
        problem = error.what();
    }
    if (!scene || !scene->mRootNode)
        throw Error(std::string("not a sound ") + (collada ? "Collada" : "FBX") +
                        " file: " + (problem.empty() ? "assimp cannot read it" : problem),
                    where, "check the file's format and extension, or export glTF instead");
    NodeScene nodes = Import(*scene, where).read();
    if (!collada) turn_axes(*scene, nodes);
    return clips_from_nodes(nodes, where, options);
}

}  // namespace surefoot

#endif
