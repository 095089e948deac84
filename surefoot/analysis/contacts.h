#pragma once
// When which part of which foot stands on the ground.

#include <surefoot/analysis/clip_facts.h>
#include <surefoot/analysis/tracks.h>

namespace surefoot {

struct Contacts {
    std::array<std::vector<Contact>, 2> state;  ///< by Side, one a frame
    bool uneven = false;                        ///< feet stand at heights that no plane explains (stairs, rubble)

    bool down(Side side, int frame) const noexcept {
        return state[static_cast<std::size_t>(side)][static_cast<std::size_t>(frame)] != Contact::lifted;
    }
};

/// Needs soles, in a motion that travels (an in-place clip must first be given its root motion) and whose ground is at
/// y = 0. Heel and toes are judged apart, by height and speed with hysteresis; gaps and touches shorter than 50 ms are
/// noise. Height is meant above the plane on which the feet stand, and where no plane fits (stairs, rubble), above the
/// foot's own stances before and after. `leg_length` scales heights and speeds.
Contacts find_contacts(const Tracks& tracks, float leg_length);

/// Strikes (lifted to standing) and toe-offs, in order of time; at equal times left before right.
std::vector<PhaseEvent> find_events(const Contacts& contacts, float fps);

/// Mean horizontal speed [m/s] of planted sole points: within 1.5 cm of the point's own 3rd percentile height and
/// slower than 0.25 m/s, after smoothing by 25 ms (DESIGN §8). 0 where nothing is planted.
float planted_skate(const Tracks& tracks);

}  // namespace surefoot
