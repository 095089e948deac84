#include <surefoot/course/sweep.h>
#include <surefoot/course/walk_table.h>
#include <surefoot/host/parallel.h>

#include "generated_walker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace surefoot {
namespace {

SweepRequest small() {
    SweepRequest request;
    request.courses = {"flat", "hills", "stairs_up"};
    request.paths = {"straight"};
    request.speeds_mps = {1.4f};
    request.seconds = 4;
    return request;
}

TEST(Sweep, covers_every_course_path_and_speed_as_far_as_it_makes_sense) {
    const std::vector<WalkInfo> walks = plan_sweep({});
    std::set<std::string> courses, paths;
    std::set<float> speeds;
    for (const WalkInfo& walk : walks) {
        courses.insert(walk.course);
        paths.insert(walk.path);
        speeds.insert(walk.speed_mps);
        EXPECT_TRUE(!is_stepped(walk.course) || walk.speed_mps <= 1.4f) << walk_title(walk);
        EXPECT_FALSE(walk.course == "stairs_up" && walk.path == "eight");
        EXPECT_TRUE((walk.path != "turns" && walk.path != "host-turns") || walk.speed_mps <= 1.4f) << walk_title(walk);
    }
    EXPECT_EQ(courses.size(), course_names().size());
    EXPECT_EQ(paths.size(), path_names().size());
    EXPECT_EQ(speeds, (std::set<float>{0.8f, 1.4f, 2.5f, 4.0f}));
    const auto back = std::count_if(walks.begin(), walks.end(), [](const WalkInfo& walk) { return walk.reverse; });
    const auto flat = std::count_if(walks.begin(), walks.end(), [](const WalkInfo& w) { return w.course == "flat"; });
    EXPECT_EQ(2 * back + flat, static_cast<std::ptrdiff_t>(walks.size()));
}

TEST(Sweep, what_is_asked_for_by_name_is_walked) {
    SweepRequest request;
    request.courses = {"stairs_up"};
    request.paths = {"eight"};
    request.speeds_mps = {4};
    request.reverse = {true};
    const std::vector<WalkInfo> walks = plan_sweep(request);
    ASSERT_EQ(walks.size(), 1U);
    EXPECT_TRUE(walks[0].reverse);
    EXPECT_EQ(walks[0].seconds, 60);
}

TEST(Sweep, gives_the_same_bytes_with_one_thread_and_with_eight) {
    const std::vector<WalkInfo> plan = plan_sweep(small());
    set_thread_count(1);
    const std::vector<SweptWalk> one = sweep(plan, walk_generated);
    set_thread_count(8);
    const std::vector<SweptWalk> eight = sweep(plan, walk_generated);
    set_thread_count(0);
    ASSERT_EQ(one.size(), eight.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(walk_json(one[i].rows), walk_json(eight[i].rows)) << i;
        EXPECT_EQ(one[i].traces[2].foot_cm, eight[i].traces[2].foot_cm) << i;
    }
}

TEST(Sweep, is_judged_by_mode_surefoot_or_by_the_one_mode_walked) {
    SweepRequest request = small();
    request.courses = {"hills"};
    const std::vector<SweptWalk> all = sweep(plan_sweep(request), walk_generated);
    ASSERT_EQ(all[0].rows.size(), 3U);
    EXPECT_TRUE(meets_all_marks(all)) << walk_table(all[0].rows, TableLayout::one_walk);
    EXPECT_GT(missed_marks(all[0].rows[0]), 0) << "without foot placement";
    const FootMode none[] = {FootMode::none};
    const std::vector<SweptWalk> bare = sweep(plan_sweep(request), walk_generated, none);
    ASSERT_EQ(bare[0].rows.size(), 1U);
    EXPECT_FALSE(meets_all_marks(bare));
    EXPECT_FALSE(meets_all_marks({})) << "nothing walked is no pass";
}

TEST(Sweep, flat_ground_changes_nothing_and_traces_say_where_feet_are) {
    SweepRequest request = small();
    request.courses = {"flat"};
    const std::vector<SweptWalk> walks = sweep(plan_sweep(request), walk_generated);
    const SweptWalk& walk = walks[0];
    EXPECT_LT(walk.rows[2].flat_change_mm, 1);
    const Trace& foot = walk.traces[2].foot_cm[0];
    EXPECT_EQ(foot.size(), walk.ground_cm.size());
    EXPECT_NEAR(*std::min_element(foot.begin(), foot.end()), 0, 0.5);
    EXPECT_GT(*std::max_element(foot.begin(), foot.end()), 2) << "a foot that swings";
}

}  // namespace
}  // namespace surefoot
