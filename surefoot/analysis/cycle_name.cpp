#include <surefoot/analysis/cycle_name.h>

#include <fmt/format.h>

namespace surefoot {
namespace {

constexpr float k_named_turn = 8;       // [deg/s] real straight walks drift by a few
constexpr float k_standing = 0.10f;     // [m/s]
constexpr float k_on_the_spot = 0.30f;  // [m/s] someone who turns on the spot strays a little
constexpr float k_run = 3.0f;           // [m/s] for a leg of 0.9 m; above it a jog is called a run
constexpr float k_crouch = 0.85f;       // of the leg's length; walking keeps the hips above 0.9

}  // namespace

std::string cycle_name(const ClipFacts& facts, float leg_length, bool airborne) {
    const float planar = std::fabs(facts.speed), tempo = std::sqrt(leg_length / 0.9f);
    const bool turns = std::fabs(facts.turn) >= k_named_turn;
    const char* side = facts.turn > 0 ? "left" : "right";
    const std::string crouch = facts.hip_height < k_crouch * leg_length ? "crouch_" : "";
    if (planar < k_standing * tempo && !turns) return crouch + "idle";
    if (planar < k_on_the_spot * tempo && std::fabs(facts.turn) > 30)
        return fmt::format("{}turn_{}_{:.0f}", crouch, side, std::fabs(facts.turn));

    const float aside = std::fabs(facts.travel);
    std::string gait = !airborne ? "walk" : planar > k_run * tempo ? "run" : "jog";
    if (aside > 150)
        gait = "back";
    else if (aside > 30)
        gait = facts.lateral > 0 ? "strafe_left" : "strafe_right";
    if (turns) return fmt::format("{}{}_{:.1f}mps_{}_{:.0f}", crouch, gait, planar, side, std::fabs(facts.turn));
    return fmt::format("{}{}_{:.2f}mps", crouch, gait, planar);
}

}  // namespace surefoot
