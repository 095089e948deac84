#include <surefoot/graph/foot_lanes.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

static_assert(sizeof(FootKey) == 12 * sizeof(float), "kernels see a key as print, toes and age");
static_assert(sizeof(Transform) == 7 * sizeof(float), "kernels see a transform as qx qy qz qw tx ty tz");
static_assert(k_leg_joints == LegPaths::k_most);

void FootMeans::begin(const LegPaths::Side& leg, const FootBlend& blend, float pace, float ahead,
                      FootGoal& answer) noexcept {
    const int lane = lanes_;
    const auto set = [lane](float(&to)[3][k_foot_lanes], Vec3 v) noexcept {
        to[0][lane] = v.x;
        to[1][lane] = v.y;
        to[2][lane] = v.z;
    };
    set(feet_.heel, leg.heel);
    set(feet_.ball, leg.ball);
    set(feet_.velocity, blend.velocity);
    feet_.turn[lane] = blend.turn;
    feet_.pace[lane] = pace;
    feet_.ahead[lane] = ahead;
    answers_[lane] = &answer;
    counts_[lane] = 0;
}

void FootMeans::add(const PackedClip& clip, Side side, float time, float weight, float say) noexcept {
    const int lane = lanes_, at = counts_[lane]++;
    most_ = std::max(most_, counts_[lane]);
    auto& made = *reinterpret_cast<FootKey*>(made_[at][lane].memory);
    const FootKeyPlace keys = foot_key_place(clip, side, time, made);
    FootLeafLanes& leaf = leaves_[at];
    leaf.from[lane] = &keys.from->print.rotation.x;
    leaf.to[lane] = &keys.to->print.rotation.x;
    leaf.share[lane] = keys.share;
    leaf.weight[lane] = weight;
    leaf.stepping[lane] = clip.cycles > 0 ? weight : 0.0f;
    leaf.say[lane] = say;
}

void FootMeans::answer_all() noexcept {
    static constexpr float k_idle[k_key_floats] = {0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0};
    const int used = lanes_;
    FootGoal unused;
    if (used == 0) return;
    for (; lanes_ < k_foot_lanes; ++lanes_) begin({}, {}, 1, 0, unused);
    for (int lane = 0; lane < k_foot_lanes; ++lane)
        for (int at = counts_[lane]; at < most_; ++at) {
            FootLeafLanes& leaf = leaves_[at];
            leaf.from[lane] = leaf.to[lane] = k_idle;
            leaf.share[lane] = leaf.weight[lane] = leaf.stepping[lane] = leaf.say[lane] = 0;
        }
    KernelBuilds<FootKernels>::fastest().mean_feet(leaves_, most_, feet_);
    for (int lane = 0; lane < used; ++lane) {
        const auto& f = feet_.foot;
        const auto& t = feet_.toes;
        *answers_[lane] = {{{f[0][lane], f[1][lane], f[2][lane], f[3][lane]}, {f[4][lane], f[5][lane], f[6][lane]}},
                           {t[0][lane], t[1][lane], t[2][lane], t[3][lane]}};
    }
    lanes_ = most_ = 0;
}

int LegLanes::add(std::span<Transform> locals) noexcept {
    joints_ = static_cast<int>(locals.size());
    locals_[2 * count_] = locals_[2 * count_ + 1] = &locals[0].rotation.x;
    return count_++;
}

/// Idle lanes compute, and write, what the first pose does.
void LegLanes::repeat_first() noexcept {
    for (int lane = 2 * count_; lane < k_foot_lanes; ++lane) {
        locals_[lane] = locals_[0];
        const int first = lane % 2;
        for (auto& row : goals_.foot) row[lane] = row[first];
        for (auto& row : goals_.toes) row[lane] = row[first];
    }
}

void LegLanes::run_forward() noexcept {
    for (int lane = 2 * count_; lane < k_foot_lanes; ++lane) locals_[lane] = locals_[0];
    KernelBuilds<FootKernels>::fastest().run_forward(chains_, locals_, joints_, models_);
}

void LegLanes::sink_to_reach(float share, float (&sinks)[k_foot_lanes]) noexcept {
    repeat_first();
    KernelBuilds<FootKernels>::fastest().sink(chains_, models_, goals_, share, sinks);
}

BlendedLeg LegLanes::pose(int pose, std::size_t side) const noexcept {
    const auto lane = 2 * static_cast<std::size_t>(pose) + side;
    const auto place = [&](int joint) noexcept {
        const float* at = models_ + static_cast<std::size_t>(joint) * k_model_floats + 4 * k_foot_lanes + lane;
        return Vec3{at[0], at[k_foot_lanes], at[2 * k_foot_lanes]};
    };
    return {place(chains_.upper), place(chains_.lower), place(chains_.count - 1)};
}

void LegLanes::set_goals(int pose, const std::array<FootGoal, 2>& feet) noexcept {
    for (std::size_t side = 0; side < 2; ++side) {
        const std::size_t lane = 2 * static_cast<std::size_t>(pose) + side;
        const Quat q = feet[side].foot.rotation, toes = feet[side].toes;
        const Vec3 p = feet[side].foot.translation;
        const float foot_floats[7] = {q.x, q.y, q.z, q.w, p.x, p.y, p.z},
                    toe_floats[4] = {toes.x, toes.y, toes.z, toes.w};
        for (std::size_t k = 0; k < 7; ++k) goals_.foot[k][lane] = foot_floats[k];
        for (std::size_t k = 0; k < 4; ++k) goals_.toes[k][lane] = toe_floats[k];
    }
}

void LegLanes::reach() noexcept {
    repeat_first();
    KernelBuilds<FootKernels>::fastest().reach(chains_, models_, goals_, locals_);
}

}  // namespace surefoot
