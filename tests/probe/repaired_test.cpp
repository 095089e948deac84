// The figures that authoring promises, on real clips: what `author --fix --probe` makes of them, at default settings.

#include <surefoot/author/author.h>
#include <surefoot/author/lint.h>
#include <surefoot/probe/probe.h>

#include <gtest/gtest.h>

#include <tests/support/folder.h>
#include <tests/support/motion_data.h>

#include <cstdio>

namespace surefoot {
namespace {

ProbeResult play(std::span<const AnalyzedClip> clips, std::span<const ProjectSpace> spaces) {
    return probe(bake_character(clips, spaces), {});
}

AuthorResult author_and_fix(const std::filesystem::path& clips, const std::filesystem::path& folder) {
    AuthorOptions options;
    options.fix = true;
    options.mannequin = false;
    options.probe = play;
    const std::string paths[] = {clips.string()};
    return author_clips(paths, folder, options);
}

void expect_what_is_asked(const Project& project) {
    const std::vector<ProbeSpace>& spaces = project.probe.spaces;
    const ProbeStat speed = probe_stat(spaces, ProbeFigure::speed), turn = probe_stat(spaces, ProbeFigure::turn);
    std::printf("  %d blends: speed %.2f %%, turn %.2f deg/s, skate %.2f of the sources'\n", speed.cells, speed.mean,
                turn.mean, skate_ratio(spaces));
    EXPECT_FALSE(has_findings(project.findings, Severity::error));
    EXPECT_EQ(unmeasured_cells(spaces), 0);
    EXPECT_LE(speed.mean, 2);
    EXPECT_LE(turn.mean, 2);
    EXPECT_LE(skate_ratio(spaces), 1.5);
}

TEST(repaired, captures_of_o3de_do_what_is_asked_in_every_blend) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    test::Folder out;
    const Project project = author_and_fix(folder / "o3de_mocap_bvh", out.path).project;
    expect_what_is_asked(project);
}

TEST(repaired, clips_of_ual1_that_only_go_straight_come_out_as_a_character_that_turns) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    test::Folder out;
    const Project project = author_and_fix(folder / "ual1_locomotion_glb", out.path).project;
    expect_what_is_asked(project);
    ASSERT_FALSE(project.spaces.empty());
    EXPECT_EQ(project.spaces[0].space.dimensions(), 2);
    const BlendWeights curve = blend_weights(project.spaces[0].space, {1.4f, 30});
    EXPECT_FALSE(curve.clamped);
}

}  // namespace
}  // namespace surefoot
