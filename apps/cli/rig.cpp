// surefoot rig TEMPLATE: a character from guide points, with a mannequin to see it by.

#include "clip_files.h"
#include "command.h"
#include "parameters.h"

#include <surefoot/base/error.h>
#include <surefoot/host/files.h>
#include <surefoot/io/bvh.h>
#include <surefoot/io/gltf.h>
#include <surefoot/mannequin/mannequin.h>
#include <surefoot/rig_text/rig_template.h>

#include <fmt/format.h>

#include <memory>

namespace surefoot::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr Bundle k_rigs{"rig", bundled_rig, bundled_rig_names};

struct Options {
    std::string rig = "adult", preset, out;
    std::vector<std::string> set;
    bool mesh = true, json = false;
};

int list(bool json) {
    Json all = Json::array();
    for (const std::string& name : k_rigs.list()) {
        const RigTemplate rig = read_rig_template(bundled_rig(name), name + ".rig");
        all.push_back({{"name", name}, {"help", rig.help}});
        if (!json) print(fmt::format("{:<14} {}\n", name, rig.help));
    }
    if (json) print_json(Json{{"rigs", all}});
    return 0;
}

std::string role_of(const RoleMap& roles, int joint) {
    for (int r = 0; r < k_role_count; ++r)
        if (roles[static_cast<Role>(r)] == joint) return std::string(role_name(static_cast<Role>(r)));
    return {};
}

/// Degrees that round trips through floats have not spoilt.
Json degrees(float low, float high) {
    const auto rounded = [](float radians) { return std::round(radians * k_degrees_per_radian * 1000) / 1000.0; };
    return Json::array({rounded(low), rounded(high)});
}

Json joints_json(const Rig& rig) {
    const Skeleton& skeleton = *rig.skeleton;
    std::vector<Transform> models(skeleton.rest.size());
    local_to_model(skeleton, skeleton.rest, models);
    std::vector<Quat> stance(skeleton.rest.size());  // rest rotations are identity, arms out
    const BodyLimits limits(skeleton, rig.roles, stance, rig.limits);
    Json list = Json::array();
    for (int j = 0; j < skeleton.joint_count(); ++j) {
        const auto at = static_cast<std::size_t>(j);
        const Vec3 place = models[at].translation;
        Json joint{{"name", skeleton.names[at]},
                   {"parent", nullptr},
                   {"role", nullptr},
                   {"position_m", {place.x, place.y, place.z}},
                   {"limits_deg", nullptr}};
        if (skeleton.parents[at] != k_no_joint)
            joint["parent"] = skeleton.names[static_cast<std::size_t>(skeleton.parents[at])];
        if (const std::string role = role_of(rig.roles, j); !role.empty()) joint["role"] = role;
        if (const JointLimit& limit = limits[j]; !limit.free())
            joint["limits_deg"] = {{"x", degrees(limit.low.x, limit.high.x)},
                                   {"y", degrees(limit.low.y, limit.high.y)},
                                   {"z", degrees(limit.low.z, limit.high.z)}};
        list.push_back(std::move(joint));
    }
    return list;
}

Json described(const RigTemplate& source, const std::vector<double>& values, const Rig& rig) {
    return {{"name", source.name},
            {"help", source.help},
            {"stature_m", rig.stature},
            {"parameters", parameters_json(source.parameters, values)},
            {"presets", presets_json(source.presets, source.parameters)},
            {"joints", joints_json(rig)},
            {"warnings", source.warnings}};
}

void describe(const RigTemplate& source, const std::vector<double>& values, const Rig& rig) {
    print(fmt::format("{}{}{}\n\n", source.name, source.help.empty() ? "" : ": ", source.help));
    print_parameters(source.parameters, values);
    print_presets(source.presets);
    print(fmt::format("\n{} joints, {:.4g} m\n", rig.skeleton->joint_count(), rig.stature));
}

std::string as_glb(const RigTemplate& source, const std::vector<double>& values, const Rig& rig, bool mesh) {
    GltfScene scene;
    scene.skeleton = rig.skeleton;
    scene.name = rig.name;
    if (mesh) scene.mesh = make_mannequin(*rig.skeleton, rig.roles, rig.legs);
    Json set = Json::object();
    for (std::size_t i = 0; i < values.size(); ++i) set[source.parameters[i].name] = values[i];
    scene.extras = Json{{"rig", {{"template", source.name}, {"parameters", set}, {"joints", joints_json(rig)}}}}.dump(
        -1, ' ', false, Json::error_handler_t::replace);
    return write_glb(scene);
}

int run(const Options& options) {
    if (options.rig == "list") return list(options.json);
    if (!options.out.empty()) check_clip_output(options.out);
    const NamedText text = find_text(options.rig, k_rigs);
    const RigTemplate source = read_rig_template(text.text, text.where);
    const std::vector<double> values = rig_values(source, options.preset, options.set);
    for (const std::string& warning : source.warnings) std::fprintf(stderr, "%s\n", warning.c_str());
    const Rig rig = make_rig(source, values);
    if (!options.out.empty())
        write_file(options.out, options.out.ends_with("bvh") || options.out.ends_with("BVH")
                                    ? write_bvh(make_motion(rig.skeleton, rig.name, 1, 30))
                                    : as_glb(source, values, rig, options.mesh));
    if (options.json)
        print_json(described(source, values, rig));
    else if (options.out.empty())
        describe(source, values, rig);
    return 0;
}

}  // namespace

extern const Command k_rig;
const Command k_rig{"rig", "Characters from guide points: proportions, spine joints, fingers, toes; with a mannequin",
                    [](CLI::App& app) {
                        auto options = std::make_shared<Options>();
                        app.add_option(
                            "TEMPLATE", options->rig,
                            "A .rig file, the name of a bundled template (default: adult), or 'list' for their names");
                        app.add_option("-o,--output", options->out, "Write the character, .glb, or its skeleton, .bvh");
                        app.add_option("--preset", options->preset, "Begin with the values of this preset");
                        app.add_option("-p,--set", options->set, "Set a parameter, name=value (may be repeated)")
                            ->type_name("NAME=VALUE")
                            ->allow_extra_args(false);
                        // The parameters that every bundled template has.
                        const auto shorthand = [&](const char* name, const char* help) {
                            app.add_option_function<std::string>(
                                   std::string("--") + name,
                                   [options, name](const std::string& value) {
                                       options->set.push_back(std::string(name) + "=" + value);
                                   },
                                   help)
                                ->type_name("VALUE");
                        };
                        shorthand("stature", "Sole to crown, metres");
                        shorthand("spine", "Joints of the spine");
                        for (const char* part : {"leg", "trunk", "neck", "head", "arm", "hand", "foot"})
                            shorthand(part, "Times the usual length");
                        const auto flag = [&](const char* option, const char* value, const char* help) {
                            app.add_flag_callback(
                                option, [options, value] { options->set.emplace_back(value); }, help);
                        };
                        flag("--fingers", "fingers=1", "Three joints for each finger");
                        flag("--no-toes", "toes=0", "Feet without a toe joint");
                        app.add_flag("!--no-mesh", options->mesh, "Leave out the mannequin that a .glb wears");
                        app.add_flag("--json", options->json, "Describe the rig as JSON on standard output");
                        return [options] { return run(*options); };
                    }};

}  // namespace surefoot::cli
