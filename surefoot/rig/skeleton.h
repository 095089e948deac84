#pragma once
// A skeleton: named joints, parents before children, in rest pose. Immutable once built and shared by all who use it.

#include <surefoot/math/transform.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot {

inline constexpr int k_no_joint = -1;
inline constexpr int k_max_joints = 1024;

struct Skeleton {
    std::vector<std::string> names;     ///< unique, not empty
    std::vector<std::int16_t> parents;  ///< [k_no_joint or an index below the joint's own]
    std::vector<Transform> rest;        ///< local rest pose, metres
    /// Where a leaf joint's bone ends, in the joint's frame (BVH "End Site"); zero where there is none.
    std::vector<Vec3> tips;

    int joint_count() const noexcept { return static_cast<int>(parents.size()); }
    /// Index of the joint of that exact name, or k_no_joint.
    int find(std::string_view name) const noexcept;
    int add(std::string name, int parent, const Transform& rest_local, Vec3 tip = {});

    friend bool operator==(const Skeleton&, const Skeleton&) = default;
};

/// What is wrong with a skeleton, as a sentence with the joint's name; empty when it is sound: at least one joint and
/// at most k_max_joints, arrays of equal length, parents before children, unique names, finite unit rotations.
std::string problem(const Skeleton& skeleton);

/// True where joint by joint names and parents are the same; rest poses may differ.
bool same_joints(const Skeleton& a, const Skeleton& b) noexcept;

/// Local to model space: models[j] = models[parent] * locals[j]. Both spans hold joint_count() transforms.
void local_to_model(const Skeleton& skeleton, std::span<const Transform> locals, std::span<Transform> models) noexcept;

/// The reverse of local_to_model.
void model_to_local(const Skeleton& skeleton, std::span<const Transform> models, std::span<Transform> locals) noexcept;

/// True where `joint` is `ancestor` or below it.
bool is_within(const Skeleton& skeleton, int joint, int ancestor) noexcept;

}  // namespace surefoot
