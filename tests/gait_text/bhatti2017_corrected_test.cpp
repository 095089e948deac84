// What the corrected model promises: feet that stand still and never sink, arms against legs, the speed that is asked.

#include <surefoot/gait_text/gait.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr int k_steps = 2000;

struct Played {
    Gait gait;
    GaitTable table;

    std::size_t column(const std::string& name) const {
        const auto found =
            std::find_if(gait.outputs.begin(), gait.outputs.end(), [&](const auto& o) { return o.name == name; });
        EXPECT_NE(found, gait.outputs.end()) << name;
        return static_cast<std::size_t>(found - gait.outputs.begin());
    }
    double at(const std::string& name, int row) const {
        return table.values[static_cast<std::size_t>(row) * gait.outputs.size() + column(name)];
    }
};

Played play(const std::string& preset, const std::vector<std::string>& set = {}) {
    Played played{read_gait(bundled_gait("bhatti2017"), "bhatti2017.gait", GaitOutputs::everything), {}};
    GaitMoments moments;
    moments.steps = k_steps;
    played.table = sample_gait(played.gait, gait_values(played.gait, preset, set), moments);
    return played;
}

std::vector<std::string> presets() {
    std::vector<std::string> names{""};
    for (const GaitPreset& preset : play("").gait.presets) names.push_back(preset.name);
    return names;
}

TEST(Bhatti2017, uses_every_name_and_has_every_control_of_the_printed_model_but_one_toe_wave_a_foot) {
    const Gait corrected = play("").gait;
    EXPECT_TRUE(corrected.warnings.empty()) << corrected.warnings[0];
    for (const GaitOutput& printed : read_gait(bundled_gait("bhatti2017_as_printed"), "p").outputs) {
        const bool there = std::any_of(corrected.outputs.begin(), corrected.outputs.end(),
                                       [&](const auto& o) { return o.name == printed.name; });
        EXPECT_EQ(there, printed.name != "Ftau") << printed.name;
    }
    EXPECT_GE(corrected.presets.size(), 15u);
}

TEST(Bhatti2017, feet_never_sink_and_those_on_the_ground_stand_still) {
    for (const std::string& preset : presets()) {
        const Played p = play(preset);
        for (const std::string side : {"Left", "Right"}) {
            int standing = 0;
            for (int row = 0; row < k_steps; ++row) {
                EXPECT_GE(p.at(side + "Foot.tY", row), 0) << preset;
                EXPECT_GE(p.at(side + "Toe.tY", row), 0) << preset;
                const std::string stands = std::string("stands") + side[0];
                if (p.at(stands, row) == 0 || p.at(stands, row + 1) == 0) continue;
                if (p.at("phase" + side.substr(0, 1), row + 1) < p.at("phase" + side.substr(0, 1), row)) continue;
                ++standing;
                EXPECT_EQ(p.at(side + "Foot.tY", row), 0) << preset;
                const double before = p.at("root.tZ", row) + p.at(side + "Foot.tZ", row);
                const double after = p.at("root.tZ", row + 1) + p.at(side + "Foot.tZ", row + 1);
                EXPECT_NEAR(after, before, 1e-9) << preset << " " << side << " at row " << row;
            }
            EXPECT_GT(standing, k_steps / 5) << preset;
        }
    }
}

TEST(Bhatti2017, every_control_closes_its_cycle_without_a_jump) {
    for (const std::string& preset : presets()) {
        const Played p = play(preset);
        for (const GaitOutput& output : p.gait.outputs) {
            if (!output.control || output.name == "root.tZ") continue;
            EXPECT_NEAR(p.at(output.name, 0), p.at(output.name, k_steps), 1e-6) << preset << " " << output.name;
            double low = 1e30, high = -1e30;
            for (int row = 0; row <= k_steps; ++row) {
                low = std::min(low, p.at(output.name, row));
                high = std::max(high, p.at(output.name, row));
            }
            // A full swing takes a fifth of the cycle at the quickest.
            for (int row = 0; row < k_steps; ++row)
                EXPECT_LE(std::fabs(p.at(output.name, row + 1) - p.at(output.name, row)),
                          20 * (high - low) / k_steps + 1e-12)
                    << preset << " " << output.name << " at row " << row;
        }
    }
}

