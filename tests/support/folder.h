#pragma once
// A place on disk for one test.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace surefoot::test {

/// A folder that is there, and empty, for as long as this lives; its name is that of the running test.
class Folder {
  public:
    Folder() {
        const auto* running = testing::UnitTest::GetInstance()->current_test_info();
        path = std::filesystem::temp_directory_path() / ("surefoot_" + std::string(running->test_suite_name()) + "_" +
                                                         running->name() + "_" + std::to_string(getpid()));
        std::filesystem::remove_all(path);
        std::filesystem::create_directories(path);
    }
    ~Folder() { std::filesystem::remove_all(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::filesystem::path path;
};

}  // namespace surefoot::test
