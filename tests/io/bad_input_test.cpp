// Every kind of broken file we know, with what its user is told. None may crash, hang or take unbounded memory.

#include "glb_bytes.h"
#include "random_motion.h"
#include "written_scenes.h"

#include <surefoot/base/error.h>
#include <surefoot/host/files.h>
#include <surefoot/io/bvh.h>
#include <surefoot/io/gltf.h>
#include <surefoot/io/load.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <sys/mount.h>
#include <unistd.h>

namespace surefoot {
namespace {

namespace fs = std::filesystem;

const std::string k_joint = "HIERARCHY\nROOT hips\n{\nOFFSET 0 1 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n";
const std::string k_bvh = k_joint + "End Site\n{\nOFFSET 0 1 0\n}\n}\nMOTION\nFrames: 3\nFrame Time: 0.033333\n";

std::string with(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

std::string repeated(const std::string& part, int times) {
    std::string text;
    for (int i = 0; i < times; ++i) text += part;
    return text;
}

/// One rotating node of three keys, as JSON to be broken.
const std::string k_gltf =
    R"({"asset":{"version":"2.0"},"nodes":[{"name":"a","children":[1]},{"name":"b","translation":[0,1,0]}],)"
    R"("buffers":[{"byteLength":60}],"bufferViews":[{"buffer":0,"byteLength":12},{"buffer":0,"byteOffset":12,"byteLength":48}],)"
    R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"SCALAR"},{"bufferView":1,"componentType":5126,"count":3,"type":"VEC4"}],)"
    R"("animations":[{"name":"walk","channels":[{"sampler":0,"target":{"node":0,"path":"rotation"}}],"samplers":[{"input":0,"output":1}]}]})";
const std::vector<float> k_keys = {0, 0.1f, 0.2f, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};

std::string glb_with(const std::string& from, const std::string& to) {
    return test::glb_bytes(with(k_gltf, from, to), k_keys);
}

struct Bad {
    const char* what;
    const char* file;
    std::string bytes;
    const char* message;
};

