#pragma once
// How far feet go that lie on flat ground, and who stands with one foot ahead.

#include <surefoot/clip/packed_clip.h>
#include <surefoot/rig/leg.h>

#include <algorithm>
#include <array>
#include <span>

namespace surefoot::test {

class DragMeter {
  public:
    /// The next frame: a pose in model space, and where its root is.
    void see(const Legs& legs, const Transform& root, std::span<const Transform> models) {
        for (std::size_t side = 0; side < 2; ++side) {
            const Leg& leg = legs.side[side];
            const Transform foot = root * models[static_cast<std::size_t>(leg.foot)];
            const Vec3 heel = transform_point(foot, leg.heel), ball = transform_point(foot, leg.ball);
            const Vec3 mid = lerp(heel, ball, 0.5f);
            constexpr float k_down = 0.01f;  // [m]
            const bool lies = seen_ && heel.y < k_down && ball.y < k_down;
            way_[side] = lies ? way_[side] + planar_length(mid - last_[side]) : 0;
            longest_ = std::max(longest_, way_[side]);
            last_[side] = mid;
        }
        seen_ = true;
    }
    /// [m] the longest way of a foot while heel and ball lay.
    float longest() const { return longest_; }

  private:
    std::array<Vec3, 2> last_{};
    std::array<float, 2> way_{};
    float longest_ = 0;
    bool seen_ = false;
};

/// Moves one foot of a clip that stands.
inline void put_ahead(PackedClip& clip, Side side, float metres) {
    clip.feet[static_cast<std::size_t>(side)].keys.edit([&](std::vector<FootKey>& keys) {
        for (FootKey& key : keys) key.print.translation.z += metres;
    });
}

}  // namespace surefoot::test
