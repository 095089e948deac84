#pragma once
// What a pack's definitions consist of, in the order in which they lie in the file: the format, together with
// format.h. A change here is a new k_pack_version. Private to the room.

#include <surefoot/pack_file/pack.h>
#include <surefoot/rig/fields.h>

namespace surefoot {

SUREFOOT_FIELDS(Vec3, x, y, z)
SUREFOOT_FIELDS(Quat, x, y, z, w)
SUREFOOT_FIELDS(Transform, rotation, translation)
SUREFOOT_FIELDS(RootFrame, position, yaw)

// Clips. Their keys (base/table.h) lie in the tables.
SUREFOOT_FIELDS(CurveGroup, intervals, curves, key_bytes)
SUREFOOT_FIELDS(Curves, number_count, periodic, groups, numbers, steps, words, bytes)
SUREFOOT_FIELDS(PoseCurves, middle, moving_middle, curves)
SUREFOOT_FIELDS(FootKey, print, toes, age)
SUREFOOT_FIELDS(FootCurves, middle, curves)
SUREFOOT_FIELDS(FootStep, lift, stance, duration)
SUREFOOT_FIELDS(FootPrints, keys, small, steps)
SUREFOOT_FIELDS(PackedClip, name, fps, frame_count, joint_count, cyclic, rotations, turning_blocks, moving,
                translations, small, root, start, travel, velocity, turn_rate, phase_map, cycles, feet)

// Spaces.
SUREFOOT_FIELDS(Axis, name, unit, low, high, wraps)
SUREFOOT_FIELDS(BlendSpace, axes, samples, simplices, neighbours, copy_of, weighting, outside, extrapolation_bound)
SUREFOOT_FIELDS(LegPaths::Side, upper_parent, upper, lower_parent, lower, foot_parent, foot, toes, knee_forward, heel,
                ball)
SUREFOOT_FIELDS(LegPaths, count, joint, parent, side)
SUREFOOT_FIELDS(LocomotionStyle, name, space, mask)

// Gaits.
SUREFOOT_FIELDS(GaitBasis, modes, degree, travel_deg, climb, least_speed, most_speed, most_turn, fitted_speeds,
                fitted_turn, walk_until, run_from, middle_speed, speed_unit)
SUREFOOT_FIELDS(HarmonicGait, name, skeleton, soles, legs, harmonics, foot_harmonics, foot_lift, foot_hold, mean,
                moving, foot_mean, toes_mean, basis, coefficients, cycles)
SUREFOOT_FIELDS(LiveManner, name, gait, pattern)

// Nodes.
SUREFOOT_FIELDS(Parameter, name, unit, kind, initial, low, high, rate, lasts)
SUREFOOT_FIELDS(Operand, offset, scale, parameter)
SUREFOOT_FIELDS(EventMark, event, at)
SUREFOOT_FIELDS(ClipNode, clip, loop, rate, group, events, target, align_from, align_until)
SUREFOOT_FIELDS(SpaceNode, space, at, group)
SUREFOOT_FIELDS(LocomotionNode, speed, turn, lateral, slope, custom, style, style_weight, group)
SUREFOOT_FIELDS(GaitNode, rig, speed, turn, manner, glide)
SUREFOOT_FIELDS(LerpNode, weight)
SUREFOOT_FIELDS(AdditiveNode, weight, mask, reference)
SUREFOOT_FIELDS(LayerNode, weight, mask)
SUREFOOT_FIELDS(MirrorNode, when)
SUREFOOT_FIELDS(RateNode, factor)
SUREFOOT_FIELDS(FeetNode, weight)
SUREFOOT_FIELDS(Condition, kind, subject, comparison, value, value_to)
SUREFOOT_FIELDS(Transition, name, from, to, seconds, curve, kind, interrupted_by, entry, entry_group, priority,
                conditions)
SUREFOOT_FIELDS(MachineNode, states, transitions, initial)
SUREFOOT_FIELDS(SyncGroup, name, events, leader)
SUREFOOT_FIELDS(Pack, program, roles, legs, standing, hip_height)

// Of these a part is made again when a pack is opened (rebuild.cpp); each member is still named, so that a new one has
// to be thought about.

template <class Archive, class Value>
requires(std::is_same_v<std::remove_const_t<Value>, LocomotionSpace>) void fields(Archive& archive, Value& value) {
    auto& [space, clips, made_velocities, made_turns, made_axes, made_custom_slots, made_has_turn] = value;
    archive(space, clips);
}

template <class Archive, class Value>
requires(std::is_same_v<std::remove_const_t<Value>, LocomotionGraph>) void fields(Archive& archive, Value& value) {
    auto& [skeleton, clips, facing, lateral, styles, legs, made_side_travel, made_custom_names] = value;
    archive.part("skeleton", skeleton);
    archive.part("clips", clips);
    archive.part("spaces", facing, lateral, styles, legs);
}

template <class Archive, class Value>
requires(std::is_same_v<std::remove_const_t<Value>, LiveRig>) void fields(Archive& archive, Value& value) {
    auto& [made_skeleton, made_soles, made_legs, manners, made_lanes, made_limb, made_stand, made_change_seconds,
           made_direction, made_stand_print, made_stand_place, idle, made_idle_lanes, made_idle_values,
           made_idle_to_stand, made_idle_hz] = value;
    archive(manners, idle);
}

template <class Archive, class Value>
requires(std::is_same_v<std::remove_const_t<Value>, Node>) void fields(Archive& archive, Value& value) {
    auto& [path, data, children, made_first, made_follows, made_memory] = value;
    archive(path, data, children);
}

template <class Archive, class Value>
requires(std::is_same_v<std::remove_const_t<Value>, Program>) void fields(Archive& archive, Value& value) {
    auto& [name, body, rigs, parameters, groups, events, targets, masks, references, mirror, nodes, made_state_size,
           made_inertializes, made_inertia_memory, made_holds_feet, made_feet_memory, made_registers, made_drifting] =
        value;
    archive(name, body);
    archive.part("gaits", rigs);
    archive.part("nodes", parameters, groups, events, targets, masks, references, mirror, nodes);
}

/// How many values an enumeration has; what is read lies below.
template <class Enumeration>
inline constexpr int k_values_of = 0;
template <>
inline constexpr int k_values_of<Weighting> = static_cast<int>(Weighting::axis_distance) + 1;
template <>
inline constexpr int k_values_of<Outside> = static_cast<int>(Outside::extrapolate) + 1;
template <>
inline constexpr int k_values_of<ParameterKind> = static_cast<int>(ParameterKind::trigger) + 1;
template <>
inline constexpr int k_values_of<Curve> = static_cast<int>(Curve::cubic_in_out) + 1;
template <>
inline constexpr int k_values_of<TransitionKind> = static_cast<int>(TransitionKind::inertialize) + 1;
template <>
inline constexpr int k_values_of<Interruption> = static_cast<int>(Interruption::anyone) + 1;
template <>
inline constexpr int k_values_of<Entry> = static_cast<int>(Entry::phase) + 1;
template <>
inline constexpr int k_values_of<ConditionKind> = static_cast<int>(ConditionKind::window) + 1;
template <>
inline constexpr int k_values_of<Comparison> = static_cast<int>(Comparison::not_equal) + 1;

}  // namespace surefoot
