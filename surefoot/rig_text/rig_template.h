#pragma once
// Rigs as text: guide points ("widgets") that say where joints are, and the skeleton that is made of them.
//
//     rig stick help "The least that walks"
//     parameter stature = 1.75 in [0.5, 3] unit "m" group "Size" help "Sole to crown"
//     parameter leg = 1 in [0.5, 2] help "Length of the legs"
//     let hip = 0.53 * leg
//     scale = stature / (hip + 0.47)                                    # metres per unit of all points
//     joint Hips role hips at (0, hip, 0)
//     chain Spine Chest = 2 in Hips through (0, hip + 0.1, 0) (0, hip + 0.35, 0)
//     joint Head in Spine.end role head at (0, hip + 0.35, 0) tip (0, hip + 0.47, 0)
//     joint LeftUpperLeg in Hips role left_upper_leg at (0.05, hip, 0)   # and RightUpperLeg, its mirror image
//     joint LeftLowerLeg in LeftUpperLeg role left_lower_leg at (0.05, hip / 2, 0)
//     joint LeftFoot in LeftLowerLeg role left_foot at (0.05, 0.04, 0) tip (0.05, 0, 0.1)
//     limit left_lower_leg x [0, 140]                                    # degrees
//
// Points are in model space: soles on y = 0, facing +Z, the left hand on +X. What is named Left is written once and
// mirrored, limb by limb. Parameters, `let`, presets, expressions, comments and bounds are those of gaits
// (gait_text/gait.h), without time: all is computed once, in double precision.
//
//     rig NAME [from BASE]   first of all. From a bundled template: its statements are read as if they stood here
//     set NAME = VALUE       another default for a parameter of the base
//     joint NAME [in PARENT] [role ROLE] at (x, y, z) [tip (x, y, z)]    tip: where the bone of a last joint ends
//     chain NAME... = COUNT in PARENT through (x, y, z) (x, y, z) ...
//                            COUNT joints (1 to 24) at equal steps along the line; the first stands at the first point,
//                            the last one step before the last point, where the next joint is to be. Up to as many
//                            joints as names take these; more are called by the first name and a number. NAME.end is
//                            the last. Trunk roles of chain joints are found by their place, as in any file
//                            (rig/roles.h)
//     when CONDITION { ... } joints and chains that are left out where the condition is 0
//     limit ROLE [x [low, high]] [y [low, high]] [z [low, high]]         degrees; see rig/limits.h. The rest is human

#include <surefoot/gait_text/gait.h>
#include <surefoot/rig/leg.h>
#include <surefoot/rig/limits.h>

#include <memory>

namespace surefoot {

inline constexpr int k_max_chain_joints = 24;

/// One joint, or a chain of joints, as the template says it. Numbers are indices of the program's outputs.
struct RigPart {
    std::vector<std::string> names;  ///< of a joint: one
    std::string parent;              ///< empty: none
    Role role = Role::count;         ///< count: none
    std::vector<int> points;         ///< the output that is x of each; y and z follow it
    int tip = -1, count = -1, when = -1;
    bool left = false;  ///< has a mirror image
    std::string place;  ///< file:line:column
};

struct RigLimitRange {
    Role role = Role::count;
    int axis = 0;  ///< 0 to 2
    int low = -1;  ///< output; the high end follows it
    std::string place;
};

/// A template as read. The program's first output is the scale.
struct RigTemplate {
    std::string name, help;
    std::vector<GaitParameter> parameters;
    std::vector<GaitPreset> presets;
    std::vector<RigPart> parts;
    std::vector<RigLimitRange> limits;
    GaitProgram program;
    std::vector<std::string> warnings;  ///< names that nothing uses, with file:line:column
};

/// `where` names the text in messages. Throws Error with file:line:column, the line and a caret.
RigTemplate read_rig_template(std::string_view text, const std::string& where);

/// Values of a template's parameters: the defaults, then the preset (empty: none), then `name=value` in order. Throws
/// Error for unknown names, what is no number, and values out of range.
std::vector<double> rig_values(const RigTemplate& rig, std::string_view preset,
                               std::span<const std::string> assignments);

/// A character without clips. Every rest rotation is identity; it stands with its soles on y = 0, facing +Z.
struct Rig {
    std::string name;
    std::shared_ptr<const Skeleton> skeleton;
    RoleMap roles;
    Legs legs;
    RoleLimits limits = human_limits();
    float stature = 0;  ///< [m] of the highest point
};

/// Throws Error where the values make no skeleton that can walk: hips and both legs are needed, bones have a length.
Rig make_rig(const RigTemplate& rig, std::span<const double> values);

/// A bundled template with `assignments`, such as {"stature=1.2", "spine=5"}. Throws Error.
Rig make_rig(std::string_view name, std::span<const std::string> assignments = {});

/// The texts of the templates that the program carries (the folder `templates`); empty where there is none of that
/// name.
std::string_view bundled_rig(std::string_view name) noexcept;
/// Their names, one a line, in order.
std::string_view bundled_rig_names() noexcept;

}  // namespace surefoot
