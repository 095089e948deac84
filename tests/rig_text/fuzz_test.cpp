// Whatever the text: an Error or a sound rig, soon.

#include <surefoot/base/error.h>
#include <surefoot/base/random.h>
#include <surefoot/rig_text/rig_template.h>

#include <gtest/gtest.h>

#include <tests/support/damage.h>

#include <algorithm>

namespace surefoot {
namespace {

bool survives(const std::string& text) {
    try {
        const RigTemplate rig = read_rig_template(text, "fuzz.rig");
        const Rig made = make_rig(rig, rig_values(rig, {}, {}));
        EXPECT_EQ(problem(*made.skeleton), "");
        EXPECT_TRUE(made.roles.has_legs());
        for (const Leg& leg : made.legs.side) EXPECT_TRUE(is_finite(leg.heel) && is_finite(leg.toe_tip));
        return true;
    } catch (const Error& error) {
        EXPECT_FALSE(std::string(error.what()).empty());
        return false;
    }
}

TEST(RigFuzz, soups_of_words_are_read_or_refused) {
    const std::string words[] = {"rig",       "from",      "adult",     "set",     "let", "scale", "joint",
                                 "chain",     "in",        "role",      "through", "at",  "tip",   "when",
                                 "Left",      "Hips",      "hips",      "head",    "x",   "y",     "limit",
                                 "left_foot", "(0, 1, 0)", "(a, b, c)", "=",       "1",   "0.5",   "{",
                                 "}",         "[",         "]",         "(",       ")",   ",",     ".end",
                                 "Spine.end", "parameter", "preset",    "\"x\"",   "+",   "\xff"};
    Random random(3);
    int read = 0;
    for (int i = 0; i < 20000; ++i) {
        std::string text = i % 3 == 0 ? "rig a from adult " : "rig a scale = 1 joint Hips role hips at (0, 1, 0) ";
        const int length = static_cast<int>(random.below(i % 2 == 0 ? 5 : 30));
        for (int w = 0; w < length; ++w) text += words[random.below(std::size(words))] + " ";
        read += survives(text) ? 1 : 0;
    }
    EXPECT_GT(read, 100);  // or the soup is too thin to tell anything
}

TEST(RigFuzz, bundled_templates_with_damage_are_read_or_refused) {
    Random random(4);
    int read = 0, refused = 0;
    for (const char* name : {"adult", "toe_walker"}) {
        const std::string whole(bundled_rig(name));
        ASSERT_FALSE(whole.empty());
        for (int i = 0; i < 800; ++i) ++(survives(test::damaged(whole, random)) ? read : refused);
    }
    EXPECT_GT(read, 100);
    EXPECT_GT(refused, 100);
}

TEST(RigFuzz, any_values_within_the_ranges_make_a_sound_rig) {
    Random random(5);
    const RigTemplate rig = read_rig_template(bundled_rig("adult"), "adult.rig");
    for (int i = 0; i < 2000; ++i) {
        std::vector<double> values;
        for (const GaitParameter& p : rig.parameters) {
            const double value = random.between(static_cast<float>(p.low), static_cast<float>(p.high));
            values.push_back(p.unit == "joints" ? std::floor(value) : std::clamp(value, p.low, p.high));
        }
        const Rig made = make_rig(rig, values);
        EXPECT_EQ(problem(*made.skeleton), "");
        for (const Leg& leg : made.legs.side) {
            EXPECT_TRUE(is_finite(leg.heel) && is_finite(leg.toe_tip));
            EXPECT_GT(leg.length(), 0);
        }
    }
}

}  // namespace
}  // namespace surefoot
