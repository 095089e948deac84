#include <surefoot/graph/foot_blend.h>
#include <surefoot/graph/locomotion.h>
#include <surefoot/ik/foot_placement.h>
#include <surefoot/ik/two_bone.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr float k_least_duty = 0.05f, k_most_duty = 0.95f;
constexpr float k_most_pace = 4;  // times faster or slower than its clips a blend is played, where it means anything

/// What a leaf's foot is doing: which step, and how much the leaf has to say about timing.
struct FootLeaf {
    const PackedClip* clip;
    const FootPrints* track;
    float weight;  ///< adds up to 1
    float say;     ///< of the leaf's speed, adds up to 1; 0 for clips without steps
    float time;    ///< [s] of the body
    int step;
};

struct FootLeaves {
    FootLeaf leaf[k_max_leaves];
    int count = 0;
    Side side = Side::left;  ///< whose the tracks are

    std::span<FootLeaf> all() noexcept { return {leaf, static_cast<std::size_t>(count)}; }
    std::span<const FootLeaf> all() const noexcept { return {leaf, static_cast<std::size_t>(count)}; }
};

/// What the leaves are to both sides; false where one has no tracks.
bool gather(std::span<const PackedClip> clips, const FootBlend& blend, FootLeaves& leaves) noexcept {
    float weights = 0, says = 0;
    for (const Leaf& leaf : blend.leaves) {
        const PackedClip& clip = clips[static_cast<std::size_t>(leaf.clip)];
        if (!clip.feet[0].known() || !clip.feet[1].known()) return false;
        constexpr float k_slowest = 1e-3f;  // [m/s] so that clips that stamp on the spot have a say among themselves
        const float speed = clip.cycles > 0 ? std::max(foot_speed(clip.velocity, clip.turn_rate), k_slowest) : 0.0f;
        FootLeaf& out = leaves.leaf[leaves.count++];
        // What extrapolation takes off has its say about timing, too.
        out = {&clip, nullptr, leaf.weight, std::fabs(leaf.weight) * speed, leaf.time, 0};
        weights += leaf.weight;
        says += out.say;
    }
    for (FootLeaf& leaf : leaves.all()) {
        leaf.weight /= weights;
        leaf.say = says > 0 ? leaf.say / says : 0.0f;
    }
    return true;
}

/// The leaves as one side sees them, which is in its step of that number.
void turn_to(std::size_t side, std::uint32_t step, FootLeaves& leaves) noexcept {
    leaves.side = static_cast<Side>(side);
    for (FootLeaf& leaf : leaves.all()) {
        leaf.track = &leaf.clip->feet[side];
        if (leaf.clip->cycles > 0) leaf.step = static_cast<int>(step % static_cast<std::uint32_t>(leaf.clip->cycles));
    }
}

/// Share of the step's phase for which the blended foot stands: a mean by the steps' durations, so that its way on the
/// ground is the mean of the clips' ways. A lone stepping clip keeps its own.
float blended_duty(const FootLeaves& leaves) noexcept {
    float stance = 0, duration = 0;
    for (const FootLeaf& leaf : leaves.all()) {
        if (leaf.clip->cycles == 0) continue;
        const FootStep& step = leaf.track->steps[static_cast<std::size_t>(leaf.step)];
        stance += leaf.say * step.duration * step.lift;
        duration += leaf.say * step.duration;
    }
    return duration > 0 ? std::clamp(stance / duration, k_least_duty, k_most_duty) : 0.5f;
}

/// Where a clip's own step is when the blended one is `share` of its way, of which it stands for `duty`.
float own_share(const FootStep& step, float share, float duty) noexcept {
    return share < duty ? share / duty * step.lift : step.lift + (share - duty) / (1 - duty) * (1 - step.lift);
}

void add(Quat& sum, Quat q, float weight) noexcept {
    q = aligned(q, sum);
    sum = {sum.x + weight * q.x, sum.y + weight * q.y, sum.z + weight * q.z, sum.w + weight * q.w};
}

/// The sole's two places as the leaves have them. Clips that stand (idles) keep a stepping foot where it is, but must
/// not keep it on the ground: a foot that is on its way has to leave it, or it shuffles.
class SoleMean {
  public:
    void add(Vec3 heel, Vec3 ball, float weight, bool steps) noexcept {
        heel_ += heel * weight;
        ball_ += ball * weight;
        if (!steps) return;
        stepping_ += weight;
        heel_lift_ += heel.y * weight;
        ball_lift_ += ball.y * weight;
    }
    Vec3 heel() const noexcept { return lifted(heel_, heel_lift_); }
    Vec3 ball() const noexcept { return lifted(ball_, ball_lift_); }