const std::vector<Bad>& table() {
    const std::string good = test::glb_bytes(k_gltf, k_keys);
    static const std::vector<Bad> bad = {
        {"empty BVH", "x.bvh", "", "x.bvh: the file is empty"},
        {"blank BVH", "x.bvh", " \r\n\t\n", "x.bvh: the file is empty"},
        {"not a BVH", "x.bvh", "PK\x03\x04 a zip, really", "x.bvh:1: not a BVH file: it does not begin with HIERARCHY"},
        {"text after the hierarchy", "x.bvh", k_joint + "}\nMOTON\n",
         "x.bvh:7: 'MOTON' stands where ROOT or MOTION should"},
        {"cut inside the hierarchy", "x.bvh", k_joint, "the file ends inside its hierarchy"},
        {"no motion block", "x.bvh", k_joint + "}\n", "the file ends before its MOTION block"},
        {"truncated motion block", "x.bvh", k_bvh + "0 0 0\n1 1 1\n", "the motion block ends after 2 of 3 frames"},
        {"too few numbers", "x.bvh", k_bvh + "0 0 0\n1 1\n2 2 2\n", "x.bvh:15: frame 1 of 3 has 2 of 3 numbers"},
        {"too many numbers", "x.bvh", k_bvh + "0 0 0\n1 1 1 1\n2 2 2\n", "frame 1 of 3 has more than 3 numbers"},
        {"NaN", "x.bvh", k_bvh + "0 0 0\n1 nan 1\n2 2 2\n", "frame 1 of 3: number 1 is 'nan', not a finite number"},
        {"1e999", "x.bvh", k_bvh + "0 0 0\n1 1 1e999\n2 2 2\n",
         "frame 1 of 3: number 2 is '1e999', not a finite number"},
        {"a word among numbers", "x.bvh", k_bvh + "0 0 0\n1 1 1.0x\n2 2 2\n",
         "number 2 is '1.0x', not a finite number"},
        {"a billion frames", "x.bvh", with(k_bvh, "Frames: 3", "Frames: 1000000000") + "0 0 0\n",
         "the motion block ends after 1 of 1000000000 frames; export the clip again, or mend its 'Frames:' line"},
        {"negative frames", "x.bvh", with(k_bvh, "Frames: 3", "Frames: -3"),
         "the number of frames is not a whole number"},
        {"zero-length clip", "x.bvh", with(k_bvh, "Frames: 3", "Frames: 0"), "the clip has no frames"},
        {"frame time of zero", "x.bvh", with(k_bvh, "0.033333", "0") + "0 0 0\n",
         "a frame time of '0' s is not usable"},
        {"offset of NaN", "x.bvh", with(k_bvh, "OFFSET 0 1 0", "OFFSET 0 nan 0"),
         "an OFFSET is 'nan', not a finite number"},
        {"a channel that is none", "x.bvh", with(k_bvh, "Zrotation", "Wrotation"), "'Wrotation' is not a channel"},
        {"a billion channels", "x.bvh", with(k_bvh, "CHANNELS 3", "CHANNELS 1000000000"),
         "a joint cannot have that many CHANNELS"},
        {"no channels", "x.bvh", with(k_bvh, "CHANNELS 3 Zrotation Xrotation Yrotation\n", ""),
         "no joint has CHANNELS"},
        {"one brace too many", "x.bvh", k_joint + "}\n}\n", "a '}' closes nothing"},
        {"deep nesting", "x.bvh", "HIERARCHY\n" + repeated("ROOT a\n{\n", 100000),
         "the skeleton has more than 1024 joints"},

        {"empty GLB", "x.glb", "", "x.glb: the file is empty"},
        {"not a glTF", "x.glb", "hello", "x.glb: not a glTF file"},
        {"JSON that is a list", "x.gltf", "[1, 2]", "its JSON text is not an object"},
        {"GLB of a header only", "x.glb", good.substr(0, 14), "the GLB file ends inside its header, at byte 14"},
        {"truncated GLB", "x.glb", good.substr(0, good.size() - 20), "the GLB file is cut off: its header speaks of"},
        {"huge chunk length", "x.glb", good.substr(0, 12) + std::string("\xff\xff\xff\x7f", 4) + good.substr(16),
         "the first chunk of the GLB file is not a whole JSON text"},
        {"GLB version 1", "x.glb", good.substr(0, 4) + std::string("\1\0\0\0", 4) + good.substr(8),
         "GLB version 1 is not supported"},
        {"deep nesting", "x.gltf", R"({"extras":)" + std::string(1000000, '['),
         "the JSON text nests deeper than 128 levels"},
        {"Draco required", "x.glb",
         glb_with(R"("asset")", R"("extensionsRequired":["KHR_draco_mesh_compression"],"asset")"),
         "the file needs KHR_draco_mesh_compression, which is not supported; export without compression"},
        {"meshopt required", "x.glb",
         glb_with(R"("asset")", R"("extensionsRequired":["EXT_meshopt_compression"],"asset")"),
         "the file needs EXT_meshopt_compression, which is not supported"},
        {"cyclic hierarchy", "x.glb", glb_with(R"({"name":"b",)", R"({"name":"b","children":[0],)"),
         "the node hierarchy is cyclic"},
        {"a node that is its own child", "x.glb", glb_with(R"("children":[1])", R"("children":[0])"),
         "the node hierarchy is cyclic"},
        {"two parents", "x.glb", glb_with(R"("children":[1])", R"("children":[1,1])"), "node 1 'b' has two parents"},
        {"child out of range", "x.glb", glb_with(R"("children":[1])", R"("children":[7])"),
         "node 0 'a' has child 7, but there are only 2 nodes"},
        {"track of no node", "x.glb", glb_with(R"("node":0)", R"("node":9)"), "animation 'walk' moves node 9"},
        {"accessor beyond its view", "x.glb", glb_with(R"("count":3,"type":"VEC4")", R"("count":4,"type":"VEC4")"),
         "accessor 1 reaches beyond its buffer view of 48 bytes (used by animation 'walk', channel 0)"},
        {"a billion keys", "x.glb", glb_with(R"("count":3,"type":"SCALAR")", R"("count":1000000000,"type":"SCALAR")"),
         "accessor 0 reaches beyond its buffer view"},
        {"accessor out of range", "x.glb", glb_with(R"("output":1)", R"("output":5)"), "accessor 5 does not exist"},
        {"view beyond its buffer", "x.glb", glb_with(R"("byteLength":48)", R"("byteLength":480)"),
         "beyond its buffer of 60 bytes"},
        {"a zero accessor of a billion", "x.glb",
         glb_with(R"("bufferView":0,"componentType":5126,"count":3)", R"("componentType":5126,"count":1000000000)"),
         "accessor 0 promises more elements than it has data for"},
        {"wrong type", "x.glb", glb_with(R"("VEC4")", R"("VEC3")"), "accessor 1 is not of the type that is needed"},
        {"many buffers", "x.glb", glb_with(R"("buffers":[)", R"("buffers":[)" + repeated(R"({"byteLength":60},)", 70)),
         "at most 64 are read"},
        {"no animation", "x.glb", glb_with(R"("animations")", R"("animation")"), "the file has no animation"},
        {"a buffer elsewhere", "x.gltf",
         with(k_gltf, R"("byteLength":60)", R"("byteLength":60,"uri":"../../../../etc/passwd")"),
         "x.gltf: not a sound glTF file"},
        {"an absolute buffer", "x.gltf", with(k_gltf, R"("byteLength":60)", R"("byteLength":60,"uri":"/etc/passwd")"),
         "x.gltf: not a sound glTF file"},
        {"keys that run backwards", "x.glb",
         test::glb_bytes(k_gltf, {0.2f, 0.1f, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}),
         "has key times that run backwards"},
        {"a key that is infinite", "x.glb",
         test::glb_bytes(k_gltf, {0, 0.1f, 1e30f * 1e30f, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}),
         "accessor 0 holds a number that is not finite"},
        {"a clip of a thousand years", "x.glb",
         test::glb_bytes(k_gltf, {0, 0.01f, 3e10f, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}), "its clips are too long"},

        {"empty FBX", "x.fbx", "", "x.fbx: the file is empty"},
        {"not an FBX", "x.fbx", "hello", "x.fbx: not a sound FBX file"},
        {"binary FBX cut short", "x.fbx", std::string("Kaydara FBX Binary  \0\x1a\0\x84\x1d\0\0", 27),
         "x.fbx: not a sound FBX file"},
        {"deep FBX", "x.fbx", "; FBX 7.4.0 project file\n" + repeated("a: {\n", 100000),
         "nests deeper than 256 levels"},
        {"not a Collada", "x.dae", "hello", "x.dae: not a sound Collada file"},
        {"deep Collada", "x.dae", "<COLLADA>" + repeated("<node>", 100000), "nests deeper than 256 levels"},
        {"unknown extension", "x.txt", "hello", "the extension '.txt' is not one of a clip"},
    };
    return bad;
}

