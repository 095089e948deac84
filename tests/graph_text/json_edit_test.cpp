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

TEST(JsonEdit, takes_out_what_was_put_in_and_no_other_byte) {
    for (const char* place : {"/a/curve", "/b/two", "/empty/x", "/a/when/-", "/last"}) {
        std::string pointer = place;
        const std::string longer = with_json_value(k_text, pointer, R"({"y": [1]})");
        if (pointer.ends_with("-")) pointer.back() = '2';
        EXPECT_EQ(Json::parse(longer)[Json::json_pointer(pointer)]["y"][0], 1) << longer;
        EXPECT_EQ(without_json_value(longer, pointer), k_text) << place;
    }
    EXPECT_NE(without_json_value(k_text, "/a/when/0").find(R"("when": [{"x": -2.5e1}]})"), std::string::npos);
    EXPECT_NE(without_json_value(k_text, "/b").find("2.5e1}]},\n  \"empty\": {}"), std::string::npos);
    EXPECT_THROW(without_json_value(k_text, "/b/three"), Error);
    EXPECT_THROW(without_json_value(k_text, ""), Error);
    EXPECT_THROW(without_json_value("{", "/a"), Error);
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
            if (!pointer.empty()) {
                Json without = before;
                const Json::json_pointer place(pointer);
                Json& parent = without[place.parent_pointer()];
                if (parent.is_array())
                    parent.erase(std::stoul(place.back()));
                else
                    parent.erase(place.back());
                EXPECT_EQ(Json::parse(without_json_value(text, pointer)), without) << text << " without " << pointer;
            }
            ++changed;
        }
    }
    EXPECT_GT(changed, 300);
}

}  // namespace
}  // namespace surefoot
