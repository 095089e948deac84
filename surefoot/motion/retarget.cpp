#include <surefoot/base/error.h>
#include <surefoot/ik/two_bone.h>
#include <surefoot/motion/low_pass.h>
#include <surefoot/motion/retarget.h>
#include <surefoot/motion/retarget_turns.h>

#include <algorithm>

namespace surefoot {
namespace {

// [share of the leg's length] Sole points this much higher than the lowest one count a quarter in placing the foot.
constexpr float k_contact_height = 0.022f;
// [share of the leg's length] Hips sink no further than this: a leg that is still too short takes its foot along.
constexpr float k_deepest = 0.06f;
constexpr float k_most_rise = 25 * k_radians_per_degree;  // of a heel, beyond what the source's does

constexpr Vec3 k_left{1, 0, 0}, k_ahead{0, 0, 1};

std::size_t at(int i) { return static_cast<std::size_t>(i); }
Vec3 level(Vec3 v) { return {v.x, 0, v.z}; }

void need_legs(const RetargetBody& body, const char* which) {
    std::string missing;
    for (const Role role : {Role::hips, Role::left_upper_leg, Role::left_lower_leg, Role::left_foot,
                            Role::right_upper_leg, Role::right_lower_leg, Role::right_foot})
        if (!body.roles.has(role)) missing += (missing.empty() ? "" : ", ") + std::string(role_name(role));
    if (!missing.empty())
        throw Error(std::string("the ") + which + "'s skeleton has no joint for " + missing, {},
                    "name the joints by hand (role=joint)");
    if (!(body.legs[Side::left].length() > 1e-4f) || !(body.legs[Side::right].length() > 1e-4f))
        throw Error(std::string("the ") + which + "'s legs have no length", {}, "export it with its bone offsets");
}

float leg_length(const RetargetBody& body) {
    return 0.5f * (body.legs[Side::left].length() + body.legs[Side::right].length());
}

/// What of a body the feet are placed by.
struct Measures {
    float half_hips = 0;                          // [m] from the middle of the hip joints to one of them
    Vec3 hip_middle;                              // [m] of the hip joints, hips' frame
    float ankle = 0;                              // [m] above the sole of a flat foot, mean of both
    std::array<std::array<float, 3>, 2> reach{};  // [m] heel, ball and tip ahead of the ankle in a flat foot
};

Measures measure(const RetargetBody& body, const std::vector<Quat>& stance) {
    const std::vector<Transform> shape = shape_pose(body);
    const Legs& legs = body.legs;
    Measures m;
    const Vec3 left = shape[at(legs[Side::left].upper)].translation,
               right = shape[at(legs[Side::right].upper)].translation;
    m.half_hips = 0.5f * distance(left, right);
    m.hip_middle = transform_point(inverse(shape[at(legs.hips)]), (left + right) / 2);
    for (std::size_t s = 0; s < 2; ++s) {
        const Leg& leg = legs.side[s];
        const Quat foot = stance[at(leg.foot)];
        m.ankle -= 0.5f * rotate(foot, leg.ball).y;
        Vec3 tip = rotate(foot, leg.toe_tip);
        if (leg.toes != k_no_joint) {
            const Vec3 joint = transform_point(inverse(shape[at(leg.foot)]), shape[at(leg.toes)].translation);
            tip = rotate(foot, joint) + rotate(stance[at(leg.toes)], leg.toe_tip);
        }
        m.reach[s] = {rotate(foot, leg.heel).z, rotate(foot, leg.ball).z, tip.z};
    }
    return m;
}

using Sole = std::array<Vec3, 3>;  // heel, ball, tip
Sole sole_of(const Leg& leg, const std::vector<Transform>& models) {
    const Transform& toes = models[at(leg.toes == k_no_joint ? leg.foot : leg.toes)];
    const SolePoints points = sole_points(leg, models[at(leg.foot)], toes);
    return {points.heel, points.ball, points.toe_tip};
}
float lowest(const Sole& sole) { return std::min({sole[0].y, sole[1].y, sole[2].y}); }

/// 1 for a point on the ground, falling to 0 within a few hundredths of the leg's length above it.
float contact(float height, float leg_length) {
    const float up = std::max(0.0f, height) / (k_contact_height * leg_length), fall = 1 / (1 + up * up);
    return fall * fall;
}

/// Smoothed so that it is nowhere below `need`: the largest in a window, averaged over that window.
std::vector<double> smooth_cover(const std::vector<double>& need, double sigma, bool cyclic) {
    const int count = static_cast<int>(need.size()), reach = static_cast<int>(3 * sigma) + 1, period = count - 1;
    std::vector<double> peak(need.size());
    for (int f = 0; f < count; ++f)
        for (int k = f - reach; k <= f + reach; ++k) {
            const int i = cyclic && period > 0 ? ((k % period) + period) % period : std::clamp(k, 0, count - 1);
            peak[at(f)] = std::max(peak[at(f)], need[at(i)]);
        }
    return cyclic && period > 0 ? low_pass_periodic(peak, period, 0, sigma) : low_pass(peak, sigma);
}

/// How a foot is put down; vectors in root space.
struct Foothold {
    Vec3 ankle;                      // [m] where it shall be
    Vec3 left;                       // the foot's own, level
    Vec3 pivot;                      // [m] from the ankle: what of the foot's front is on the ground
    float heel_up = 0, ball_up = 0;  // 0 on the ground, 1 clear of it
};

class Retargeter {
  public:
    Retargeter(const RetargetBody& source, const RetargetBody& target, const RetargetOptions& options)
        : source_(source),
          target_(target),
          options_(options),
          turns_(source, target),
          from_(measure(source, turns_.source_stance())),
          to_(measure(target, turns_.target_stance())),
          scale_(leg_length(target) / leg_length(source)),
          models_(source.skeleton->rest.size()),
          rotations_(target.skeleton->rest.size()),
          placed_(target.skeleton->rest.size()) {}

