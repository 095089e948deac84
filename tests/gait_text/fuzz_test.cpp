// Whatever the text: an Error or a program that runs, soon. Deterministic.

#include <surefoot/base/error.h>
#include <surefoot/base/random.h>
#include <surefoot/gait_text/gait.h>

#include <gtest/gtest.h>

#include <tests/support/damage.h>

#include <cmath>

namespace surefoot {
namespace {

/// Reads; what can be read is run, too. True where it can.
bool survives(const std::string& text) {
    try {
        const Gait gait = read_gait(text, "fuzz.gait", GaitOutputs::everything);
        EXPECT_EQ(gait.program.problem(), "");
        std::vector<float> inputs(8 * k_gait_inputs, 0.3f), parameters, out(8 * gait.program.outputs.size());
        for (const GaitParameter& p : gait.parameters)
            parameters.insert(parameters.end(), 8, static_cast<float>(p.value));
        run(gait.program, inputs, parameters, out);
        for (const float x : out) EXPECT_TRUE(std::isfinite(x)) << text;
        return true;
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("fuzz.gait"), std::string::npos) << error.what();
        return false;
    }
}

TEST(GaitFuzz, soups_of_words_are_read_or_refused) {
    const std::string words[] = {
        "gait", "parameter", "let", "control", "period", "preset",      "in",     "unit",  "help",  "\"x\"",
        "a",    "b",         "c.d", "t",       "T",      "phase",       "pi",     "1",     "0.5",   "1e3",
        "+",    "-",         "*",   "/",       "(",      ")",           ",",      "?",     ":",     "<",
        "==",   "=",         "{",   "}",       "[",      "]",           "sin",    "mix",   "pulse", "noise",
        "and",  "not",       "or",  "\n",      "#",      "control x =", "sin(t)", "a = 1", "\xff",  "."};
    Random random(3);
    int read = 0;
    for (int i = 0; i < 20000; ++i) {
        std::string text = i % 2 == 0 ? "control k = " : "";
        const int length = 1 + static_cast<int>(random.below(i % 2 == 0 ? 8 : 60));
        for (int w = 0; w < length; ++w) text += words[random.below(std::size(words))] + " ";
        read += survives(text) ? 1 : 0;
    }
    EXPECT_GT(read, 100);  // or the soup is too thin to tell anything
}

TEST(GaitFuzz, bundled_gaits_with_damage_are_read_or_refused) {
    Random random(4);
    const std::string_view names = bundled_gait_names();
    int read = 0, refused = 0;
    for (std::size_t at = 0; at < names.size(); at = names.find('\n', at) + 1) {
        const std::string whole(bundled_gait(names.substr(at, names.find('\n', at) - at)));
        ASSERT_FALSE(whole.empty());
        for (int i = 0; i < 1500; ++i) ++(survives(test::damaged(whole, random)) ? read : refused);
    }
    EXPECT_GT(read, 100);
    EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace surefoot