  private:
    Vec3 lifted(Vec3 mean, float stepping_height) const noexcept {
        constexpr float k_half = 0.15f;  // weight of the stepping clips at which half their height is reached, about
        if (!(stepping_ > 0 && stepping_ < 1)) return mean;
        const float share = stepping_ * (1 + k_half) / (stepping_ + k_half);
        const float standing_height = (mean.y - stepping_height) / (1 - stepping_);
        mean.y = share * (stepping_height / stepping_) + (1 - share) * standing_height;
        return mean;
    }
    Vec3 heel_, ball_;
    float stepping_ = 0, heel_lift_ = 0, ball_lift_ = 0;
};

/// The weighted mean of the leaves' keys. `strike` is the side's own phase of 0. Heel and ball are what is averaged:
/// the foot rolls about one and then the other, which stand still, while the ankle moves on a curve that no mean keeps.
FootKey mean_key(const LegPaths::Side& leg, const FootLeaves& leaves, float strike, float share) noexcept {
    const float duty = blended_duty(leaves);
    FootKey mean{{{0, 0, 0, 0}, {}}, {0, 0, 0, 0}, 0};
    SoleMean sole;
    for (const FootLeaf& leaf : leaves.all()) {
        float time = leaf.time;
        if (leaf.clip->cycles > 0) {
            const FootStep& step = leaf.track->steps[static_cast<std::size_t>(leaf.step)];
            time = time_at(*leaf.clip, strike + static_cast<float>(leaf.step) + own_share(step, share, duty));
        }
        const FootKey key = foot_key_at(*leaf.clip, leaves.side, time);
        sole.add(transform_point(key.print, leg.heel), transform_point(key.print, leg.ball), leaf.weight,
                 leaf.clip->cycles > 0);
        add(mean.print.rotation, key.print.rotation, leaf.weight);
        add(mean.toes, key.toes, leaf.weight);
        mean.age += key.age * leaf.say;
    }
    mean.print.rotation = normalized(mean.print.rotation);
    mean.print = stand_on(leg, mean.print.rotation, sole.heel(), sole.ball());
    mean.toes = normalized(mean.toes);
    return mean;
}

/// How much faster the blend goes through its phase than its clips would by themselves: the age of a stance passes that
/// much quicker.
float pace_of(const FootLeaves& leaves, const FootBlend& blend) noexcept {
    float seconds = 0;
    for (const FootLeaf& leaf : leaves.all())
        if (leaf.clip->cycles > 0)
            seconds +=
                leaf.say * phase_time(*leaf.clip, phase_in(*leaf.clip, blend.phase_before, blend.cycle_before)).slope;
    const float pace = seconds * blend.phase_rate;
    return pace > 0 ? std::clamp(pace, 1 / k_most_pace, k_most_pace) : 1.0f;
}

class LegModels {
  public:
    Transform& at(int slot) noexcept { return reinterpret_cast<Transform*>(memory_)[slot]; }
    const Transform& at(int slot) const noexcept { return reinterpret_cast<const Transform*>(memory_)[slot]; }
    Quat rotation(int slot) const noexcept { return slot < 0 ? Quat{} : at(slot).rotation; }
    Vec3 place(int slot) const noexcept { return at(slot).translation; }

  private:
    alignas(Transform) std::byte memory_[LegPaths::k_most * sizeof(Transform)];  // not worth constructing
};

void run_forward(const LegPaths& paths, std::span<const Transform> locals, LegModels& models) noexcept {
    for (std::size_t i = 0; i < static_cast<std::size_t>(paths.count); ++i) {
        const Transform& local = locals[static_cast<std::size_t>(paths.joint[i])];
        models.at(static_cast<int>(i)) = paths.parent[i] < 0 ? local : models.at(paths.parent[i]) * local;
    }
}

