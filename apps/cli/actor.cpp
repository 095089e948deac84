#include "actor.h"

#include "clip_files.h"

#include <surefoot/base/error.h>
#include <surefoot/preset/biped.h>

namespace surefoot::cli {

namespace {

Actor default_actor() {
    const Biped biped = make_biped();
    std::vector<Transform> rest(biped.skeleton->rest.size());
    local_to_model(*biped.skeleton, biped.skeleton->rest, rest);
    const Legs legs = make_legs(*biped.skeleton, biped.roles, rest, 0);
    return {{biped.skeleton, biped.roles, legs, {}}, find_roles(*biped.skeleton, rest), "default"};
}

}  // namespace

Actor read_actor(const std::string& name, const RoleOverrides& overrides) {
    if (name == "default") return default_actor();
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