TEST(Bhatti2017, swinging_feet_leave_and_meet_the_ground_at_its_speed) {
    for (const std::string& preset : presets()) {
        const Played p = play(preset);
        const double step = p.table.period_s / k_steps;
        for (int row = 1; row < k_steps; ++row)
            if (p.at("standsL", row - 1) != p.at("standsL", row + 1)) {
                const double moved = p.at("root.tZ", row + 1) + p.at("LeftFoot.tZ", row + 1) -
                                     p.at("root.tZ", row - 1) - p.at("LeftFoot.tZ", row - 1);
                EXPECT_LT(std::fabs(moved) / (2 * step), 0.25) << preset;
            }
    }
}

TEST(Bhatti2017, arms_swing_with_the_legs_of_the_other_side) {
    for (const std::string& preset : presets()) {
        const Played p = play(preset);
        double crossed = 0, same = 0;
        for (int row = 0; row < k_steps; ++row) {
            const double left_arm = p.at("LeftArm.tZ", row) - p.at("LeftArm.tZ", (row + k_steps / 2) % k_steps);
            const double left = p.at("LeftFoot.tZ", row) - p.at("LeftFoot.tZ", (row + k_steps / 2) % k_steps);
            const double right = p.at("RightFoot.tZ", row) - p.at("RightFoot.tZ", (row + k_steps / 2) % k_steps);
            crossed += left_arm * right;
            same += left_arm * left;
        }
        EXPECT_GT(crossed, 0) << preset;
        EXPECT_LT(same, 0) << preset;
    }
}

TEST(Bhatti2017, speed_and_stride_are_what_was_asked) {
    const Played p = play("", {"SlgtL=1.2", "SlgtR=1.2", "vM=0.3"});
    EXPECT_NEAR(p.table.period_s, 2 * 3.14159265358979 / 0.3 / 24, 1e-9);
    EXPECT_NEAR(p.at("root.tZ", k_steps), 1.2, 1e-9);
    EXPECT_NEAR(p.at("root.speed", 0), 1.2 / p.table.period_s, 1e-9);
    // Strike to strike of one foot, in the world: its stride.
    EXPECT_NEAR(p.at("root.tZ", k_steps) + p.at("LeftFoot.tZ", k_steps) - p.at("LeftFoot.tZ", 0), 1.2, 1e-6);
}

TEST(Bhatti2017, the_pelvis_tilts_and_its_hips_go_with_their_feet) {
    const Played p = play("");
    for (const int row : {k_steps / 4, 3 * k_steps / 4}) {
        const double left = p.at("LeftUpLeg.tY", row), right = p.at("RightUpLeg.tY", row);
        EXPECT_GT(p.at("standsL", row) != 0 ? left - right : right - left, 0.01) << row;
    }
    EXPECT_GT(p.at("LeftUpLeg.tZ", 0), p.at("RightUpLeg.tZ", 0));
    EXPECT_GT(p.at("LeftFoot.tZ", 0), p.at("RightFoot.tZ", 0));
    // Shoulders the other way.
    EXPECT_LT(p.at("LeftShoulder.tZ", 0), p.at("RightShoulder.tZ", 0));
}

TEST(Bhatti2017, a_walk_is_high_in_mid_stance_and_a_run_is_low) {
    for (const std::string preset : {"normal_walk", "jog", "run"}) {
        const Played p = play(preset);
        const double mid_stance = p.at("f_pelvis", static_cast<int>(p.at("dutyL", 0) / 2 * k_steps));
        double amplitude = 0;
        for (int row = 0; row < k_steps; ++row) amplitude = std::max(amplitude, p.at("f_pelvis", row));
        EXPECT_GT((preset == "normal_walk" ? 1 : -1) * mid_stance, 0.9 * amplitude) << preset;
    }
}

TEST(Bhatti2017, tables_come_as_csv_json_and_picture) {
    const Gait gait = read_gait("gait g control a = T control b = 0.1 period = 0.5", "g");
    GaitMoments moments;
    moments.frames = 3;
    EXPECT_EQ(gait_table_csv(gait, sample_gait(gait, {}, moments)),
              "T,time,a,b\n0,0,0,0.1\n1,0.041666666666666664,1,0.1\n2,0.08333333333333333,2,0.1\n");
    moments = {};
    const GaitTable table = sample_gait(gait, {}, moments);
    EXPECT_EQ(table.times_s.size(), 97u);
    EXPECT_EQ(table.times_s.back(), 0.5);
    EXPECT_NE(gait_table_json(gait, table).find("\"period_s\": 0.5"), std::string::npos);
    EXPECT_NE(gait_table_svg(gait, table).find("class=\"name\">b</text>"), std::string::npos);
}

}  // namespace
}  // namespace surefoot
