#include <surefoot/analysis/leg_track.h>
#include <surefoot/author/fitted_gaits.h>
#include <surefoot/author/personalities.h>
#include <surefoot/base/error.h>
#include <surefoot/fit/fit_gait.h>
#include <surefoot/math/trig.h>
#include <surefoot/motion/edit.h>

#include "tests/fit/baked_clip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

std::vector<Transform> models_of(const AnalyzedClip& clip, int frame) {
    std::vector<Transform> models(static_cast<std::size_t>(clip.motion.joint_count()));
    local_to_model(*clip.motion.skeleton, clip.motion.frame(frame), models);
    return models;
}

/// Mean height of a joint of a role.
float height(const AnalyzedClip& clip, Role role) {
    float sum = 0;
    for (int f = 0; f < clip.motion.frame_count(); ++f)
        sum += models_of(clip, f)[static_cast<std::size_t>(clip.roles.roles[role])].translation.y;
    return sum / static_cast<float>(clip.motion.frame_count());
}

AnalyzedClip styled(const HarmonicGait& gait, const GaitStyle& style, float speed) {
    return bake_gait(gait, speed, 0, GaitBakeOptions{style, 0, 60});
}

TEST(GaitStyle, sliders_at_rest_change_nothing) {
    const HarmonicGait walk = fitted_gait("walk");
    const AnalyzedClip plain = bake_gait(walk, 1.2f, 30), same = bake_gait(walk, 1.2f, 30, GaitBakeOptions{});
    for (std::size_t i = 0; i < plain.motion.locals.size(); ++i)
        EXPECT_LT(distance(plain.motion.locals[i].translation, same.motion.locals[i].translation), 1e-5f);
}

TEST(GaitStyle, every_personality_keeps_its_feet_and_its_speed) {
    const HarmonicGait walk = fitted_gait("walk");
    ASSERT_GE(bundled_personalities().size(), 6u);
    for (const float speed : {0.5f, 1.0f, 1.5f, 3.0f}) {
        const AnalyzedClip plain = bake_gait(walk, speed, 0);
        const double skate = skate_of(plain);
        const float lowest = lowest_sole(plain);
        for (const Personality& personality : bundled_personalities()) {
            const AnalyzedClip clip = styled(walk, personality.style, speed);
            const AnalyzedClip seen = analyze_clip(clip.motion, personality.name);
            EXPECT_NEAR(seen.facts.speed, speed, 0.02f * speed) << personality.name;
            EXPECT_LT(seen.facts.root_disagreement_speed, 0.02f * std::max(1.0f, speed)) << personality.name << speed;
            EXPECT_LT(skate_of(clip), 1.2 * skate) << personality.name << " at " << speed;
            EXPECT_GT(lowest_sole(clip), lowest - 0.005f) << personality.name << " at " << speed;
        }
    }
}

TEST(GaitStyle, personalities_look_like_what_they_are_called) {
    const HarmonicGait walk = fitted_gait("walk");
    const auto head = [&](const char* name) {
        for (const Personality& p : bundled_personalities())
            if (p.name == name) return height(styled(walk, p.style, 1), Role::head);
        ADD_FAILURE() << name;
        return 0.0f;
    };
    const float neutral = head("neutral");
    EXPECT_GT(head("proud"), head("tired") + 0.01f);
    EXPECT_LT(head("tired"), neutral - 0.02f);
    EXPECT_LT(head("elderly"), neutral - 0.04f);
    EXPECT_LT(head("sneaky"), neutral - 0.15f);
}

TEST(GaitStyle, each_slider_does_what_it_says) {
    const HarmonicGait walk = fitted_gait("walk");
    const auto with = [&](const char* slider, float value) {
        GaitStyle style;
        set_slider(style, slider, value, "test");
        return styled(walk, style, 1.2f);
    };
    const AnalyzedClip plain = bake_gait(walk, 1.2f, 0);
    EXPECT_NEAR(with("stride", 0.8f).facts.stride, 0.8f * plain.facts.stride, 0.02f);
    EXPECT_NEAR(with("crouch_m", 0.1f).facts.hip_height, plain.facts.hip_height - 0.1f, 0.03f);
    const auto apart = [](const AnalyzedClip& clip) {
        const std::vector<Transform> models = models_of(clip, 0);
        return models[static_cast<std::size_t>(clip.legs.side[0].foot)].translation.x -
               models[static_cast<std::size_t>(clip.legs.side[1].foot)].translation.x;
    };
    EXPECT_NEAR(apart(with("width_m", 0.1f)) - apart(plain), 0.1f, 0.01f);
    const auto ahead = [](const AnalyzedClip& clip, Role role, int axis) {
        const Vec3 at = models_of(clip, 0)[static_cast<std::size_t>(clip.roles.roles[role])].translation;
        return axis == 0 ? at.x : axis == 1 ? at.y : at.z;
    };
    EXPECT_GT(ahead(with("spine.lean_deg", 20), Role::head, 2), ahead(plain, Role::head, 2) + 0.08f);
    EXPECT_GT(ahead(with("spine.side_deg", 15), Role::head, 0), ahead(plain, Role::head, 0) + 0.05f);
    EXPECT_GT(ahead(with("arms.out_deg", 30), Role::left_hand, 0), ahead(plain, Role::left_hand, 0) + 0.15f);
    EXPECT_LT(ahead(with("arms.out_deg", 30), Role::right_hand, 0), ahead(plain, Role::right_hand, 0) - 0.15f);
    EXPECT_GT(ahead(with("arms.bend_deg", 60), Role::left_hand, 1), ahead(plain, Role::left_hand, 1) + 0.05f);
}

