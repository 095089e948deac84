#include <surefoot/author/author.h>
#include <surefoot/author/result_cache.h>
#include <surefoot/host/files.h>
#include <surefoot/io/gltf.h>
#include <surefoot/synthetic/synthetic_set.h>

#include <gtest/gtest.h>

#include <map>

namespace surefoot {
namespace {

namespace fs = std::filesystem;

class Cached : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::path(testing::TempDir()) /
                  ("cache_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::vector<fs::path> entries(const fs::path& cache) const {
        std::vector<fs::path> found;
        for (const auto& entry : fs::directory_iterator(cache)) found.push_back(entry.path());
        std::sort(found.begin(), found.end());
        return found;
    }

    fs::path folder_;
};

TEST_F(Cached, what_was_stored_is_found_by_the_next_run_and_only_under_its_key) {
    ResultCache first(folder_);
    ASSERT_TRUE(first.enabled());
    const CacheKey key = first.key("clip"), other = first.key("another clip");
    EXPECT_FALSE(first.find(key));
    first.store(key, "result");
    ResultCache second(folder_);
    EXPECT_EQ(second.find(second.key("clip")), "result");
    EXPECT_FALSE(second.find(other));
}

TEST_F(Cached, entries_that_are_cut_short_altered_or_under_a_wrong_name_are_not_believed) {
    ResultCache cache(folder_);
    const CacheKey key = cache.key("clip"), other = cache.key("another clip");
    cache.store(key, "a result of some length");
    const fs::path file = entries(folder_).at(0);
    const std::string whole = read_file(file);
    for (std::size_t size = 0; size < whole.size(); ++size) {
        write_file(file, whole.substr(0, size), Durability::may_be_lost);
        EXPECT_FALSE(cache.find(key)) << size;
    }
    for (std::size_t i = 0; i < whole.size(); ++i) {
        std::string altered = whole;
        altered[i] = static_cast<char>(altered[i] ^ 0x41);
        write_file(file, altered, Durability::may_be_lost);
        EXPECT_FALSE(cache.find(key)) << i;
    }
    write_file(file, whole + "more", Durability::may_be_lost);
    EXPECT_FALSE(cache.find(key));
    write_file(file, whole, Durability::may_be_lost);
    EXPECT_TRUE(cache.find(key));
    cache.store(other, "other");
    for (const fs::path& entry : entries(folder_)) write_file(entry, whole, Durability::may_be_lost);
    EXPECT_TRUE(cache.find(key));
    EXPECT_FALSE(cache.find(other));
}

TEST_F(Cached, entries_that_no_run_asks_for_any_more_go) {
    ResultCache first(folder_);
    for (const char* clip : {"a", "b", "c"}) first.store(first.key(clip), clip);
    write_file(folder_ / "notes.txt", "the user's own");
    ResultCache second(folder_);
    EXPECT_TRUE(second.find(second.key("b")));
    second.store(second.key("d"), "d");
    second.remove_unused();
    EXPECT_TRUE(second.find(second.key("b")));
    EXPECT_TRUE(second.find(second.key("d")));
    EXPECT_FALSE(second.find(second.key("a")));
    EXPECT_TRUE(fs::exists(folder_ / "notes.txt"));
}

TEST_F(Cached, a_folder_that_cannot_be_written_is_no_cache_and_no_error) {
    write_file(folder_ / "file", "in the way");
    ResultCache cache(folder_ / "file" / "below");
    cache.store(cache.key("clip"), "result");
    EXPECT_FALSE(cache.find(cache.key("clip")));
    cache.remove_unused();
    ResultCache none{fs::path()};
    none.store(none.key("clip"), "result");
    EXPECT_FALSE(none.find(none.key("clip")));
}

/// Every file of a project but its cache.
std::map<std::string, std::string> outputs(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string name = fs::relative(entry.path(), folder).string();
        if (entry.is_regular_file() && name.rfind(".cache", 0) != 0) files[name] = read_file(entry.path());
    }
    return files;
}

/// A few generated clips as files, one of them a take of two cycles.
std::vector<std::string> write_clips(const fs::path& folder) {
    std::vector<std::string> paths;
    for (const Motion& motion : make_synthetic_set().clips) {
        if (motion.name.find("jog") == 0 || motion.name.find("strafe") == 0) continue;
        GltfScene scene;
        scene.motions = {motion};
        paths.push_back((folder / (motion.name + ".glb")).string());
        write_file(paths.back(), write_glb(scene));
    }
    return paths;
}

TEST_F(Cached, projects_are_the_same_with_a_cache_without_one_and_with_a_broken_one) {
    const std::vector<std::string> clips = write_clips(folder_ / "in");
    AuthorOptions options;
    options.name = "test";
    AuthorOptions without = options;
    without.cache = false;
    const fs::path out = folder_ / "out";
    author_clips(clips, out, without);
    EXPECT_FALSE(fs::exists(out / ".cache"));
    author_clips(clips, out, without);  // a first run has no project of its own to keep anything of
    const auto expected = outputs(out);
    author_clips(clips, out, options);
    EXPECT_EQ(outputs(out), expected) << "a cold cache";
    ASSERT_EQ(entries(out / ".cache").size(), clips.size());
    author_clips(clips, out, options);
    EXPECT_EQ(outputs(out), expected) << "a warm cache";
    int n = 0;
    for (const fs::path& entry : entries(out / ".cache"))
        write_file(entry, n++ % 2 ? std::string("rubbish") : read_file(entry).substr(0, 1000));
    author_clips(clips, out, options);
    EXPECT_EQ(outputs(out), expected) << "a broken cache";
    fs::remove_all(out / ".cache");
    author_clips(clips, out, options);
    EXPECT_EQ(outputs(out), expected) << "no cache any more";
}

TEST_F(Cached, only_the_clip_that_changed_is_written_again) {
    const std::vector<std::string> clips = write_clips(folder_ / "in");
    const fs::path out = folder_ / "out";
    author_clips(clips, out, {});
    author_clips(clips, out, {});
    const auto before = fs::last_write_time(out / "clips/walk.glb"), other = fs::last_write_time(out / "clips/run.glb");
    Motion motion;
    for (Motion& one : make_synthetic_set().clips)
        if (one.name == "run") motion = one;
    for (RootFrame& root : motion.root) root.position.z *= 1.01f;
    GltfScene scene;
    scene.motions = {motion};
    write_file(folder_ / "in/run.glb", write_glb(scene));
    author_clips(clips, out, {});
    EXPECT_EQ(fs::last_write_time(out / "clips/walk.glb"), before);
    EXPECT_GT(fs::last_write_time(out / "clips/run.glb"), other);
}

}  // namespace
}  // namespace surefoot
