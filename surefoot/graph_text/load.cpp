#include <surefoot/analysis/analyze.h>
#include <surefoot/author/json_node.h>
#include <surefoot/author/live_rigs.h>
#include <surefoot/graph_text/graph_file.h>
#include <surefoot/graph_text/names.h>
#include <surefoot/graph_text/node_reader.h>
#include <surefoot/host/files.h>
#include <surefoot/io/load.h>
#include <surefoot/motion/edit.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace surefoot {

namespace {

/// A graph with all that it extends, and the folder that each of its files is relative to.
struct Merged {
    Json json;
    std::string file;
};

constexpr const char* k_version_key = "surefoot_graph";

/// Files named in a graph are relative to it; once merged, to nothing.
void make_paths_whole(Json& json, const std::filesystem::path& folder) {
    const auto whole = [&](Json& path) {
        if (path.is_string()) path = (folder / path.get<std::string>()).lexically_normal().string();
    };
    if (json.contains("project")) whole(json["project"]);
    for (const char* slots : {"clips", "gaits"}) {
        if (!json.contains(slots) || !json[slots].is_object()) continue;
        for (auto& [slot, filled] : json[slots].items())
            if (filled.is_object() && filled.contains("file")) whole(filled["file"]);
    }
}

Json parse_graph(std::string_view text, const std::string& where) {
    Json json;
    try {
        json = Json::parse(text);
    } catch (const Json::parse_error& error) {
        throw Error("it is no JSON: " + std::string(error.what()), where, "mend the place that is named");
    }
    JsonNode(json, where, "", nullptr).at(k_version_key).integer(k_graph_version, k_graph_version);
    return json;
}

Json read_merged(const std::filesystem::path& file, int depth) {
    constexpr int k_most_tiers = 8;
    if (depth > k_most_tiers)
        throw Error("graphs extend one another more than 8 deep", file.string(), "does one extend itself?");
    Json json = parse_graph(read_file(file), file.string());
    JsonNode root(json, file.string(), "", nullptr);
    const bool extends = root.has("extends");
    const std::string base_file = extends ? root.at("extends").text() : std::string();
    make_paths_whole(json, file.parent_path());
    if (!extends) return json;
    json.erase("extends");
    Json base = read_merged(file.parent_path() / base_file, depth + 1);
    base.merge_patch(json);
    return base;
}

Parameter parameter_of(const std::string& name, JsonNode node) {
    Parameter parameter;
    parameter.name = name;
    if (node.has("type")) parameter.kind = node.at("type").word(k_parameter_kinds);
    if (node.has("unit")) parameter.unit = node.at("unit").text();
    if (parameter.kind == ParameterKind::number) {
        parameter.low = node.at("low").real();
        parameter.high = node.at("high").real();
    }
    if (node.has("initial")) parameter.initial = node.at("initial").real();
    if (node.has("rate_per_s")) parameter.rate = node.at("rate_per_s").real();
    if (node.has("lasts_s")) parameter.lasts = node.at("lasts_s").real();
    if (!(parameter.low <= parameter.initial && parameter.initial <= parameter.high))
        node.fail("its initial value is not between low and high", "0 is meant where none is given");
    node.finish();
    return parameter;
}

/// Joints by role or name, each with all below it.
std::vector<float> mask_of(JsonNode node, const Skeleton& skeleton, const RoleMap& roles) {
    std::vector<float> mask(skeleton.rest.size(), 0.0f);
    for (const auto& [name, share] : node.entries()) {
        int joint = skeleton.find(name);
        for (int r = 0; joint == k_no_joint && r < k_role_count; ++r)
            if (name == role_name(static_cast<Role>(r))) joint = roles[static_cast<Role>(r)];
        if (joint == k_no_joint) share.fail("there is no joint or role '" + name + "'", "run `surefoot analyze`");
        const float value = share.real();
        if (!(value >= 0 && value <= 1)) share.fail("a mask's shares are between 0 and 1");
        for (int j = 0; j < skeleton.joint_count(); ++j)
            if (is_within(skeleton, j, joint)) mask[static_cast<std::size_t>(j)] = value;
    }
    return mask;
}

/// The clips that a graph's slots name: those of the project's spaces are there already, others are loaded.
class Slots {
  public:
    Slots(Character& character, const Project& project, std::filesystem::path folder)
        : character_(character), project_(project), folder_(std::move(folder)) {}

    void fill(const std::string& slot, JsonNode node) {
        if (node.json().is_string()) {
            const int clip = project_clip(node.text());
            if (clip < 0)
                node.fail("the project has no clip '" + node.text() + "'",
                          R"(name one of its clips, or a file: {"file": "jump.glb"})");
            clips_[slot] = clip;
            return;
        }
        const JsonNode file = node.at("file");
        const std::string path = file.text();
        LoadResult loaded = load_clips(std::vector<std::string>{path});
        if (!loaded.failed.empty()) file.fail(loaded.failed.front().error);
        if (loaded.clips.size() != 1)
            file.fail("it holds " + std::to_string(loaded.clips.size()) + " clips", "name one as FILE#NAME");
        const AnalyzedClip clip = analyze_clip(std::move(loaded.clips.front().motion), path, 1, project_.roles);
        clips_[slot] = add_clip(character_, clip.motion, clip.facts);
        node.finish();
    }