TEST(GaitStyle, set_for_good_it_is_the_same_at_every_speed_and_turn) {
    const HarmonicGait plain = fitted_gait("human");
    const StyleBody body = make_style_body(plain);
    std::vector<float> expected(static_cast<std::size_t>(value_count(plain))), values(expected.size());
    for (const Personality& personality : bundled_personalities()) {
        const HarmonicGait styled = with_style(plain, personality.style);
        EXPECT_EQ(problem(styled), "");
        float largest = 0, change = 0;
        for (const float speed : {0.4f, 1.4f, 2.3f, 4.0f})
            for (const float turn : {0.0f, 60.0f, -90.0f}) {
                values_at(plain, speed, turn, expected);
                std::vector<float> before = expected;
                apply_style(plain, body, personality.style, expected);
                values_at(styled, speed, turn, values);
                // Stances that are as long or short as they may be are bounded before the sliders, or after them.
                for (const std::span<float> all : {std::span(before), std::span(expected), std::span(values)})
                    for (float& lift : all.last(2)) lift = std::clamp(lift, 0.33f, 0.75f);
                for (std::size_t i = 0; i < values.size(); ++i) {
                    largest = std::max(largest, std::fabs(values[i] - expected[i]));
                    change = std::max(change, std::fabs(values[i] - before[i]));
                }
            }
        EXPECT_LT(largest, 1e-4f) << personality.name;
        EXPECT_EQ(change > 0.05f, personality.name != "neutral") << personality.name;
    }
    EXPECT_EQ(with_style(plain, {}).coefficients, plain.coefficients);
}

TEST(GaitStyle, a_slope_is_followed_by_root_and_feet) {
    const HarmonicGait walk = fitted_gait("walk");
    for (const float slope : {-20.0f, -8.0f, 8.0f, 20.0f}) {
        const auto rise = static_cast<float>(tan(static_cast<double>(slope) * k_pi / 180));
        const AnalyzedClip clip = bake_gait(walk, 1.1f, 0, GaitBakeOptions{{}, slope, 60});
        const Vec3 end = clip.motion.root.back().position;
        EXPECT_NEAR(end.y, rise * end.z, 1e-3f);
        EXPECT_GT(lowest_sole(clip, rise), -0.05f) << slope;
        EXPECT_LT(lowest_sole(clip, rise), 0.02f) << slope;
    }
    const auto lean = [&](float slope) {
        const AnalyzedClip clip = bake_gait(walk, 1.1f, 0, GaitBakeOptions{{}, slope, 60});
        const std::vector<Transform> models = models_of(clip, 0);
        return models[static_cast<std::size_t>(clip.roles.roles[Role::neck])].translation.z -
               models[static_cast<std::size_t>(clip.legs.hips)].translation.z;
    };
    EXPECT_GT(lean(15), lean(0) + 0.01f);
    EXPECT_LT(lean(-15), lean(0));
}

TEST(Personalities, bad_files_are_refused_by_name_and_place) {
    const auto message = [](const char* text) -> std::string {
        try {
            read_personalities(text, "mine.json");
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(message("{").find("mine.json: it is no JSON"), std::string::npos);
    EXPECT_NE(message(R"({"a": {"spine": {"lean": 3}}})").find("no slider 'spine.lean'"), std::string::npos);
    EXPECT_NE(message(R"({"a": {"legs": {"bend_deg": 3}}})").find("no slider 'legs.bend_deg'"), std::string::npos);
    EXPECT_NE(message(R"({"a": {"stride": 9}})").find("/a/stride"), std::string::npos);
    EXPECT_NE(message(R"({"a": {"stride": "long"}})").find("/a/stride"), std::string::npos);
    EXPECT_NE(message("[1]").find("mine.json"), std::string::npos);
    EXPECT_EQ(read_personalities(R"({"a": {"help": "x", "head": {"turn_deg": 9}}})", "m")[0].style[BodyPart::head].turn,
              9);
}

}  // namespace
}  // namespace surefoot
