#include "support.h"

#include <surefoot/author/author.h>
#include <surefoot/author/make_clip.h>
#include <surefoot/author/probe_result.h>
#include <surefoot/author/rank.h>
#include <surefoot/author/repair.h>
#include <surefoot/base/error.h>
#include <surefoot/host/files.h>
#include <surefoot/host/parallel.h>
#include <surefoot/space/lock_edge.h>
#include <surefoot/synthetic/synthetic_set.h>
#include <tests/support/folder.h>
#include <tests/support/motion_data.h>

#include <gtest/gtest.h>

#include <filesystem>

namespace surefoot {
namespace {

namespace fs = std::filesystem;

using test::Folder;

/// The generated set without some of its clips.
std::vector<Motion> set_without(const std::vector<std::string>& names) {
    ClipSet set = make_synthetic_set();
    std::erase_if(set.clips, [&](const Motion& motion) {
        return std::find(names.begin(), names.end(), motion.name) != names.end();
    });
    return std::move(set.clips);
}

AuthorOptions options(bool fix) {
    AuthorOptions result;
    result.name = "test";
    result.mannequin = false;
    result.fix = fix;
    return result;
}

AuthorResult author_set(const std::vector<std::string>& without, const fs::path& folder, bool fix) {
    return author_motions(set_without(without), folder, options(fix));
}

int errors(const std::map<std::string, int>& counts) {
    int sum = 0;
    for (const auto& [rule, count] : counts) sum += rule.compare(0, 5, "error") == 0 ? count : 0;
    return sum;
}

int total(const std::map<std::string, int>& counts, bool with_infos) {
    int sum = 0;
    for (const auto& [rule, count] : counts) sum += with_infos || rule.compare(0, 4, "info") != 0 ? count : 0;
    return sum;
}

bool made_by(const Project& project, const std::string& kind, const std::string& from) {
    for (const ProjectRepair& repair : project.repairs)
        for (const RepairStep& step : repair.steps)
            if (step.kind == kind && std::find(step.clips.begin(), step.clips.end(), from) != step.clips.end())
                return true;
    return false;
}

TEST(repair, a_side_that_nobody_recorded_is_mirrored_and_measured) {
    Folder folder;
    const AuthorResult result = author_set({"turn_left", "turn_left_slow", "walk_left"}, folder.path, true);
    const Project project = load_project(folder.path);
    EXPECT_TRUE(made_by(project, "mirror", "turn_right"));
    const int made = project.find_clip("turn_left");
    ASSERT_GE(made, 0);
    const ProjectClip& clip = project.clips[static_cast<std::size_t>(made)];
    EXPECT_TRUE(clip.made());
    EXPECT_NEAR(clip.facts.turn, 90, 1);
    EXPECT_FALSE(clip.facts.events.empty());
    EXPECT_TRUE(fs::exists(folder.path / clip.file));
    EXPECT_NE(read_file(folder.path / clip.file).find("mirrored from"), std::string::npos);
    EXPECT_NE(read_file(folder.path / clip.file).find("phase_events"), std::string::npos);
    EXPECT_EQ(errors(result.repairs.after), 0);
    EXPECT_LT(total(result.repairs.after, true), total(result.repairs.before, true));
}

TEST(repair, what_only_goes_forward_is_played_backwards) {
    Folder folder;
    author_set({"back", "back_left", "back_right"}, folder.path, true);
    const Project project = load_project(folder.path);
    EXPECT_TRUE(made_by(project, "reverse", "walk"));
    bool backward = false;
    for (const ProjectClip& clip : project.clips) backward |= !clip.excluded && clip.facts.speed < -0.5f;
    EXPECT_TRUE(backward);
}

TEST(repair, a_second_run_changes_no_byte_and_neither_does_another_thread_count) {
    Folder folder;
    std::string first;
    for (const int threads : {1, 8}) {
        set_thread_count(threads);
        const fs::path out = folder.path / std::to_string(threads);
        author_set({"turn_left", "back", "back_left", "back_right"}, out, true);
        const std::string once = read_file(out / "project.json");
        EXPECT_GT(load_project(out).repairs.size(), 0u);
        const AuthorResult again = author_set({"turn_left", "back", "back_left", "back_right"}, out, true);
        EXPECT_EQ(again.repairs.made(), 0);
        EXPECT_TRUE(read_file(out / "project.json") == once);
        author_set({"turn_left", "back", "back_left", "back_right"}, out, false);  // repairs survive a plain run
        EXPECT_TRUE(read_file(out / "project.json") == once);
        if (threads == 1) first = once;
        EXPECT_TRUE(once == first);
    }
    set_thread_count(0);
}

TEST(repair, undoing_everything_gives_the_findings_of_before) {
    Folder folder;
    const AuthorResult plain = author_set({"turn_left", "back", "back_left", "back_right"}, folder.path / "a", false);
    author_set({"turn_left", "back", "back_left", "back_right"}, folder.path / "b", true);
    std::vector<std::string> warnings;
    Workbench bench = load_workbench(folder.path / "b", warnings);
    const Project before = bench.project;
    ASSERT_GT(before.repairs.size(), 0u);
    EXPECT_EQ(undo_repairs(bench, "", warnings).size(), before.repairs.size());
    EXPECT_TRUE(warnings.empty()) << warnings.front();
    EXPECT_TRUE(bench.project.repairs.empty());
    EXPECT_TRUE(bench.project.clips == plain.project.clips);
    EXPECT_EQ(count_findings(bench.project), count_findings(plain.project));
    ASSERT_EQ(bench.project.spaces.size(), plain.project.spaces.size());
    for (std::size_t s = 0; s < bench.project.spaces.size(); ++s) {
        EXPECT_EQ(bench.project.spaces[s].clips, plain.project.spaces[s].clips);
        EXPECT_EQ(bench.project.spaces[s].space.simplices, plain.project.spaces[s].space.simplices);
    }
    write_project(bench, folder.path / "b", &before, {false, true, {}, {}});
    for (const ProjectClip& clip : before.clips) EXPECT_EQ(fs::exists(folder.path / "b" / clip.file), !clip.made());
    EXPECT_THROW(undo_repairs(bench, "77", warnings), Error);
}

TEST(repair, undoing_one_takes_what_was_built_on_it_along) {
    Folder folder;
    author_set({"turn_left", "back", "back_left", "back_right"}, folder.path, true);
    std::vector<std::string> warnings;
    const Workbench repaired = load_workbench(folder.path, warnings);
    for (const ProjectRepair& repair : repaired.project.repairs) {
        Workbench bench = repaired;
        const std::vector<std::string> undone = undo_repairs(bench, repair.id, warnings);
        ASSERT_FALSE(undone.empty());
        EXPECT_EQ(undone.front(), repair.id);
        for (const ProjectRepair& left : bench.project.repairs)
            for (const RepairStep& step : left.steps)
                for (const std::string& clip : step.clips) EXPECT_GE(bench.project.find_clip(clip), 0);
    }
}

TEST(repair, only_what_was_asked_for_is_repaired) {
    Folder folder;
    author_set({"turn_left", "back", "back_left", "back_right"}, folder.path, false);
    std::vector<std::string> warnings;
    Workbench bench = load_workbench(folder.path, warnings);
    const std::map<std::string, int> before = count_findings(bench.project);
    EXPECT_EQ(repair(bench, {{"duplicate"}}).made(), 0);
    EXPECT_EQ(count_findings(bench.project), before);
    std::string id;
    for (const Finding& finding : bench.project.findings)
        if (finding.rule == "missing-axis-end" && finding.at[1] > 80) id = fix_id(finding);
    ASSERT_FALSE(id.empty());
    const RepairReport report = repair(bench, {{id}});
    EXPECT_EQ(report.made(), 1);
    EXPECT_EQ(report.attempts.front().fix_id, id);
}

TEST(repair, a_user_s_choices_about_a_made_clip_survive) {
    Folder folder;
    author_set({"turn_left"}, folder.path, true);
    Project project = load_project(folder.path);
    const int made = project.find_clip("turn_left");
    ASSERT_GE(made, 0);
    project.clips[static_cast<std::size_t>(made)].pins = {{"facing", {0, 90}}};
    save_project(folder.path / "project.json", project);
    author_set({"turn_left"}, folder.path, false);
    const Project again = load_project(folder.path);
    EXPECT_EQ(again.clips[static_cast<std::size_t>(again.find_clip("turn_left"))].pins.size(), 1u);
}

/// On the axis between two of its samples: a space whose idle and walk are there, and whose crossing edge is not.
TEST(repair, an_edge_across_an_axis_gets_the_clip_between_the_two_samples_on_the_axis) {
    std::vector<std::string> warnings;
    Folder folder;
    author_motions(set_without({"walk", "jog_left", "jog_right", "run_left", "run_right", "turn_left_slow",
                                "turn_right_slow", "back", "back_left", "back_right"}),
                   folder.path, options(false));
    Workbench bench = load_workbench(folder.path, warnings);
    int crossing = 0;
    for (const Finding& finding : bench.project.findings) crossing += finding.rule == "crossing-axis";
    ASSERT_GT(crossing, 0);  // walk_left to walk_right, with idle behind and jog ahead of it on the axis
    const RepairReport report = repair(bench, {{"crossing-axis"}});
    EXPECT_GT(report.made(), 0);
    for (const Finding& finding : bench.project.findings) EXPECT_NE(finding.rule, "crossing-axis");
    const ProjectRepair& repair = bench.project.repairs.front();
    ASSERT_EQ(repair.steps.front().kind, "interpolate");
    const BenchClip* made = bench.find(repair.steps.front().makes);
    ASSERT_NE(made, nullptr);
    EXPECT_NEAR(made->clip.facts.turn, 0, 0.5f);
    // The paper's weights: by the distances to the two samples.
    const double w = repair.steps.front().numbers.at("weight_0"), v = repair.steps.front().numbers.at("weight_1");
    EXPECT_NEAR(w + v, 1, 1e-9);
    const float between = static_cast<float>(w) * bench.find(repair.steps.front().clips[0])->clip.facts.speed +
                          static_cast<float>(v) * bench.find(repair.steps.front().clips[1])->clip.facts.speed;
    EXPECT_NEAR(made->clip.facts.speed, between, 0.05f);
}

TEST(repair, without_a_sample_on_one_side_there_stays_a_placeholder) {
    std::vector<std::string> warnings;
    Folder folder;
    author_motions(set_without({"walk", "jog", "run", "jog_left", "jog_right", "run_left", "run_right", "back",
                                "back_left", "back_right", "strafe_left", "strafe_right"}),
                   folder.path, options(false));
    Workbench bench = load_workbench(folder.path, warnings);
    repair(bench, {{"crossing-axis"}});
    for (const ProjectRepair& repair : bench.project.repairs)
        for (const RepairStep& step : repair.steps) EXPECT_NE(step.kind, "interpolate");
}

TEST(repair, nothing_is_done_to_a_space_that_would_lose_its_second_dimension) {
    // Two turns are all that spans the plane: none of them may go, whatever stands too close.
    std::vector<std::string> warnings;
    Folder folder;
    std::vector<Motion> clips;
    ClipSet set = make_synthetic_set();
    for (Motion& motion : set.clips)
        if (motion.name == "idle" || motion.name == "walk" || motion.name == "walk_left") clips.push_back(motion);
    author_motions(clips, folder.path, options(true));
    EXPECT_EQ(load_project(folder.path).find_space("facing")->space.dimensions(), 2);
}

/// DESIGN: after --fix no errors, and fewer errors and warnings, on what people have.
void expect_repaired(const fs::path& clips, const fs::path& out) {
    const std::string paths[] = {clips.string()};
    const AuthorResult result = author_clips(paths, out, options(true));
    for (const auto& [rule, count] : result.repairs.before)
        std::printf("  %-36s %3d -> %d\n", rule.c_str(), count,
                    result.repairs.after.count(rule) ? result.repairs.after.at(rule) : 0);
    EXPECT_EQ(errors(result.repairs.after), 0);
    EXPECT_LT(total(result.repairs.after, false), total(result.repairs.before, false));
    EXPECT_EQ(count_findings(result.project), result.repairs.after);
    const std::string once = read_file(out / "project.json");
    const AuthorResult again = author_clips(paths, out, options(true));
    EXPECT_EQ(again.repairs.made(), 0);
    EXPECT_TRUE(read_file(out / "project.json") == once);
}

TEST(repair, the_game_clips_of_ual1_come_out_without_errors) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    Folder out;
    expect_repaired(folder / "ual1_locomotion_glb", out.path);
}

TEST(repair, the_captures_of_o3de_come_out_without_errors) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    Folder out;
    expect_repaired(folder / "o3de_mocap_bvh", out.path);
}