    int find(const std::string& name) {
        const auto found = clips_.find(name);
        return found != clips_.end() ? found->second : project_clip(name);
    }

  private:
    int project_clip(const std::string& name) {
        const auto& packed = character_.graph.clips;
        for (std::size_t i = 0; i < packed.size(); ++i)
            if (packed[i].name == name) return static_cast<int>(i);
        for (const ProjectClip& clip : project_.clips) {
            if (clip.name != name || clip.file.empty()) continue;
            const std::filesystem::path path = folder_ / clip.file;
            const std::vector<LoadedClip> loaded = read_clips(read_file(path), path.string());
            if (loaded.empty()) throw Error("the file holds no clip", path.string(), "run 'surefoot author' again");
            return add_clip(character_, loaded.front().motion, clip.facts);
        }
        return -1;
    }

    Character& character_;
    const Project& project_;
    std::filesystem::path folder_;
    std::map<std::string, int> clips_;
};

/// The live gaits that a graph's slots name; those that the program carries may be named without a slot.
class Gaits {
  public:
    /// Of a graph; notes the keys that editors and versions need on the way.
    explicit Gaits(JsonNode& root) {
        root.at(k_version_key);
        if (root.has("$schema")) root.at("$schema").text();  // for editors
        if (root.has("gaits"))
            for (const auto& [slot, gait] : root.at("gaits").entries()) fill(slot, gait);
    }
    void fill(const std::string& slot, JsonNode node) {
        if (node.json().is_string()) {
            add(slot, node.text(), node);
            return;
        }
        add(slot, node.at("file").text(), node);
        node.finish();
    }
    int find(const JsonNode& name) {
        const auto found = index_.find(name.text());
        return found != index_.end() ? found->second : add(name.text(), name.text(), name);
    }
    const std::vector<std::shared_ptr<const LiveRig>>& rigs() const { return rigs_; }

    /// All are of the body's skeleton.
    void check(const Skeleton& skeleton, const std::string& file) const {
        for (const auto& [slot, index] : index_)
            if (!fits(*rigs_[static_cast<std::size_t>(index)]->skeleton, skeleton))
                throw Error("the gait '" + slot + "' is of another skeleton than the project's clips", file,
                            "fit one to it: surefoot fit CLIPS --to CHARACTER -o gait.json");
    }

  private:
    int add(const std::string& slot, const std::string& name, const JsonNode& node) {
        try {
            rigs_.push_back(std::make_shared<const LiveRig>(read_live_rig(name)));
        } catch (const Error& error) {
            node.fail(error.what());
        }
        return index_[slot] = static_cast<int>(rigs_.size()) - 1;
    }
    static bool fits(const Skeleton& a, const Skeleton& b) {
        constexpr float k_near = 1e-3f;  // [m] what files round
        bool same = same_joints(a, b);
        for (std::size_t j = 0; same && j < a.rest.size(); ++j)
            same = distance(a.rest[j].translation, b.rest[j].translation) < k_near;
        return same;
    }

