#include <surefoot/io/clip_extras.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace surefoot {
namespace {

using Json = nlohmann::ordered_json;

const std::string k_extras =
    R"({"source":{"file":"walk.bvh"},"provenance":["cut from frames 3 to 63"],"phase_events":[)"
    R"({"foot":"left","kind":"strike","time_s":0},{"foot":"right","kind":"toe_off","time_s":0.125},)"
    R"({"foot":"right","kind":"strike","time_s":0.5},{"foot":"left","kind":"toe_off","time_s":0.625}]})";

std::string events_of(const std::string& extras) {
    const Json json = Json::parse(extras);
    std::string text;
    for (const Json& event : json["phase_events"])
        text += event["foot"].get<std::string>() + " " + event["kind"].get<std::string>() + " " +
                event["time_s"].dump() + "; ";
    return text;
}

ClipEdit edit(ClipEdit::Kind kind, float from, float duration, bool cyclic) {
    return {.kind = kind, .from = from, .duration = duration, .cyclic = cyclic, .text = "edited"};
}

TEST(ClipExtras, mirroring_exchanges_the_feet) {
    EXPECT_EQ(events_of(edited_extras(k_extras, edit(ClipEdit::Kind::mirrored, 0, 1, true))),
              "right strike 0; left toe_off 0.125; left strike 0.5; right toe_off 0.625; ");
}

TEST(ClipExtras, a_reversed_cycle_lifts_the_feet_where_it_set_them_down) {
    EXPECT_EQ(events_of(edited_extras(k_extras, edit(ClipEdit::Kind::reversed, 0, 1, true))),
              "left toe_off 0; left strike 0.375; right toe_off 0.5; right strike 0.875; ");
}

TEST(ClipExtras, a_cut_keeps_the_events_inside_it_at_their_new_times) {
    EXPECT_EQ(events_of(edited_extras(k_extras, edit(ClipEdit::Kind::cut, 0.125f, 0.375f, false))),
              "right toe_off 0; right strike 0.375; ");
}

TEST(ClipExtras, an_edit_adds_a_line_of_provenance_and_keeps_what_it_does_not_know) {
    const Json json = Json::parse(edited_extras(k_extras, edit(ClipEdit::Kind::resampled, 0, 1, true)));
    EXPECT_EQ(json["provenance"], Json({"cut from frames 3 to 63", "edited"}));
    EXPECT_EQ(json["source"]["file"], "walk.bvh");
    EXPECT_EQ(json["phase_events"], Json::parse(k_extras)["phase_events"]);
}

TEST(ClipExtras, notes_of_others_come_back_unharmed) {
    const ClipEdit reversed = edit(ClipEdit::Kind::reversed, 0, 1, true);
    EXPECT_EQ(edited_extras("", reversed), "");
    EXPECT_EQ(edited_extras("[1]", reversed), "[1]");
    EXPECT_EQ(edited_extras(R"({"phase_events":[3,{"time_s":"x"}],"provenance":7})", reversed),
              R"({"phase_events":[3,{"time_s":"x"}],"provenance":["edited"]})");
}

}  // namespace
}  // namespace surefoot
