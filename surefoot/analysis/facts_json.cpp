#include <surefoot/analysis/facts_json.h>
#include <surefoot/base/error.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace surefoot {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* k_feet[] = {"left", "right"};
constexpr const char* k_kinds[] = {"strike", "toe_off"};
constexpr std::string_view k_contact_letters = "-htf";  // lifted, heel, toe, flat: the order of Contact

/// Seven significant digits, as the decimal number that a reader of the file sees.
Json number(double value) {
    if (!std::isfinite(value)) return nullptr;
    return Json::parse(fmt::format("{:.7g}", value));
}
Json number(float value, double factor = 1) { return number(static_cast<double>(value) * factor); }
Json number_if(bool present, float value, double factor = 1) { return present ? number(value, factor) : Json(nullptr); }

Json events_json(const std::vector<PhaseEvent>& events) {
    Json list = Json::array();
    for (const PhaseEvent& event : events)
        list.push_back({{"foot", k_feet[static_cast<int>(event.foot)]},
                        {"kind", k_kinds[static_cast<int>(event.kind)]},
                        {"time_s", number(event.time)}});
    return list;
}

Json custom_json(const std::map<std::string, float>& custom) {
    Json json = Json::object();
    for (const auto& [name, value] : custom) json[name] = number(value);
    return json;
}

std::string contact_letters(const std::vector<Contact>& contacts) {
    std::string letters;
    for (const Contact contact : contacts) letters += k_contact_letters[static_cast<std::size_t>(contact)];
    return letters;
}

/// Reads values out of one object and names the key where one has the wrong type.
class FactsReader {
  public:
    FactsReader(const Json& json, const std::string& where) : json_(json), where_(where) {
        if (!json.is_object()) fail("", "an object");
    }

    void read(const char* key, float& value, double factor = 1) const {
        const Json* found = find(key);
        if (!found) return;
        if (!found->is_number()) fail(key, "a number");
        value = static_cast<float>(found->get<double>() / factor);
    }
    void read(const char* key, int& value) const {
        const Json* found = find(key);
        if (!found) return;
        const bool whole = found->is_number_integer();
        const std::int64_t read = whole ? found->get<std::int64_t>() : 0;
        if (!whole || read != static_cast<int>(read)) fail(key, "a whole number below two thousand million");
        value = static_cast<int>(read);
    }
    void read(const char* key, bool& value) const {
        const Json* found = find(key);
        if (!found) return;
        if (!found->is_boolean()) fail(key, "true or false");
        value = found->get<bool>();
    }
    void read(const char* key, std::string& value) const {
        const Json* found = find(key);
        if (!found) return;
        if (!found->is_string()) fail(key, "a text");
        value = found->get<std::string>();
    }
    void read(const char* key, std::vector<std::string>& values) const {
        const Json* found = find(key);
        if (!found) return;
        if (!found->is_array()) fail(key, "a list of texts");
        values.clear();
        for (const Json& item : *found) {
            if (!item.is_string()) fail(key, "a list of texts");
            values.push_back(item.get<std::string>());
        }
    }
    void read(const char* key, std::map<std::string, float>& values) const {
        const Json* found = find(key);
        if (!found) return;
        if (!found->is_object()) fail(key, "an object of numbers");
        values.clear();
        for (const auto& [name, value] : found->items()) {
            if (!value.is_number()) fail(std::string(key) + "/" + name, "a number");
            values[name] = value.get<float>();
        }
    }
    void read(const char* key, std::vector<Contact>& contacts) const {
        std::string letters;
        read(key, letters);
        contacts.clear();
        for (const char letter : letters) {
            const std::size_t index = k_contact_letters.find(letter);
            if (index == std::string_view::npos) fail(key, "a text of the letters '-', 'h', 't' and 'f'");
            contacts.push_back(static_cast<Contact>(index));
        }
    }
    void read(const char* key, std::vector<PhaseEvent>& events) const {
        const Json* found = find(key);
        if (!found) return;
        if (!found->is_array()) fail(key, "a list of events");
        events.clear();
        for (const Json& item : *found) {
            const FactsReader event(item, where_ + "/" + key + "/" + std::to_string(events.size()));
            std::string foot, kind;
            PhaseEvent result;
            event.read("foot", foot);
            event.read("kind", kind);
            event.read("time_s", result.time);
            if (foot != k_feet[0] && foot != k_feet[1]) event.fail("foot", "'left' or 'right'");
            if (kind != k_kinds[0] && kind != k_kinds[1]) event.fail("kind", "'strike' or 'toe_off'");
            result.foot = foot == k_feet[0] ? Side::left : Side::right;
            result.kind = kind == k_kinds[0] ? StrideEvent::strike : StrideEvent::toe_off;
            events.push_back(result);
        }
    }

