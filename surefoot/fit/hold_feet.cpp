#include <surefoot/base/error.h>
#include <surefoot/fit/cycle_samples.h>
#include <surefoot/fit/derive.h>
#include <surefoot/fit/ridge.h>
#include <surefoot/fit/rolling_foot.h>
#include <surefoot/harmonic/series.h>
#include <surefoot/math/trig.h>

#include <algorithm>
#include <array>

namespace surefoot {
namespace {

using FootPart = GaitSeries::FootPart;

// Captured feet set off sooner than contacts say. Feet of families that walk and run, held longer, slide less in a run,
// and lie flat sooner; of one mode alone they slide no less then, and changes into it jerk more.
constexpr FootHold k_hold{0.92f, 0.11f}, k_hold_running{0.94f, 0.15f};
const FootHold& hold_for(const HarmonicGait& gait) { return gait.basis.modes > 1 ? k_hold_running : k_hold; }

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Share of a foot's own cycle at a phase of its series: foot_series_phase backwards.
float share_at(float series_phase, float lift, float series_lift) {
    return foot_series_phase(series_phase, series_lift, lift);
}

/// What the twelve series of a held foot say at a phase of theirs: rotation, heel, ball, toes.
std::array<Vec3, 4> held_print(const HarmonicGait& gait, const GaitRhythm& rhythm, const RollingFoot& foot,
                               std::size_t side, float series_phase) {
    const auto [print, toes] = foot.print(share_at(series_phase, rhythm.lift[side], gait.foot_lift));
    const Leg& leg = gait.soles.side[side];
    return {to_rotation_vector(conjugate(gait.foot_mean[side]) * print.rotation), transform_point(print, leg.heel),
            transform_point(print, leg.ball), to_rotation_vector(conjugate(gait.toes_mean[side]) * toes)};
}

/// Writes the foot's series among `values`, at whose speed and turn it is held, anew.
void hold_foot(const HarmonicGait& gait, std::span<const float> own, std::size_t side, const FootHold& hold,
               std::span<float> values) {
    constexpr int k_samples = 256;
    const GaitRhythm rhythm = rhythm_of(gait, own);
    const RollingFoot foot(gait, own, rhythm, side, {}, hold);
    const GaitSeries series(gait, values);
    constexpr FootPart k_parts[4] = {FootPart::rotation, FootPart::heel, FootPart::ball, FootPart::toes};
    for (const FootPart part : k_parts)
        for (int axis = 0; axis < 3; ++axis)
            for (float& v : series.foot(side, part, axis)) v = 0;
    for (int i = 0; i < k_samples; ++i) {
        const float phase = (static_cast<float>(i) + 0.5f) / k_samples;
        const std::array<Vec3, 4> print = held_print(gait, rhythm, foot, side, phase);
        std::array<float, 1 + 2 * k_most_harmonics> wave{1.0f / k_samples};
        for (int k = 1; k <= gait.foot_harmonics; ++k) {
            const SinCos w = sin_cos(2 * k_pi * k * static_cast<double>(phase));
            wave[at(2 * k - 1)] = static_cast<float>(2 * w.cos / k_samples);
            wave[at(2 * k)] = static_cast<float>(2 * w.sin / k_samples);
        }
        for (std::size_t p = 0; p < 4; ++p) {
            const float axes[3] = {print[p].x, print[p].y, print[p].z};
            for (int axis = 0; axis < 3; ++axis) {
                const std::span<float> to = series.foot(side, k_parts[p], axis);
                for (std::size_t n = 0; n < to.size(); ++n) to[n] += axes[axis] * wave[n];
            }
        }
    }
}

/// The numbers of one gait with both feet held.
std::vector<float> with_held_feet(const HarmonicGait& gait, std::span<const float> own, const FootHold& hold) {
    std::vector<float> values(own.begin(), own.end());
    for (std::size_t side = 0; side < 2; ++side) hold_foot(gait, own, side, hold, values);
    return values;
}

/// The family of one mode alone.
HarmonicGait mode_alone(const HarmonicGait& gait, int mode) {
    HarmonicGait alone = gait;
    GaitBasis& basis = alone.basis;
    const auto m = at(mode), rows = at(gait.basis.terms_of_mode()) * at(value_count(gait));
    basis.modes = 1;
    basis.fitted_speeds[0] = gait.basis.fitted_speeds[m], basis.fitted_turn[0] = gait.basis.fitted_turn[m];
    basis.middle_speed[0] = gait.basis.middle_speed[m], basis.speed_unit[0] = gait.basis.speed_unit[m];
    const auto first = gait.coefficients.begin() + static_cast<std::ptrdiff_t>(m * rows);
    alone.coefficients.assign(first, first + static_cast<std::ptrdiff_t>(rows));
    return alone;
}

/// Evenly from -1 to 1, and never 0: nothing is held of who stands.
constexpr std::array<float, 8> k_grid{-1, -0.714f, -0.429f, -0.143f, 0.143f, 0.429f, 0.714f, 1};

/// The coefficients of one mode, its feet held at speeds and turns over the range of its strides.
std::vector<float> hold_mode(const HarmonicGait& alone, const FootHold& hold) {
    const GaitBasis& basis = alone.basis;
    const auto [slowest, fastest] = basis.fitted_speeds[0];
    std::vector<float> powers(at(basis.terms())), values(at(value_count(alone)));
    RidgeProblem problem(powers.size(), values.size());
    for (const float v : k_grid)
        for (const float w : k_grid) {
            const float speed = 0.5f * (slowest + fastest) + 0.5f * v * (fastest - slowest);
            const float turn = w * basis.fitted_turn[0];
            values_at(alone, speed, turn, values);
            powers_at(basis, GaitMode::walk, speed, turn, powers);
            problem.add_sample(powers, with_held_feet(alone, values, hold), 1);
        }
    return problem.solve();
}

}  // namespace

HarmonicGait holding_feet(const HarmonicGait& gait) {
    if (gait.legs.count == 0) throw Error("the gait has no feet", gait.name, "fit it to a clip with both legs");
    if (gait.basis.climb != 0) throw Error("the gait is made for stairs", gait.name, "hold the feet of its walk");
    HarmonicGait result = gait;
    const FootHold& hold = hold_for(gait);
    result.foot_hold = hold.share;
    if (!gait.family()) {
        result.coefficients = with_held_feet(gait, gait.coefficients, hold);
        round_coefficients(result);
        return result;
    }
    const std::size_t values = at(value_count(gait)),
                      body = values - k_rhythm_values - 2 * at(k_foot_series) * at(1 + 2 * gait.foot_harmonics);
    for (int mode = 0; mode < gait.basis.modes; ++mode) {
        const std::vector<float> held = hold_mode(mode_alone(gait, mode), hold);
        for (int t = 0; t < gait.basis.terms_of_mode(); ++t) {
            // The body and its rhythm stay as they are.
            const std::size_t to = at(mode * gait.basis.terms_of_mode() + t) * values, from = at(t) * values;
            for (std::size_t i = body; i < values - k_rhythm_values; ++i) result.coefficients[to + i] = held[from + i];
        }
    }
    round_coefficients(result);
    return result;
}

}  // namespace surefoot
