// Facts as JSON: the keys are a contract (DESIGN §11), and project files must give every field back.

#include <surefoot/analysis/facts_json.h>
#include <surefoot/base/error.h>

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace surefoot {
namespace {

using Json = nlohmann::ordered_json;

/// Every field of ClipFacts in one list, so that none can be forgotten: structured bindings take exactly as many names
/// as the struct has fields, so a new field fails to compile here until it is added.
auto fields(const ClipFacts& facts) {
    const auto& [name, file, frames, joints, fps, duration, forward, lateral, speed, chord, turn, travel, slope, climb,
                 in_place, cyclic, locomotion, not_locomotion, cadence, stride, duty, events, contacts, skate, seam,
                 seam_speed, loop_error, closing, root_disagreement_speed, root_disagreement_turn, hip_height, height,
                 unit_scale, warnings, custom] = facts;
    const std::vector<std::pair<const char*, float>> numbers = {{"frames", static_cast<float>(frames)},
                                                                {"joints", static_cast<float>(joints)},
                                                                {"fps", fps},
                                                                {"duration", duration},
                                                                {"forward", forward},
                                                                {"lateral", lateral},
                                                                {"speed", speed},
                                                                {"chord", chord},
                                                                {"turn", turn},
                                                                {"travel", travel},
                                                                {"slope", slope},
                                                                {"climb", climb},
                                                                {"in_place", in_place},
                                                                {"cyclic", cyclic},
                                                                {"locomotion", locomotion},
                                                                {"cadence", cadence},
                                                                {"stride", stride},
                                                                {"duty", duty},
                                                                {"skate", skate},
                                                                {"seam", seam},
                                                                {"seam_speed", seam_speed},
                                                                {"loop_error", loop_error},
                                                                {"closing", closing},
                                                                {"root_disagreement_speed", root_disagreement_speed},
                                                                {"root_disagreement_turn", root_disagreement_turn},
                                                                {"hip_height", hip_height},
                                                                {"height", height},
                                                                {"unit_scale", unit_scale}};
    std::vector<std::string> texts = {name, file, not_locomotion};
    texts.insert(texts.end(), warnings.begin(), warnings.end());
    std::vector<std::tuple<Side, StrideEvent, float>> steps;
    for (const PhaseEvent& event : events) steps.emplace_back(event.foot, event.kind, event.time);
    return std::tuple(numbers, texts, steps, contacts[0], contacts[1], custom);
}

ClipFacts nothing_default() {
    ClipFacts facts;
    facts.name = "walk \"fast\" \\ \xC3\xA9";
    facts.file = "a folder/x.glb#Walk 2";
    facts.frames = 63;
    facts.joints = 22;
    facts.fps = 59.94f;
    facts.duration = 1.0343677f;
    facts.forward = -1.25f;
    facts.lateral = 0.1234567f;
    facts.speed = -1.256081f;
    facts.chord = 1.2f;
    facts.turn = -45.5f;
    facts.travel = 174.3593f;
    facts.slope = 4.5f;
    facts.climb = 0.098f;
    facts.in_place = true;
    facts.cyclic = true;
    facts.locomotion = false;
    facts.not_locomotion = "it rolls";
    facts.cadence = 116.129f;
    facts.stride = 1.298f;
    facts.duty = 0.61f;
    facts.events = {{Side::left, StrideEvent::strike, 0},
                    {Side::right, StrideEvent::toe_off, 0.1f},
                    {Side::right, StrideEvent::strike, 0.5166667f},
                    {Side::left, StrideEvent::toe_off, 0.65f}};
    facts.contacts[0] = {Contact::heel, Contact::flat, Contact::toe, Contact::lifted};
    facts.contacts[1] = {Contact::lifted, Contact::lifted, Contact::flat};
    facts.skate = 0.012f;
    facts.seam = 0.0234f;
    facts.seam_speed = 0.7f;
    facts.loop_error = 0.0001f;
    facts.closing = 0.0117f;
    facts.root_disagreement_speed = 0.03f;
    facts.root_disagreement_turn = 1.5f;
    facts.hip_height = 0.93f;
    facts.height = 1.78f;
    facts.unit_scale = 0.0254f;
    facts.custom = {{"mood", -0.25f}, {"style", 0.5f}};
    facts.warnings = {"one", "two: \xE2\x80\xA6"};
    return facts;
}

/// Equal but for the last digit of seven that a number is written with.
void expect_same(const ClipFacts& a, const ClipFacts& b) {
    const auto [numbers_a, texts_a, events_a, left_a, right_a, custom_a] = fields(a);
    const auto [numbers_b, texts_b, events_b, left_b, right_b, custom_b] = fields(b);
    for (std::size_t i = 0; i < numbers_a.size(); ++i)
        EXPECT_NEAR(numbers_a[i].second, numbers_b[i].second, 1e-6f * std::fabs(numbers_a[i].second))
            << numbers_a[i].first;
    EXPECT_EQ(texts_a, texts_b);
    EXPECT_EQ(left_a, left_b);
    EXPECT_EQ(right_a, right_b);
    EXPECT_EQ(custom_a, custom_b);
    ASSERT_EQ(events_a.size(), events_b.size());
    for (std::size_t i = 0; i < events_a.size(); ++i) {
        EXPECT_EQ(std::get<0>(events_a[i]), std::get<0>(events_b[i]));
        EXPECT_EQ(std::get<1>(events_a[i]), std::get<1>(events_b[i]));
        EXPECT_NEAR(std::get<2>(events_a[i]), std::get<2>(events_b[i]), 1e-6f);
    }
}

std::vector<std::string> keys(const Json& object) {
    std::vector<std::string> names;
    for (const auto& [key, value] : object.items()) names.push_back(key);
    return names;
}

TEST(facts_json, the_example_leaves_no_field_at_its_default) {
    const auto [numbers, texts, events, left, right, custom] = fields(nothing_default());
    const auto [numbers_0, texts_0, events_0, left_0, right_0, custom_0] = fields(ClipFacts{});
    for (std::size_t i = 0; i < numbers.size(); ++i)
        EXPECT_NE(numbers[i].second, numbers_0[i].second) << numbers[i].first;
    for (const std::string& text : texts) EXPECT_NE(text, "");
    EXPECT_NE(events, events_0);
    EXPECT_NE(left, left_0);
    EXPECT_NE(right, right_0);
    EXPECT_NE(custom, custom_0);
}

TEST(facts_json, every_field_survives_the_way_through_text) {
    const std::string text = facts_to_json(nothing_default(), FactsDetail::full).dump();
    const ClipFacts back = facts_from_json(Json::parse(text), "project.json");
    expect_same(nothing_default(), back);
    EXPECT_EQ(facts_to_json(back, FactsDetail::full).dump(), text);  // written again: the same bytes
}

TEST(facts_json, default_facts_survive_too) {
    const std::string text = facts_to_json(ClipFacts{}, FactsDetail::full).dump();
    expect_same(ClipFacts{}, facts_from_json(Json::parse(text), "project.json"));
}

TEST(facts_json, a_listing_has_exactly_the_keys_of_the_contract) {
    const std::vector<std::string> contract = {"name",          "file",         "frames",     "fps",
                                               "duration_s",    "joints",       "speed_mps",  "forward_mps",
                                               "lateral_mps",   "chord_mps",    "turn_deg_s", "travel_deg",
                                               "slope_deg",     "in_place",     "cyclic",     "cadence_steps_min",
                                               "stride_m",      "phase_events", "skate_cm_s", "seam_cm",
                                               "loop_error_cm", "height_m",     "unit_scale", "warnings"};
    std::vector<std::string> with_own = contract;
    with_own.push_back("custom");  // only where a person gave numbers
    EXPECT_EQ(keys(facts_to_json(nothing_default(), FactsDetail::listed)), with_own);
    EXPECT_EQ(keys(facts_to_json(ClipFacts{}, FactsDetail::listed)), contract);  // absent facts are null, not missing
    const Json listed = facts_to_json(nothing_default(), FactsDetail::listed);
    EXPECT_EQ(keys(listed["phase_events"][0]), (std::vector<std::string>{"foot", "kind", "time_s"}));
}

TEST(facts_json, a_listing_is_in_the_units_that_its_keys_name) {
    const ClipFacts facts = nothing_default();
    const Json json = facts_to_json(facts, FactsDetail::listed);
    EXPECT_NEAR(json["skate_cm_s"].get<float>(), 100 * facts.skate, 1e-4f);
    EXPECT_NEAR(json["seam_cm"].get<float>(), 100 * facts.seam, 1e-4f);
    EXPECT_NEAR(json["loop_error_cm"].get<float>(), 100 * facts.loop_error, 1e-4f);
    EXPECT_NEAR(json["turn_deg_s"].get<float>(), facts.turn, 1e-4f);
    EXPECT_NEAR(json["cadence_steps_min"].get<float>(), facts.cadence, 1e-4f);
    EXPECT_EQ(json["phase_events"][1]["foot"], "right");
    EXPECT_EQ(json["phase_events"][1]["kind"], "toe_off");
    EXPECT_NEAR(json["phase_events"][1]["time_s"].get<float>(), 0.1f, 1e-6f);
}

TEST(facts_json, facts_that_a_clip_does_not_have_are_null_in_a_listing) {
    ClipFacts pose;  // one frame
    pose.frames = 1;
    const Json json = facts_to_json(pose, FactsDetail::listed);
    for (const char* key : {"speed_mps", "forward_mps", "lateral_mps", "chord_mps", "turn_deg_s", "travel_deg",
                            "slope_deg", "cadence_steps_min", "stride_m", "skate_cm_s", "seam_cm", "loop_error_cm"})
        EXPECT_TRUE(json[key].is_null()) << key;
    pose.speed = std::numeric_limits<float>::infinity();
    pose.frames = 2;
    EXPECT_TRUE(facts_to_json(pose, FactsDetail::listed)["speed_mps"].is_null());  // never a text that is no JSON
}

TEST(facts_json, missing_and_null_keys_leave_the_default) {
    expect_same(ClipFacts{}, facts_from_json(Json::object(), "x"));
    Json nulls = facts_to_json(nothing_default(), FactsDetail::full);
    for (auto& [key, value] : nulls.items()) value = nullptr;
    expect_same(ClipFacts{}, facts_from_json(nulls, "x"));
    EXPECT_EQ(facts_from_json(Json::parse(R"({"name": "a", "of_later_versions": [1]})"), "x").name, "a");
}

/// What facts_from_json says of `json`; empty where it takes it.
std::string refusal(const Json& json) {
    try {
        facts_from_json(json, "project.json/clips/3");
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(facts_json, every_key_refuses_a_value_of_the_wrong_type_by_name) {
    const Json good = facts_to_json(nothing_default(), FactsDetail::full);
    for (const std::string& key : keys(good)) {
        Json bad = good;
        bad[key] = Json::object({{"an", "object"}});  // right for no key
        const std::string message = refusal(bad);
        EXPECT_NE(message.find("project.json/clips/3/" + key), std::string::npos) << key << ": " << message;
    }
}

TEST(facts_json, bad_values_are_refused_with_their_place) {
    const std::pair<const char*, const char*> table[] = {
        {R"({"frames": 1.5})", "/frames"},
        {R"({"frames": "12"})", "/frames"},
        {R"({"speed_mps": "fast"})", "/speed_mps"},
        {R"({"cyclic": 1})", "/cyclic"},
        {R"({"name": 7})", "/name"},
        {R"({"warnings": "one"})", "/warnings"},
        {R"({"warnings": ["one", 2]})", "/warnings"},
        {R"({"phase_events": [1]})", "/phase_events/0"},
        {R"({"phase_events": [{"foot": "left", "kind": "strike", "time_s": 0}, {"foot": "middle", "kind": "strike"}]})",
         "/phase_events/1/foot"},
        {R"({"phase_events": [{"foot": "left", "kind": "jump"}]})", "/phase_events/0/kind"},
        {R"({"phase_events": [{"foot": "left", "kind": "strike", "time_s": "0"}]})", "/phase_events/0/time_s"},
        {R"({"contacts_left": "ff?"})", "/contacts_left"},
        {R"([1, 2])", "project.json/clips/3"},
        {R"("text")", "project.json/clips/3"},
        {R"({"frames": 99999999999999})", "/frames"},
    };
    for (const auto& [text, place] : table) {
        const std::string message = refusal(Json::parse(text));
        EXPECT_NE(message.find(place), std::string::npos) << text << ": '" << message << "'";
    }
}

}  // namespace
}  // namespace surefoot
