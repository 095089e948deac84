#pragma once
// Is a clip locomotion? Judged by how the body moves, never by the clip's name.

#include <surefoot/analysis/measure.h>

#include <string>

namespace surefoot {

/// What the judgement rests on; lengths in leg lengths, so that it holds for any size.
struct BodyFeatures {
    float hips_low = 0, hips_high = 0;  ///< 5th and 95th percentile of the hips' height, in leg lengths
    float tilt = 0;                     ///< [deg] 90th percentile of the torso's lean
    float airborne = 0;                 ///< [s] longest time with both feet off the ground
    float planted = 0;                  ///< share of frames in which both feet are down
    float standing = 0;                 ///< share of frames in which any foot is down
    float hand_speed = 0;               ///< [m/s] 95th percentile, faster hand, relative to the hips
    float hand_swing = 0;               ///< [m/s] mean of the same
    float foot_speed = 0;               ///< [m/s] 95th percentile, faster foot's ball
    float arms_up = 0;                  ///< share of frames with both hands level with the shoulders or above
    float flat = 0;                     ///< share of frames in which a foot that is down lies flatter than 25 degrees
    float aside = 0;                    ///< median distance of the hips from the line between the feet, in leg lengths
    /// [leg lengths] height of the hips over a standing foot against their mean height: above 0 in a walk, which vaults
    /// over its leg, below 0 in a run, which sinks on it.
    float vault = 0;
    int strikes[2] = {0, 0};  ///< by Side
    bool uneven = false;      ///< the feet stand at different heights
};

BodyFeatures body_features(const Measured& measured, const ClipFacts& facts, float leg_length);

/// Why this is no locomotion, as a sentence a user understands; empty where it is. Standing on both feet with little
/// motion is locomotion at speed 0.
std::string why_not_locomotion(const BodyFeatures& features, const ClipFacts& facts, float leg_length);

}  // namespace surefoot
