#pragma once
// The parts of the body, each in a file of its own. Private to the room.
//
// The trunk is a tube of twelve corners a ring from the crotch to the crown, with two holes of eight corners for the
// arms; its lower rim and a corner between the legs make two more loops of eight, from which the legs go on as far as
// the toes, and the arms from theirs as far as the hands. So the whole is one closed surface, and its edges run around
// every joint that bends. Fingers are closed tubes that begin inside the hand.

#include <surefoot/mannequin/cage.h>
#include <surefoot/mannequin/loft.h>
#include <surefoot/mannequin/measures.h>

namespace surefoot {

inline constexpr int k_trunk_corners = 12, k_limb_corners = 8;

/// A cross-section of trunk or limb, in shares of stature: half-axes to the side, to the front and to the back. A
/// cage's corners lie outside of the smooth surface by as much as makes the surface go through these.
struct Girth {
    float side = 0, front = 0, back = 0;
};

/// The corners of a ring: corner k at k turns of a whole, from `across` towards `forward`.
Loop add_ring(Cage& cage, const Measures& body, Vec3 center, const Axes& axes, const Girth& girth, int corners,
              const SkinWeights& skin);

/// A limb that grows ring by ring from a loop of the cage.
class Tube {
  public:
    /// `chain` is what the limb's skin follows.
    Tube(Cage& cage, const Measures& body, Side side, Loop from, SkinChain chain);

    /// `place` is that of the ring along the chain [m].
    void ring(Vec3 center, const Axes& axes, const Girth& girth, float place);
    /// Goes on to a loop that is there already.
    void extend(const Loop& loop);
    void cap() { cage_.cap(last_, flip_); }
    const Loop& last() const { return last_; }
    const SkinChain& chain() const { return chain_; }

  private:
    Cage& cage_;
    const Measures& body_;
    Loop last_;
    SkinChain chain_;
    bool flip_;
};

/// Loops at which limbs begin, indexed by Side; corners in the order of the limbs' rings.
struct Holes {
    std::array<Loop, 2> arm, leg;
};
/// The trunk with neck and head.
Holes add_trunk(Cage& cage, const Measures& body);
/// From the hip to the ankle, then the foot.
void add_leg(Cage& cage, const Measures& body, Side side, const Loop& hole);
/// Ring after ring from the loop at the ankle to the toes, closed.
void add_foot(Cage& cage, const Measures& body, Side side, const Loop& ankle);
/// From the shoulder to the end of the hand, or a cap where there is no arm.
void add_arm(Cage& cage, const Measures& body, Side side, const Loop& hole);
/// A thumb, or all fingers that have roles.
void add_fingers(Mesh& mesh, const Measures& body, Side side);

/// The leg's path for skins: hips, thigh, shank, foot; the place along it is metres from the hip joint.
SkinChain leg_chain(const Measures& body, Side side);
/// The arm's path: girdle, upper arm, forearm, hand; from the shoulder joint.
SkinChain arm_chain(const Measures& body, Side side);
/// The joints of an arm (k_no_joint where the skeleton lacks them), and its directions.
struct ArmBones {
    int girdle, upper, lower, hand;
    Vec3 shoulder, elbow, wrist, tip;
    Axes upper_axes, lower_axes;  ///< `across` up and `forward` ahead where the arm points to the side

    bool there() const { return upper != k_no_joint && lower != k_no_joint; }
};
ArmBones arm_bones(const Measures& body, Side side);

}  // namespace surefoot
