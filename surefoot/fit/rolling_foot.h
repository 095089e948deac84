#pragma once
// A fitted gait's foot held to the floor exactly: it rolls over a foothold that is fixed in the world, about its heel
// while the toes are up, about the toes once the heel rises, and swings as the gait has it from one to the next.
// Private to the room.

#include <surefoot/harmonic/harmonic_gait.h>

namespace surefoot {

/// How long and how flat a foot is held.
struct FootHold {
    float share = 1;     ///< (0, 1] of its stance, after which it is let go
    float flat = 0.13f;  ///< [rad] a foot that is pitched by less means to lie flat
};
/// Series that hold their feet already are held for as long, and lie flat but for what they ring by.
FootHold hold_of(const HarmonicGait& gait) noexcept;

class RollingFoot {
  public:
    /// `rhythm` in place of the gait's own; one that goes nowhere keeps both feet on the floor throughout. The gait's
    /// places count from `origin` in the root's frame. All that is passed must outlive this.
    RollingFoot(const HarmonicGait& gait, std::span<const float> values, const GaitRhythm& rhythm, std::size_t side,
                Vec3 origin, const FootHold& hold);

    /// Seen from the root, at a share [0, 1) of the foot's own cycle, 0 at its strike.
    FootGoal at(float share) const;
    /// The same seen from where the root is in the middle of the stance (clip/foot_prints.h).
    FootGoal print(float share) const;

  private:
    /// How a foot lies [rad]: toes up by `pitch`, then its left side up by `roll`, then turned to its left by `yaw`.
    struct Attitude {
        float yaw = 0, pitch = 0, roll = 0;
    };
    /// Yaw and place on the floor of the flat foot from which a foot has rolled.
    struct Placed {
        Vec3 ankle;
        float yaw = 0;
    };
    struct Sole {
        Quat foot, toes;  ///< of the foot without its yaw; of the toes in the foot
        Vec3 ankle;       ///< from where the flat foot's ankle is over the floor; y is its height over the lowest point
    };

    Transform captured_print(float share) const;
    Placed captured(float share) const;
    Attitude attitude(Quat rotation) const;
    float pitch(float share) const;
    float toe_bend(float share) const;
    float roll(float share) const;
    Sole rolled(float share) const;
    Placed held(float share) const;
    Placed swinging(float share) const;
    RootFrame moved(float share) const;

    const HarmonicGait& gait_;
    std::span<const float> values_;
    const GaitRhythm& rhythm_;
    std::size_t side_;
    const Leg& leg_;
    Vec3 origin_;
    bool stands_;
    Quat flat_, toes_flat_;
    Vec3 toes_;  ///< of the toe joint in the foot, or the ball
    FootStep step_;
    float lift_;  ///< share of its cycle at which the foot is let go
    float flat_pitch_;
    RootFrame foothold_;  ///< as seen from the root in the middle of the stance
};

/// A gait's body over such feet.
class GroundedBody {
  public:
    /// As RollingFoot; the gait needs feet and level ground.
    GroundedBody(const HarmonicGait& gait, std::span<const float> values, const GaitRhythm& rhythm, Vec3 origin = {});

    /// The local pose at a phase in [0, 1).
    void pose(float phase, std::span<Transform> locals) const;

  private:
    const HarmonicGait& gait_;
    std::span<const float> values_;
    Vec3 origin_;
    std::array<RollingFoot, 2> feet_;
};

}  // namespace surefoot