void solve_leg(const LegPaths& paths, std::size_t side, const LegModels& models, const Transform& foot,
               std::span<Transform> locals) noexcept {
    const LegPaths::Side& leg = paths.side[side];
    TwoBone in;
    in.hip = models.place(leg.upper);
    in.knee = models.place(leg.lower);
    in.ankle = models.place(leg.foot);
    in.target = foot.translation;
    in.knee_forward = rotate(models.rotation(leg.upper), leg.knee_forward);
    const TwoBoneResult solved = solve_two_bone(in);
    const auto local = [&](int slot) -> Quat& {
        return locals[static_cast<std::size_t>(paths.joint[static_cast<std::size_t>(slot)])].rotation;
    };
    local(leg.upper) =
        normalized(conjugate(models.rotation(leg.upper_parent)) * solved.upper * models.rotation(leg.upper));
    local(leg.lower) = normalized(conjugate(solved.upper * models.rotation(leg.lower_parent)) * solved.lower *
                                  models.rotation(leg.lower));
    local(leg.foot) = normalized(conjugate(solved.lower * models.rotation(leg.foot_parent)) * foot.rotation);
}

}  // namespace

LegPaths make_leg_paths(const Skeleton& skeleton, const Legs& legs, std::span<const Transform> standing) {
    LegPaths paths;
    std::vector<int> slot(skeleton.parents.size(), -1);
    for (int j = 0; j < skeleton.joint_count(); ++j) {
        if (!is_within(skeleton, legs.side[0].foot, j) && !is_within(skeleton, legs.side[1].foot, j)) continue;
        if (paths.count == LegPaths::k_most) return {};
        const auto at = static_cast<std::size_t>(paths.count);
        const int parent = skeleton.parents[static_cast<std::size_t>(j)];
        paths.joint[at] = static_cast<std::int16_t>(j);
        paths.parent[at] = static_cast<std::int16_t>(parent < 0 ? -1 : slot[static_cast<std::size_t>(parent)]);
        slot[static_cast<std::size_t>(j)] = paths.count++;
    }
    const auto slot_of = [&](int joint) { return joint < 0 ? -1 : slot[static_cast<std::size_t>(joint)]; };
    const auto parent_of = [&](int joint) { return slot_of(skeleton.parents[static_cast<std::size_t>(joint)]); };
    for (std::size_t s = 0; s < 2; ++s) {
        const Leg& leg = legs.side[s];
        paths.side[s] = {parent_of(leg.upper),
                         slot_of(leg.upper),
                         parent_of(leg.lower),
                         slot_of(leg.lower),
                         parent_of(leg.foot),
                         slot_of(leg.foot),
                         leg.toes,
                         knee_forward(leg, standing),
                         leg.heel,
                         leg.ball};
    }
    return paths;
}

std::string problem(const LegPaths& paths, const Skeleton& skeleton) {
    if (paths.count == 0) return {};
    if (paths.count < 0 || paths.count > LegPaths::k_most) return "the paths of the legs have a wrong number of joints";
    const auto in = [](int value, int least, int end) { return value >= least && value < end; };
    for (int i = 0; i < paths.count; ++i) {
        const auto slot = static_cast<std::size_t>(i);
        if (!in(paths.joint[slot], 0, skeleton.joint_count()) || !in(paths.parent[slot], -1, i))
            return "the paths of the legs name a joint that is not there";
    }
    for (const LegPaths::Side& leg : paths.side) {
        for (const int parent : {leg.upper_parent, leg.lower_parent, leg.foot_parent})
            if (!in(parent, -1, paths.count)) return "a leg hangs on nothing";
        for (const int slot : {leg.upper, leg.lower, leg.foot})
            if (!in(slot, 0, paths.count)) return "a leg is not among the paths of the legs";
        if (!in(leg.toes, k_no_joint, skeleton.joint_count())) return "the toes are no joint";
        for (const Vec3 v : {leg.knee_forward, leg.heel, leg.ball})
            if (!is_finite(v)) return "a knee or sole has no finite place";
    }
    return {};
}

Transform stand_on(const LegPaths::Side& leg, Quat rotation, Vec3 heel, Vec3 ball) noexcept {
    constexpr float k_level = 0.02f;  // [m] the two differ by less: it stands on both
    const float t = std::clamp(0.5f + 0.5f * (heel.y - ball.y) / k_level, 0.0f, 1.0f);
    return {rotation, lerp(heel - rotate(rotation, leg.heel), ball - rotate(rotation, leg.ball), t * t * (3 - 2 * t))};
}

void reach_feet(const LegPaths& paths, const std::array<FootGoal, 2>& feet, std::span<Transform> locals) noexcept {
    if (paths.count == 0) return;
    LegModels models;
    run_forward(paths, locals, models);
    for (std::size_t side = 0; side < 2; ++side) {
        solve_leg(paths, side, models, feet[side].foot, locals);
        if (paths.side[side].toes != k_no_joint)
            locals[static_cast<std::size_t>(paths.side[side].toes)].rotation = feet[side].toes;
    }
}