TEST(repair, the_generated_set_needs_none) {
    Folder folder;
    const AuthorResult result = author_set({}, folder.path, true);
    EXPECT_EQ(errors(result.repairs.after), 0);
    EXPECT_LE(total(result.repairs.after, true), total(result.repairs.before, true));
}

TEST(rank_placeholders, worth_is_said_in_whole_warnings) {
    Placeholder placeholder;
    const auto said = [&](float worth) {
        placeholder.worth = worth;
        return describe_worth(placeholder);
    };
    EXPECT_EQ(said(0), "");
    EXPECT_EQ(said(0.1f), "a small gain, less than settling one warning");
    EXPECT_EQ(said(1.05f), "would settle as much as 1 warning");
    EXPECT_EQ(said(2.6f), "would settle as much as 3 warnings");
    placeholder.probe_gain = 0.314f;
    EXPECT_EQ(said(2.6f), "would mend 31 % of what the probe found wrong and settle as much as 3 warnings");
    EXPECT_EQ(said(0.4f), "would mend 31 % of what the probe found wrong");
}

TEST(rank_placeholders, the_clip_that_opens_a_dimension_is_worth_most) {
    Folder folder;
    std::vector<std::string> warnings;
    ClipSet set = make_synthetic_set();
    std::vector<Motion> clips;
    for (Motion& motion : set.clips)
        if (motion.name == "idle" || motion.name == "walk" || motion.name == "run") clips.push_back(motion);
    author_motions(clips, folder.path, options(false));
    Workbench bench = load_workbench(folder.path, warnings);
    const Placeholder* best = most_wanted(bench.project);
    ASSERT_NE(best, nullptr);
    EXPECT_EQ(best->rule, "degenerate-space");
    EXPECT_GT(best->worth, 1);
}

