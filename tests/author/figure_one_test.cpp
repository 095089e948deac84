// Figure 1 of Delicado & Pelechano 2019 played again with real clips: files that go the whole way from loading and
// measuring to lint, laid out with each of the paper's five problems at a known place.
#include "support.h"

#include <surefoot/author/author.h>
#include <surefoot/host/files.h>
#include <surefoot/io/gltf.h>
#include <surefoot/synthetic/biped.h>
#include <surefoot/synthetic/gait_cycle.h>

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <set>

namespace surefoot {
namespace {

namespace fs = std::filesystem;
using test::of_rule;

/// A clip of the figure: the generated gait that it is made of, and what it is to do.
struct Wanted {
    const char *name, *gait;
    float speed, turn;
};

const std::vector<Wanted> k_figure{
    {"idle", "idle", 0, 0},
    {"turn_left", "turn_left", 0, 110},
    {"turn_right", "turn_right", 0, -110},
    {"walk", "walk", 1.5f, 0},
    {"walk_left", "walk_left", 1.5f, 50},  // (a): blended with back_left across speed = 0
    {"walk_right", "walk_right", 1.5f, -50},
    {"back", "back", -1.2f, 0},
    {"back_left", "back_left", -1.2f, 45},
    {"back_right", "back_right", -1.2f, -45},
    {"jog", "jog", 3, 0},
    {"run_astray", "run_left", 4.9f, 6},  // (c): was to go straight
    {"run_left", "run_left", 4.2f, 70},
    {"run_right", "run_right", 4.2f, -70},
    {"jog_wide", "jog_left", 2.2f, 88},  // (b): nearly on the line from turn_left to run_left
    {"jog_right", "jog_right", 2.4f, -28},
    {"trot_right", "jog_right", 2.1f, -18},  // (d): next to jog_right
};

Motion make_clip_of(const Wanted& wanted, const Rig& biped) {
    for (GaitParameters gait : synthetic_gaits())
        if (gait.name == wanted.gait) {
            gait.name = wanted.name;
            gait.forward = wanted.speed;
            gait.turn = wanted.turn;
            return make_gait_cycle(biped, gait);
        }
    ADD_FAILURE() << "no gait " << wanted.gait;
    return {};
}

class FigureOne : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        const fs::path folder = fs::temp_directory_path() / ("surefoot_figure_one_" + std::to_string(getpid()));
        fs::remove_all(folder);
        const Rig biped = make_biped();
        for (const Wanted& wanted : k_figure) {
            GltfScene scene;
            scene.motions = {make_clip_of(wanted, biped)};
            write_file(folder / "files" / (std::string(wanted.name) + ".glb"), write_glb(scene));
        }
        AuthorOptions options;
        options.mannequin = false;
        const std::string files = (folder / "files").string();
        result_ = author_clips({&files, 1}, folder / "project", options);
        fs::remove_all(folder);
    }

    static LintResult findings() { return {result_.project.findings, result_.project.placeholders, {}}; }
    static bool is_asked_for(PlaceholderKind kind, float speed, float turn) {
        for (const Placeholder& p : result_.project.placeholders)
            if (p.kind == kind && p.target.size() == 2 && std::fabs(p.target[0] - speed) < 0.05f &&
                std::fabs(p.target[1] - turn) < 1)
                return true;
        return false;
    }

    static AuthorResult result_;
};
AuthorResult FigureOne::result_;

std::set<std::string> clips_of(const Finding& finding) { return {finding.clips.begin(), finding.clips.end()}; }

TEST_F(FigureOne, sixteen_files_are_measured_to_do_what_they_were_made_for) {
    ASSERT_EQ(result_.project.clips.size(), k_figure.size());
    for (const Wanted& wanted : k_figure) {
        const int clip = result_.project.find_clip(wanted.name);
        ASSERT_GE(clip, 0) << wanted.name;
        EXPECT_FALSE(result_.project.clips[clip].excluded) << result_.project.clips[clip].reason;
        EXPECT_NEAR(result_.project.clips[clip].facts.speed, wanted.speed, 0.03) << wanted.name;
        EXPECT_NEAR(result_.project.clips[clip].facts.turn, wanted.turn, 1.5) << wanted.name;
    }
}

