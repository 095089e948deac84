// GLB by hand: nlohmann's JSON and one buffer. tinygltf's writer drops empty lists and nulls from extras, and what we
// put there (contacts, provenance) has to come back as it was.

#include <surefoot/base/error.h>
#include <surefoot/io/gltf.h>
#include <surefoot/io/joint_names.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>

namespace surefoot {

namespace {

using Json = nlohmann::ordered_json;

enum : int { k_unsigned_short = 5123, k_unsigned_int = 5125, k_float = 5126 };
enum : int { k_vertices = 34962, k_triangles = 34963 };  // buffer view targets

std::string place(const GltfScene& scene) { return "scene '" + scene.name + "'"; }

Json parse_extras(const std::string& text, const std::string& where) {
    if (text.empty()) return Json::object();
    Json json = Json::parse(text, nullptr, false);
    if (!json.is_object()) throw Error("extras are not a JSON object", where, "nothing was written");
    return json;
}

Json numbers(Vec3 v) { return Json::array({v.x, v.y, v.z}); }
Json numbers(Quat q) { return Json::array({q.x, q.y, q.z, q.w}); }

const Skeleton& skeleton_of(const GltfScene& scene) {
    return scene.motions.empty() ? *scene.skeleton : *scene.motions.front().skeleton;
}

class Writer {
  public:
    explicit Writer(const GltfScene& scene) : scene_(scene), skeleton_(skeleton_of(scene)) {}
    std::string write();

  private:
    int add_view(const void* data, std::size_t size, int target);
    int add_accessor(int view, std::size_t offset, std::size_t count, int component, const char* type);
    int add_floats(const std::vector<float>& values, const char* type, std::size_t components, bool bounds, int target);
    void write_joints();
    void write_skin();
    void write_mesh(const Mesh& mesh);
    void write_static(const StaticMesh& mesh);
    int write_material(const std::string& name, const std::array<float, 4>& color);
    void write_animation(const Motion& motion, const std::string& extras);
    std::string pack();

