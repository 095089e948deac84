#include "actor.h"

#include "clip_files.h"

#include <surefoot/base/error.h>
#include <surefoot/rig_text/rig_template.h>

#include <filesystem>

namespace surefoot::cli {

namespace {

Actor rig_actor(const std::string& name) {
    const Rig rig = make_rig(name == "default" ? "adult" : name);
    std::vector<Transform> rest(rig.skeleton->rest.size());
    local_to_model(*rig.skeleton, rig.skeleton->rest, rest);
    return {{rig.skeleton, rig.roles, rig.legs, {}}, find_roles(*rig.skeleton, rest), name};
}

}  // namespace

Actor read_actor(const std::string& name, const RoleOverrides& overrides) {
    const bool file = std::filesystem::exists(name);
    if (name == "default" || (!file && !bundled_rig(name).empty())) return rig_actor(name);
    LoadOptions load;
    load.still = true;
    return actor_in(read_clip_files(name, load), overrides);
}

RoleOverrides parse_roles(const std::vector<std::string>& given, const char* option) {
    RoleOverrides result;
    for (const std::string& text : given) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
            throw Error("'" + text + "' does not say which joint has which role", option,
                        "write role=joint, as left_foot=Foot_L");
        if (role_from_name(text.substr(0, equals)) == Role::count)
            throw Error("there is no role '" + text.substr(0, equals) + "'", option,
                        "`surefoot roles FILE` shows their names");
        result.emplace_back(text.substr(0, equals), text.substr(equals + 1));
    }
    return result;
}

}  // namespace surefoot::cli
