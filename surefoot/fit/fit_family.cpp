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

constexpr float k_most_travel = 30;   // [deg] of travel against facing
constexpr std::size_t k_fewest = 8;   // cycles of a mode
constexpr float k_walk_lift = 0.55f;  // share of the cycle that a foot stands in the slowest run, about

/// Left and right exchanged, in the events too: nothing needs measuring again.
AnalyzedClip mirrored(const AnalyzedClip& clip) {
    AnalyzedClip result = clip;
    result.motion = mirror(clip.motion, clip.roles.roles);
    result.facts.travel = -clip.facts.travel;
    for (PhaseEvent& event : result.facts.events) event.foot = event.foot == Side::left ? Side::right : Side::left;
    return result;
}

std::string why_left_out(const AnalyzedClip& clip, const Skeleton& skeleton) {
    if (!(*clip.motion.skeleton == skeleton)) return "it is of another skeleton";
    if (!clip.facts.cyclic) return "it is no cycle";
    if (!clip.facts.locomotion) return clip.facts.not_locomotion;
    if (std::fabs(clip.facts.travel) > k_most_travel && clip.facts.forward < 0.1f) return "it does not go ahead";
    if (std::fabs(clip.facts.travel) > k_most_travel) return "it goes sideways";
    return {};
}

/// The cycles that a family is made of, each followed by its mirror image.
struct Cycles {
    std::vector<const AnalyzedClip*> clips;
    std::vector<PackedClip> packed;
};

Cycles choose(std::span<const AnalyzedClip> clips, FamilyReport& report) {
    Cycles cycles;
    for (const AnalyzedClip& clip : clips) {
        std::string reason = why_left_out(clip, *clips.front().motion.skeleton);
        if (reason.empty()) {
            try {
                cycles.packed.push_back(pack_for_fit(clip));
                cycles.packed.push_back(pack_for_fit(mirrored(clip)));
                cycles.clips.push_back(&clip);
                continue;
            } catch (const Error& error) {
                cycles.packed.resize(2 * cycles.clips.size());
                reason = error.problem();
            }
        }
        report.left_out.push_back(clip.facts.name + ": " + reason);
    }
    return cycles;
}

GaitMode mode_of(const PackedClip& clip) { return mean_lift(clip) > k_walk_lift ? GaitMode::walk : GaitMode::run; }

