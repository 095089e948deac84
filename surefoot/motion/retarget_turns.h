#pragma once
// The first half of retargeting: which way every joint of the target is turned. Private to the room.

#include <surefoot/motion/retarget.h>

namespace surefoot {

class RetargetTurns {
  public:
    RetargetTurns(const RetargetBody& source, const RetargetBody& target);

    /// Model rotations of the target's joints for a pose of the source, given in local and model space.
    void turn(std::span<const Transform> locals, std::span<const Transform> models, std::span<Quat> result) const;

    /// What a joint of the source turns against its T-stance, in model space.
    Quat source_turn(int joint, std::span<const Transform> models) const {
        return normalized(models[static_cast<std::size_t>(joint)].rotation *
                          conjugate(source_stance_[static_cast<std::size_t>(joint)]));
    }
    const std::vector<Quat>& source_stance() const { return source_stance_; }
    const std::vector<Quat>& target_stance() const { return target_stance_; }

  private:
    /// What a joint of the target follows.
    struct Follow {
        enum class Kind { parent, turn, local } kind = Kind::parent;
        int from = k_no_joint, to = k_no_joint;  ///< turn: between these joints of the source; local: like `from`
        float share = 0;                         ///< turn: of the way from `from` to `to`
        Quat rest;                               ///< parent, local: rotation against the parent where nothing turns
        Quat source_rest;                        ///< local: the same of `from`
    };
    void follow_roles(const RetargetBody& source, const RetargetBody& target);
    void follow_trunk(const RetargetBody& source, const RetargetBody& target);
    void follow_names(const RetargetBody& source, const RetargetBody& target);

    std::shared_ptr<const Skeleton> skeleton_;  // the target's
    std::vector<Quat> source_stance_, target_stance_;
    std::vector<Follow> follow_;
};

/// A body's shape pose, which is its rest pose where none was given.
std::vector<Transform> shape_pose(const RetargetBody& body);

}  // namespace surefoot
