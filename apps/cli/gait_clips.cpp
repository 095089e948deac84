#include "gait_clips.h"

#include "actor.h"
#include "fitted_clips.h"

#include <surefoot/author/fitted_gaits.h>
#include <surefoot/base/error.h>
#include <surefoot/host/files.h>

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <cmath>
#include <filesystem>

namespace surefoot::cli {

namespace {

/// The text in front of # and @.
std::string bare_name(const std::string& text) { return text.substr(0, text.find_first_of("#@")); }

double number(const std::string& text, const std::string& where) {
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = fast_float::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end || !std::isfinite(value))
        throw Error("'" + text + "' is not a number", where, "write " + bare_name(where) + "@speed=1.4");
    return value;
}

/// "bhatti2017_run_speed_3": what sets it apart from other requests of the same gait.
std::string title_of(const GaitRequest& request, const std::string& text) {
    std::string name = request.preset.empty() ? std::filesystem::path(request.gait).stem().string() : request.preset;
    if (const std::size_t at = text.find('@'); at != std::string::npos)
        for (const char c : "_" + text.substr(at + 1)) name += c == '=' || c == ',' ? '_' : c;
    return name;
}

bool names_fitted(const std::string& name) {
    return !std::filesystem::exists(name) && find_fitted_gait(name) != nullptr;
}

/// Its own skeleton stays: authoring puts it onto others.
LoadedClip load_fitted(const GaitRequest& request, const std::string& text) {
    const GaitBakeOptions options{fitted_style(request.preset, request.set),
                                  static_cast<float>(request.slope.value_or(0)), 60, true};
    AnalyzedClip clip = bake_fitted(request.gait, request.speed, request.turn, options);
    clip.motion.name = clip.facts.name = title_of(request, text);
    return as_loaded(std::move(clip), text);
}

LoadedClip load_gait(const std::string& text, const GaitActor& actor) {
    const GaitRequest request = parse_gait_request(text);
    if (names_fitted(request.gait)) return load_fitted(request, text);
    const Gait gait = read_gait_named(request.gait);
    const GaitPlay play{request.speed.value_or(0), request.turn.value_or(0), request.slope.value_or(0)};
    AnalyzedClip clip = play_gait(gait, gait_values(gait, request.preset, request.set), actor, play);
    clip.motion.name = clip.facts.name = title_of(request, text);
    LoadedClip loaded = as_loaded(std::move(clip), text);
    for (const std::string& control : bind_gait(gait).unknown)
        loaded.warnings.push_back("the control '" + control + "' moves nothing");
    return loaded;
}

}  // namespace

Gait read_gait_named(const std::string& name, GaitOutputs outputs) {
    const NamedText source = find_text(name, k_gaits);
    return read_gait(source.text, source.where, outputs);
}

bool names_gait(const std::string& text) {
    if (std::filesystem::exists(text)) return std::filesystem::path(text).extension() == ".gait";
    const std::string name = bare_name(text);
    return std::filesystem::path(name).extension() == ".gait" || !bundled_gait(name).empty() || names_fitted(name);
}

GaitRequest parse_gait_request(const std::string& text) {
    GaitRequest request;
    request.gait = bare_name(text);
    const std::size_t at = text.find('@', request.gait.size());
    if (const std::size_t hash = text.find('#', request.gait.size()); hash < at)
        request.preset = text.substr(hash + 1, at == std::string::npos ? at : at - hash - 1);
    for (std::size_t from = at; from < text.size();) {
        const std::size_t comma = std::min(text.find(',', ++from), text.size());
        const std::string setting = text.substr(from, comma - from);
        from = comma;
        if (setting.starts_with("speed="))
            request.speed = number(setting.substr(6), text);
        else if (setting.starts_with("turn="))
            request.turn = number(setting.substr(5), text);
        else if (setting.starts_with("slope="))
            request.slope = number(setting.substr(6), text);
        else
            request.set.push_back(setting);
    }
    return request;
}

GaitActor gait_actor(const Actor& actor) {
    return make_gait_actor(actor.body.skeleton, actor.roles, actor.body.legs, actor.body.shape, actor.name);
}

LoadedClip as_loaded(AnalyzedClip clip, const std::string& source) {
    return noted(std::move(clip), source, source, "the gait \"" + source + "\"");
}

LoadResult load_clips_and_gaits(std::span<const std::string> paths, const LoadOptions& options, const Actor* actor) {
    std::vector<std::string> files, gaits;
    for (const std::string& path : paths) (names_gait(path) ? gaits : files).push_back(path);
    LoadResult loaded;
    if (!files.empty() || gaits.empty()) loaded = load_clips(files, options);
    if (gaits.empty()) return loaded;
    const GaitActor moved = gait_actor(actor != nullptr ? *actor : read_actor("default"));
    for (const std::string& gait : gaits) {
        try {
            loaded.clips.push_back(load_gait(gait, moved));
        } catch (const Error& error) {
            loaded.failed.push_back({gait, error.what()});
        }
    }
    return loaded;
}

}  // namespace surefoot::cli
