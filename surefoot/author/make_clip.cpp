#include <surefoot/analysis/measure.h>
#include <surefoot/author/make_clip.h>
#include <surefoot/base/error.h>
#include <surefoot/io/clip_name.h>
#include <surefoot/motion/clean.h>
#include <surefoot/motion/edit.h>
#include <surefoot/motion/interpolate.h>
#include <surefoot/motion/plant.h>
#include <surefoot/motion/steer.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace surefoot {
namespace {

double number(const RepairStep& step, const std::string& name, double otherwise) {
    const auto found = step.numbers.find(name);
    return found == step.numbers.end() ? otherwise : found->second;
}

PathTarget path_target(const RepairStep& step) {
    PathTarget target;
    const auto take = [&](const char* name, float scale) -> std::optional<float> {
        const auto found = step.numbers.find(name);
        if (found == step.numbers.end()) return {};
        return static_cast<float>(found->second) * scale;
    };
    target.turn = take("turn_deg_s", k_radians_per_degree);
    target.lateral = take("lateral_mps", 1);
    target.forward = take("forward_mps", 1);
    return target;
}

Motion mixed(const RepairStep& step, std::span<const AnalyzedClip* const> inputs) {
    std::vector<PhasedClip> clips;
    float fps = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const auto marks = cycle_marks(*inputs[i]);
        if (!marks)
            throw Error("its strikes do not alternate, so it cannot be mixed at equal phase", inputs[i]->facts.name,
                        "leave it out");
        const double weight = number(step, "weight_" + std::to_string(i), 1);
        clips.push_back({&inputs[i]->motion, *marks, static_cast<float>(weight)});
        fps = std::max(fps, inputs[i]->motion.fps);
    }
    return interpolate(clips, fps);
}

Motion made_motion(const RepairStep& step, std::span<const AnalyzedClip* const> inputs) {
    const AnalyzedClip& from = *inputs.front();
    if (step.kind == "mirror") return mirror(from.motion, from.roles.roles);
    if (step.kind == "reverse") return reverse(from.motion);
    if (step.kind == "retime") return retime(from.motion, static_cast<float>(number(step, "rate", 1)));
    if (step.kind == "steer") return steer(from.motion, from.roles.roles, stance_flags(from.facts), path_target(step));
    if (step.kind == "interpolate") return mixed(step, inputs);
    if (step.kind == "plant") return plant(from.motion, from.roles.roles, from.legs, stance_flags(from.facts));
    if (step.kind == "clean") {
        Motion motion = from.motion;
        CleanOptions options;
        options.legs = &from.legs;
        clean(motion, options);
        return motion;
    }
    throw Error("there is no repair \"" + step.kind + "\"", "project.json",
                "undo it, or use the version of Surefoot that made it");
}

/// The user's own numbers of what is made of clips: theirs, by the share that each has.
std::map<std::string, float> own_numbers(const RepairStep& step, std::span<const AnalyzedClip* const> inputs) {
    if (step.kind != "interpolate") return inputs.front()->facts.custom;
    std::map<std::string, float> numbers;
    double sum = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) sum += number(step, "weight_" + std::to_string(i), 1);
    for (std::size_t i = 0; i < inputs.size(); ++i)
        for (const auto& [name, value] : inputs[i]->facts.custom)
            numbers[name] += static_cast<float>(number(step, "weight_" + std::to_string(i), 1) / sum) * value;
    return numbers;
}

/// The name with left and right exchanged; itself where it speaks of neither.
std::string other_side(const std::string& name) {
    std::string result;
    for (std::size_t i = 0; i < name.size();) {
        bool found = false;
        for (const auto& [from, to] : {std::pair{"left", "right"},
                                       {"right", "left"},
                                       {"Left", "Right"},
                                       {"Right", "Left"},
                                       {"LEFT", "RIGHT"},
                                       {"RIGHT", "LEFT"}}) {
            if (name.compare(i, std::string_view(from).size(), from) != 0) continue;
            result += to;
            i += std::string_view(from).size();
            found = true;
            break;
        }
        if (!found) result += name[i++];
    }
    return result;
}

std::string lower(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

std::string plain_name(const RepairStep& step) {
    const std::string& from = step.clips.front();
    if (step.kind == "mirror") {
        const std::string other = other_side(from);
        return other != from ? other : from + "_mirrored";
    }
    if (step.kind == "reverse") return from + "_reversed";
    if (step.kind == "retime") return from + (number(step, "rate", 1) > 1 ? "_faster" : "_slower");
    if (step.kind == "clean") return from + "_clean";
    if (step.kind == "plant") return from + "_planted";
    if (step.kind == "steer") {
        const double turn = number(step, "turn_deg_s", 0);
        if (std::fabs(turn) < 0.5) return from + "_straight";
        return from + fmt::format("_{}_{:.0f}", turn > 0 ? "left" : "right", std::fabs(turn));
    }
    if (step.clips.size() == 2 && step.clips[1] == from + "_reversed") return from + "_treading";
    std::string name = "mix";
    for (const std::string& clip : step.clips) name += "_" + clip;
    constexpr std::size_t k_longest = 60;
    return name.size() > k_longest ? name.substr(0, k_longest) : name;
}

}  // namespace

