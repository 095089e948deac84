#include <surefoot/body/channels.h>
#include <surefoot/gait_text/gait.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace surefoot {
namespace {

float driven(const std::string& name, const std::string& unit, float value, int channel, BodyScale scale = {}) {
    const ControlName control{name, unit};
    const BodyBinding binding = bind_controls({&control, 1});
    EXPECT_TRUE(binding.unknown.empty()) << name;
    std::vector<float> outputs(8, value), channels(8 * k_body_channels);
    apply(binding, scale, outputs, channels);
    return channels[8 * static_cast<std::size_t>(channel)];
}

TEST(BodyChannels, every_control_of_both_models_of_the_paper_is_known) {
    for (const char* gait : {"bhatti2017", "bhatti2017_as_printed"}) {
        std::vector<ControlName> names;
        const Gait read = read_gait(bundled_gait(gait), gait);
        for (const GaitOutput& output : read.outputs) names.push_back({output.name, output.unit});
        const BodyBinding binding = bind_controls(names);
        EXPECT_TRUE(binding.unknown.empty()) << gait << ": " << binding.unknown.front();
        // What is calculated on the way drives nothing; all else does.
        for (const char* moving : {"RightFoot.tY",
                                   "RightFoot.tZ",
                                   "LeftFoot.tY",
                                   "LeftFoot.tZ",
                                   "RightToe.tY",
                                   "LeftToe.tY",
                                   "RightUpLeg.tZ",
                                   "RightUpLeg.tY",
                                   "LeftUpLeg.tZ",
                                   "LeftUpLeg.tY",
                                   "RightArm.tY",
                                   "RightArm.tZ",
                                   "LeftArm.tY",
                                   "LeftArm.tZ",
                                   "RightShoulder.tY",
                                   "RightShoulder.tZ",
                                   "LeftShoulder.tY",
                                   "LeftShoulder.tZ",
                                   "StY",
                                   "StZ",
                                   "CtZ",
                                   "CtY"})
            EXPECT_TRUE(std::any_of(binding.terms.begin(), binding.terms.end(), [&](const BodyTerm& term) {
                return read.outputs[term.control].name == moving;
            })) << moving;
    }
}

TEST(BodyChannels, plain_names_and_those_of_the_paper_mean_the_same) {
    for (const auto& [plain, paper] : {std::pair{"left_foot.tZ", "LeftFoot.tZ"},
                                       {"right_hip.tY", "RightUpLeg.tY"},
                                       {"left_hand.tY", "LeftArm.tY"},
                                       {"right_toe.tY", "RightToe.tY"}}) {
        const ControlName names[] = {{plain, "m"}, {paper, "m"}};
        const BodyBinding binding = bind_controls(names);
        ASSERT_EQ(binding.terms.size(), 2u);
        EXPECT_EQ(binding.terms[0].channel, binding.terms[1].channel);
        EXPECT_EQ(binding.terms[0].reference, binding.terms[1].reference);
    }
}

TEST(BodyChannels, unknown_names_are_listed_and_drive_nothing) {
    const ControlName names[] = {{"left_wing.tY", "m"}, {"left_foot.tY", "m"}, {"left_", ""}, {"", ""}};
    const BodyBinding binding = bind_controls(names);
    EXPECT_EQ(binding.unknown, (std::vector<std::string>{"left_wing.tY", "left_", ""}));
    EXPECT_EQ(binding.terms.size(), 1u);
}

TEST(BodyChannels, angles_are_in_radians_unless_their_unit_says_degrees) {
    const int lean = static_cast<int>(BodyChannel::chest_rx);
    EXPECT_FLOAT_EQ(driven("chest.rX", "", 0.5f, lean), 0.5f);
    EXPECT_FLOAT_EQ(driven("chest.rX", "rad", 0.5f, lean), 0.5f);
    EXPECT_FLOAT_EQ(driven("chest.rX", "deg", 90, lean), 1.57079633f);
    EXPECT_FLOAT_EQ(driven("root.turn", "deg/s", 90, static_cast<int>(BodyChannel::root_turn)), 1.57079633f);
}

TEST(BodyChannels, a_small_body_takes_short_steps_in_quick_time) {
    const BodyScale half{0.5f, 0.4f, std::sqrt(0.5f)};
    EXPECT_FLOAT_EQ(driven("left_foot.tZ", "m", 0.4f, of_side(BodyChannel::foot_z, Side::left), half), 0.2f);
    EXPECT_FLOAT_EQ(driven("right_hand.tZ", "m", 0.4f, of_side(BodyChannel::hand_z, Side::right), half), 0.16f);
    EXPECT_FLOAT_EQ(driven("root.speed", "m/s", 2, static_cast<int>(BodyChannel::root_speed), half),
                    2 * std::sqrt(0.5f));
    EXPECT_FLOAT_EQ(driven("hips.tY", "m", k_gait_hip_height, of_side(BodyChannel::hip_y, Side::right), half), 0);
    EXPECT_FLOAT_EQ(driven("head.rY", "rad", 0.3f, static_cast<int>(BodyChannel::head_ry), half), 0.3f);
}

TEST(BodyChannels, what_is_far_out_of_range_is_held) {
    EXPECT_EQ(driven("left_foot.tZ", "m", 1e30f, of_side(BodyChannel::foot_z, Side::left)), 1000);
    EXPECT_EQ(driven("left_foot.tZ", "m", -1e30f, of_side(BodyChannel::foot_z, Side::left)), -1000);
}

}  // namespace
}  // namespace surefoot