  private:
    /// The value, or nullptr where it is missing or null.
    const Json* find(const char* key) const {
        const auto found = json_.find(key);
        return found == json_.end() || found->is_null() ? nullptr : &*found;
    }
    [[noreturn]] void fail(const std::string& key, const std::string& expected) const {
        throw Error("expected " + expected, key.empty() ? where_ : where_ + "/" + key,
                    "correct the value or remove it");
    }

    const Json& json_;
    const std::string where_;
};

}  // namespace

Json facts_to_json(const ClipFacts& facts, FactsDetail detail) {
    const bool full = detail == FactsDetail::full, moves = full || facts.frames > 1;
    const bool steps = full || facts.cadence > 0, loops = full || facts.cyclic;
    Json json = {
        {"name", facts.name},
        {"file", facts.file},
        {"frames", facts.frames},
        {"fps", number(facts.fps)},
        {"duration_s", number(facts.duration)},
        {"joints", facts.joints},
        {"speed_mps", number_if(moves, facts.speed)},
        {"forward_mps", number_if(moves, facts.forward)},
        {"lateral_mps", number_if(moves, facts.lateral)},
        {"chord_mps", number_if(moves, facts.chord)},
        {"turn_deg_s", number_if(moves, facts.turn)},
        {"travel_deg", number_if(full || facts.speed != 0, facts.travel)},
        {"slope_deg", number_if(moves, facts.slope)},
        {"in_place", facts.in_place},
        {"cyclic", facts.cyclic},
        {"cadence_steps_min", number_if(steps, facts.cadence)},
        {"stride_m", number_if(steps, facts.stride)},
        {"phase_events", events_json(facts.events)},
        {"skate_cm_s", number_if(moves, facts.skate, 100)},
        {"seam_cm", number_if(loops, facts.seam, 100)},
        {"loop_error_cm", number_if(loops, facts.loop_error, 100)},
        {"height_m", number_if(full || facts.height > 0, facts.height)},
        {"unit_scale", number(facts.unit_scale)},
        {"warnings", facts.warnings},
    };
    if (!facts.custom.empty()) json["custom"] = custom_json(facts.custom);
    if (!full) return json;
    json["climb_mps"] = number(facts.climb);
    json["locomotion"] = facts.locomotion;
    json["not_locomotion"] = facts.not_locomotion;
    json["duty"] = number(facts.duty);
    json["seam_speed_mps"] = number(facts.seam_speed);
    json["closing_cm"] = number(facts.closing, 100);
    json["root_disagreement_mps"] = number(facts.root_disagreement_speed);
    json["root_disagreement_deg_s"] = number(facts.root_disagreement_turn);
    json["hip_height_m"] = number(facts.hip_height);
    json["contacts_left"] = contact_letters(facts.contacts[0]);
    json["contacts_right"] = contact_letters(facts.contacts[1]);
    return json;
}

ClipFacts facts_from_json(const Json& json, const std::string& where) {
    const FactsReader reader(json, where);
    ClipFacts facts;
    reader.read("name", facts.name);
    reader.read("file", facts.file);
    reader.read("frames", facts.frames);
    reader.read("fps", facts.fps);
    reader.read("duration_s", facts.duration);
    reader.read("joints", facts.joints);
    reader.read("speed_mps", facts.speed);
    reader.read("forward_mps", facts.forward);
    reader.read("lateral_mps", facts.lateral);
    reader.read("chord_mps", facts.chord);
    reader.read("turn_deg_s", facts.turn);
    reader.read("travel_deg", facts.travel);
    reader.read("slope_deg", facts.slope);
    reader.read("in_place", facts.in_place);
    reader.read("cyclic", facts.cyclic);
    reader.read("cadence_steps_min", facts.cadence);
    reader.read("stride_m", facts.stride);
    reader.read("phase_events", facts.events);
    reader.read("skate_cm_s", facts.skate, 100);
    reader.read("seam_cm", facts.seam, 100);
    reader.read("loop_error_cm", facts.loop_error, 100);
    reader.read("height_m", facts.height);
    reader.read("unit_scale", facts.unit_scale);
    reader.read("warnings", facts.warnings);
    reader.read("custom", facts.custom);
    reader.read("climb_mps", facts.climb);
    reader.read("locomotion", facts.locomotion);
    reader.read("not_locomotion", facts.not_locomotion);
    reader.read("duty", facts.duty);
    reader.read("seam_speed_mps", facts.seam_speed);
    reader.read("closing_cm", facts.closing, 100);
    reader.read("root_disagreement_mps", facts.root_disagreement_speed);
    reader.read("root_disagreement_deg_s", facts.root_disagreement_turn);
    reader.read("hip_height_m", facts.hip_height);
    reader.read("contacts_left", facts.contacts[0]);
    reader.read("contacts_right", facts.contacts[1]);
    return facts;
}

}  // namespace surefoot
