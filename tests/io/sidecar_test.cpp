#include <surefoot/base/error.h>
#include <surefoot/host/files.h>
#include <surefoot/io/load.h>
#include <surefoot/io/sidecar.h>

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

namespace surefoot {
namespace {

std::vector<LoadedClip> clips_named(const std::vector<std::string>& names) {
    std::vector<LoadedClip> clips(names.size());
    for (std::size_t i = 0; i < names.size(); ++i) clips[i].motion.name = names[i];
    return clips;
}

TEST(sidecar, it_lies_beside_the_clip_under_the_same_name) {
    EXPECT_EQ(sidecar_path("clips/walk.bvh"), "clips/walk.surefoot.json");
    EXPECT_EQ(sidecar_path("a.b/walk.v2.glb"), "a.b/walk.v2.surefoot.json");
    EXPECT_EQ(sidecar_path("a.b/walk"), "a.b/walk.surefoot.json");
}

TEST(sidecar, numbers_hold_for_all_clips_of_a_file_unless_one_has_its_own) {
    auto clips = clips_named({"Walk", "Walk_Tired"});
    apply_sidecar(R"({"style": 0.25, "load": -3, "clips": {"Walk_Tired": {"style": 1}}})", "x.surefoot.json", clips);
    EXPECT_EQ(clips[0].custom, (std::map<std::string, float>{{"load", -3.0f}, {"style", 0.25f}}));
    EXPECT_EQ(clips[1].custom, (std::map<std::string, float>{{"load", -3.0f}, {"style", 1.0f}}));
}

TEST(sidecar, what_is_wrong_with_one_is_told_with_its_place) {
    const std::pair<const char*, const char*> faults[] = {
        {"", "no JSON object"},
        {"[1]", "no JSON object"},
        {"{\"style\": 1", "no JSON object"},
        {R"({"style": "high"})", "\"style\" must be a number, found \"high\""},
        {R"({"style": 1e300})", "\"style\" must be a number"},
        {R"({"speed": 1})", "\"speed\" is measured"},
        {R"({"a,b": 1})", "cannot name an axis"},
        {R"({"": 1})", "cannot name an axis"},
        {R"({"clips": 3})", "must be an object of clip names"},
        {R"({"clips": {"Walk": 3}})", "the numbers of clip \"Walk\""},
        {R"({"clips": {"Run": {"style": 1}}})", "there is no clip \"Run\""},
    };
    for (const auto& [json, expected] : faults) {
        auto clips = clips_named({"Walk"});
        try {
            apply_sidecar(json, "walk.surefoot.json", clips);
            ADD_FAILURE() << json;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find("walk.surefoot.json"), std::string::npos) << error.what();
        }
    }
}

TEST(sidecar, clips_are_loaded_with_the_numbers_beside_them) {
    const auto folder = std::filesystem::temp_directory_path() / ("surefoot_sidecar_test_" + std::to_string(getpid()));
    std::filesystem::remove_all(folder);
    const char* bvh =
        "HIERARCHY\nROOT hips\n{\nOFFSET 0 90 0\nCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation "
        "Yrotation\nEnd Site\n{\nOFFSET 0 10 0\n}\n}\nMOTION\nFrames: 2\nFrame Time: 0.033333\n0 90 0 0 0 0\n0 90 1 "
        "0 0 0\n";
    write_file(folder / "plain.bvh", bvh);
    write_file(folder / "tired.bvh", bvh);
    write_file(folder / "tired.surefoot.json", R"({"style": 0.5})");
    write_file(folder / "wrong.bvh", bvh);
    write_file(folder / "wrong.surefoot.json", R"({"style": null})");
    const std::string path = folder.string();
    const LoadResult result = load_clips({&path, 1});
    ASSERT_EQ(result.clips.size(), 2u);
    EXPECT_TRUE(result.clips[0].custom.empty());
    EXPECT_EQ(result.clips[1].custom.at("style"), 0.5f);
    ASSERT_EQ(result.failed.size(), 1u);
    EXPECT_NE(result.failed[0].error.find("wrong.surefoot.json"), std::string::npos);
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace surefoot