    Motion run(const Motion& motion, RetargetReport* report) {
        Motion result = make_motion(target_.skeleton, motion.name, motion.frame_count(), motion.fps);
        result.cyclic = motion.cyclic;
        std::vector<std::array<Vec3, 2>> ankles;
        std::vector<double> need;
        for (int f = 0; f < motion.frame_count(); ++f) {
            const RootFrame& root = motion.root[at(f)];
            result.root[at(f)] = {root.position * scale_, root.yaw};
            ankles.emplace_back();
            need.push_back(static_cast<double>(pose(motion.frame(f), result.frame(f), ankles.back())));
        }
        float most = 0;
        if (*std::max_element(need.begin(), need.end()) > 0) {
            const auto sigma = static_cast<double>(options_.sink_smoothing) * static_cast<double>(motion.fps);
            need = smooth_cover(need, sigma, motion.cyclic);
        }
        for (int f = 0; f < motion.frame_count(); ++f) {
            const auto sink = static_cast<float>(std::max(0.0, need[at(f)]));
            most = std::max(most, sink);
            plant(result.frame(f), sink, ankles[at(f)]);
            if (f > 0)  // one sign of a quaternion throughout
                for (std::size_t j = 0; j < rotations_.size(); ++j)
                    result.frame(f)[j].rotation = aligned(result.frame(f)[j].rotation, result.frame(f - 1)[j].rotation);
        }
        if (report) *report = {scale_, most};
        return result;
    }

  private:
    /// Turns the target's joints as the source's and sets its hips. Fills where the ankles shall be, and returns by how
    /// much the hips must sink for the legs to reach them.
    float pose(std::span<const Transform> locals, std::span<Transform> out, std::array<Vec3, 2>& ankles) {
        local_to_model(*source_.skeleton, locals, models_);
        turns_.turn(locals, models_, rotations_);
        const Skeleton& skeleton = *target_.skeleton;
        for (std::size_t j = 0; j < out.size(); ++j) {
            const int parent = skeleton.parents[j];
            out[j].rotation = parent == k_no_joint ? rotations_[j] : conjugate(rotations_[at(parent)]) * rotations_[j];
            out[j].rotation = normalized(out[j].rotation);
        }
        place_hips(out);
        local_to_model(skeleton, out, placed_);
        float sink = 0;
        for (std::size_t s = 0; s < 2; ++s) {
            Foothold foothold = find_foothold(s);
            raise_heel(s, foothold, out);
            ankles[s] = foothold.ankle;
            sink = std::max(sink, shortfall(s, ankles[s]));
        }
        return sink;
    }

