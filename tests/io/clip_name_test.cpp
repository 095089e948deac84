#include <surefoot/io/clip_name.h>

#include <gtest/gtest.h>

namespace surefoot {
namespace {

TEST(ClipName, is_its_own_where_it_says_something) {
    EXPECT_EQ(clip_name("Walk_Loop", "a/b.glb"), "Walk_Loop");
    EXPECT_EQ(clip_name("Armature|Walk", "b.glb"), "Walk");
    EXPECT_EQ(clip_name("Armature|Walk|Layer0", "b.glb"), "Walk");
    EXPECT_EQ(clip_name("marche lente é", "b.glb"), "marche lente é");
}

TEST(ClipName, is_the_files_stem_where_it_is_generic) {
    for (const char* name :
         {"", " ", "mixamo.com", "Take 001", "take_02", "Animation", "animation.003", "Anim_0", "Scene",
          "Armature|mixamo.com|Layer0", "Armature|ArmatureAction", "Default", "Unreal Take", "Action.001"})
        EXPECT_EQ(clip_name(name, "moves/slow walk.v2.fbx"), "slow walk.v2") << name;
    EXPECT_EQ(clip_name("", "moves\\Jog.bvh"), "Jog");
    EXPECT_EQ(clip_name("", ".bvh"), "bvh");
    EXPECT_EQ(clip_name("", ""), "clip");
}

TEST(ClipName, is_safe_as_a_file_name) {
    EXPECT_EQ(safe_file_name("../../etc/passwd"), "_.._etc_passwd");
    EXPECT_EQ(safe_file_name("a\\b:c*d?e\"f<g>h|i"), "a_b_c_d_e_f_g_h_i");
    EXPECT_EQ(safe_file_name(std::string("new\nline\0zero", 13)), "new_line_zero");
    EXPECT_EQ(safe_file_name("\x1b[31mred"), "_[31mred");
    EXPECT_EQ(safe_file_name(".hidden"), "hidden");
    EXPECT_EQ(safe_file_name("trailing. "), "trailing");
    EXPECT_EQ(safe_file_name("CON"), "_CON");
    EXPECT_EQ(safe_file_name("com1.glb"), "_com1.glb");
    EXPECT_EQ(safe_file_name("console"), "console");
    EXPECT_EQ(safe_file_name("..."), "clip");
    EXPECT_EQ(safe_file_name("///"), "clip");
    EXPECT_EQ(safe_file_name("bad \xff utf8 \xc3("), "bad _ utf8 _(");
    EXPECT_EQ(safe_file_name(std::string(500, 'x')).size(), 80u);
    // A long name is not cut inside a character.
    std::string long_name;
    for (int i = 0; i < 100; ++i) long_name += "é";
    EXPECT_EQ(safe_file_name("x" + long_name).size(), 79u);
}

TEST(ClipName, names_become_unique_without_regard_to_case) {
    std::vector<std::string> names = {"walk", "Walk", "walk_2", "WALK", "run"};
    std::vector<std::string*> all;
    for (std::string& name : names) all.push_back(&name);
    make_unique(all);
    EXPECT_EQ(names, (std::vector<std::string>{"walk", "Walk_3", "walk_2", "WALK_4", "run"}));
}

}  // namespace
}  // namespace surefoot
