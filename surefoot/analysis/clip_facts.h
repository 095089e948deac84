#pragma once
// What a clip does: the one table every later stage reads. Filled by analyze_clip (analysis/analyze.h).
//
// Sources: Delicado & Pelechano 2019, §3.1 (velocity and turn of a clip); Colvin & Kajala 2013, §III.D (foot states).

#include <surefoot/rig/leg.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace surefoot {

/// Colvin & Kajala's four states of a foot.
enum class Contact : std::uint8_t { lifted, heel, toe, flat };

enum class StrideEvent : std::uint8_t { strike, toe_off };

struct PhaseEvent {
    Side foot = Side::left;
    StrideEvent kind = StrideEvent::strike;
    float time = 0;  ///< [s] from the first frame
};

struct ClipFacts {
    std::string name;
    std::string file;  ///< as the user gave it, with #NAME where the file holds several
    int frames = 0, joints = 0;
    float fps = 0, duration = 0;  ///< [1/s], [s]

    // Mean velocity in the body's frame, by which the clip is placed (DESIGN §5).
    float forward = 0;  ///< [m/s] along the torso's facing
    float lateral = 0;  ///< [m/s] to the character's left
    float speed = 0;    ///< [m/s] planar magnitude, negative where |travel| > 90 deg
    float chord = 0;    ///< [m/s] the paper's velocity: first to last frame, over the time between
    float turn = 0;     ///< [deg/s] of the torso, positive to the left
    float travel = 0;   ///< [deg] direction of travel against facing: 0 forward, +90 left, 180 backward
    float slope = 0;    ///< [deg] positive uphill
    float climb = 0;    ///< [m/s] vertical

    bool in_place = false;  ///< the hips do not travel, but the stance feet say that the character does
    bool cyclic = false;
    bool locomotion = true;  ///< false: `not_locomotion` says why it has no place in a locomotion space
    std::string not_locomotion;

    float cadence = 0;                 ///< [steps/min], 0 where there are no steps
    float stride = 0;                  ///< [m] travelled a cycle of two steps
    float duty = 0;                    ///< share of a cycle that a foot stands
    std::vector<PhaseEvent> events;    ///< in order of time
    std::vector<Contact> contacts[2];  ///< by Side, one a frame

    float skate = 0;                    ///< [m/s] mean horizontal speed of planted sole points
    float seam = 0;                     ///< [m] largest joint mismatch between first and last frame, before closing
    float seam_speed = 0;               ///< [m/s] largest joint velocity mismatch at the seam
    float loop_error = 0;               ///< [m] the seam as the clip stands now
    float closing = 0;                  ///< [m] largest displacement that closing the loop added
    float root_disagreement_speed = 0;  ///< [m/s] root motion against stance feet
    float root_disagreement_turn = 0;   ///< [deg/s]
    float hip_height = 0;               ///< [m] mean height of the hips above the clip's ground
    float height = 0;                   ///< [m] of the character
    float unit_scale = 1;               ///< factor that turned the file's units into metres
    std::vector<std::string> warnings;

    /// Numbers that a person gave the clip (io/sidecar.h): values on axes of their own, by name.
    std::map<std::string, float> custom;
};

}  // namespace surefoot
