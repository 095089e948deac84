#include <surefoot/motion/interpolate.h>

#include <surefoot/analysis/analyze.h>
#include <surefoot/analysis/measure.h>
#include <surefoot/base/error.h>
#include <surefoot/motion/edit.h>
#include <surefoot/synthetic/synthetic_set.h>

#include <gtest/gtest.h>

namespace surefoot {
namespace {

AnalyzedClip generated(const std::string& name) {
    ClipSet set = make_synthetic_set();
    for (Motion& motion : set.clips)
        if (motion.name == name) return analyze_clip(std::move(motion), name);
    ADD_FAILURE() << name;
    return {};
}

std::vector<float> strikes(const ClipFacts& facts) {
    std::vector<float> left, right;
    for (const PhaseEvent& event : facts.events)
        if (event.kind == StrideEvent::strike) (event.foot == Side::left ? left : right).push_back(event.time);
    EXPECT_EQ(left.size(), 1u);
    EXPECT_EQ(right.size(), 1u);
    const float other = right[0] > left[0] ? right[0] : right[0] + facts.duration;
    return {left[0], other, left[0] + facts.duration};
}

PhasedClip phased(const AnalyzedClip& clip, float weight) { return {&clip.motion, strikes(clip.facts), weight}; }

ClipFacts measured(const Motion& motion, const AnalyzedClip& like) {
    EXPECT_EQ(problem(motion), "");
    ClipFacts facts = like.facts;
    measure(motion, like.roles.roles, like.legs, facts);
    return facts;
}

TEST(interpolate, halfway_between_walk_and_jog_goes_at_the_mean_speed_and_does_not_skate) {
    const AnalyzedClip walk = generated("walk"), jog = generated("jog");
    const PhasedClip clips[] = {phased(walk, 1), phased(jog, 1)};
    const ClipFacts facts = measured(interpolate(clips, 60), walk);
    EXPECT_NEAR(facts.speed, 0.5f * (walk.facts.speed + jog.facts.speed), 0.01f);
    const float stride = 0.5f * (walk.facts.stride + jog.facts.stride);
    EXPECT_NEAR(facts.duration, stride / facts.speed, 0.02f);
    EXPECT_LT(facts.skate, std::max(walk.facts.skate, jog.facts.skate) + 0.05f);
    EXPECT_NEAR(facts.turn, 0, 0.5f);
    EXPECT_LT(facts.loop_error, 1e-3f);
    ASSERT_EQ(std::count_if(facts.events.begin(), facts.events.end(),
                            [](const PhaseEvent& e) { return e.kind == StrideEvent::strike; }),
              2);  // one step of either foot: none doubled
}

TEST(interpolate, a_clip_that_starts_on_the_other_foot_blends_in_step) {
    const AnalyzedClip walk = generated("walk");
    AnalyzedClip shifted = walk;
    shifted.motion = rotate_cycle(walk.motion, walk.motion.frame_count() / 2);
    measure(shifted.motion, shifted.roles.roles, shifted.legs, shifted.facts);
    const PhasedClip clips[] = {phased(walk, 1), phased(shifted, 2)};
    const ClipFacts facts = measured(interpolate(clips, 60), walk);
    EXPECT_NEAR(facts.speed, walk.facts.speed, 0.01f);
    EXPECT_NEAR(facts.stride, walk.facts.stride, 0.02f);
    EXPECT_LT(facts.skate, walk.facts.skate + 0.02f);
}

TEST(interpolate, the_mean_of_a_left_and_a_right_turn_goes_straight) {
    const AnalyzedClip left = generated("walk_left"), right = generated("walk_right");
    const PhasedClip clips[] = {phased(left, 1), phased(right, 1)};
    const ClipFacts facts = measured(interpolate(clips, 60), left);
    EXPECT_NEAR(facts.turn, 0, 0.5f);
    EXPECT_NEAR(facts.speed, 0.5f * (left.facts.speed + right.facts.speed), 0.01f);
}

TEST(interpolate, an_idle_joins_without_dragging_the_rhythm) {
    const AnalyzedClip walk = generated("walk"), idle = generated("idle");
    const PhasedClip clips[] = {phased(walk, 1), {&idle.motion, {}, 1}};
    const ClipFacts facts = measured(interpolate(clips, 60), walk);
    EXPECT_NEAR(facts.speed, 0.5f * walk.facts.speed, 0.01f);
    EXPECT_NEAR(facts.duration, walk.facts.duration, 0.02f);
}

TEST(interpolate, a_walk_and_its_reverse_tread_on_the_spot_at_the_same_rhythm) {
    AnalyzedClip walk = generated("walk"), back = walk;
    back.motion = reverse(walk.motion);
    measure(back.motion, back.roles.roles, back.legs, back.facts);
    const PhasedClip clips[] = {phased(walk, 1), phased(back, 1)};
    const Motion march = interpolate(clips, 60);
    const ClipFacts facts = measured(march, walk);
    EXPECT_NEAR(facts.speed, 0, 0.02f);
    EXPECT_NEAR(march.duration(), walk.motion.duration(), 0.02f);
    EXPECT_LT(planar_length(march.root.back().position), 0.02f);
}

TEST(interpolate, what_does_not_fit_is_refused_by_name) {
    const AnalyzedClip walk = generated("walk");
    PhasedClip good = phased(walk, 1), short_one = good, none = good;
    short_one.marks.pop_back();
    none.weight = 0;
    const PhasedClip unlike[] = {good, short_one}, nothing[] = {none}, backward[] = {{&walk.motion, {0, 1, 0.5f}, 1}};
    EXPECT_THROW(interpolate(unlike, 60), Error);
    EXPECT_THROW(interpolate(nothing, 60), Error);
    EXPECT_THROW(interpolate(backward, 60), Error);
    EXPECT_THROW(interpolate({}, 60), Error);
}

TEST(retime, the_same_steps_in_less_time) {
    const AnalyzedClip walk = generated("walk");
    const Motion quick = retime(walk.motion, 1.2f);
    const ClipFacts facts = measured(quick, walk);
    EXPECT_NEAR(facts.speed, 1.2f * walk.facts.speed, 0.01f);
    EXPECT_NEAR(facts.stride, walk.facts.stride, 0.02f);
    EXPECT_NEAR(facts.cadence, 1.2f * walk.facts.cadence, 1.0f);
    EXPECT_NEAR(quick.fps, walk.motion.fps, 1.0f);
    // The same events at time / rate: whoever moves the marks by that finds them there.
    ASSERT_EQ(facts.events.size(), walk.facts.events.size());
    for (const PhaseEvent& was : walk.facts.events) {
        float nearest = 1;
        for (const PhaseEvent& is : facts.events)
            if (is.foot == was.foot && is.kind == was.kind)
                for (const float cycle : {-quick.duration(), 0.0f, quick.duration()})
                    nearest = std::min(nearest, std::fabs(is.time + cycle - was.time / 1.2f));
        EXPECT_LT(nearest, 1.5f / quick.fps);
    }
    EXPECT_THROW(retime(walk.motion, 1.3f), Error);
    EXPECT_THROW(retime(walk.motion, std::nanf("")), Error);
}

}  // namespace
}  // namespace surefoot
