// The numbers of the embedded set: what a grown person does at these speeds, by the walking and running literature.
//
// Cadence of walking: step length over cadence is nearly constant, 0.0063 m/(step/min) (Sekiya et al., "The invariant
// relationship between step length and step rate during free walking", J. Human Movement Studies 30, 1996). Cadence of
// running rises little with speed (Cavanagh and Kram, "Stride length in distance running", 1989). Duty factors: 0.62
// walking; 0.39 and 0.36 running (Novacheck, "The biomechanics of running", Gait and Posture 7, 1998). Joint ranges:
// Perry, "Gait Analysis", 1992. The times and angles of the feet were searched so that the knee, which only follows
// from where foot and hips are, bends over the cycle as those two measured it.

#include <surefoot/synthetic/gait_cycle.h>

#include <cmath>

namespace surefoot {

namespace {

/// Frame intervals of a two-step cycle at `cadence` steps a minute, even, so that half a cycle is whole frames. Bounded
/// for gaits that go nowhere, which set their own number afterwards.
int intervals_at(float cadence) {
    return 2 * static_cast<int>(std::floor(60 * k_gait_fps / std::fmax(cadence, 30.0f) + 0.5f));
}
float walking_cadence(float speed) { return std::sqrt(60 * speed / 0.0063f); }
float running_cadence(float speed) { return 145 + 8 * speed; }

GaitParameters idle() {
    GaitParameters g;
    g.name = "idle";
    g.intervals = 240;
    g.duty = 1;
    g.step_width = 0.20f;
    g.toe_out = 9;
    g.bob = 0.002f;
    g.sway = 0.012f;
    g.list = 1;
    g.pelvis_yaw = 0.6f;
    g.trunk_yaw = 0.8f;
    g.pelvis_pitch = 2;
    g.lean = 1.5f;
    g.arm_swing = 1;
    g.arm_bias = 0;
    g.elbow = 16;
    g.elbow_swing = 1;
    g.breath = 1.2f;
    return g;
}

GaitParameters walk(float speed) {
    GaitParameters g;
    g.name = "walk";
    g.forward = speed;
    g.intervals = intervals_at(walking_cadence(speed));
    g.duty = 0.60f;
    g.stance_pitch = {{0, 18}, {0.12f, 0}, {0.58f, 0}, {0.90f, -30}, {1, -57}};
    g.swing_pitch = {{0.11f, -80}, {0.36f, -32}, {0.66f, 1}};
    g.clearance = 0.028f;
    g.bob = 0.014f;
    g.bob_low = 0.005f;
    g.pelvis_yaw = 7;
    g.straightest_knee = 6;
    return g;
}

GaitParameters jog(float speed) {
    GaitParameters g = walk(speed);
    g.name = "jog";
    g.intervals = intervals_at(running_cadence(speed));
    g.duty = 0.386f;
    g.stance_pitch = {{0, 5}, {0.10f, 0}, {0.34f, 0}, {0.86f, -38}, {1, -57}};
    g.swing_pitch = {{0.11f, -90}, {0.41f, -42}, {0.90f, 11}};
    g.toes_flat_until = 0.72f;
    g.step_width = 0.07f;
    g.clearance = 0.040f;
    g.kick = 0.072f;
    g.bob = 0.026f;
    g.bob_low = 0.21f;
    g.sway = 0.012f;
    g.list = 3;
    g.pelvis_yaw = 8;
    g.pelvis_pitch = 6;
    g.straightest_knee = 16;
    g.lean = 7;
    g.bank = 0.55f;
    g.trunk_yaw = 10;
    g.arm_swing = 27;
    g.arm_bias = -12;
    g.arm_out = 13;
    g.elbow = 80;
    g.elbow_swing = 12;
    g.arm_twist = 16;
    return g;
}

GaitParameters run(float speed) {
    GaitParameters g = jog(speed);
    g.name = "run";
    g.straightest_knee = 17;
    g.duty = 0.30f;
    g.stance_pitch = {{0, 5}, {0.13f, 0}, {0.34f, 0}, {0.88f, -39}, {1, -58}};
    g.swing_pitch = {{0.11f, -96}, {0.36f, -48}, {0.90f, 11}};
    g.step_width = 0.05f;
    g.clearance = 0.040f;
    g.kick = 0.190f;
    g.bob = 0.028f;
    g.bob_low = 0.22f;
    g.pelvis_yaw = 9;
    g.pelvis_pitch = 8;
    g.lean = 10;
    g.trunk_yaw = 13;
    g.arm_swing = 40;
    g.elbow = 92;
    g.elbow_swing = 14;
    return g;
}

/// Backward the foot lands on the ball and leaves from the heel (Winter, Pluck and Yang, "Backward walking: a simple
/// reversal of forward walking?", J. Motor Behavior 21, 1989), in shorter and quicker steps.
GaitParameters back(float speed) {
    GaitParameters g = walk(speed);
    g.name = "back";
    g.straightest_knee = 9;
    g.forward = -speed;
    g.intervals = intervals_at(1.08f * walking_cadence(speed));
    g.duty = 0.62f;
    g.stance_pitch = {{0, -30}, {0.30f, 0}, {0.80f, 0}, {1, 12}};
    g.swing_pitch = {{0.25f, 14}, {0.6f, -16}, {0.85f, -29}};
    g.toes_flat_until = 0.95f;
    g.toe_share = 1;
    g.step_width = 0.13f;
    g.pelvis_yaw = -3;
    g.trunk_yaw = 4;
    g.lean = 5;
    g.arm_swing = -12;
    g.arm_bias = 2;
    g.elbow = 26;
    g.clearance = 0.04f;
    return g;
}

GaitParameters strafe(float speed) {
    GaitParameters g = walk(speed);
    g.name = "strafe_left";
    g.forward = 0;
    g.lateral = speed;
    g.intervals = 40;
    g.duty = 0.58f;
    g.stance_pitch = {{0, -14}, {0.22f, 0}, {0.70f, 0}, {1, -26}};
    g.swing_pitch = {{0.3f, -20}, {0.7f, -12}};
    g.step_width = 0.42f;
    g.clearance = 0.05f;
    g.bob = 0.008f;
    g.sidestep_bob = 0.025f;
    g.sway = 0;
    g.list = 2;
    g.pelvis_yaw = 0;
    g.trunk_yaw = 1;
    g.straightest_knee = 16;
    g.lean = 5;
    g.pelvis_pitch = 5;
    g.arm_swing = 4;
    g.arm_bias = 6;
    g.arm_out = 16;
    g.elbow = 38;
    g.elbow_swing = 3;
    g.arm_twist = 22;
    return g;
}

GaitParameters turn_on_the_spot(float rate, const char* name) {
    GaitParameters g = walk(0);
    g.name = name;
    g.forward = 0;
    g.turn = rate;
    g.intervals = 56;
    g.duty = 0.62f;
    g.stance_pitch = {{0, -4}, {0.18f, 0}, {0.72f, 0}, {1, -24}};
    g.swing_pitch = {{0.3f, -22}, {0.75f, -3}};
    g.step_width = 0.20f;
    g.toe_out = 8;
    g.clearance = 0.05f;
    g.bob = 0.008f;
    g.sway = 0.025f;
    g.list = 2;
    g.pelvis_yaw = 0;
    g.trunk_yaw = 1;
    g.arm_swing = 6;
    g.elbow = 22;
    g.elbow_swing = 3;
    return g;
}

GaitParameters turning(GaitParameters gait, float rate) {
    gait.turn = rate;
    gait.name += "_left";
    return gait;
}

}  // namespace

std::vector<GaitParameters> synthetic_gaits() {
    std::vector<GaitParameters> gaits{idle()};
    const auto both_ways = [&](const GaitParameters& left) {
        const std::string stem = left.name.substr(0, left.name.find("_left"));
        const std::string rest = left.name.substr(stem.size() + 5);
        gaits.push_back(left);
        gaits.push_back(mirrored_gait(left, stem + "_right" + rest));
    };
    gaits.push_back(walk(1.4f));
    both_ways(turning(walk(1.4f), 45));
    gaits.push_back(jog(2.6f));
    both_ways(turning(jog(2.6f), 70));
    gaits.push_back(run(4.2f));
    both_ways(turning(run(4.2f), 45));
    gaits.push_back(back(1.0f));
    both_ways(turning(back(1.0f), 30));
    both_ways(strafe(0.9f));
    both_ways(turn_on_the_spot(45, "turn_left_slow"));
    both_ways(turn_on_the_spot(90, "turn_left"));
    return gaits;
}

}  // namespace surefoot
