#include <surefoot/base/error.h>
#include <surefoot/base/random.h>
#include <surefoot/graph_text/json_edit.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace surefoot {
namespace {

using Json = nlohmann::ordered_json;

const std::string k_text = R"({
  "a": {"seconds": 0.3, "when": [{"x": 1}, {"x": -2.5e1}]},
  "b": {
    "one": "with \"quotes\", {braces} and [brackets]",
    "key/with~both": true
  },
  "empty": {}
}
)";

TEST(JsonEdit, replaces_one_value_and_no_other_byte) {
    std::string expected = k_text;
    expected.replace(expected.find("0.3"), 3, "0.45");
    EXPECT_EQ(with_json_value(k_text, "/a/seconds", "0.45"), expected);
    EXPECT_EQ(with_json_value(expected, "/a/seconds", "0.3"), k_text);
    EXPECT_EQ(Json::parse(with_json_value(k_text, "/a/when/1/x", "7"))["a"]["when"][1]["x"], 7);
    EXPECT_EQ(Json::parse(with_json_value(k_text, "/b/key~1with~0both", "[]"))["b"]["key/with~both"], Json::array());
    EXPECT_EQ(with_json_value("  1 ", "", "2"), "  2 ");
}

TEST(JsonEdit, lays_a_new_key_out_as_the_one_before_it) {
    const std::string inside = with_json_value(k_text, "/a/curve", "\"linear\"");
    EXPECT_NE(inside.find(R"(-2.5e1}], "curve": "linear"},)"), std::string::npos) << inside;
    const std::string below = with_json_value(k_text, "/b/two", "2");
    EXPECT_NE(below.find("\"key/with~both\": true,\n    \"two\": 2\n  },"), std::string::npos) << below;
    EXPECT_NE(with_json_value(k_text, "/empty/x", "1").find(R"("empty": {"x": 1})"), std::string::npos);
    for (const std::string& text : {inside, below}) EXPECT_TRUE(Json::accept(text));
}

TEST(JsonEdit, says_what_cannot_be_changed) {
    EXPECT_THROW(with_json_value("{", "/a", "1"), Error);
    EXPECT_THROW(with_json_value(k_text, "/a/seconds", "0.4.5"), Error);
    EXPECT_THROW(with_json_value(k_text, "/nowhere/seconds", "1"), Error);
    EXPECT_THROW(with_json_value(k_text, "/a/when/2", "1"), Error);
    EXPECT_THROW(with_json_value(k_text, "/a/seconds/deeper", "1"), Error);
}

/// A value at random, and the pointers to all that is in it.
Json random_json(Random& random, int depth) {
    const char* const words[] = {"plain", "a \"b\" \\ c", "{[,:]}", "ä\n"};
    const auto kind = depth > 3 ? random.below(3) : random.below(5);
    if (kind == 0) return random.between(-9, 9);
    if (kind == 1) return words[random.below(4)];
    if (kind == 2) return nullptr;
    Json made = kind == 3 ? Json::array() : Json::object();
    for (auto left = random.below(4); left > 0; --left)
        if (kind == 3)
            made.push_back(random_json(random, depth + 1));
        else
            made[words[random.below(4)] + std::to_string(left)] = random_json(random, depth + 1);
    return made;
}

TEST(JsonEdit, does_what_parsing_and_changing_does_on_any_text) {
    Random random(7);
    int changed = 0;
    for (int round = 0; round < 300; ++round) {
        const Json before = random_json(random, 0);
        const Json flat = before.flatten();
        const std::string text = before.dump(static_cast<int>(random.below(3)) - 1);
        for (const auto& [pointer, value] : flat.items()) {
            Json expected = before;
            expected[Json::json_pointer(pointer)] = 42;
            EXPECT_EQ(Json::parse(with_json_value(text, pointer, "42")), expected) << text << " at " << pointer;
            ++changed;
        }
    }
    EXPECT_GT(changed, 300);
}

}  // namespace
}  // namespace surefoot