TEST(BadInput, each_kind_is_refused_with_a_message_that_helps) {
    for (const Bad& bad : table()) {
        try {
            read_clips(bad.bytes, bad.file);
            ADD_FAILURE() << bad.what << ": was read";
        } catch (const Error& error) {
            const std::string text = error.what();
            EXPECT_NE(text.find(bad.message), std::string::npos) << bad.what << ": " << text;
            EXPECT_EQ(text.find(bad.file), 0u) << bad.what << " does not say where: " << text;
            EXPECT_FALSE(error.remedy().empty()) << bad.what << " does not say what to do: " << text;
        }
    }
}

TEST(BadInput, the_unbroken_forms_are_read) {
    EXPECT_EQ(read_clips(k_bvh + "0 0 0\n1 1 1\n2 2 2\n", "x.bvh").size(), 1u);
    EXPECT_EQ(read_clips(test::glb_bytes(k_gltf, k_keys), "x.glb").at(0).motion.frame_count(),
              7);  // 10 keys a second: read at 30
}

TEST(BadInput, one_frame_is_a_pose_with_a_warning) {
    const LoadedClip clip = read_bvh(with(k_bvh, "Frames: 3", "Frames: 1") + "1 2 3\n", "x.bvh");
    EXPECT_EQ(clip.motion.frame_count(), 1);
    ASSERT_FALSE(clip.warnings.empty());
    EXPECT_EQ(clip.warnings[0], "only one frame: a pose, not a motion");
}

TEST(BadInput, joints_of_a_glb_without_names_of_their_own_get_them) {
    const auto twice = read_clips(glb_with(R"("name":"b")", R"("name":"a")"), "x.glb");
    EXPECT_EQ(twice[0].motion.skeleton->names, (std::vector<std::string>{"a", "a_2"}));
    const auto missing = read_clips(glb_with(R"({"name":"b",)", "{"), "x.glb");
    EXPECT_EQ(missing[0].motion.skeleton->names, (std::vector<std::string>{"a", "joint_1"}));
    EXPECT_EQ(missing[0].warnings.at(0), "joint 1 has no name: called 'joint_1'");
}

