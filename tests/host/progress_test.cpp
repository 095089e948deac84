#include <surefoot/host/progress.h>

#include <surefoot/host/parallel.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <mutex>
#include <string>
#include <vector>

namespace surefoot {
namespace {

std::mutex g_several;
std::vector<std::string> g_told;

void tell(const std::string& label, std::size_t done, std::size_t total) {
    const std::lock_guard<std::mutex> hold(g_several);
    g_told.push_back(label + " " + std::to_string(done) + "/" + std::to_string(total));
}

TEST(progress, who_watches_is_told_of_every_step_and_nobody_afterwards) {
    g_told.clear();
    watch_progress(tell);
    {
        Progress progress("measuring", 3);
        parallel_for(3, [&](std::size_t) { progress.advance(); });
    }
    watch_progress(nullptr);
    Progress("unheard", 1).advance();
    std::sort(g_told.begin(), g_told.end());
    EXPECT_EQ(g_told, (std::vector<std::string>{"measuring 0/3", "measuring 1/3", "measuring 2/3", "measuring 3/3"}));
}

}  // namespace
}  // namespace surefoot
