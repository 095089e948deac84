#pragma once
// Real motion lies beside the repository in development and CI (../shared/motion); a user has none. Tests that need it
// say so and skip.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace surefoot::test {

/// The folder of real clips, or an empty path. The environment variable SUREFOOT_MOTION points elsewhere.
inline std::filesystem::path motion_data() {
    const char* given = std::getenv("SUREFOOT_MOTION");
    const std::filesystem::path folder = given ? given : SUREFOOT_SOURCE_DIR "/../shared/motion";
    return std::filesystem::is_directory(folder) ? folder : std::filesystem::path{};
}

}  // namespace surefoot::test

/// Use at the start of a test: declares `variable` as the folder of real clips, or skips the test with a message.
#define SUREFOOT_NEED_MOTION_DATA(variable)                                 \
    const std::filesystem::path variable = ::surefoot::test::motion_data(); \
    if (variable.empty())                                                   \
    GTEST_SKIP() << "not run: no real motion at ../shared/motion (set SUREFOOT_MOTION to its folder)"