class Files : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("surefoot_io_" + std::to_string(getpid()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override {
        fs::permissions(folder_, fs::perms::owner_all);
        fs::remove_all(folder_);
    }
    LoadResult load(const std::string& name) const {
        const std::string paths[] = {(folder_ / name).string()};
        return load_clips(paths);
    }
    fs::path folder_;
};

TEST_F(Files, a_folder_without_clips_is_reported) {
    std::ofstream(folder_ / "notes.txt") << "nothing";
    const LoadResult result = load("");
    EXPECT_TRUE(result.clips.empty());
    ASSERT_EQ(result.failed.size(), 1u);
    EXPECT_NE(result.failed[0].error.find("no clips in this folder; it should hold .bvh"), std::string::npos);
}

TEST_F(Files, a_missing_file_is_reported_and_the_rest_goes_on) {
    write_file(folder_ / "good.bvh", k_bvh + "0 0 0\n1 1 1\n2 2 2\n");
    write_file(folder_ / "broken.bvh", "no");
    const std::string paths[] = {(folder_ / "missing.bvh").string(), folder_.string()};
    const LoadResult result = load_clips(paths);
    ASSERT_EQ(result.clips.size(), 1u);
    EXPECT_EQ(result.clips[0].motion.name, "good");
    ASSERT_EQ(result.failed.size(), 2u);
    EXPECT_NE(result.failed[0].error.find("broken.bvh:1: not a BVH file"), std::string::npos);
    EXPECT_NE(result.failed[1].error.find("missing.bvh: no such file or folder; check the path"), std::string::npos);
}

TEST_F(Files, a_folder_that_cannot_be_written_is_reported_and_left_alone) {
    if (geteuid() == 0) {
        // Root may write anywhere; a file where the folder should be stops root, too.
        std::ofstream(folder_ / "taken") << "a file";
        EXPECT_THROW(write_file(folder_ / "taken" / "x.bvh", "text"), Error);
        EXPECT_EQ(read_file(folder_ / "taken"), "a file");
        return;
    }
    fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_THROW(write_file(folder_ / "x.bvh", "text"), Error);
    EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(Files, a_full_disk_leaves_what_was_there) {
    if (geteuid() != 0 || mount("tmpfs", folder_.c_str(), "tmpfs", 0, "size=64k") != 0)
        GTEST_SKIP() << "not run: a small disk can only be made by root";
    write_file(folder_ / "x.bvh", "before");
    std::string problem;
    try {
        write_file(folder_ / "x.bvh", std::string(1 << 20, 'x'));
    } catch (const Error& error) {
        problem = error.what();
    }
    const std::string kept = read_file(folder_ / "x.bvh");
    const auto files = std::distance(fs::directory_iterator(folder_), fs::directory_iterator{});
    umount(folder_.c_str());
    EXPECT_NE(problem.find("cannot be written: No space left on device"), std::string::npos) << problem;
    EXPECT_EQ(kept, "before");
    EXPECT_EQ(files, 1) << "a temporary file was left";
}

/// Bytes changed, cut, doubled and swapped at random: whatever comes out, it is a clip or an Error.
void expect_no_harm(const std::string& good, const char* file, int rounds, std::uint64_t seed) {
    Random random(seed);
    int read = 0;
    for (int i = 0; i < rounds; ++i) {
        std::string bytes = good;
        const int changes = 1 + static_cast<int>(random.below(8));
        for (int c = 0; c < changes && !bytes.empty(); ++c) {
            const std::size_t at = random.below(static_cast<std::uint32_t>(bytes.size()));
            switch (random.below(6)) {
                case 0:
                    bytes[at] = static_cast<char>(random.next());
                    break;
                case 1:
                    bytes.resize(at);
                    break;
                case 2:
                    bytes.erase(at, 1 + random.below(16));
                    break;
                case 3:
                    bytes.insert(
                        at, bytes.substr(random.below(static_cast<std::uint32_t>(bytes.size())), random.below(64)));
                    break;
                case 4:
                    bytes[at] = "0123456789-.eE{}[]\n \","[random.below(22)];
                    break;
                default:
                    bytes.insert(at, std::string("99999999999"));
            }
        }
        try {
            for (const LoadedClip& clip : read_clips(bytes, file)) {
                EXPECT_EQ(problem(clip.motion), "");
                ++read;
            }
        } catch (const Error&) {
        }
    }
    EXPECT_LT(read, rounds);
}

TEST(Mutations, of_a_bvh_do_no_harm) {
    Random random(7);
    expect_no_harm(write_bvh(test::random_motion(random, 6, 5)), "x.bvh", 4000, 1);
}

// Not of an FBX: assimp 5.2 adds a key for every half turn between two keys, so a single angle of 1e11 degrees keeps it
// busy for minutes, and there is no way to stop it from outside.
TEST(Mutations, of_a_collada_do_no_harm) {
    expect_no_harm(test::write_collada(test::written_joints(false), true), "x.dae", 300, 5);
}

TEST(Mutations, of_a_glb_do_no_harm) {
    Random random(8);
    GltfScene scene;
    scene.motions.push_back(test::random_motion(random, 4, 5));
    const std::string glb = write_glb(scene);
    expect_no_harm(glb, "x.glb", 2000, 2);
    expect_no_harm(test::glb_bytes(k_gltf, k_keys), "x.glb", 2000, 3);
    // The JSON alone, so that lengths do not stop most mutations at the door.
    expect_no_harm(
        with(k_gltf, R"("byteLength":60)",
             R"("byteLength":60,"uri":"data:application/octet-stream;base64,)" + std::string(80, 'A') + "\""),
        "x.gltf", 4000, 4);
}

}  // namespace
}  // namespace surefoot
