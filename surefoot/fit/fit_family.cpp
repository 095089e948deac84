#include <surefoot/base/error.h>
#include <surefoot/fit/cycle_samples.h>
#include <surefoot/fit/ridge.h>
#include <surefoot/host/parallel.h>
#include <surefoot/motion/edit.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr float k_most_travel = 30;                      // [deg] of travel against facing
constexpr std::size_t k_fewest = 8, k_fewest_turns = 3;  // cycles of a mode, and of turns on the spot
constexpr float k_spot_speed = 0.25f, k_spot_turn = 15;  // [m/s] at most, [deg/s] at least, of turns on the spot
constexpr float k_walk_lift = 0.55f;  // share of the cycle that a foot stands in the slowest run, about

/// Left and right exchanged, in the events too: nothing needs measuring again.
AnalyzedClip mirrored(const AnalyzedClip& clip) {
    AnalyzedClip result = clip;
    result.motion = mirror(clip.motion, clip.roles.roles);
    result.facts.travel = -clip.facts.travel;
    for (PhaseEvent& event : result.facts.events) event.foot = event.foot == Side::left ? Side::right : Side::left;
    return result;
}

std::string why_left_out(const AnalyzedClip& clip, const Skeleton& skeleton, const FamilyOptions& options) {
    const ClipFacts& facts = clip.facts;
    if (!(*clip.motion.skeleton == skeleton)) return "it is of another skeleton";
    if (!facts.cyclic) return "it is no cycle";
    if (!facts.locomotion) return facts.not_locomotion;
    if (options.on_the_spot) {
        const bool turns = std::fabs(facts.speed) < k_spot_speed && std::fabs(facts.turn) > k_spot_turn;
        return turns ? "" : "it does not turn on the spot";
    }
    const float off = std::remainder(facts.travel - options.travel_deg, 360.0f);
    if (std::fabs(off) <= k_most_travel) return {};
    return fmt::format("it goes {:.0f} degrees off where the family goes", std::fabs(off));
}

/// A mirror image goes where the family goes, unless that is sideways.
bool has_mirror_images(const FamilyOptions& options) {
    return options.on_the_spot || options.travel_deg == 0 || std::fabs(options.travel_deg) == 180;
}

/// What a family is asked for so that it does as the clip does: speed [m/s] and turn [deg/s].
std::array<float, 2> asked_for(const PackedClip& clip, bool on_the_spot) {
    return {on_the_spot ? 0.0f : planar_length(clip.velocity), clip.turn_rate * k_degrees_per_radian};
}

/// The cycles that a family is made of.
struct Cycles {
    std::vector<const AnalyzedClip*> clips;
    std::vector<PackedClip> packed;        ///< each followed by its mirror image, if the family has them
    std::size_t images = 2;                ///< packed ones of a clip
    std::vector<std::array<float, 2>> at;  ///< of each packed one: speed [m/s] and turn [deg/s]
};

Cycles choose(std::span<const AnalyzedClip> clips, const FamilyOptions& options, FamilyReport& report) {
    Cycles cycles;
    cycles.images = has_mirror_images(options) ? 2 : 1;
    for (const AnalyzedClip& clip : clips) {
        std::string reason = why_left_out(clip, *clips.front().motion.skeleton, options);
        if (reason.empty()) {
            try {
                if (cycles.packed.push_back(pack_for_fit(clip)); is_standing(cycles.packed.back()))
                    throw Error("it stands", clip.facts.name, "");
                if (options.travel_deg != 0 && mean_lift(cycles.packed.back()) <= k_walk_lift)
                    throw Error("it runs, and runners only go ahead", clip.facts.name, "");
                if (cycles.images == 2) cycles.packed.push_back(pack_for_fit(mirrored(clip)));
                cycles.clips.push_back(&clip);
                continue;
            } catch (const Error& error) {
                cycles.packed.resize(cycles.images * cycles.clips.size());
                reason = error.problem();
            }
        }
        report.left_out.push_back(clip.facts.name + ": " + reason);
    }
    for (const PackedClip& clip : cycles.packed) cycles.at.push_back(asked_for(clip, options.on_the_spot));
    return cycles;
}

GaitMode mode_of(const PackedClip& clip, const FamilyOptions& options) {
    const bool ahead = options.travel_deg == 0 && !options.on_the_spot;
    return ahead && mean_lift(clip) <= k_walk_lift ? GaitMode::run : GaitMode::walk;
}

/// Where the strides of a mode lie: middle and spread of their speeds, so that powers of them are of the size of 1, and
/// their ends, but for the last few in a hundred, which are the odd ones.
void set_range(GaitBasis& basis, const Cycles& cycles, const FamilyOptions& options, GaitMode mode) {
    constexpr double k_odd = 0.03;
    std::vector<float> speeds, turns;
    for (std::size_t i = 0; i < cycles.packed.size(); ++i) {
        if (mode_of(cycles.packed[i], options) != mode) continue;
        speeds.push_back(cycles.at[i][0]);
        turns.push_back(std::fabs(cycles.at[i][1]));
    }
    std::sort(speeds.begin(), speeds.end());
    std::sort(turns.begin(), turns.end());
    double mean = 0, variance = 0;
    for (const float v : speeds) mean += static_cast<double>(v) / static_cast<double>(speeds.size());
    for (const float v : speeds) {
        const double off = static_cast<double>(v) - mean;
        variance += off * off / static_cast<double>(speeds.size());
    }
    const auto m = static_cast<std::size_t>(mode);
    const std::size_t last = speeds.size() - 1, odd = static_cast<std::size_t>(k_odd * static_cast<double>(last) + 0.5);
    basis.middle_speed[m] = static_cast<float>(mean);
    basis.speed_unit[m] = std::max(0.1f, static_cast<float>(std::sqrt(variance)));
    basis.fitted_speeds[m] = {speeds[odd], speeds[last - odd]};
    basis.fitted_turn[m] = turns[last - odd];
}