    const GltfScene& scene_;
    const Skeleton& skeleton_;
    Json json_;
    std::string binary_;
    std::vector<int> joint_nodes_;
    int root_node_ = -1;
};

int Writer::add_view(const void* data, std::size_t size, int target) {
    binary_.resize((binary_.size() + 3) & ~std::size_t{3}, '\0');
    Json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", size}};
    if (target != 0) view["target"] = target;
    binary_.append(static_cast<const char*>(data), size);
    json_["bufferViews"].push_back(std::move(view));
    return static_cast<int>(json_["bufferViews"].size()) - 1;
}

int Writer::add_accessor(int view, std::size_t offset, std::size_t count, int component, const char* type) {
    Json accessor = {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}};
    if (offset > 0) accessor["byteOffset"] = offset;
    json_["accessors"].push_back(std::move(accessor));
    return static_cast<int>(json_["accessors"].size()) - 1;
}

void add_bounds(Json& accessor, const float* values, std::size_t count, std::size_t components) {
    Json low = Json::array(), high = Json::array();
    for (std::size_t c = 0; c < components; ++c) {
        float least = values[c], most = values[c];
        for (std::size_t i = 1; i < count; ++i) {
            least = std::min(least, values[i * components + c]);
            most = std::max(most, values[i * components + c]);
        }
        low.push_back(least), high.push_back(most);
    }
    accessor["min"] = std::move(low);
    accessor["max"] = std::move(high);
}

int Writer::add_floats(const std::vector<float>& values, const char* type, std::size_t components, bool bounds,
                       int target) {
    const int view = add_view(values.data(), values.size() * sizeof(float), target);
    const int accessor = add_accessor(view, 0, values.size() / components, k_float, type);
    if (bounds) add_bounds(json_["accessors"].back(), values.data(), values.size() / components, components);
    return accessor;
}

std::vector<float> flat(const std::vector<Vec3>& vectors) {
    std::vector<float> values;
    values.reserve(3 * vectors.size());
    for (const Vec3 v : vectors) values.insert(values.end(), {v.x, v.y, v.z});
    return values;
}

std::vector<float> flat_units(std::vector<Vec3> vectors) {
    for (Vec3& v : vectors) v = normalized(v, k_up);
    return flat(vectors);
}

template <std::size_t N>
std::vector<float> flat(const std::vector<std::array<float, N>>& vectors) {
    std::vector<float> values;
    values.reserve(N * vectors.size());
    for (const auto& v : vectors) values.insert(values.end(), v.begin(), v.end());
    return values;
}

/// A node name that no joint has: viewers bind tracks by name.
std::string free_name(const Skeleton& skeleton, std::string name) {
    while (skeleton.find(name) != k_no_joint) name.insert(0, "surefoot_");
    return name;
}

void Writer::write_joints() {
    std::vector<int> tops;
    const auto moves = [](const Motion& m) {
        return std::any_of(m.root.begin(), m.root.end(), [](const RootFrame& r) { return !(r == RootFrame{}); });
    };
    for (int j = 0; j < skeleton_.joint_count(); ++j)
        if (skeleton_.parents[static_cast<std::size_t>(j)] == k_no_joint) tops.push_back(j);
    Json& nodes = json_["nodes"];
    if (tops.size() > 1 || std::any_of(scene_.motions.begin(), scene_.motions.end(), moves)) {
        root_node_ = 0;
        nodes.push_back({{"name", free_name(skeleton_, "root")}, {"extras", {{"surefoot", {{"root_motion", true}}}}}});
    }
    const int first = root_node_ + 1;
    for (int j = 0; j < skeleton_.joint_count(); ++j) {
        const auto at = static_cast<std::size_t>(j);
        Json node = {{"name", skeleton_.names[at]}};
        const Transform& rest = skeleton_.rest[at];
        if (!(rest.translation == Vec3{})) node["translation"] = numbers(rest.translation);
        if (!(rest.rotation == Quat{})) node["rotation"] = numbers(rest.rotation);
        if (!(skeleton_.tips[at] == Vec3{})) node["extras"] = {{"surefoot", {{"tip", numbers(skeleton_.tips[at])}}}};
        nodes.push_back(std::move(node));
        joint_nodes_.push_back(first + j);
        const int parent = skeleton_.parents[at] == k_no_joint ? root_node_ : first + skeleton_.parents[at];
        if (parent >= 0) nodes[static_cast<std::size_t>(parent)]["children"].push_back(first + j);
    }
    json_["scenes"][0]["nodes"].push_back(root_node_ >= 0 ? root_node_
                                                          : joint_nodes_[static_cast<std::size_t>(tops[0])]);
}

/// The inverse of each joint's place in the pose that the mesh shows.
void Writer::write_skin() {
    std::vector<Transform> models(static_cast<std::size_t>(skeleton_.joint_count()));
    local_to_model(skeleton_, skeleton_.rest, models);
    if (scene_.mesh && !scene_.mesh->bind.empty()) {
        if (scene_.mesh->bind.size() != models.size())
            throw Error("its bind pose does not match the skeleton", "mesh '" + scene_.name + "'",
                        "nothing was written");
        models = scene_.mesh->bind;
    }
    std::vector<float> inverses;
    for (const Transform& model : models) {
        const Matrix34 m = to_matrix(inverse({normalized(model.rotation), model.translation}));
        for (std::size_t column = 0; column < 4; ++column)
            for (std::size_t row = 0; row < 4; ++row)
                inverses.push_back(row < 3 ? m.m[4 * row + column] : column == 3 ? 1.0f : 0.0f);
    }
    const int accessor = add_floats(inverses, "MAT4", 16, false, 0);
    json_["skins"].push_back(
        {{"inverseBindMatrices", accessor}, {"joints", joint_nodes_}, {"skeleton", joint_nodes_.front()}});
    if (root_node_ >= 0) json_["skins"][0]["skeleton"] = root_node_;
}

int Writer::write_material(const std::string& name, const std::array<float, 4>& color) {
    json_["materials"].push_back(
        {{"name", name},
         {"pbrMetallicRoughness", {{"baseColorFactor", color}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.9}}}});
    return static_cast<int>(json_["materials"].size()) - 1;
}