    void place_hips(std::span<Transform> out) {
        const std::size_t theirs = at(source_.legs.hips), ours = at(target_.legs.hips);
        Vec3 middle = transform_point(models_[theirs], from_.hip_middle);
        middle = {scale_ * middle.x, to_.ankle + scale_ * (middle.y - from_.ankle), scale_ * middle.z};
        const Transform model{rotations_[ours], middle - rotate(rotations_[ours], to_.hip_middle)};
        local_to_model(*target_.skeleton, out, placed_);
        const int parent = target_.skeleton->parents[ours];
        out[ours] = parent == k_no_joint ? model : inverse(placed_[at(parent)]) * model;
        out[ours].rotation = normalized(out[ours].rotation);
    }

    /// Where the target's ankle shall be: each of its sole points asks for the place where the source's is, scaled, and
    /// moved in the flat foot's own frame by what the feet differ in size and the hips in width; the lower the point,
    /// the more it counts. A foot that stands does not turn about the vertical, so what does not slide does not start
    /// to.
    Foothold find_foothold(std::size_t s) const {
        const Leg &theirs = source_.legs.side[s], &ours = target_.legs.side[s];
        const Sole from = sole_of(theirs, models_), to = sole_of(ours, placed_);
        const Transform foot = placed_[at(ours.foot)];
        const Vec3 left = normalized(level(rotate(turns_.source_turn(theirs.foot, models_), k_left)), k_left);
        const Vec3 ahead = cross(left, k_up);
        const float wider = (s == 0 ? 1.0f : -1.0f) * (to_.half_hips - scale_ * from_.half_hips);

        const float low = lowest(from);
        Vec3 sum;
        float weight = 0;
        Sole about;  // the ankle
        std::array<float, 3> down{};
        for (std::size_t i = 0; i < from.size(); ++i) {
            const float w = down[i] = contact(from[i].y - low, theirs.length());
            about[i] = to[i] - foot.translation;
            const Vec3 place = from[i] * scale_ + ahead * (to_.reach[s][i] - scale_ * from_.reach[s][i]) + left * wider;
            sum += (place - about[i]) * w;
            weight += w;
        }
        Foothold result{sum / weight, left, {}, 1 - down[0], ours.toes == k_no_joint ? 1 : 1 - down[1]};
        result.ankle.y += std::max(0.0f, std::min(0.0f, scale_ * low) - (lowest(about) + result.ankle.y));
        result.pivot = lerp(about[1], about[2], result.ball_up);
        return result;
    }

    /// Where the hip is too far from a foot that rolls over its ball or toes, the heel rises a little more, as it does
    /// in anyone whose feet are short for their stride.
    void raise_heel(std::size_t s, Foothold& foothold, std::span<Transform> out) {
        const Leg& ours = target_.legs.side[s];
        const Vec3 hip = placed_[at(ours.upper)].translation;
        const float reach = reach_of(s), most = k_most_rise * foothold.heel_up * foothold.heel_up;
        const auto ankle_at = [&](float angle) {
            return foothold.ankle + foothold.pivot - rotate(axis_angle(foothold.left, angle), foothold.pivot);
        };
        if (distance(hip, foothold.ankle) <= reach || distance(hip, ankle_at(most)) >= distance(hip, foothold.ankle))
            return;
        float low = 0, high = most;
        if (distance(hip, ankle_at(most)) > reach) low = most;
        for (int i = 0; i < 16 && low < high; ++i) {
            const float middle = 0.5f * (low + high);
            (distance(hip, ankle_at(middle)) > reach ? low : high) = middle;
        }
        const Quat turn = axis_angle(foothold.left, high);
        turn_local(out, ours.foot, {}, turn * placed_[at(ours.foot)].rotation);
        if (ours.toes != k_no_joint)  // which stay on the ground while the ball does
            turn_local(out, ours.toes, turn,
                       axis_angle(foothold.left, high * foothold.ball_up) * placed_[at(ours.toes)].rotation);
        foothold.ankle = ankle_at(high);
    }