namespace {

/// A blend's feet, one side and step at a time.
class BlendedFeet {
  public:
    BlendedFeet(const LegPaths& paths, const FootBlend& blend) noexcept : paths_(paths), blend_(blend) {}

    /// False where one of the clips has no foot track.
    bool gather(std::span<const PackedClip> clips) noexcept {
        if (!surefoot::gather(clips, blend_, leaves_)) return false;
        pace_ = pace_of(leaves_, blend_);
        return true;
    }
    /// Goes over to a side, and returns its share of its step.
    float turn_to(std::size_t side) noexcept {
        strike_ = strike_phase(static_cast<Side>(side));
        const float after = blend_.phase - strike_;
        // Counted from well above zero, so that the step before the first one has a number too.
        constexpr std::uint32_t k_far = 27720;  // a multiple of every small cycle count
        step_ = blend_.cycle + k_far - (after < 0);
        surefoot::turn_to(side, step_, leaves_);
        side_ = side;
        return after < 0 ? after + 1 : after;
    }
    void turn_to_next_step() noexcept { surefoot::turn_to(side_, step_ + 1, leaves_); }
    float duty() const noexcept { return blended_duty(leaves_); }
    bool steps() const noexcept {
        for (const FootLeaf& leaf : leaves_.all())
            if (leaf.clip->cycles > 0) return true;
        return false;
    }
    /// The foot at a share of its step, as seen from the root at that moment.
    FootGoal at(float share) const noexcept {
        const FootKey key = mean_key(paths_.side[side_], leaves_, strike_, share);
        const RootFrame moved = integrate(blend_.velocity, blend_.turn, key.age / pace_);
        return {inverse(to_transform(moved)) * key.print, key.toes};
    }

  private:
    const LegPaths& paths_;
    const FootBlend& blend_;
    FootLeaves leaves_;
    float pace_ = 1, strike_ = 0;
    std::uint32_t step_ = 0;
    std::size_t side_ = 0;
};

}  // namespace

void blend_feet(const LegPaths& paths, std::span<const PackedClip> clips, const FootBlend& blend,
                std::span<Transform> locals) noexcept {
    if (paths.count == 0) return;
    BlendedFeet blended(paths, blend);
    if (!blended.gather(clips)) return;
    std::array<FootGoal, 2> feet;
    for (std::size_t side = 0; side < 2; ++side) {
        const float share = blended.turn_to(side);
        feet[side] = blended.at(share);
    }
    reach_feet(paths, feet, locals);
}

bool plan_feet(const LegPaths& paths, std::span<const PackedClip> clips, const FootBlend& blend,
               std::array<FootPlan, 2>& feet) noexcept {
    if (paths.count == 0) return false;
    BlendedFeet blended(paths, blend);
    if (!blended.gather(clips)) return false;
    for (std::size_t side = 0; side < 2; ++side) {
        FootPlan& foot = feet[side];
        foot.share = blended.turn_to(side);
        foot.now = blended.at(foot.share);
        foot.stance = blended.duty();
        foot.steps = blended.steps() && blend.phase_rate > 0;
        if (!foot.swings()) continue;
        blended.turn_to_next_step();
        const float middle = 0.5f * blended.duty(), ahead = (1 + middle - foot.share) / blend.phase_rate;
        foot.next = to_transform(integrate(blend.velocity, blend.turn, ahead)) * blended.at(middle).foot;
    }
    return true;
}

float sink_to_reach(const LegPaths& paths, const std::array<FootGoal, 2>& feet, float reach,
                    std::span<const Transform> locals) noexcept {
    LegModels models;
    run_forward(paths, locals, models);
    float sink = 0;
    for (std::size_t side = 0; side < 2; ++side) {
        const LegPaths::Side& leg = paths.side[side];
        const Vec3 hip = models.place(leg.upper), knee = models.place(leg.lower), ankle = feet[side].foot.translation;
        const float length = reach * (distance(hip, knee) + distance(knee, models.place(leg.foot)));
        const float level = planar_length(ankle - hip), square = length * length - level * level;
        if (square > 0) sink = std::max(sink, hip.y - ankle.y - std::sqrt(square));
    }
    return sink;
}

}  // namespace surefoot