/// Where the strides of a mode lie: middle and spread of their speeds, so that powers of them are of the size of 1, and
/// their ends, but for the last few in a hundred, which are the odd ones.
void set_range(GaitBasis& basis, const std::vector<PackedClip>& clips, GaitMode mode) {
    constexpr double k_odd = 0.03;
    std::vector<float> speeds, turns;
    for (const PackedClip& clip : clips) {
        if (mode_of(clip) != mode) continue;
        speeds.push_back(clip.velocity.z);
        turns.push_back(std::fabs(clip.turn_rate) * k_degrees_per_radian);
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

GaitBasis make_basis(const std::vector<PackedClip>& clips, const FamilyOptions& options) {
    const auto running = static_cast<std::size_t>(std::count_if(
        clips.begin(), clips.end(), [](const PackedClip& clip) { return mode_of(clip) == GaitMode::run; }));
    const std::size_t walking = clips.size() - running;
    if (walking < 2 * k_fewest)
        throw Error(fmt::format("a family needs {} strides that walk, and there are {}", k_fewest, walking / 2), "fit",
                    "give more clips or takes of one character");
    GaitBasis basis;
    basis.modes = running >= 2 * k_fewest ? 2 : 1;
    basis.degree = options.degree;
    basis.least_speed = options.least_speed, basis.most_speed = options.most_speed;
    basis.most_turn = options.most_turn;
    basis.walk_until = options.walk_until, basis.run_from = options.run_from;
    for (int m = 0; m < basis.modes; ++m) set_range(basis, clips, static_cast<GaitMode>(m));
    return basis;
}

/// The coefficients of one mode, behind those that are there.
void fit_mode(HarmonicGait& gait, const Cycles& cycles, std::span<const CycleSamples> samples, GaitMode mode,
              double ridge) {
    const auto terms = static_cast<std::size_t>(gait.basis.terms_of_mode());
    RidgeProblem problem(terms, static_cast<std::size_t>(value_count(gait)));
    std::vector<float> powers(terms);
    double all = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const PackedClip& clip = cycles.packed[i];
        if (mode_of(clip) != mode) continue;
        constexpr float k_bent = 0.02f;  // [m] by which closing may move a joint before a stride counts half
        const float bent = cycles.clips[i / 2]->facts.closing / k_bent;
        const double weight = 1 / (1 + static_cast<double>(bent * bent));
        powers_at(gait.basis, mode, clip.velocity.z, clip.turn_rate * k_degrees_per_radian, powers);
        problem.add_sample(powers, values_of(samples[i], gait), weight);
        all += weight;
    }
    int term = 0;
    for (int degree = 0; degree <= gait.basis.degree; ++degree)
        for (int of_turn = 0; of_turn <= degree; ++of_turn, ++term) {
            // Turns are counted in the widest there are, so that their powers are small numbers already.
            double cost = degree == 0 ? 0.0 : degree == 1 ? 0.05 : 1.0;
            for (int k = 0; k < of_turn; ++k) cost *= 0.2;
            problem.add_penalty({{term, 1.0}}, ridge * all * cost);
        }
    const std::vector<float> solved = problem.solve();
    gait.coefficients.insert(gait.coefficients.end(), solved.begin(), solved.end());
}

std::vector<StrideError> stride_errors(const HarmonicGait& gait, const Cycles& cycles) {
    std::vector<StrideError> errors(cycles.clips.size());
    parallel_for(errors.size(), [&](std::size_t i) {
        const PackedClip& clip = cycles.packed[2 * i];
        const float speed = clip.velocity.z, turn = clip.turn_rate * k_degrees_per_radian;
        HarmonicGait own = gait;  // in the stride's own mode, whatever the family would do at its speed
        own.basis.walk_until = mode_of(clip) == GaitMode::walk ? speed + 1 : speed - 2;
        own.basis.run_from = own.basis.walk_until + 1;
        std::vector<float> values(static_cast<std::size_t>(value_count(gait)));
        values_at(own, speed, turn, values);
        errors[i] = {cycles.clips[i]->facts.name, mode_of(clip), speed, turn,
                     measure_fit(*cycles.clips[i], own, values)};
    });
    return errors;
}

}  // namespace

HarmonicGait fit_family(std::span<const AnalyzedClip> clips, const FamilyOptions& options, FamilyReport* told) {
    if (clips.empty()) throw Error("there are no clips", "fit", "give clips or takes of one character");
    FamilyReport report;
    const Cycles cycles = choose(clips, report);
    const GaitBasis basis = make_basis(cycles.packed, options);
    HarmonicGait gait = gait_of_body(*cycles.clips.front(), options.fit);
    gait.name = "gait";
    gait.basis = basis;
    gait.foot_lift = 0;
    for (std::size_t i = 0; i < cycles.packed.size(); ++i) {
        const PackedClip& clip = cycles.packed[i];
        gait.foot_lift += mean_lift(clip) / static_cast<float>(cycles.packed.size());
        if (i % 2 == 0) gait.cycles.push_back({clip.velocity.z, clip.turn_rate * k_degrees_per_radian});
    }
    std::vector<CycleSamples> samples(cycles.packed.size());
    parallel_for(samples.size(), [&](std::size_t i) { samples[i] = sample_cycles(cycles.packed[i], gait); });
    set_means(gait, samples);
    for (int m = 0; m < basis.modes; ++m) fit_mode(gait, cycles, samples, static_cast<GaitMode>(m), options.ridge);
    report.strides = stride_errors(gait, cycles);
    if (told) *told = std::move(report);
    return gait;
}

}  // namespace surefoot