    /// [m] to which a leg may stretch: as far as the options say, or as the source's does in this frame.
    float reach_of(std::size_t s) const {
        const Leg& theirs = source_.legs.side[s];
        const float stretched =
            distance(models_[at(theirs.upper)].translation, models_[at(theirs.foot)].translation) / theirs.length();
        return target_.legs.side[s].length() * std::clamp(stretched, options_.straightest_leg, 1.0f);
    }

    /// By how much the hip must come down for a leg on the ground to reach [m]; one in the air may fall short.
    float shortfall(std::size_t s, Vec3 ankle) const {
        const Leg &theirs = source_.legs.side[s], &ours = target_.legs.side[s];
        const float reach = reach_of(s);
        const Vec3 line = placed_[at(ours.upper)].translation - ankle;
        if (length(line) <= reach) return 0;
        const float across = planar_length(line);
        const float above = across < reach ? std::sqrt(reach * reach - across * across) : 0.0f;
        const float need = std::clamp(line.y - above, 0.0f, k_deepest * ours.length());
        return need * contact(lowest(sole_of(theirs, models_)), theirs.length());
    }

    /// Sinks the hips and puts the ankles where they shall be.
    void plant(std::span<Transform> out, float sink, const std::array<Vec3, 2>& ankles) {
        const Skeleton& skeleton = *target_.skeleton;
        const int parent = skeleton.parents[at(target_.legs.hips)];
        local_to_model(skeleton, out, placed_);
        const Quat to_parent = parent == k_no_joint ? Quat{} : conjugate(placed_[at(parent)].rotation);
        out[at(target_.legs.hips)].translation += rotate(to_parent, {0, -sink, 0});
        local_to_model(skeleton, out, placed_);
        for (std::size_t s = 0; s < 2; ++s) {
            const Leg& leg = target_.legs.side[s];
            const Quat upper = placed_[at(leg.upper)].rotation, lower = placed_[at(leg.lower)].rotation;
            TwoBone bones;
            bones.hip = placed_[at(leg.upper)].translation;
            bones.knee = placed_[at(leg.lower)].translation;
            bones.ankle = placed_[at(leg.foot)].translation;
            bones.target = ankles[s];
            bones.knee_forward = rotate(upper * conjugate(turns_.target_stance()[at(leg.upper)]), k_ahead);
            bones.soft_extension = std::max(bones.soft_extension, options_.straightest_leg);
            const TwoBoneResult bent = solve_two_bone(bones);
            // A joint takes its model rotation; what lies between it and the one above keeps its own bend.
            const Quat foot = placed_[at(leg.foot)].rotation;
            turn_local(out, leg.upper, {}, bent.upper * upper);
            turn_local(out, leg.lower, bent.upper, bent.lower * lower);
            turn_local(out, leg.foot, bent.lower, foot);
        }
    }

    /// Gives a joint the model rotation `model`, where its parent was turned by `parent_turn` since placed_.
    void turn_local(std::span<Transform> out, int joint, Quat parent_turn, Quat model) const {
        const int parent = target_.skeleton->parents[at(joint)];
        const Quat above = parent == k_no_joint ? Quat{} : parent_turn * placed_[at(parent)].rotation;
        out[at(joint)].rotation = normalized(conjugate(above) * model);
    }

    const RetargetBody &source_, &target_;
    const RetargetOptions& options_;
    RetargetTurns turns_;
    Measures from_, to_;
    float scale_;
    std::vector<Transform> models_;  // the source's
    std::vector<Quat> rotations_;    // the target's, in model space
    std::vector<Transform> placed_;  // the target's
};

}  // namespace

Motion retarget(const Motion& motion, const RetargetBody& source, const RetargetBody& target,
                const RetargetOptions& options, RetargetReport* report) {
    need_legs(source, "source");
    need_legs(target, "target");
    return Retargeter(source, target, options).run(motion, report);
}

}  // namespace surefoot
