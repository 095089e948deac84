#pragma once
// Poses with left and right exchanged. The map is made once for a skeleton (motion/edit.h, mirror_map); a pose then
// takes two passes over the joints.

#include <surefoot/rig/skeleton.h>

#include <cstdint>
#include <span>
#include <vector>

namespace surefoot {

struct MirrorMap {
    std::vector<std::int16_t> partner;  ///< of each joint; itself on the middle line
    /// A mirrored joint's model rotation is reflected(partner's) * correction: what a joint's axes on one side differ
    /// from the reflection of the other side's.
    std::vector<Quat> correction;
    /// From the hips up to the root positions are reflected as they are; elsewhere each side keeps its own offsets and
    /// takes the other's movement against them.
    std::vector<std::uint8_t> carries;

    bool empty() const noexcept { return partner.empty(); }
};

/// Reflection in the plane x = 0, of points, rotations and root frames.
constexpr Vec3 reflected(Vec3 v) noexcept { return {-v.x, v.y, v.z}; }
constexpr Quat reflected(Quat q) noexcept { return {q.x, -q.y, -q.z, q.w}; }
constexpr RootFrame reflected(const RootFrame& r) noexcept { return {reflected(r.position), -r.yaw}; }

/// Mirrors a local pose; `out` must not be `locals`. All spans hold joint_count() transforms but `scratch`, which holds
/// twice as many.
void mirror_pose(const Skeleton& skeleton, const MirrorMap& map, std::span<const Transform> locals,
                 std::span<Transform> out, std::span<Transform> scratch) noexcept;

/// What is wrong with a map for that skeleton; empty: nothing.
std::string problem(const MirrorMap& map, const Skeleton& skeleton);

}  // namespace surefoot
