#include <surefoot/analysis/analyze.h>
#include <surefoot/bake/character.h>
#include <surefoot/crowd/crowd.h>
#include <surefoot/ground/height_field.h>
#include <surefoot/synthetic/synthetic_set.h>

#include "tests/bake/synthetic_clips.h"
#include "tests/support/allocations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <numeric>

namespace surefoot {
namespace {

using test::allocation_count;

constexpr float k_dt = 1.0f / 60;

/// The synthetic set, baked: real legs, soles and footprints.
const Character& hero() {
    static const Character character = [] {
        std::vector<AnalyzedClip> clips;
        for (const Motion& motion : make_synthetic_set().clips) clips.push_back(analyze_clip(motion, motion.name));
        return bake_character(clips, test::spaces_for(clips), "hero");
    }();
    return character;
}

/// A plane, counted questions, and a hole.
class Slope final : public Ground {
  public:
    Slope(float slope_x, float slope_z) : x_(slope_x), z_(slope_z) {}
    void query(std::span<const GroundQuery> queries, std::span<GroundHit> hits) const noexcept override {
        asked += queries.size();
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const Vec3 at = queries[i].origin;
            hits[i] = {};
            hits[i].height = height(at);
            hits[i].normal = normalized(Vec3{-x_, 1, -z_});
            hits[i].hit = !hole && hits[i].height <= at.y + queries[i].up && hits[i].height >= at.y - queries[i].down;
        }
    }
    float height(Vec3 at) const noexcept { return x_ * at.x + z_ * at.z; }
    mutable std::size_t asked = 0;
    bool hole = false;

  private:
    float x_, z_;
};

/// Walkers of all speeds and headings.
struct Walkers {
    explicit Walkers(std::size_t n, const Ground* on = nullptr) : count(n), ground(on) {
        for (std::size_t c = 0; c < count; ++c) {
            const float share = static_cast<float>(c) / static_cast<float>(count);
            wishes[c].speed = 3 * share;
            wishes[c].turn = 20 * (static_cast<float>(c % 3) - 1);
            roots[c].yaw = 6 * share;
            roots[c].position = {10 * share - 5, 0, 20 + 10 * share};
            states[c].phase = 0.1f * static_cast<float>(c % 10);
            if (!ground) continue;
            const GroundQuery query{roots[c].position, 100, 100};
            GroundHit hit;
            ground->query({&query, 1}, {&hit, 1});
            roots[c].position.y = hit.height;
        }
    }
    Crowd crowd() {
        Crowd crowd{states, wishes, roots};
        crowd.periods = periods;
        crowd.frame = frame;
        crowd.locals = locals;
        crowd.ground = ground;
        crowd.feet = feet;
        return crowd;
    }
    void step(CrowdScratch& scratch, std::size_t range = 1000) {
        for (std::size_t first = 0; first < count; first += range)
            evaluate(hero().graph, crowd(), {first, std::min(range, count - first)}, k_dt, scratch);
        ++frame;
    }
    /// Heel and ball of a foot, world.
    std::array<Vec3, 2> sole(std::size_t character, std::size_t side) const {
        std::vector<Transform> models(joints);
        local_to_model(*hero().skeleton, std::span(locals).subspan(character * joints, joints), models);
        const Leg& leg = hero().legs.side[side];
        const Transform foot = to_transform(roots[character]) * models[static_cast<std::size_t>(leg.foot)];
        return {transform_point(foot, leg.heel), transform_point(foot, leg.ball)};
    }
    /// A foot's share of its step.
    float share(std::size_t character, std::size_t side) const {
        const float after = states[character].phase - (side == 0 ? 0.0f : 0.5f);
        return after < 0 ? after + 1 : after;
    }