bool makes_clip(const std::string& kind) {
    for (const char* making : {"mirror", "reverse", "interpolate", "steer", "retime", "clean", "plant"})
        if (kind == making) return true;
    return false;
}

std::optional<std::vector<float>> cycle_marks(const AnalyzedClip& clip) {
    const ClipFacts& facts = clip.facts;
    std::vector<float> left, right;
    for (const PhaseEvent& event : facts.events)
        if (event.kind == StrideEvent::strike) (event.foot == Side::left ? left : right).push_back(event.time);
    if (left.empty() && right.empty()) return std::vector<float>{};
    if (left.empty() || right.size() != left.size() || !clip.motion.cyclic) return {};
    const float duration = clip.motion.duration();
    const float end = left.size() > 1 ? left[1] : left[0] + duration;
    float between = -1;
    for (const float time : right)
        for (const float shifted : {time, time + duration})
            if (shifted > left[0] && shifted < end) {
                if (between >= 0 && shifted != between) return {};
                between = shifted;
            }
    if (between < 0) return {};
    return std::vector<float>{left[0], between, end};
}

AnalyzedClip make_clip(const RepairStep& step, std::span<const AnalyzedClip* const> inputs) {
    if (inputs.empty()) throw Error("the repair names no clip", step.makes, "undo it");
    const AnalyzedClip& from = *inputs.front();
    AnalyzedClip made;
    made.motion = made_motion(step, inputs);
    made.motion.name = step.makes;
    made.roles = from.roles;
    made.legs = from.legs;
    start_at_origin(made.motion);
    if (const std::string fault = problem(made.motion); !fault.empty())
        throw Error("making it gave an unsound clip: " + fault, step.makes, "undo the repair");
    made.facts.name = step.makes;
    made.facts.in_place = from.facts.in_place;
    made.facts.unit_scale = 1;
    made.facts.custom = own_numbers(step, inputs);
    measure(made.motion, made.roles.roles, made.legs, made.facts);
    return made;
}

std::string describe_step(const RepairStep& step) {
    const std::string first = step.clips.empty() ? "" : "\"" + step.clips.front() + "\"";
    if (step.kind == "mirror") return "mirrored from " + first;
    if (step.kind == "reverse") return first + " played backwards";
    if (step.kind == "retime") return fmt::format("{} played {:.3g} times as fast", first, number(step, "rate", 1));
    if (step.kind == "plant") return first + " with its standing feet held to the ground";
    if (step.kind == "clean") return first + " with its capture glitches mended";
    if (step.kind == "steer") {
        std::string text = first + " on another path:";
        for (const auto& [name, words, unit] : {std::tuple{"turn_deg_s", "turning", "deg/s"},
                                                {"lateral_mps", "sideways", "m/s"},
                                                {"forward_mps", "forward", "m/s"}})
            if (const auto found = step.numbers.find(name); found != step.numbers.end())
                text += fmt::format(" {} {:.3g} {}", words, found->second, unit);
        return text;
    }
    if (step.kind == "interpolate") {
        double sum = 0;
        for (std::size_t i = 0; i < step.clips.size(); ++i) sum += number(step, "weight_" + std::to_string(i), 1);
        std::string text;
        for (std::size_t i = 0; i < step.clips.size(); ++i)
            text += fmt::format("{}{:.2f} of \"{}\"", i > 0 ? " and " : "",
                                number(step, "weight_" + std::to_string(i), 1) / sum, step.clips[i]);
        return text + " mixed at equal phase";
    }
    if (step.kind == "exclude") return "left out " + first + ": " + step.reason;
    if (step.kind == "lock-edge")
        return fmt::format("joined {} and \"{}\" whatever their distance", first,
                           step.clips.size() > 1 ? step.clips[1] : "");
    return step.kind;
}

std::string name_for(const RepairStep& step, std::span<const ProjectClip> clips) {
    const std::string plain = safe_file_name(plain_name(step));
    std::string name = plain;
    const auto taken = [&] {
        return std::any_of(clips.begin(), clips.end(),
                           [&](const ProjectClip& clip) { return lower(clip.name) == lower(name); });
    };
    for (int n = 2; taken(); ++n) name = plain + "_" + std::to_string(n);
    return name;
}

}  // namespace surefoot
