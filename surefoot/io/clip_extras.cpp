#include <surefoot/io/clip_extras.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace surefoot {
namespace {

using Json = nlohmann::ordered_json;

constexpr double k_same_time = 1e-4;  // [s] events this near to an end of the clip are at it

/// Seven significant digits, as in the files we write.
Json seconds(double value) { return Json::parse(fmt::format("{:.7g}", value)); }

void exchange(Json& event, const char* key, const char* one, const char* other) {
    if (event.value(key, Json()) == one)
        event[key] = other;
    else if (event.value(key, Json()) == other)
        event[key] = one;
}

/// The event in the edited clip; false where it is not in it any more.
bool edit_event(Json& event, const ClipEdit& edit) {
    const auto at = event.is_object() ? event.find("time_s") : event.end();
    if (!event.is_object() || at == event.end() || !at->is_number()) return true;  // not one of ours
    const double before = at->get<double>(), duration = static_cast<double>(edit.duration);
    switch (edit.kind) {
        case ClipEdit::Kind::mirrored:
            exchange(event, "foot", "left", "right");
            return true;
        case ClipEdit::Kind::resampled:
        case ClipEdit::Kind::posed:
            return true;
        case ClipEdit::Kind::retimed:
            event["time_s"] = seconds(std::clamp(before / static_cast<double>(edit.rate), 0.0, duration));
            return true;
        case ClipEdit::Kind::reversed: {
            exchange(event, "kind", "strike", "toe_off");
            const double after = duration - before;
            // Both ends of a loop are one moment, and that is its beginning.
            event["time_s"] = seconds(edit.cyclic && after > duration - k_same_time ? 0.0 : std::max(after, 0.0));
            return true;
        }
        case ClipEdit::Kind::cut: {
            const double after = before - static_cast<double>(edit.from);
            if (after < -k_same_time || after > duration + k_same_time) return false;
            event["time_s"] = seconds(std::clamp(after, 0.0, duration));
            return true;
        }
    }
    return true;
}

}  // namespace

std::string edited_extras(const std::string& extras, const ClipEdit& edit) {
    if (extras.empty()) return {};
    Json json = Json::parse(extras, nullptr, false);
    if (!json.is_object()) return extras;
    if (const auto events = json.find("phase_events"); events != json.end() && events->is_array()) {
        Json kept = Json::array();
        for (Json& event : *events)
            if (edit_event(event, edit)) kept.push_back(std::move(event));
        const auto time = [](const Json& event) {
            return event.is_object() && event.contains("time_s") && event["time_s"].is_number()
                       ? event["time_s"].get<double>()
                       : 0.0;
        };
        std::stable_sort(kept.begin(), kept.end(), [&](const Json& a, const Json& b) { return time(a) < time(b); });
        *events = std::move(kept);
    }
    Json& provenance = json["provenance"];
    if (!provenance.is_array()) provenance = Json::array();
    provenance.push_back(edit.text);
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace surefoot