GaitBasis make_basis(const Cycles& cycles, const FamilyOptions& options) {
    const auto running =
        static_cast<std::size_t>(std::count_if(cycles.packed.begin(), cycles.packed.end(), [&](const PackedClip& clip) {
            return mode_of(clip, options) == GaitMode::run;
        }));
    const std::size_t walking = cycles.packed.size() - running,
                      fewest = options.on_the_spot ? k_fewest_turns : k_fewest;
    if (walking < cycles.images * fewest)
        throw Error(
            fmt::format("a family needs {} strides that walk, and there are {}", fewest, walking / cycles.images),
            "fit", "give more clips or takes of one character");
    GaitBasis basis;
    basis.modes = running >= cycles.images * k_fewest ? 2 : 1;
    basis.degree = options.degree;
    basis.travel_deg = options.travel_deg;
    basis.least_speed = options.on_the_spot ? 0 : options.least_speed;
    basis.most_speed = options.on_the_spot ? 0 : options.most_speed;
    basis.most_turn = options.most_turn;
    basis.walk_until = options.walk_until, basis.run_from = options.run_from;
    for (int m = 0; m < basis.modes; ++m) set_range(basis, cycles, options, static_cast<GaitMode>(m));
    return basis;
}

/// The coefficients of one mode, behind those that are there.
void fit_mode(HarmonicGait& gait, const Cycles& cycles, std::span<const CycleSamples> samples, GaitMode mode,
              const FamilyOptions& options) {
    const auto terms = static_cast<std::size_t>(gait.basis.terms_of_mode());
    RidgeProblem problem(terms, static_cast<std::size_t>(value_count(gait)));
    std::vector<float> powers(terms);
    double all = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (mode_of(cycles.packed[i], options) != mode) continue;
        constexpr float k_bent = 0.02f;  // [m] by which closing may move a joint before a stride counts half
        const float bent = cycles.clips[i / cycles.images]->facts.closing / k_bent;
        const double weight = 1 / (1 + static_cast<double>(bent * bent));
        powers_at(gait.basis, mode, cycles.at[i][0], cycles.at[i][1], powers);
        problem.add_sample(powers, values_of(samples[i], gait), weight);
        all += weight;
    }
    int term = 0;
    for (int degree = 0; degree <= gait.basis.degree; ++degree)
        for (int of_turn = 0; of_turn <= degree; ++of_turn, ++term) {
            // Turns are counted in the widest there are, so that their powers are small numbers already.
            double cost = degree == 0 ? 0.0 : degree == 1 ? 0.05 : 1.0;
            for (int k = 0; k < of_turn; ++k) cost *= 0.2;
            problem.add_penalty({{term, 1.0}}, options.ridge * all * cost);
        }
    const std::vector<float> solved = problem.solve();
    gait.coefficients.insert(gait.coefficients.end(), solved.begin(), solved.end());
}

std::vector<StrideError> stride_errors(const HarmonicGait& gait, const Cycles& cycles, const FamilyOptions& options) {
    std::vector<StrideError> errors(cycles.clips.size());
    parallel_for(errors.size(), [&](std::size_t i) {
        const GaitMode mode = mode_of(cycles.packed[cycles.images * i], options);
        const auto [speed, turn] = cycles.at[cycles.images * i];
        HarmonicGait own = gait;  // in the stride's own mode, whatever the family would do at its speed
        own.basis.walk_until = mode == GaitMode::walk ? speed + 1 : speed - 2;
        own.basis.run_from = own.basis.walk_until + 1;
        std::vector<float> values(static_cast<std::size_t>(value_count(gait)));
        values_at(own, speed, turn, values);
        errors[i] = {cycles.clips[i]->facts.name, mode, speed, turn, measure_fit(*cycles.clips[i], own, values)};
    });
    return errors;
}

}  // namespace

HarmonicGait fit_family(std::span<const AnalyzedClip> clips, const FamilyOptions& options, FamilyReport* told) {
    if (clips.empty()) throw Error("there are no clips", "fit", "give clips or takes of one character");
    FamilyReport report;
    const Cycles cycles = choose(clips, options, report);
    const GaitBasis basis = make_basis(cycles, options);
    HarmonicGait gait = gait_of_body(*cycles.clips.front(), options.fit);
    gait.name = "gait";
    gait.basis = basis;
    gait.foot_lift = 0;
    for (std::size_t i = 0; i < cycles.packed.size(); ++i) {
        gait.foot_lift += mean_lift(cycles.packed[i]) / static_cast<float>(cycles.packed.size());
        if (i % cycles.images == 0) gait.cycles.push_back(cycles.at[i]);
    }
    std::vector<CycleSamples> samples(cycles.packed.size());
    parallel_for(samples.size(), [&](std::size_t i) { samples[i] = sample_cycles(cycles.packed[i], gait); });
    set_means(gait, samples);
    for (int m = 0; m < basis.modes; ++m) fit_mode(gait, cycles, samples, static_cast<GaitMode>(m), options);
    round_coefficients(gait);
    report.strides = stride_errors(gait, cycles, options);
    if (told) *told = std::move(report);
    return gait;
}

}  // namespace surefoot