void check_triangles(const std::vector<std::uint32_t>& indices, std::size_t vertices, const std::string& name) {
    const bool sound = vertices > 0 && !indices.empty() && indices.size() % 3 == 0 &&
                       *std::max_element(indices.begin(), indices.end()) < vertices;
    if (!sound) throw Error("its triangles do not match its vertices", "mesh '" + name + "'", "nothing was written");
}

void Writer::write_mesh(const Mesh& mesh) {
    const std::size_t count = mesh.positions.size();
    check_triangles(mesh.indices, count, scene_.name);
    if (mesh.normals.size() != count || mesh.joints.size() != count || mesh.weights.size() != count)
        throw Error("its arrays differ in length", "mesh '" + scene_.name + "'", "nothing was written");
    for (std::size_t v = 0; v < count; ++v)
        for (const std::uint16_t joint : mesh.joints[v])
            if (joint >= skeleton_.names.size())
                throw Error("vertex " + std::to_string(v) + " hangs on joint " + std::to_string(joint) +
                                ", which does not exist",
                            "mesh '" + scene_.name + "'", "nothing was written");
    Json attributes;
    attributes["POSITION"] = add_floats(flat(mesh.positions), "VEC3", 3, true, k_vertices);
    attributes["NORMAL"] = add_floats(flat_units(mesh.normals), "VEC3", 3, false, k_vertices);
    const int joints = add_view(mesh.joints.data(), count * sizeof(mesh.joints[0]), k_vertices);
    attributes["JOINTS_0"] = add_accessor(joints, 0, count, k_unsigned_short, "VEC4");
    attributes["WEIGHTS_0"] = add_floats(flat(mesh.weights), "VEC4", 4, false, k_vertices);
    const int indices = add_view(mesh.indices.data(), mesh.indices.size() * sizeof(std::uint32_t), k_triangles);
    const int triangles = add_accessor(indices, 0, mesh.indices.size(), k_unsigned_int, "SCALAR");
    const int material = write_material(scene_.name, scene_.mesh_color);  // first: it may move json_'s other members
    json_["meshes"].push_back(
        {{"name", scene_.name},
         {"primitives", {{{"attributes", std::move(attributes)}, {"indices", triangles}, {"material", material}}}}});
    // A skinned mesh stands at the top of the scene: its node's own transform is ignored.
    json_["nodes"].push_back(
        {{"name", free_name(skeleton_, scene_.name)}, {"mesh", json_["meshes"].size() - 1}, {"skin", 0}});
    json_["scenes"][0]["nodes"].push_back(json_["nodes"].size() - 1);
}

std::vector<Vec3> vertex_normals(const StaticMesh& mesh) {
    std::vector<Vec3> normals(mesh.positions.size());
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
        const Vec3 area = cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
        normals[a] += area, normals[b] += area, normals[c] += area;
    }
    return normals;
}

void Writer::write_static(const StaticMesh& mesh) {
    const std::size_t count = mesh.positions.size();
    check_triangles(mesh.indices, count, mesh.name);
    if ((!mesh.normals.empty() && mesh.normals.size() != count) ||
        (!mesh.vertex_colors.empty() && mesh.vertex_colors.size() != count))
        throw Error("its arrays differ in length", "mesh '" + mesh.name + "'", "nothing was written");
    Json attributes;
    attributes["POSITION"] = add_floats(flat(mesh.positions), "VEC3", 3, true, k_vertices);
    attributes["NORMAL"] = add_floats(flat_units(mesh.normals.empty() ? vertex_normals(mesh) : mesh.normals), "VEC3", 3,
                                      false, k_vertices);
    if (!mesh.vertex_colors.empty())
        attributes["COLOR_0"] = add_floats(flat(mesh.vertex_colors), "VEC4", 4, false, k_vertices);
    const int indices = add_view(mesh.indices.data(), mesh.indices.size() * sizeof(std::uint32_t), k_triangles);
    const int triangles = add_accessor(indices, 0, mesh.indices.size(), k_unsigned_int, "SCALAR");
    const int material = write_material(mesh.name, mesh.color);  // first: it may move json_'s other members
    json_["meshes"].push_back(
        {{"name", mesh.name},
         {"primitives", {{{"attributes", std::move(attributes)}, {"indices", triangles}, {"material", material}}}}});
    json_["nodes"].push_back({{"name", free_name(skeleton_, mesh.name)}, {"mesh", json_["meshes"].size() - 1}});
    json_["scenes"][0]["nodes"].push_back(json_["nodes"].size() - 1);
}