TEST_F(FigureOne, edges_across_the_axis_of_standing_are_found_on_both_sides) {
    const auto crossing = of_rule(findings(), "crossing-axis");
    ASSERT_EQ(crossing.size(), 2u);
    std::set<std::set<std::string>> pairs;
    for (const Finding& finding : crossing) {
        pairs.insert(clips_of(finding));
        EXPECT_NEAR(finding.at[0], 0, 1e-5);
        EXPECT_NEAR(std::fabs(finding.at[1]), 47.2, 1);
        EXPECT_EQ(finding.severity, Severity::error);
        EXPECT_TRUE(is_asked_for(PlaceholderKind::needed, 0, finding.at[1]));
    }
    EXPECT_EQ(pairs, (std::set<std::set<std::string>>{{"walk_left", "back_left"}, {"walk_right", "back_right"}}));
}

TEST_F(FigureOne, the_sliver_is_found) {
    const auto acute = of_rule(findings(), "acute-triangle");
    ASSERT_EQ(acute.size(), 1u) << acute[0].message << "\n" << acute.back().message;
    EXPECT_EQ(clips_of(acute[0]), (std::set<std::string>{"jog_wide", "turn_left", "run_left"}));
    EXPECT_NE(acute[0].message.find("\"jog_wide\" is so near the line"), std::string::npos) << acute[0].message;
}

TEST_F(FigureOne, the_run_that_veers_is_found_and_a_straight_one_asked_for) {
    const auto misaligned = of_rule(findings(), "misaligned");
    ASSERT_EQ(misaligned.size(), 1u);
    EXPECT_EQ(misaligned[0].clips, std::vector<std::string>{"run_astray"});
    EXPECT_TRUE(is_asked_for(PlaceholderKind::needed, 4.9f, 0));
}

TEST_F(FigureOne, the_two_that_are_too_close_are_found_redundant) {
    const auto close = of_rule(findings(), "too-close");
    ASSERT_EQ(close.size(), 1u);
    EXPECT_EQ(clips_of(close[0]), (std::set<std::string>{"jog_right", "trot_right"}));
    EXPECT_NE(close[0].message.find("redundant"), std::string::npos) << close[0].message;
}

TEST_F(FigureOne, the_corners_are_uncovered_and_suggested) {
    const ProjectSpace* space = result_.project.find_space("facing");
    ASSERT_NE(space, nullptr);
    const Axis &speed = space->space.axes[0], &turn = space->space.axes[1];
    std::set<std::vector<float>> places;
    for (const Finding& finding : of_rule(findings(), "uncovered")) {
        EXPECT_EQ(finding.severity, Severity::info);
        places.insert(finding.at);
    }
    EXPECT_EQ(places,
              (std::set<std::vector<float>>{
                  {speed.low, turn.low}, {speed.low, turn.high}, {speed.high, turn.low}, {speed.high, turn.high}}));
    for (const auto& at : places) EXPECT_TRUE(is_asked_for(PlaceholderKind::suggested, at[0], at[1]));
}

TEST_F(FigureOne, nothing_is_found_where_nothing_was_put) {
    const std::set<std::string> put{
        "crossing-axis", "acute-triangle",     "misaligned", "too-close",
        "uncovered",     "opposite-directions"};  // the edges across the axis blend opposite travel, too
    for (const Finding& finding : result_.project.findings) {
        EXPECT_TRUE(put.count(finding.rule)) << finding.rule << ": " << finding.message;
        if (finding.rule == "opposite-directions") {
            EXPECT_EQ(std::fabs(finding.at[0] - 0.15f) < 0.05f, true) << finding.message;
        }
    }
    EXPECT_EQ(of_rule(findings(), "opposite-directions").size(), 2u);
}

}  // namespace
}  // namespace surefoot