TEST(rank_placeholders, what_the_probe_found_wrong_goes_before_findings) {
    Folder folder;
    std::vector<std::string> warnings;
    ClipSet set = make_synthetic_set();
    std::vector<Motion> clips;
    for (Motion& motion : set.clips)
        if (motion.name == "idle" || motion.name == "walk" || motion.name == "turn_left" || motion.name == "turn_right")
            clips.push_back(motion);
    author_motions(clips, folder.path, options(false));
    Workbench bench = load_workbench(folder.path, warnings);
    for (const Placeholder& placeholder : bench.project.placeholders) EXPECT_EQ(placeholder.probe_gain, 0);
    // Every blend that turns left is wrong; nothing else is.
    ProjectSpace& space = bench.project.spaces.front();
    ProbeSpace probe;
    probe.name = space.name;
    for (const Axis& axis : space.space.axes) probe.axes.push_back({axis.name, axis.unit, axis.low, axis.high, 9});
    std::vector<int> index(probe.axes.size());
    do {
        ProbeCell cell;
        cell.grid = index;
        cell.standing = 1;
        for (std::size_t k = 0; k < index.size(); ++k) cell.at.push_back(grid_value(probe.axes[k], index[k]));
        if (cell.at[1] > 0) cell.blend[ProbeFigure::speed] = 10;
        probe.cells.push_back(cell);
    } while (next_grid_point(index, probe.axes));
    bench.project.probe.spaces = {probe};
    std::vector<Placeholder>& wanted = bench.project.placeholders;
    wanted.clear();
    for (const float turn : {-45.0f, 45.0f}) {
        Placeholder placeholder;
        placeholder.space = space.name, placeholder.text = turn > 0 ? "left" : "right";
        placeholder.axes = {"speed", "turn"},
        placeholder.target = {turn > 0 ? 0.7f : 0.71f, turn > 0 ? turn : turn + 20};
        wanted.push_back(placeholder);
    }
    rank_placeholders(bench);
    ASSERT_NE(most_wanted(bench.project), nullptr);
    EXPECT_EQ(most_wanted(bench.project)->text, "left");
    EXPECT_GT(wanted[1].probe_gain, wanted[0].probe_gain + 0.02f);
}