/// The tracks of one animation: all numbers in one buffer view, accessors into it.
class Tracks {
  public:
    Tracks(Json& accessors, int view) : accessors_(accessors), view_(view) {}

    int add(const std::vector<float>& values, const char* type, std::size_t components, bool bounds = false) {
        const std::size_t count = values.size() / components;
        Json accessor = {{"bufferView", view_}, {"componentType", +k_float}, {"count", count}, {"type", type}};
        if (!data_.empty()) accessor["byteOffset"] = data_.size() * sizeof(float);
        if (bounds) add_bounds(accessor, values.data(), count, components);
        data_.insert(data_.end(), values.begin(), values.end());
        accessors_.push_back(std::move(accessor));
        return static_cast<int>(accessors_.size()) - 1;
    }
    /// One channel; a track of one value is written as one key.
    void add_channel(int node, const char* path, const std::vector<float>& values, std::size_t components) {
        const int times = values.size() == components ? first_time() : all_times_;
        const int output = add(values, components == 3 ? "VEC3" : "VEC4", components);
        channels_.push_back({{"sampler", samplers_.size()}, {"target", {{"node", node}, {"path", path}}}});
        samplers_.push_back({{"input", times}, {"interpolation", "LINEAR"}, {"output", output}});
    }
    void add_times(const Motion& motion) {
        std::vector<float> times;
        for (int f = 0; f < motion.frame_count(); ++f)
            times.push_back(static_cast<float>(f / static_cast<double>(motion.fps)));
        all_times_ = add(times, "SCALAR", 1, true);
    }

    const std::vector<float>& data() const { return data_; }
    Json& channels() { return channels_; }
    Json& samplers() { return samplers_; }

  private:
    int first_time() {
        if (first_time_ < 0) first_time_ = add({0.0f}, "SCALAR", 1, true);
        return first_time_;
    }

    Json& accessors_;
    int view_;
    int all_times_ = -1, first_time_ = -1;
    std::vector<float> data_;
    Json channels_ = Json::array(), samplers_ = Json::array();
};

/// The values of one joint over the clip: all of them, one where they never change, none where they are those at rest.
template <typename Value, typename Get>
std::vector<Value> track_values(const Motion& motion, const Value& rest, const Get& get) {
    std::vector<Value> values;
    bool constant = true;
    for (int f = 0; f < motion.frame_count(); ++f) {
        values.push_back(get(f));
        constant = constant && values.back() == values.front();
    }
    if (constant) values.resize(values.front() == rest ? 0 : 1);
    return values;
}

std::vector<float> flat(const std::vector<Quat>& rotations) {
    std::vector<float> values;
    for (const Quat q : rotations) values.insert(values.end(), {q.x, q.y, q.z, q.w});
    return values;
}

