#pragma once
// Whose body is to be seen: what a stage draws and what gaits are put on.

#include <surefoot/bake/character.h>
#include <surefoot/rig_text/rig_template.h>

#include <memory>
#include <string>
#include <vector>

namespace surefoot::wasm {

struct StageBody {
    std::string name;
    std::shared_ptr<const Skeleton> skeleton;
    RoleMap roles;
    Legs legs;
    std::vector<Transform> standing;  ///< model space: soles on y = 0, no bone twisted
    float hip_height = 0;             ///< [m] standing
};

StageBody body_of(const Character& character);
StageBody body_of(const Rig& rig);

/// The bundled templates, [{"name", "help", "parameters"}] (surefoot.d.mts: RigFacts).
std::string rigs_json();

/// A bundled template with one value a parameter, each brought into its range. Throws Error for what is no template,
/// and where the values make no skeleton that can walk.
StageBody rigged_body(const std::string& name, std::span<const double> values);

}  // namespace surefoot::wasm
