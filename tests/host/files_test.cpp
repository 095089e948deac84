#include <surefoot/base/error.h>
#include <surefoot/host/files.h>

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <iterator>
#include <string>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace surefoot {
namespace {

namespace fs = std::filesystem;

/// A folder of its own, gone at the end.
struct Scratch {
    fs::path folder = fs::temp_directory_path() / ("surefoot_files_test_" + std::to_string(getpid()));
    Scratch() { fs::create_directories(folder); }
    ~Scratch() { fs::remove_all(folder); }
    auto entries() const { return std::distance(fs::directory_iterator(folder), fs::directory_iterator()); }
};

TEST(Files, what_was_written_is_read_and_nothing_else_is_left) {
    Scratch scratch;
    const fs::path file = scratch.folder / "a.txt";
    write_file(file, "first");
    write_file(file, "second");
    EXPECT_EQ(read_file(file), "second");
    EXPECT_EQ(scratch.entries(), 1);
}

TEST(Files, a_name_as_long_as_the_file_system_allows_can_be_written) {
    Scratch scratch;
    const fs::path file = scratch.folder / std::string(255, 'x');
    write_file(file, "text");
    EXPECT_EQ(read_file(file), "text");
}

TEST(Files, a_folder_in_the_way_is_named_and_left_alone) {
    Scratch scratch;
    fs::create_directory(scratch.folder / "out.json");
    try {
        write_file(scratch.folder / "out.json", "text");
        FAIL() << "a folder was overwritten";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("out.json: cannot be written: it is a folder"), std::string::npos);
    }
    EXPECT_EQ(scratch.entries(), 1);
}

TEST(Files, a_pipe_is_written_to_and_not_replaced) {
    Scratch scratch;
    const fs::path pipe = scratch.folder / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    const pid_t reader = fork();
    if (reader == 0) {
        std::FILE* file = std::fopen(pipe.c_str(), "rb");
        char text[8] = {};
        const bool right = file && std::fread(text, 1, 4, file) == 4 && std::string(text) == "text";
        _exit(right ? 0 : 1);
    }
    write_file(pipe, "text");
    int status = 1;
    waitpid(reader, &status, 0);
    EXPECT_EQ(status, 0);
    EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST(Files, an_interrupt_while_writing_leaves_no_temporary_file) {
    Scratch scratch;
    const pid_t writer = fork();
    if (writer == 0) {
        std::signal(SIGINT, SIG_DFL);
        remove_temporaries_on_signals();
        const std::string large(std::size_t{16} << 20, 'x');
        for (;;) write_file(scratch.folder / "large.bin", large);
    }
    while (scratch.entries() == 0) usleep(100);  // the first temporary file is there
    kill(writer, SIGINT);
    int status = 0;
    waitpid(writer, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGINT);
    for (const auto& entry : fs::directory_iterator(scratch.folder))
        EXPECT_EQ(entry.path().filename(), "large.bin") << "left behind";
}

}  // namespace
}  // namespace surefoot