    std::map<std::string, int> index_;
    std::vector<std::shared_ptr<const LiveRig>> rigs_;
};

/// Of a graph without a project: the body is its first gait's.
Character character_of(const LiveRig& rig) {
    Character character;
    character.skeleton = character.graph.skeleton = rig.skeleton;
    character.legs = rig.soles;
    character.standing.resize(rig.stand.size());
    local_to_model(*rig.skeleton, rig.stand, character.standing);
    character.roles = find_roles(*rig.skeleton, character.standing).roles;
    character.hip_height = character.standing[static_cast<std::size_t>(rig.soles.hips)].translation.y;
    set_legs(character.graph, character.legs, character.standing);
    return character;
}

void take_body(Pack& pack, const Character& character) {
    pack.roles = character.roles;
    pack.legs = character.legs;
    pack.standing = character.standing;
    pack.hip_height = character.hip_height;
}

/// The program of a graph whose character has been found. `folder` is the project's.
Pack build_graph(JsonNode& root, const std::string& file, Gaits& gaits, Character& character, const Project& project,
                 const std::filesystem::path& folder) {
    Slots slots(character, project, folder);
    if (root.has("clips"))
        for (const auto& [slot, clip] : root.at("clips").entries()) slots.fill(slot, clip);

    Pack result;
    Program& program = result.program;
    program.name = root.has("name") ? root.at("name").text() : std::filesystem::path(file).stem().string();
    program.body = std::move(character.graph);
    character.graph = {};
    character.graph.clips = program.body.clips;  // those that nodes name directly still join
    if (root.has("parameters"))
        for (const auto& [name, node] : root.at("parameters").entries())
            program.parameters.push_back(parameter_of(name, node));
    if (root.has("targets")) program.targets = root.at("targets").texts();
    if (root.has("groups"))
        for (auto& [name, node] : root.at("groups").entries()) {
            SyncGroup group{name, {}};
            if (node.has("events")) group.events = read_marks(program, node.at("events"));
            if (node.has("leader")) {
                const JsonNode leader = node.at("leader");
                if (JsonNode nodes = root.at("nodes"); !nodes.has(leader.text().c_str()))
                    leader.fail("there is no node '" + leader.text() + "'", "name one of \"nodes\"");
                group.leader = "/nodes/" + leader.text();
            }
            node.finish();
            program.groups.push_back(std::move(group));
        }
    NodeSources sources;
    if (root.has("masks"))
        for (const auto& [name, node] : root.at("masks").entries()) {
            sources.masks[name] = static_cast<int>(program.masks.size());
            program.masks.push_back(mask_of(node, *character.skeleton, character.roles));
        }
    program.mirror = mirror_map(*character.skeleton, character.roles);
    sources.clip_of = [&](const std::string& name) {
        const int clip = slots.find(name);
        if (character.graph.clips.size() > program.body.clips.size()) program.body.clips = character.graph.clips;
        return clip;
    };
    sources.rig_of = [&](const JsonNode& name) { return gaits.find(name); };
    read_nodes(program, root.at("nodes"), root.at("root"), sources);
    gaits.check(*program.body.skeleton, file);
    program.rigs = gaits.rigs();
    root.finish();
    lay_out(program);
    if (const std::string text = problem(program); !text.empty())
        throw Error(text, file, "mend the node that is named");
    take_body(result, character);
    return result;
}

}  // namespace

bool is_graph_text(std::string_view text) {
    const auto json = Json::parse(text.begin(), text.end(), nullptr, false);
    return json.is_object() && json.contains(k_version_key);
}

Pack load_graph(const std::filesystem::path& file, std::vector<std::string>* warnings, std::vector<PackReport>* packing,
                const BakeOptions& options) {
    const Json json = read_merged(file, 0);
    JsonNode root(json, file.string(), "", warnings);
    Gaits gaits(root);
    Project project;
    std::filesystem::path project_file;
    Character character;
    if (gaits.rigs().empty() || root.has("project")) {
        project_file = root.at("project").text();
        if (std::filesystem::is_directory(project_file)) project_file /= "project.json";
        project = load_project(project_file, warnings);
        character = bake_character(project, project_file.parent_path(), options);
    } else {
        character = character_of(*gaits.rigs().front());
    }
    if (warnings) warnings->insert(warnings->end(), character.warnings.begin(), character.warnings.end());
    Pack result = build_graph(root, file.string(), gaits, character, project, project_file.parent_path());
    if (packing) *packing = std::move(character.packing);
    return result;
}

Pack read_graph(std::string_view text, const std::string& where, Character character,
                std::vector<std::string>* warnings) {
    const Json json = parse_graph(text, where);
    JsonNode root(json, where, "", warnings);
    if (root.has("extends"))
        root.at("extends").fail("a graph without a folder cannot extend another", "open one that stands by itself");
    if (root.has("project")) root.at("project").text();  // whatever it names: the character is here
    Gaits gaits(root);
    return build_graph(root, where, gaits, character, {}, {});
}

Pack gait_graph(const std::shared_ptr<const LiveRig>& rig, const std::string& name, float own_speed) {
    Character character = character_of(*rig);
    Pack pack;
    take_body(pack, character);
    Program& program = pack.program;
    program.name = name;
    program.body = std::move(character.graph);
    program.mirror = mirror_map(*rig->skeleton, pack.roles);
    program.rigs = {rig};
    const HarmonicGait& gait = *rig->manners.front().gait;
    const float fastest = gait.family() ? gait.basis.most_speed : own_speed;
    const auto add = [&](const char* parameter, const char* unit, float low, float high) -> Operand {
        program.parameters.push_back({parameter, unit, ParameterKind::number, 0, low, high, 0, 0});
        return {0, 1, static_cast<int>(program.parameters.size()) - 1};
    };
    GaitNode node;
    node.speed = add("speed", "m/s", std::min(0.0f, gait.basis.least_speed), std::max(0.0f, fastest));
    node.turn = add("turn", "deg/s", -gait.basis.most_turn, gait.basis.most_turn);
    const auto manners = static_cast<float>(rig->manners.size());
    node.manner = manners > 1 ? add("manner", "", 0, manners - 1) : Operand(0.0f);
    add_node(program, "/root", node, {});
    lay_out(program);
    if (const std::string text = problem(pack); !text.empty()) throw Error(text, name, "fit another gait");
    return pack;
}

}  // namespace surefoot