TEST(make_clip, marks_are_one_cycle_of_alternating_feet) {
    AnalyzedClip clip;
    clip.motion = make_motion(make_synthetic_set().skeleton, "x", 61, 60);
    clip.motion.cyclic = true;
    EXPECT_EQ(cycle_marks(clip)->size(), 0u);
    clip.facts.events = {{Side::right, StrideEvent::strike, 0.1f}, {Side::left, StrideEvent::strike, 0.6f}};
    const auto marks = cycle_marks(clip);
    ASSERT_TRUE(marks);
    EXPECT_FLOAT_EQ((*marks)[0], 0.6f);
    EXPECT_FLOAT_EQ((*marks)[1], 1.1f);
    EXPECT_FLOAT_EQ((*marks)[2], 1.6f);
    clip.facts.events = {{Side::left, StrideEvent::strike, 0.1f}, {Side::left, StrideEvent::strike, 0.6f}};
    EXPECT_FALSE(cycle_marks(clip));
}

TEST(make_clip, names_speak_of_the_side_and_are_free) {
    const std::vector<ProjectClip> taken{test::make_clip("walk_left", 1, 45), test::make_clip("Walk_Right", 1, -45)};
    EXPECT_EQ(name_for({"mirror", {"walk_left"}, {}, "", "", ""}, taken), "walk_right_2");
    EXPECT_EQ(name_for({"mirror", {"turn_left"}, {}, "", "", ""}, taken), "turn_right");
    EXPECT_EQ(name_for({"mirror", {"strut"}, {}, "", "", ""}, taken), "strut_mirrored");
    EXPECT_EQ(name_for({"reverse", {"walk"}, {}, "", "", ""}, taken), "walk_reversed");
    EXPECT_EQ(name_for({"steer", {"walk"}, {{"turn_deg_s", -30}}, "", "", ""}, taken), "walk_right_30");
}

}  // namespace
}  // namespace surefoot
