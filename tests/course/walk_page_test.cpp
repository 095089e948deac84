#include <surefoot/course/walk_page.h>
#include <surefoot/host/parallel.h>

#include "generated_walker.h"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot {
namespace {

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
    return count;
}

std::vector<WalkInfo> small_plan() {
    SweepRequest request;
    request.courses = {"hills", "stairs_up"};
    request.paths = {"straight"};
    request.speeds_mps = {1.4f};
    request.reverse = {false};
    request.seconds = 6;
    return plan_sweep(request);
}

const std::vector<SweptWalk>& walks() {
    static const std::vector<SweptWalk> walks = sweep(small_plan(), walk_generated);
    return walks;
}

TEST(WalkPage, has_a_row_and_plots_for_every_walk_and_refers_to_nothing_else) {
    const std::string page = walk_page("biped <1>", walks());
    EXPECT_NE(page.find("biped &lt;1&gt;"), std::string::npos);
    EXPECT_EQ(count_of(page, "<tr class=\"judged\">"), 2U);
    EXPECT_EQ(count_of(page, "<tr class=\"compared\">"), 4U);
    EXPECT_EQ(count_of(page, "<svg class=\"walk-plot\""), 2U);
    for (const char* outside : {"http://", "https://", "<link", "<img", " src=", "@import", "url("})
        EXPECT_EQ(page.find(outside), std::string::npos) << outside;
    EXPECT_EQ(page.find("style=\""), std::string::npos) << "inline styles do not work here";
    EXPECT_EQ(page.find("nan"), std::string::npos);
    EXPECT_EQ(count_of(page, "<script>"), 1U);
    EXPECT_EQ(count_of(page, "<style>"), 2U);
    EXPECT_EQ(count_of(page.substr(0, page.find("<title>")), "'sha256-"), 3U);
}

TEST(WalkPage, shows_misses_by_mark_and_class_and_only_where_there_are_some) {
    std::vector<SweptWalk> bad{walks()[0]};
    for (MeasuredWalk& row : bad[0].rows) row.metrics = {};
    for (MeasuredWalk& row : bad[0].rows) row.metrics.planted_samples = 1, row.metrics.knee_min_deg = 90;
    EXPECT_EQ(count_of(walk_page("biped", bad), "class=\"miss\""), 0U);
    bad[0].rows[0].metrics.hip_jerk_ratio = 9.75;
    EXPECT_EQ(count_of(walk_page("biped", bad), "class=\"miss\""), 0U) << "without foot placement nothing is judged";
    bad[0].rows[2].metrics.hip_jerk_ratio = 9.75;
    const std::string page = walk_page("biped", bad);
    EXPECT_NE(page.find("<td class=\"miss\">✗ 1</td>"), std::string::npos) << "summary";
    EXPECT_NE(page.find("<td class=\"miss\">✗ 9.75</td>"), std::string::npos) << "table";
    EXPECT_NE(page.find("<span class=\"miss\">✗ hip jerk 9.75</span>"), std::string::npos) << "plots";
}

TEST(WalkPage, has_the_same_bytes_with_one_thread_and_with_eight) {
    const auto page = [](int threads) {
        set_thread_count(threads);
        const std::vector<SweptWalk> swept = sweep(small_plan(), walk_generated);
        const std::optional<ColvinStudy> study = study_colvin(swept, walk_generated);
        return walk_page("biped", swept, &*study);
    };
    const std::string one = page(1), eight = page(8);
    set_thread_count(0);
    EXPECT_TRUE(one == eight);
}

TEST(WalkPage, draws_the_papers_figures_where_mode_colvin2013_walked_hills) {
    const std::optional<ColvinStudy> study = study_colvin(walks(), walk_generated);
    ASSERT_TRUE(study);
    const std::string page = walk_page("biped", walks(), &*study);
    for (const char* id : {"figure-7", "figure-8", "figure-9", "figure-10"})
        EXPECT_EQ(count_of(page, std::string("id=\"") + id + "\""), 1U) << id;
    EXPECT_FALSE(study_colvin(std::span(walks()).subspan(1), walk_generated)) << "stairs alone";
}

TEST(ColvinStudy, shows_what_foot_placement_really_did) {
    const std::optional<ColvinStudy> study = study_colvin(walks(), walk_generated);
    ASSERT_TRUE(study);
    const auto joint = [](const std::vector<Transform>& pose, int j) {
        return pose[static_cast<std::size_t>(j)].translation;
    };
    EXPECT_LT(study->sunk.steps.lowered, -0.01f);
    EXPECT_NEAR(joint(study->sunk.placed, study->legs.hips).y - joint(study->sunk.animated, study->legs.hips).y,
                study->sunk.steps.lowered, 1e-4f);
    const ColvinInput& stretched = study->sunk.steps.legs[study->sunk.side];
    const float length = distance(stretched.hip, stretched.knee) + distance(stretched.knee, stretched.ankle);
    EXPECT_NEAR(distance(stretched.hip, stretched.target), length, 2e-3f) << "it just reaches";

    const ColvinMoment& moment = study->turned;
    for (std::size_t side = 0; side < 2; ++side) {
        const ColvinInput& leg = moment.steps.legs[side];
        const ColvinTrace& trace = moment.traces[side];
        const Leg& joints = study->legs.side[side];
        EXPECT_LT(distance(joint(moment.placed, joints.upper), leg.hip), 1e-4f);
        EXPECT_LT(distance(joint(moment.placed, joints.foot), leg.target), 2e-3f) << "the foot is on its target";
        EXPECT_LT(distance(leg.hip + trace.swung.ankle, leg.target), 2e-3f) << "after step 4 already";
        EXPECT_NEAR(trace.posed.knee.y, 0, 1e-5f) << "the thigh at 90 degrees";
    }
    const ColvinInput& leg = moment.steps.legs[moment.side];
    const float before = knee_plane_deg(leg, moment.traces[moment.side].swung.knee);
    const float after = knee_plane_deg(leg, joint(moment.placed, study->legs.side[moment.side].lower) - leg.hip);
    EXPECT_GT(before, 5);
    EXPECT_LT(after, before / 4);
}

}  // namespace
}  // namespace surefoot