    std::size_t count, joints = hero().skeleton->rest.size();
    const Ground* ground;
    std::vector<LocomotionState> states = std::vector<LocomotionState>(count);
    std::vector<LocomotionRequest> wishes = std::vector<LocomotionRequest>(count);
    std::vector<RootFrame> roots = std::vector<RootFrame>(count);
    std::vector<Transform> locals = std::vector<Transform>(count * joints);
    std::vector<CrowdFeet> feet = std::vector<CrowdFeet>(count);
    std::vector<std::uint8_t> periods;
    std::uint32_t frame = 0;
};

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

constexpr std::size_t k_first = 30;  // frames in which those who appear in mid-stride find their feet
bool is_mid_stance(float share) { return share > 0.12f && share < 0.22f; }

TEST(CrowdFeet, on_level_ground_are_where_they_are_without_any) {
    const Slope level(0, 0);
    Walkers with(24, &level), without(24);
    CrowdScratch scratch(hero().graph);
    float worst = 0;
    for (std::size_t frame = 0; frame < 120; ++frame) {
        with.step(scratch);
        without.step(scratch);
        for (std::size_t c = 0; c < with.count; ++c)
            for (std::size_t side = 0; side < 2; ++side)
                for (std::size_t k = 0; k < 2; ++k)
                    worst = std::max(worst, distance(with.sole(c, side)[k], without.sole(c, side)[k]));
    }
    EXPECT_LT(worst, 0.01f);  // bodies sink a little for legs that stretch
    EXPECT_GT(level.asked, 24u * 60);
}

TEST(CrowdFeet, stand_flat_on_slopes_and_as_still_as_on_the_level) {
    const Slope slope(0.15f, -0.2f), level(0, 0);
    const auto measured = [](const Slope& ground, float& off, float& skate) {
        Walkers walkers(30, &ground);
        CrowdScratch scratch(hero().graph);
        std::vector<std::array<Vec3, 2>> last(walkers.count * 2);
        std::vector<bool> stood(last.size(), false);
        int soles = 0, moves = 0;
        off = skate = 0;
        for (std::size_t frame = 0; frame < 300; ++frame) {
            walkers.step(scratch);
            for (std::size_t i = 0; i < last.size(); ++i) {
                const std::array<Vec3, 2> sole = walkers.sole(i / 2, i % 2);
                const bool stands = frame > k_first && is_mid_stance(walkers.share(i / 2, i % 2));
                for (const Vec3 p : sole)
                    if (stands) off += std::fabs(p.y - ground.height(p)), ++soles;
                if (stands && stood[i]) skate += planar_length(sole[1] - last[i][1]) / k_dt, ++moves;
                last[i] = sole;
                stood[i] = stands;
            }
        }
        off /= static_cast<float>(soles);
        skate /= static_cast<float>(moves);
    };
    float off, skate, level_off, level_skate;
    measured(slope, off, skate);
    measured(level, level_off, level_skate);
    RecordProperty("mean_off_cm", std::to_string(100 * off));
    RecordProperty("level_off_cm", std::to_string(100 * level_off));
    EXPECT_LT(off, level_off + 0.003f);
    EXPECT_LT(skate, level_skate + 0.02f);
}

TEST(CrowdFeet, go_over_hills_without_sinking_in) {
    const HeightField hills = make_hills();
    Walkers walkers(40, &hills);
    CrowdScratch scratch(hero().graph);
    float lowest = 0, off = 0;
    int soles = 0;
    for (std::size_t frame = 0; frame < 400; ++frame) {
        walkers.step(scratch);
        for (std::size_t c = 0; frame > k_first && c < walkers.count; ++c)
            for (std::size_t side = 0; side < 2; ++side)
                for (const Vec3 p : walkers.sole(c, side)) {
                    GroundQuery query{p, 2, 2};
                    GroundHit hit;
                    hills.query({&query, 1}, {&hit, 1});
                    lowest = std::min(lowest, p.y - hit.height);
                    if (!is_mid_stance(walkers.share(c, side))) continue;
                    off += std::fabs(p.y - hit.height);
                    ++soles;
                }
    }
    EXPECT_GT(lowest, -0.04f);
    EXPECT_LT(off / static_cast<float>(soles), 0.01f);
}

TEST(CrowdFeet, bodies_follow_the_ground_smoothly) {
    const HeightField hills = make_hills();
    Walkers walkers(20, &hills);
    CrowdScratch scratch(hero().graph);
    std::vector<float> before(walkers.count), before_that(walkers.count);
    float most = 0;
    for (std::size_t frame = 0; frame < 300; ++frame) {
        walkers.step(scratch);
        for (std::size_t c = 0; c < walkers.count; ++c) {
            const float y = walkers.roots[c].position.y;
            if (frame > k_first) most = std::max(most, std::fabs(y - 2 * before[c] + before_that[c]) / (k_dt * k_dt));
            before_that[c] = before[c];
            before[c] = y;
        }
    }
    EXPECT_LT(most, 20.0f);  // [m/s^2] twice what a jump has
    EXPECT_GT(most, 0.5f);
}

TEST(CrowdFeet, a_stand_is_asked_for_once_and_again_when_it_is_moved) {
    const Slope slope(0.1f, 0.1f);
    Walkers walkers(1, &slope);
    walkers.wishes[0] = {};
    CrowdScratch scratch(hero().graph);
    slope.asked = 0;
    walkers.step(scratch);
    EXPECT_EQ(slope.asked, 2u);
    for (int frame = 0; frame < 20; ++frame) walkers.step(scratch);
    EXPECT_EQ(slope.asked, 2u);
    walkers.roots[0].position.x += 1;  // a host that carries it elsewhere
    for (int frame = 0; frame < 60; ++frame) walkers.step(scratch);
    EXPECT_EQ(slope.asked, 4u);
    for (std::size_t side = 0; side < 2; ++side)
        for (const Vec3 p : walkers.sole(0, side)) EXPECT_NEAR(p.y, slope.height(p), 0.02f);
}

TEST(CrowdFeet, ranges_periods_and_roll_back_change_no_bit) {
    const HeightField hills = make_hills();
    Walkers whole(53, &hills), cut(53, &hills);
    for (Walkers* w : {&whole, &cut})
        for (std::size_t c = 0; c < w->count; ++c) w->periods.push_back(static_cast<std::uint8_t>(c % 4));
    CrowdScratch scratch(hero().graph);
    for (int frame = 0; frame < 40; ++frame) {
        whole.step(scratch);
        cut.step(scratch, 7);
    }
    EXPECT_TRUE(same_bytes(whole.locals, cut.locals));
    EXPECT_TRUE(same_bytes(whole.roots, cut.roots));
    EXPECT_TRUE(same_bytes(whole.feet, cut.feet));
    const auto states = whole.states;
    const auto roots = whole.roots;
    const auto feet = whole.feet;
    const std::uint32_t at = whole.frame;
    for (int frame = 0; frame < 40; ++frame) whole.step(scratch);
    const auto wanted = whole.locals;
    whole.states = states, whole.roots = roots, whole.feet = feet, whole.frame = at;
    for (int frame = 0; frame < 40; ++frame) whole.step(scratch);
    EXPECT_TRUE(same_bytes(whole.locals, wanted));
}

TEST(CrowdFeet, where_there_is_no_ground_the_last_one_goes_on) {
    Slope slope(0, 0.1f);
    Walkers walkers(8, &slope);
    CrowdScratch scratch(hero().graph);
    for (int frame = 0; frame < 30; ++frame) walkers.step(scratch);
    slope.hole = true;
    const float before = walkers.roots[5].position.y;
    for (int frame = 0; frame < 120; ++frame) walkers.step(scratch);
    for (const RootFrame& root : walkers.roots) EXPECT_TRUE(std::isfinite(root.position.y));
    EXPECT_NEAR(walkers.roots[5].position.y, before, 0.15f);
}

TEST(CrowdFeet, without_ground_are_to_the_bit_those_of_one_alone) {
    Walkers walkers(27);  // idles of one clip among them
    CrowdScratch scratch(hero().graph);
    std::vector<LocomotionState> alone = walkers.states;
    std::vector<Transform> locals(walkers.joints);
    for (int frame = 0; frame < 40; ++frame) {
        walkers.step(scratch);
        for (std::size_t c = 0; c < walkers.count; ++c) {
            pose(hero().graph, update(hero().graph, alone[c], walkers.wishes[c], k_dt), locals);
            ASSERT_EQ(
                std::memcmp(locals.data(), &walkers.locals[c * walkers.joints], locals.size() * sizeof(Transform)), 0)
                << "character " << c;
        }
    }
}

TEST(CrowdFeet, allocate_nothing) {
    const HeightField hills = make_hills();
    Walkers walkers(24, &hills);
    CrowdScratch scratch(hero().graph);
    walkers.step(scratch);
    const long before = allocation_count();
    for (int frame = 0; frame < 20; ++frame) walkers.step(scratch);
    EXPECT_EQ(allocation_count(), before);
}

}  // namespace
}  // namespace surefoot