void Writer::write_animation(const Motion& motion, const std::string& extras) {
    Tracks tracks(json_["accessors"], static_cast<int>(json_["bufferViews"].size()));
    tracks.add_times(motion);
    Json own = {{"fps", motion.fps}, {"frames", motion.frame_count()}, {"cyclic", motion.cyclic}};
    if (root_node_ >= 0) {
        const auto root = [&](int f) { return motion.root[static_cast<std::size_t>(f)]; };
        const auto positions = track_values(motion, Vec3{}, [&](int f) { return root(f).position; });
        const auto turns = track_values(motion, Quat{}, [&](int f) { return from_yaw(root(f).yaw); });
        if (!positions.empty()) tracks.add_channel(root_node_, "translation", flat(positions), 3);
        if (!turns.empty()) tracks.add_channel(root_node_, "rotation", flat(turns), 4);
        std::vector<float> yaws;  // a quaternion forgets whole turns and the last bit
        for (const RootFrame& frame : motion.root) yaws.push_back(frame.yaw);
        own["root_yaw"] = tracks.add(yaws, "SCALAR", 1);
    }
    for (std::size_t j = 0; j < skeleton_.rest.size(); ++j) {
        const auto local = [&](int f) { return motion.frame(f)[j]; };
        auto rotations = track_values(motion, skeleton_.rest[j].rotation, [&](int f) { return local(f).rotation; });
        const auto positions =
            track_values(motion, skeleton_.rest[j].translation, [&](int f) { return local(f).translation; });
        // One track runs over the whole clip in any case, so that every program sees its length.
        if (j == 0 && rotations.size() < 2)
            rotations.assign(static_cast<std::size_t>(motion.frame_count()), local(0).rotation);
        if (!rotations.empty()) tracks.add_channel(joint_nodes_[j], "rotation", flat(rotations), 4);
        if (!positions.empty()) tracks.add_channel(joint_nodes_[j], "translation", flat(positions), 3);
    }
    add_view(tracks.data().data(), tracks.data().size() * sizeof(float), 0);
    Json all = parse_extras(extras, "extras of clip '" + motion.name + "'");
    all["surefoot"] = std::move(own);
    json_["animations"].push_back({{"name", motion.name},
                                   {"channels", std::move(tracks.channels())},
                                   {"samplers", std::move(tracks.samplers())},
                                   {"extras", std::move(all)}});
}

std::string Writer::pack() {
    binary_.resize((binary_.size() + 3) & ~std::size_t{3}, '\0');
    json_["buffers"][0]["byteLength"] = binary_.size();
    std::string text = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + 3) & ~std::size_t{3}, ' ');
    const std::size_t total = 12 + 8 + text.size() + 8 + binary_.size();
    if (total > 0xffffffffu)
        throw Error("the scene takes more than 4 GiB, the most a GLB may hold", place(scene_), "write fewer clips");
    std::string file;
    file.reserve(total);
    const auto word = [&](std::size_t value) {
        for (int i = 0; i < 4; ++i) file += static_cast<char>((value >> (8 * i)) & 0xff);
    };
    file += "glTF";
    word(2), word(total);
    word(text.size()), word(0x4e4f534a);  // "JSON"
    file += text;
    word(binary_.size()), word(0x004e4942);  // "BIN"
    file += binary_;
    return file;
}

std::string Writer::write() {
    json_ = {
        {"asset", {{"version", "2.0"}, {"generator", "Surefoot"}, {"extras", {{"surefoot", {{"written", true}}}}}}},
        {"scene", 0},
        {"scenes", {{{"name", scene_.name}}}}};
    if (Json extras = parse_extras(scene_.extras, place(scene_)); !extras.empty())
        json_["scenes"][0]["extras"] = std::move(extras);
    write_joints();
    write_skin();
    if (scene_.mesh) write_mesh(*scene_.mesh);
    for (const StaticMesh& mesh : scene_.statics) write_static(mesh);
    for (std::size_t m = 0; m < scene_.motions.size(); ++m)
        write_animation(scene_.motions[m], m < scene_.motion_extras.size() ? scene_.motion_extras[m] : "");
    return pack();
}

}  // namespace

std::string write_glb(const GltfScene& scene) {
    if (scene.motions.empty()) {
        if (scene.skeleton == nullptr)
            throw Error("there is no motion to write", place(scene), "give one clip at least, or a skeleton");
        if (std::string text = problem(*scene.skeleton); !text.empty())
            throw Error(text, place(scene), "nothing was written");
    }
    for (const Motion& motion : scene.motions) {
        const std::string where = place(scene) + ", clip '" + motion.name + "'";
        if (std::string text = problem(motion); !text.empty()) throw Error(text, where, "nothing was written");
        const auto& first = scene.motions.front().skeleton;
        if (motion.skeleton != first && !(*motion.skeleton == *first))
            throw Error("its skeleton is not that of the other clips", where, "write it to a file of its own");
    }
    return Writer(scene).write();
}

}  // namespace surefoot
