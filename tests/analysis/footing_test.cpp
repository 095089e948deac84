// How far heels reach behind the ankle, as clips tell it.

#include <surefoot/analysis/footing.h>
#include <surefoot/synthetic/synthetic_set.h>

#include "tests/analysis/support.h"

namespace surefoot {
namespace {

float heel_of(const Leg& leg) { return -dot(leg.heel, leg.forward); }
float ball_of(const Leg& leg) { return dot(leg.ball, leg.forward); }

Legs standing_legs(const ClipSet& set) {
    std::vector<Transform> rest(set.skeleton->rest.size());
    local_to_model(*set.skeleton, set.skeleton->rest, rest);
    return make_legs(*set.skeleton, set.roles, rest, 0);
}

/// Frames in which both feet roll, toes up, about the place on their sole that is `heel` behind the ankle. It lies
/// `depth` in the ground.
Tracks rolling(const Legs& legs, float heel, float depth, std::span<const float> degrees) {
    Tracks tracks;
    for (const float angle : degrees)
        for (std::size_t side = 0; side < 2; ++side) {
            const Leg& leg = legs.side[side];
            // Flat first: the foot's own up and forward onto the world's; then its toes go up.
            const Quat flat = rotation_between(leg.up, k_up);
            const Vec3 ahead = rotate(flat, leg.forward);
            const Quat turn = axis_angle(normalized(cross(ahead, k_up)), angle * k_radians_per_degree) * flat;
            const Vec3 pivot = leg.heel + leg.forward * (heel_of(leg) - heel);
            Transform foot{turn, {}};
            foot.translation = Vec3{0, -depth, 0} - rotate(turn, pivot);
            tracks.foot[side].foot.push_back(foot);
        }
    tracks.hips.resize(degrees.size());
    return tracks;
}

class Heels : public ::testing::Test {
  protected:
    const ClipSet set = make_synthetic_set();
    const Legs legs = standing_legs(set);
    const float usual = heel_of(legs.side[0]);
    static constexpr float k_angles[] = {12, 16, 20, 24};

    Legs rounded(float heel, float depth = 0) const {
        const Tracks clips[] = {rolling(legs, heel, depth, k_angles)};
        return rounded_heels(legs, clips);
    }
};

TEST_F(Heels, end_where_clips_roll_over_them) {
    const Legs found = rounded(0.7f * usual);
    for (std::size_t side = 0; side < 2; ++side) {
        const Leg &before = legs.side[side], &after = found.side[side];
        EXPECT_NEAR(heel_of(after), 0.7f * usual, 1e-4f);
        EXPECT_NEAR(dot(after.mid, after.forward), 0.5f * (ball_of(after) - heel_of(after)), 1e-4f);
        EXPECT_NEAR(dot(after.heel, after.up), dot(before.heel, before.up), 1e-5f) << "it stays on the sole";
        EXPECT_EQ(after.ball, before.ball);
        EXPECT_EQ(after.toe_tip, before.toe_tip);
    }
}

TEST_F(Heels, are_not_shorter_than_heels_are) {
    EXPECT_NEAR(heel_of(rounded(0.05f * usual).side[0]), 0.25f * ball_of(legs.side[0]), 1e-4f);
}

TEST_F(Heels, stay_where_a_clip_sinks_them_little_or_sinks_the_whole_foot) {
    for (const Legs& found :
         {rounded(usual), rounded(0.9f * usual), rounded(1.5f * usual), rounded(0.7f * usual, 0.2f)})
        for (std::size_t side = 0; side < 2; ++side) {
            EXPECT_EQ(found.side[side].heel, legs.side[side].heel);
            EXPECT_EQ(found.side[side].mid, legs.side[side].mid);
        }
    EXPECT_EQ(rounded_heels(legs, {}).side[0].heel, legs.side[0].heel);
}

TEST_F(Heels, are_not_told_by_a_single_frame) {
    Tracks clips[] = {rolling(legs, 0.95f * usual, 0, k_angles), {}};
    const float stumble[] = {15};
    clips[1] = rolling(legs, 0.3f * usual, 0, stumble);
    EXPECT_EQ(rounded_heels(legs, clips).side[0].heel, legs.side[0].heel);
}

TEST_F(Heels, of_the_generated_set_are_as_long_as_they_were_made) {
    std::vector<Tracks> clips;
    for (const Motion& motion : set.clips) clips.push_back(make_tracks(motion, set.roles));
    EXPECT_EQ(rounded_heels(legs, clips).side[0].heel, legs.side[0].heel);
}

// The mesh of this character is 5.9 cm long behind the ankle and round there: feet pitched by 10 to 30 degrees touch
// the ground as a point 3.9 to 4.0 cm behind the ankle would (measured on its vertices that hang on foot and toes).
TEST_F(Heels, of_ual1_come_down_where_its_mesh_does) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    for (const char* name : {"Walk_Loop", "Walk_Formal_Loop"}) {
        const std::string file = "ual1_locomotion_glb/UAL1_50clips_mannequin.glb#" + std::string(name);
        const AnalyzedClip clip = test::analyzed(test::load(folder / file).at(0));
        EXPECT_GT(heel_of(clip.legs.side[0]), 0.08f) << "by proportion alone";
        const Tracks tracks[] = {make_tracks(clip.motion, clip.roles.roles)};
        for (const Leg& leg : rounded_heels(clip.legs, tracks).side) EXPECT_NEAR(heel_of(leg), 0.0395f, 0.005f) << name;
    }
}

}  // namespace
}  // namespace surefoot
