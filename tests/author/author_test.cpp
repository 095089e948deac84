#include "support.h"

#include <surefoot/author/author.h>
#include <surefoot/author/report.h>
#include <surefoot/author/workbench.h>
#include <surefoot/base/error.h>
#include <surefoot/host/files.h>
#include <surefoot/host/parallel.h>
#include <surefoot/io/gltf.h>
#include <surefoot/io/load.h>
#include <surefoot/synthetic/synthetic_set.h>
#include <tests/support/folder.h>
#include <tests/support/motion_data.h>

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <mutex>
#include <set>

namespace surefoot {
namespace {

namespace fs = std::filesystem;

using test::Folder;

std::map<std::string, std::string> contents(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) files[fs::relative(entry.path(), folder).string()] = read_file(entry.path());
    return files;
}

AuthorOptions plain() {
    AuthorOptions options;
    options.name = "test";
    options.mannequin = false;
    return options;
}

TEST(author, the_synthetic_set_becomes_a_project_whose_every_file_is_there) {
    Folder folder;
    const AuthorResult result = author_motions(make_synthetic_set().clips, folder.path, plain());
    const Project project = load_project(folder.path);
    EXPECT_TRUE(project == result.project);
    ASSERT_NE(project.find_space("facing"), nullptr);
    ASSERT_NE(project.find_space("lateral"), nullptr);
    EXPECT_EQ(project.find_space("facing")->space.dimensions(), 2);
    int used = 0;
    for (const ProjectClip& clip : project.clips) {
        if (clip.excluded) continue;
        ++used;
        const std::string file = (folder.path / clip.file).string();
        const LoadResult loaded = load_clips({&file, 1});
        ASSERT_EQ(loaded.clips.size(), 1u) << clip.name;
        EXPECT_EQ(loaded.clips[0].motion.frame_count(), clip.facts.frames) << clip.name;
        EXPECT_EQ(loaded.clips[0].motion.cyclic, clip.facts.cyclic) << clip.name;
        EXPECT_NE(loaded.clips[0].extras.find("provenance"), std::string::npos) << clip.name;
    }
    EXPECT_GE(used, 14);
    EXPECT_NE(read_file(folder.path / "report.html").find("</html>"), std::string::npos);
}

/// Files of a folder by name, for authoring in memory: as the page does that they are dragged into.
using Files = std::map<std::string, std::string>;

Files made_files(const Workbench& bench, const AuthorResult& result) {
    Files files;
    std::mutex several;
    give_project(
        bench, {false, false, result.failed, result.warnings}, [](const ProjectClip&) { return true; },
        [&](const std::string& file, const std::string& bytes) {
            const std::lock_guard<std::mutex> hold(several);
            files[file] = bytes;
        });
    return files;
}

TEST(author, clips_in_memory_become_the_same_files_as_clips_in_a_folder) {
    Folder folder;
    Files given;
    for (const Motion& clip : make_synthetic_set().clips) {
        GltfScene scene;
        scene.motions = {clip};
        given[clip.name + ".glb"] = write_glb(scene);
    }
    given["walk.surefoot.json"] = "{\"style\": 0.5}";
    given["notes.txt"] = "neither clip nor sidecar";
    given["broken.bvh"] = "HIERARCHY nonsense";
    for (const auto& [name, bytes] : given) write_file(folder.path / "in" / name, bytes);
    AuthorOptions options = plain();
    options.cache = false;
    options.fix = true;
    // From inside the folder, so that sources are called the same.
    const fs::path home = fs::current_path();
    fs::current_path(folder.path / "in");
    const std::string here = ".";
    const LoadResult on_disk = load_clips({&here, 1});
    std::vector<std::string> paths;
    for (const auto& [name, bytes] : given)
        if (is_clip_file(name)) paths.push_back(name);
    const AuthorResult native = author_clips(paths, folder.path / "out", options);
    fs::current_path(home);

    const LoadResult loaded = load_clips_in_memory(given);
    EXPECT_EQ(loaded.clips.size(), on_disk.clips.size());
    ASSERT_EQ(loaded.failed.size(), 1u);
    AuthorResult result;
    const Workbench bench = author_workbench(loaded, options, result);
    EXPECT_EQ(bench.project.find_clip("broken"), -1);
    EXPECT_EQ(result.failed, native.failed);
    EXPECT_EQ(result.repairs.made(), native.repairs.made());
    const int walk = bench.project.find_clip("walk");
    ASSERT_GE(walk, 0);
    EXPECT_EQ(bench.project.clips[static_cast<std::size_t>(walk)].facts.custom.at("style"), 0.5f);
    const Files made = made_files(bench, result), written = contents(folder.path / "out");
    ASSERT_EQ(made.size(), written.size());
    for (const auto& [name, bytes] : written) EXPECT_TRUE(made.at(name) == bytes) << name;

    // What was made opens again without a folder, and is not moved by it.
    std::vector<std::string> warnings;
    Workbench again = load_workbench(
        parse_project(made.at("project.json"), "project.json"), [&](const std::string& file) { return made.at(file); },
        warnings);
    EXPECT_TRUE(warnings.empty()) << warnings.front();
    EXPECT_EQ(clips_in_use(again).size(), clips_in_use(bench).size());
    again.clips[0] = nullptr;
    EXPECT_THROW(clips_in_use(again), Error);
}

TEST(author, without_clips_in_memory_there_is_an_error_in_words) {
    AuthorResult result;
    EXPECT_THROW(author_workbench(load_clips_in_memory({{"notes.txt", ""}}), plain(), result), Error);
    EXPECT_THROW(author_workbench(load_clips_in_memory({{"a.bvh", "nonsense"}}), plain(), result), Error);
}

TEST(author, numbers_beside_the_clips_open_a_third_dimension_that_survives_the_next_run) {
    Folder folder;
    const ClipSet set = make_synthetic_set();
    for (const Motion& clip : set.clips) {
        if (clip.name != "idle" && clip.name != "walk" && clip.name != "walk_left" && clip.name != "walk_right" &&
            clip.name != "run")
            continue;
        for (const char* style : {"0", "0.8"}) {
            Motion named = clip;
            named.name += std::string("_style") + style[0] + (style[1] ? "8" : "");
            GltfScene scene;
            scene.motions = {named};
            write_file(folder.path / "in" / (named.name + ".glb"), write_glb(scene));
            write_file(folder.path / "in" / (named.name + ".surefoot.json"), std::string("{\"style\": ") + style + "}");
        }
    }
    AuthorOptions options = plain();
    options.axes = {"speed,turn,style"};
    options.weighting = Weighting::gradient_band;
    options.extrapolate = 0.125f;
    const std::string in = (folder.path / "in").string();
    AuthorResult result = author_clips({&in, 1}, folder.path / "out", options);
    EXPECT_TRUE(result.warnings.empty()) << result.warnings.front();
    ASSERT_EQ(result.project.spaces.size(), 1u);
    const ProjectSpace& space = result.project.spaces[0];
    ASSERT_EQ(space.space.dimensions(), 3);
    EXPECT_EQ(space.clips.size(), 10u);  // both idles, too
    EXPECT_EQ(space.space.axes[2].high, 0.8f);
    EXPECT_GE(space.space.simplices.at(0)[3], 0);
    EXPECT_TRUE(load_project(folder.path / "out") == result.project);

    options.weighting = {};
    options.extrapolate = {};
    result = author_clips({&in, 1}, folder.path / "out", options);
    EXPECT_EQ(result.project.spaces[0].space.weighting, Weighting::gradient_band);
    EXPECT_EQ(result.project.spaces[0].space.outside, Outside::extrapolate);
    EXPECT_EQ(result.project.spaces[0].space.extrapolation_bound, 0.125f);
}

TEST(author, the_bytes_do_not_depend_on_the_thread_count) {
    Folder folder;
    std::map<std::string, std::string> first;
    for (const int threads : {1, 8}) {
        set_thread_count(threads);
        const fs::path out = folder.path / std::to_string(threads);
        author_motions(make_synthetic_set().clips, out, plain());
        if (threads == 1)
            first = contents(out);
        else
            EXPECT_EQ(contents(out), first);
    }
    set_thread_count(0);
    EXPECT_GT(first.size(), 10u);
}

TEST(author, running_again_keeps_what_the_user_pinned) {
    Folder folder;
    author_motions(make_synthetic_set().clips, folder.path, plain());
    Project project = load_project(folder.path);
    project.name = "kept name";
    project.clips[project.find_clip("walk_left")].excluded = true;
    project.clips[project.find_clip("walk_left")].excluded_by_user = true;
    project.clips[project.find_clip("walk_left")].reason = "ugly";
    project.clips[project.find_clip("run")].pins = {{"facing", {5.5f, 0}}};
    project.lint["uncovered"].enabled = false;
    project.spaces[0].axes_pinned = true;
    project.spaces[0].space.axes[0].high = 8;
    project.unknown = R"({"note":"mine"})";
    // The user marks clips as excluded in the list only; their samples go with the next run.
    const int out = project.find_clip("walk_left");
    project.clips[out].file = "clips/walk_left.glb";
    save_project(folder.path / "project.json", project);

    AuthorOptions options = plain();
    options.name.clear();
    author_motions(make_synthetic_set().clips, folder.path, options);
    const Project again = load_project(folder.path);
    EXPECT_EQ(again.name, "kept name");
    const ProjectClip& left = again.clips[again.find_clip("walk_left")];
    EXPECT_TRUE(left.excluded && left.excluded_by_user);
    EXPECT_EQ(left.reason, "ugly");
    EXPECT_FALSE(fs::exists(folder.path / "clips/walk_left.glb"));
    const ProjectSpace& facing = *again.find_space("facing");
    for (std::size_t i = 0; i < facing.clips.size(); ++i) {
        EXPECT_NE(again.clips[facing.clips[i]].name, "walk_left");
        if (again.clips[facing.clips[i]].name == "run") {
            EXPECT_EQ(facing.space.samples[i][0], 5.5f);
        }
    }
    EXPECT_EQ(facing.space.axes[0].high, 8);
    EXPECT_NE(again.unknown.find("mine"), std::string::npos);
    for (const Finding& finding : again.findings) EXPECT_NE(finding.rule, "uncovered");
    const auto before = contents(folder.path);
    author_motions(make_synthetic_set().clips, folder.path, options);
    EXPECT_EQ(contents(folder.path), before) << "a third run changes nothing";
}

std::string message_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(author, cycles_found_in_takes_are_counted_and_each_is_placed_or_left_out) {
    SUREFOOT_NEED_MOTION_DATA(motion);
    Folder folder;
    const std::string paths[] = {(motion / "o3de_mocap_bvh/Walk1.bvh").string(),
                                 (motion / "o3de_mocap_bvh/Jog1.bvh").string()};
    const AuthorResult result = author_clips(paths, folder.path, plain());
    EXPECT_EQ(result.takes, 2);
    EXPECT_GE(result.takes_with_cycles, 1);
    int placed = 0, left_out = 0;
    for (const ProjectClip& clip : result.project.clips) {
        if (clip.source_first == 0 && clip.excluded) continue;  // a whole take without any
        (clip.excluded ? left_out : placed) += 1;
    }
    EXPECT_GT(placed, 0);
    EXPECT_EQ(result.cycles_placed, placed);
    EXPECT_EQ(result.cycles_found, placed + left_out);
}

TEST(author, what_cannot_be_authored_is_said_in_so_many_words_and_leaves_no_project) {
    Folder folder;
    const fs::path empty = folder.path / "empty", out = folder.path / "out";
    fs::create_directories(empty);
    const std::string none[] = {empty.string()};
    EXPECT_NE(message_of([&] { author_clips(none, out, plain()); }).find("no clips in this folder"), std::string::npos);

    // A skeleton without legs.
    auto pole = std::make_shared<Skeleton>();
    pole->add("root", k_no_joint, {});
    Transform up;
    up.translation = {0, 1, 0};
    pole->add("tip", 0, up);
    const std::string legless = message_of([&] { author_motions({make_motion(pole, "pole", 30, 30)}, out, plain()); });
    EXPECT_NE(legless.find("leg"), std::string::npos) << legless;
    EXPECT_FALSE(fs::exists(out / "project.json"));
}

TEST(author, identical_clips_are_authored_and_said_to_be_so) {
    Folder folder;
    const std::vector<Motion> set = make_synthetic_set().clips;
    const auto walk = std::find_if(set.begin(), set.end(), [](const Motion& m) { return m.name == "walk"; });
    ASSERT_NE(walk, set.end());
    const AuthorResult result = author_motions({*walk, *walk, *walk}, folder.path, plain());
    std::set<std::string> names, rules;
    for (const ProjectClip& clip : result.project.clips) names.insert(clip.name);
    EXPECT_EQ(names.size(), 3u);
    for (const Finding& finding : result.project.findings) rules.insert(finding.rule);
    EXPECT_TRUE(rules.count("degenerate-space"));
    EXPECT_TRUE(rules.count("duplicate"));
}

TEST(author, clips_of_a_style_get_a_space_of_their_own_and_keep_it) {
    Folder folder;
    AuthorOptions options = plain();
    options.styles = {StyleOption::parse("brisk=jog*", false), StyleOption::parse("none=nothing*", true)};
    AuthorResult result = author_motions(make_synthetic_set().clips, folder.path, options);
    const ProjectSpace* style = result.project.find_space("style:brisk");
    ASSERT_NE(style, nullptr);
    EXPECT_EQ(style->clips.size(), 3u) << "jog, jog_left, jog_right";
    for (const int clip : result.project.find_space("facing")->clips)
        EXPECT_NE(result.project.clips[static_cast<std::size_t>(clip)].style, "brisk");
    for (const Finding& finding : result.project.findings) EXPECT_NE(finding.space, "style:brisk") << finding.message;
    EXPECT_TRUE(std::any_of(result.warnings.begin(), result.warnings.end(),
                            [](const std::string& w) { return w.find("no style \"none\"") != std::string::npos; }));
    result = author_motions(make_synthetic_set().clips, folder.path, plain());
    EXPECT_NE(result.project.find_space("style:brisk"), nullptr) << "kept by the project";
    EXPECT_THROW(StyleOption::parse("=x", false), Error);
    EXPECT_THROW(StyleOption::parse("brisk", false), Error);
}

TEST(author, a_damaged_project_is_not_overwritten) {
    Folder folder;
    write_file(folder.path / "project.json", "{\"surefoot_project\": 1, \"clips\": 7}");
    EXPECT_NE(message_of([&] { author_motions(make_synthetic_set().clips, folder.path, plain()); }).find("/clips"),
              std::string::npos);
    EXPECT_EQ(read_file(folder.path / "project.json"), "{\"surefoot_project\": 1, \"clips\": 7}");
}

TEST(author, real_game_clips_without_turns_make_a_line_and_name_what_opens_the_plane) {
    SUREFOOT_NEED_MOTION_DATA(motion);
    Folder folder;
    const std::string paths[] = {(motion / "ual1_locomotion_glb/UAL1_50clips_mannequin.glb").string()};
    const AuthorResult result = author_clips(paths, folder.path, plain());
    std::set<std::string> used;
    for (const ProjectClip& clip : result.project.clips) {
        if (clip.excluded) {
            EXPECT_FALSE(clip.reason.empty()) << clip.name;
        } else {
            used.insert(clip.name);
        }
    }
    EXPECT_TRUE(used.count("Walk_Loop") && used.count("Walk_Formal_Loop") && used.count("Jog_Fwd_Loop"));
    EXPECT_FALSE(used.count("Sword_Attack") || used.count("Death01") || used.count("Roll"));
    const ProjectSpace* facing = result.project.find_space("facing");
    ASSERT_NE(facing, nullptr);
    EXPECT_EQ(facing->space.dimensions(), 1);
    bool opens = false;
    for (const Placeholder& p : result.project.placeholders)
        opens |= p.rule == "degenerate-space" && p.axes.size() == 2;
    EXPECT_TRUE(opens);
}

}  // namespace
}  // namespace surefoot
