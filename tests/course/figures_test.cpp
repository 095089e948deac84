#include <surefoot/course/figures.h>
#include <surefoot/course/walk_table.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

namespace surefoot {
namespace {

const WalkFigure& figure(const std::string& key) {
    for (const WalkFigure& each : walk_figures())
        if (each.key == key) return each;
    throw std::runtime_error("no figure " + key);
}

/// A walk on an eight over flat ground that meets every mark.
MeasuredWalk perfect() {
    MeasuredWalk walk;
    walk.info.path = "eight";
    walk.metrics.planted_samples = 100;
    walk.metrics.knee_min_deg = 90;
    walk.metrics.knee_peak_ratio = walk.metrics.hip_jerk_ratio = 1;
    walk.twin.path_m = 80;
    walk.flat_change_mm = 0;
    return walk;
}

/// For each mark, what is just bad enough to miss it.
const std::map<std::string, std::function<void(MeasuredWalk&)>> k_bad{
    {"skate_cm_s",
     [](MeasuredWalk& w) {
         w.twin.skate_cm_s = 1;
         w.metrics.skate_cm_s = 1.51;
     }},
    {"drag_cm",
     [](MeasuredWalk& w) {
         w.own.drag_cm = 2.5;
         w.metrics.drag_cm = 3.51;
     }},
    {"penetration_heel_ball_cm", [](MeasuredWalk& w) { w.metrics.penetration_heel_ball_cm = 1.51; }},
    {"penetration_toe_mid_cm", [](MeasuredWalk& w) { w.metrics.penetration_toe_mid_cm = 2.51; }},
    {"penetration_mean_cm", [](MeasuredWalk& w) { w.metrics.penetration_mean_cm = 0.21; }},
    {"float_mean_cm", [](MeasuredWalk& w) { w.metrics.float_mean_cm = 0.51; }},
    {"sole_angle_deg", [](MeasuredWalk& w) { w.metrics.sole_angle_deg = 1.01; }},
    {"sole_angle_worst_deg", [](MeasuredWalk& w) { w.metrics.sole_angle_worst_deg = 6.01; }},
    {"over_extensions", [](MeasuredWalk& w) { w.metrics.over_extensions = 1; }},
    {"knee_peak_ratio",
     [](MeasuredWalk& w) {
         w.metrics.knee_peak_ratio = 1.81;
         w.metrics.knee_peak_deg_s2 = 22001;
     }},
    {"knee_min_deg", [](MeasuredWalk& w) { w.metrics.knee_min_deg = 39.9; }},
    {"hip_jerk_ratio", [](MeasuredWalk& w) { w.metrics.hip_jerk_ratio = 2.01; }},
    {"drift_m", [](MeasuredWalk& w) { w.metrics.drift_m = 0.81; }},
    {"drift_deg", [](MeasuredWalk& w) { w.metrics.drift_deg = 2.01; }},
    {"flat_change_mm", [](MeasuredWalk& w) { w.flat_change_mm = 1.01; }},
    {"planted_samples", [](MeasuredWalk& w) { w.metrics.planted_samples = 0; }},
};

TEST(Figures, each_mark_is_missed_by_what_is_just_too_bad_and_by_nothing_else) {
    ASSERT_EQ(missed_marks(perfect()), 0);
    std::size_t marks = 0;
    for (const WalkFigure& each : walk_figures()) {
        EXPECT_EQ(each.mark == nullptr, each.met == nullptr) << each.key;
        if (each.mark == nullptr) continue;
        ++marks;
        const auto bad = k_bad.find(each.key);
        ASSERT_NE(bad, k_bad.end()) << "no known-bad walk for " << each.key;
        MeasuredWalk walk = perfect();
        bad->second(walk);
        EXPECT_TRUE(each.missed(walk)) << each.key;
        EXPECT_EQ(missed_marks(walk), 1) << each.key;
    }
    EXPECT_EQ(marks, k_bad.size());
}

TEST(Figures, what_was_not_measured_misses_its_mark) {
    MeasuredWalk walk = perfect();
    walk.metrics.skate_cm_s = walk.metrics.float_mean_cm = walk.metrics.sole_angle_deg = std::nan("");
    EXPECT_EQ(missed_marks(walk), 3);
    EXPECT_EQ(figure("skate_cm_s").text(walk), "–");
}

TEST(Figures, knees_may_be_jerked_more_on_steps_and_drift_counts_on_eights) {
    MeasuredWalk walk = perfect();
    walk.metrics.knee_peak_ratio = 2.9;
    walk.metrics.knee_peak_deg_s2 = 35000;
    EXPECT_TRUE(figure("knee_peak_ratio").missed(walk));
    walk.info.course = "stairs_up";
    EXPECT_FALSE(figure("knee_peak_ratio").missed(walk));
    walk.metrics.knee_peak_ratio = 3.1;
    EXPECT_TRUE(figure("knee_peak_ratio").missed(walk));
    walk.metrics.knee_peak_deg_s2 = 29000;
    EXPECT_FALSE(figure("knee_peak_ratio").missed(walk)) << "ratio or absolute bound";
    walk.metrics.drift_m = 5;
    EXPECT_TRUE(figure("drift_m").missed(walk));
    walk.info.path = "start-stop";
    EXPECT_FALSE(figure("drift_m").missed(walk));
}

TEST(Figures, tables_mark_misses_of_judged_rows_only) {
    MeasuredWalk walk = perfect();
    walk.metrics.hip_jerk_ratio = 7.25;
    EXPECT_NE(walk_table({&walk, 1}, TableLayout::many).find("7.25!"), std::string::npos);
    EXPECT_NE(walk_markdown({&walk, 1}).find("**7.25**"), std::string::npos);
    EXPECT_NE(figures_json(walk).find("\"misses\": [\"hip_jerk_ratio\"]"), std::string::npos);
    walk.judged = false;
    EXPECT_EQ(walk_table({&walk, 1}, TableLayout::many).find('!'), std::string::npos);
    EXPECT_EQ(walk_markdown({&walk, 1}).find("**"), std::string::npos);
}

TEST(Figures, misses_are_counted_by_course_and_mark) {
    std::vector<MeasuredWalk> rows(4, perfect());
    rows[1].metrics.hip_jerk_ratio = 3;
    rows[2].info.course = "hills";
    rows[3].judged = false;
    rows[3].metrics.hip_jerk_ratio = 3;
    const std::vector<CourseMisses> courses = misses_by_course(rows);
    ASSERT_EQ(courses.size(), 2U);
    EXPECT_EQ(courses[0].course, "flat");
    EXPECT_EQ(courses[0].walks, 2);
    EXPECT_EQ(courses[0].perfect, 1);
    EXPECT_EQ(courses[1].perfect, 1);
    for (std::size_t i = 0; i < courses[0].misses.size(); ++i)
        EXPECT_EQ(courses[0].misses[i], walk_figures()[i].key == std::string("hip_jerk_ratio") ? 1 : 0);
    EXPECT_NE(misses_table(rows, true).find("| hills | 1 | 1 |"), std::string::npos);
}

TEST(Figures, lines_of_the_table_are_aligned_though_units_are_not_ascii) {
    const MeasuredWalk walk = perfect();
    const std::string table = walk_table({&walk, 1}, TableLayout::many);
    const auto shown = [](const std::string& line) {
        return std::count_if(line.begin(), line.end(),
                             [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
    };
    const std::size_t first = table.find('\n'), second = table.find('\n', first + 1);
    const std::string head = table.substr(0, first), row = table.substr(second + 1, table.size() - second - 2);
    EXPECT_LE(std::abs(shown(head) - shown(row)), 1);
}

}  // namespace
}  // namespace surefoot
