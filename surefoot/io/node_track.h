#pragma once
// Values of one track at any time, and the uniform grid that fits a clip's keys.

#include <surefoot/io/node_scene.h>

#include <cstddef>
#include <span>

namespace surefoot {

/// Plays a track. Times asked for should rise: then the key is found at once.
class TrackPlayer {
  public:
    explicit TrackPlayer(const NodeTrack& track) : track_(&track) {}

    Vec3 vector_at(double time);
    Quat rotation_at(double time);

  private:
    struct Place {
        std::size_t key;  // the key at or before the time
        float share;      // of the way to the next key, 0 at a key and outside the track
        float interval;   // seconds between the two
    };
    Place find(double time);

    const NodeTrack* track_;
    std::size_t key_ = 0;
};

struct TimeGrid {
    double start = 0;          ///< [s]
    double step = 1.0 / 30.0;  ///< [s] between frames, so that the last one is the last key
    double fps = 30;           ///< what the file means by `step`: 30 where float keys say 29.99998
    int frames = 1;
};

/// The grid whose frames hit the keys: their own spacing where they lie uniformly (or a finer one that holds it where
/// that is below 24 a second), else the one of 30, 60 or 120 a second that fits best. Its last frame is the last key.
/// `times` are rising; throws nothing; frames is 0 where more than `most_frames` would be needed.
TimeGrid fit_time_grid(std::span<const float> times, std::size_t most_frames);

}  // namespace surefoot
