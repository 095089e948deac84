#include <surefoot/ik/foot_placement.h>
#include <surefoot/motion/clean.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }
float degrees(float radians) { return radians * k_degrees_per_radian; }

constexpr float k_window = 0.1f;   // [s] on either side, in which the joint shows how fast it moves
constexpr float k_stands_out = 4;  // times the usual step of the window: a jump

/// One joint's local transforms (those of a joint without parent in the world, so that travel is part of them).
class Track {
  public:
    Track(Motion& motion, int joint)
        : motion_(motion), joint_(joint), in_world_(motion.skeleton->parents[at(joint)] == k_no_joint) {
        for (int f = 0; f < motion.frame_count(); ++f) {
            const Transform& local = motion.frame(f)[at(joint)];
            values_.push_back(in_world_ ? to_transform(motion.root[at(f)]) * local : local);
        }
    }
    int count() const { return static_cast<int>(values_.size()); }
    int joint() const { return joint_; }
    const Transform& operator[](int f) const { return values_[at(f)]; }
    void set(int f, const Transform& value) {
        values_[at(f)] = value;
        values_[at(f)].rotation = normalized(value.rotation);
        motion_.frame(f)[at(joint_)] =
            in_world_ ? inverse(to_transform(motion_.root[at(f)])) * values_[at(f)] : values_[at(f)];
    }

  private:
    Motion& motion_;
    int joint_;
    bool in_world_;
    std::vector<Transform> values_;
};

float turn_between(const Transform& a, const Transform& b) {
    return rotation_angle(conjugate(a.rotation) * b.rotation);
}

int frames_of(const Motion& motion, float seconds, int least) {
    return std::max(least, static_cast<int>(seconds * motion.fps + 0.5f));
}

/// What is usual among steps around [first, last]: the 80th percentile of the window, which two broken neighbours do
/// not move.
float usual_step(const std::vector<float>& steps, int first, int last, int window) {
    std::vector<float> near;
    const int end = static_cast<int>(steps.size());
    for (int f = std::max(1, first - window); f < first; ++f) near.push_back(steps[at(f)]);
    for (int f = last + 2; f < std::min(end, last + 2 + window); ++f) near.push_back(steps[at(f)]);
    if (near.empty()) return 0;
    const auto rank = static_cast<std::ptrdiff_t>(0.8 * static_cast<double>(near.size() - 1) + 0.5);
    std::nth_element(near.begin(), near.begin() + rank, near.end());
    return near[static_cast<std::size_t>(rank)];
}

/// Fills first … last by a cubic from the sound frames on either side, with the velocities they have.
void fill(Track& track, int first, int last, bool rotation, bool translation) {
    const int a = first - 1, b = last + 1;
    const auto span = static_cast<float>(b - a);
    const Transform from = track[a], to = track[b];
    const auto vector_from = [&](Quat q) { return to_rotation_vector(conjugate(from.rotation) * q); };
    const auto hermite = [&](Vec3 start, Vec3 end, Vec3 out, Vec3 in, float t) {
        const float u = 1 - t;
        return start * ((1 + 2 * t) * u * u) + end * (t * t * (3 - 2 * t)) + out * (span * t * u * u) -
               in * (span * t * t * u);
    };
    // A neighbour beyond the next may be broken too: velocities count only as far as the bridge itself moves.
    const auto bounded = [&](Vec3 velocity, Vec3 bridge, float least) {
        const float most = 3 * length(bridge) / span + least, has = length(velocity);
        return has > most ? velocity * (most / has) : velocity;
    };
    const Vec3 turn = vector_from(to.rotation), shift = to.translation - from.translation;
    constexpr float k_turn = 0.02f, k_shift = 0.002f;
    const Vec3 turn_out = bounded(to_rotation_vector(conjugate(track[a - 1].rotation) * from.rotation), turn, k_turn);
    const Vec3 turn_in = bounded(to_rotation_vector(conjugate(to.rotation) * track[b + 1].rotation), turn, k_turn);
    const Vec3 shift_out = bounded(from.translation - track[a - 1].translation, shift, k_shift);
    const Vec3 shift_in = bounded(track[b + 1].translation - to.translation, shift, k_shift);
    for (int f = first; f <= last; ++f) {
        const float t = static_cast<float>(f - a) / span;
        Transform value = track[f];
        if (rotation) value.rotation = from.rotation * from_rotation_vector(hermite({}, turn, turn_out, turn_in, t));
        if (translation) value.translation = from.translation + hermite({}, shift, shift_out, shift_in, t);
        track.set(f, value);
    }
}

// --- dropped frames

void mend_dropped(Motion& motion, std::vector<Track>& tracks, const CleanOptions& options,
                  std::vector<GlitchRepair>& done) {
    const int n = motion.frame_count();
    std::vector<float> steps(at(n), 0.0f);  // [rad] of the joint that turns most
    std::vector<char> held(at(n), 0);
    for (int f = 1; f < n; ++f) {
        float shift = 0;
        for (const Track& track : tracks) {
            steps[at(f)] = std::max(steps[at(f)], turn_between(track[f - 1], track[f]));
            shift = std::max(shift, distance(track[f - 1].translation, track[f].translation));
        }
        held[at(f)] = steps[at(f)] < 1e-5f && shift < 1e-5f;
    }
    const int longest = frames_of(motion, options.dropped_seconds, 1), window = frames_of(motion, k_window, 4);
    for (int f = 2; f + 2 < n; ++f) {
        if (!held[at(f)]) continue;
        const int first = f;
        while (f + 1 < n && held[at(f + 1)]) ++f;
        if (f + 2 >= n || f - first + 1 > longest) continue;
        // A dropped frame is caught up with: the next step is longer than those around.
        const float usual = usual_step(steps, first, f, window), next = steps[at(f + 1)];
        constexpr float k_moves = 0.3f * k_radians_per_degree, k_catches_up = 1.5f;
        if (usual < k_moves || next < k_catches_up * usual) continue;
        GlitchRepair repair{Glitch::dropped, k_no_joint, first, f, 0, 0};
        for (Track& track : tracks) {
            const std::vector<Transform> before{track[first], track[f]};
            fill(track, first, f, true, true);
            repair.degrees = std::max({repair.degrees, degrees(turn_between(before[0], track[first])),
                                       degrees(turn_between(before[1], track[f]))});
            repair.metres = std::max({repair.metres, distance(before[0].translation, track[first].translation),
                                      distance(before[1].translation, track[f].translation)});
        }
        done.push_back(repair);
    }
}

// --- spikes and flips

/// A step there at `first` and back after `last`, both far above what is usual around.
bool jumps(const std::vector<float>& steps, int first, int last, int window, float least) {
    const float smaller = std::min(steps[at(first)], steps[at(last + 1)]);
    return smaller > least && smaller > k_stands_out * usual_step(steps, first, last, window);
}

void mend_spikes(const Motion& motion, Track& track, const CleanOptions& options, bool rotation,
                 std::vector<GlitchRepair>& done) {
    const int n = track.count();
    const auto apart = [&](int a, int b) {
        return rotation ? turn_between(track[a], track[b]) : distance(track[a].translation, track[b].translation);
    };
    std::vector<float> steps(at(n), 0.0f);
    for (int f = 1; f < n; ++f) steps[at(f)] = apart(f - 1, f);
    const float least = rotation ? options.spike_deg * k_radians_per_degree : options.spike_m;
    const int longest = frames_of(motion, options.spike_seconds, 2), window = frames_of(motion, k_window, 4);
    for (int first = 2; first + 2 < n; ++first) {
        if (!(steps[at(first)] > least)) continue;
        for (int last = first; last < first + longest && last + 2 < n; ++last) {
            if (!jumps(steps, first, last, window, least)) continue;
            if (apart(first - 1, last + 1) > 0.5f * std::min(steps[at(first)], steps[at(last + 1)])) continue;
            GlitchRepair repair{Glitch::spike, track.joint(), first, last, 0, 0};
            std::vector<Transform> before;
            for (int f = first; f <= last; ++f) before.push_back(track[f]);
            fill(track, first, last, rotation, !rotation);
            for (int f = first; f <= last; ++f) {
                repair.degrees = std::max(repair.degrees, degrees(turn_between(before[at(f - first)], track[f])));
                repair.metres =
                    std::max(repair.metres, distance(before[at(f - first)].translation, track[f].translation));
            }
            for (int f = first; f <= last + 1; ++f) steps[at(f)] = apart(f - 1, f);
            done.push_back(repair);
            break;
        }
    }
}

/// What turns the joint back, at either end of a flipped stretch: against where its own motion would have led.
struct FlipEnds {
    Quat first, last;
    float size() const { return 0.5f * (rotation_angle(first) + rotation_angle(last)); }
    float disagreement() const { return rotation_angle(conjugate(first) * last); }
};

FlipEnds flip_ends(const Track& track, int first, int last, bool in_parent) {
    const auto led = [&](int from, int to) {  // one step further
        return track[to].rotation * conjugate(track[from].rotation) * track[to].rotation;
    };
    const auto back = [&](Quat is, Quat should) { return in_parent ? should * conjugate(is) : conjugate(is) * should; };
    return {back(track[first].rotation, led(first - 2, first - 1)),
            back(track[last].rotation, led(last + 2, last + 1))};
}

void mend_flips(const Motion& motion, Track& track, const CleanOptions& options, std::vector<GlitchRepair>& done) {
    const int n = track.count(), window = frames_of(motion, k_window, 4);
    std::vector<float> steps(at(n), 0.0f);
    for (int f = 1; f < n; ++f) steps[at(f)] = turn_between(track[f - 1], track[f]);
    const float least = options.flip_deg * k_radians_per_degree;
    for (int first = 2; first + 2 < n; ++first) {
        if (!(steps[at(first)] > least)) continue;
        for (int last = first; last + 2 < n; ++last) {
            if (!(steps[at(last + 1)] > least)) continue;
            if (!jumps(steps, first, last, window, least)) break;
            const FlipEnds own = flip_ends(track, first, last, false), parents = flip_ends(track, first, last, true);
            const bool in_parent = parents.disagreement() < own.disagreement();
            const FlipEnds& ends = in_parent ? parents : own;
            // The same turn there and back: a limb that was thrown would come back another way.
            constexpr float k_same = 0.35f;
            if (ends.disagreement() > k_same * ends.size()) break;
            for (int f = first; f <= last; ++f) {
                const float t = last > first ? static_cast<float>(f - first) / static_cast<float>(last - first) : 0.5f;
                const Quat turn = slerp(ends.first, ends.last, t);
                Transform value = track[f];
                value.rotation = in_parent ? turn * value.rotation : value.rotation * turn;
                track.set(f, value);
            }
            for (int f = first; f <= last + 1; ++f) steps[at(f)] = turn_between(track[f - 1], track[f]);
            done.push_back({Glitch::flip, track.joint(), first, last, degrees(ends.size()), 0});
            first = last;
            break;
        }
    }
}

// --- jitter

/// How each frame stands off the middle of its neighbours.
std::vector<Vec3> tremble(const Track& track) {
    std::vector<Vec3> off(at(track.count()));
    for (int f = 1; f + 1 < track.count(); ++f)
        off[at(f)] = to_rotation_vector(conjugate(slerp(track[f - 1].rotation, track[f + 1].rotation, 0.5f)) *
                                        track[f].rotation);
    return off;
}

/// Frames around which the joint goes to and fro: neighbouring deviations point against each other (those of noise
/// correlate by -2/3, those of motion by nearly 1).
std::vector<char> trembling(const std::vector<Vec3>& off, float least) {
    const int n = static_cast<int>(off.size());
    std::vector<char> result(at(n), 0);
    std::vector<float> sizes;
    for (const Vec3 v : off) sizes.push_back(length(v));
    std::vector<float> sorted = sizes;
    std::nth_element(sorted.begin(), sorted.begin() + n / 2, sorted.end());
    const float usual = sorted[at(n / 2)];
    constexpr int k_half = 4;
    for (int f = k_half; f + k_half < n; ++f) {
        float energy = 0, against = 0;
        int turns = 0;
        for (int i = f - k_half; i <= f + k_half; ++i) energy += length_squared(off[at(i)]);
        for (int i = f - k_half; i < f + k_half; ++i) {
            const float pair = dot(off[at(i)], off[at(i + 1)]);
            against += pair;
            turns += pair < 0;
        }
        const float rms = std::sqrt(energy / (2 * k_half + 1));
        const float correlation = energy > 0 ? against / energy : 0;
        const bool stands_out = rms > k_stands_out * usual && correlation < -0.35f;
        constexpr int k_to_and_fro = 6;  // of 8 pairs: one hard stop is no tremble
        if (rms > least && turns >= k_to_and_fro && (stands_out || correlation < -0.5f))
            for (int i = f - k_half / 2; i <= f + k_half / 2; ++i) result[at(i)] = 1;
    }
    return result;
}

/// A quadratic through the frames around f, least squares, at f (Savitzky & Golay 1964).
Quat smoothed(const std::vector<Quat>& rotations, int f, int half) {
    const int n = static_cast<int>(rotations.size());
    half = std::min({half, f, n - 1 - f});
    Vec3 sum, sum_squares;
    double s2 = 0, s4 = 0;
    for (int i = -half; i <= half; ++i) {
        const Vec3 v = to_rotation_vector(conjugate(rotations[at(f)]) * rotations[at(f + i)]);
        sum += v;
        sum_squares += v * static_cast<float>(i * i);
        s2 += i * i;
        s4 += static_cast<double>(i * i) * (i * i);
    }
    const double count = 2 * half + 1, determinant = count * s4 - s2 * s2;
    if (!(determinant > 0)) return rotations[at(f)];
    const auto a = static_cast<float>(s4 / determinant), b = static_cast<float>(s2 / determinant);
    return rotations[at(f)] * from_rotation_vector(sum * a - sum_squares * b);
}

void mend_jitter(const Motion& motion, Track& track, const CleanOptions& options, std::vector<GlitchRepair>& done) {
    const int n = track.count();
    // At 30 frames a second a punch and a tremble look alike.
    constexpr float k_slowest = 45;
    if (n < 12 || motion.fps < k_slowest) return;
    const std::vector<char> broken = trembling(tremble(track), options.jitter_deg * k_radians_per_degree);
    std::vector<Quat> rotations;
    for (int f = 0; f < n; ++f) rotations.push_back(track[f].rotation);
    for (int f = 2; f + 2 < n; ++f) {
        if (!broken[at(f)]) continue;
        GlitchRepair repair{Glitch::jitter, track.joint(), f, f, 0, 0};
        for (; f + 2 < n && broken[at(f)]; ++f) {
            repair.last = f;
            Transform value = track[f];
            constexpr int k_half = 5;
            value.rotation = smoothed(rotations, f, k_half);
            repair.degrees = std::max(repair.degrees, degrees(turn_between(track[f], value)));
            track.set(f, value);
        }
        done.push_back(repair);
    }
}

// --- toes

void mend_toes(Motion& motion, const Leg& leg, const CleanOptions& options, std::vector<GlitchRepair>& done) {
    if (leg.toes == k_no_joint) return;
    const int n = motion.frame_count(), parent = motion.skeleton->parents[at(leg.toes)];
    std::vector<Transform> world(at(motion.joint_count()));
    std::vector<float> depth(at(n), 0.0f);
    const auto tip_of = [&](int f) {
        world_pose(motion, f, world);
        return rotate(world[at(leg.toes)].rotation, leg.toe_tip);
    };
    for (int f = 0; f < n; ++f) {
        const Vec3 tip = tip_of(f);
        depth[at(f)] = options.floor - (world[at(leg.toes)].translation.y + tip.y);
    }
    for (int f = 0; f < n; ++f) {
        if (!(depth[at(f)] > 0)) continue;
        GlitchRepair repair{Glitch::toes, leg.toes, f, f, 0, 0};
        for (; repair.last + 1 < n && depth[at(repair.last + 1)] > 0; ++repair.last) {
        }
        for (int i = f; i <= repair.last; ++i) repair.metres = std::max(repair.metres, depth[at(i)]);
        f = repair.last;
        if (repair.metres < options.toes_m) continue;
        for (int i = repair.first; i <= repair.last; ++i) {
            const Quat bend = bend_toe_up(tip_of(i), depth[at(i)]);
            const Quat above = parent == k_no_joint ? Quat{} : world[at(parent)].rotation;
            motion.frame(i)[at(leg.toes)].rotation = normalized(conjugate(above) * bend * world[at(leg.toes)].rotation);
            repair.degrees = std::max(repair.degrees, degrees(rotation_angle(bend)));
        }
        done.push_back(repair);
    }
}

}  // namespace

std::vector<GlitchRepair> clean(Motion& motion, const CleanOptions& options) {
    std::vector<GlitchRepair> done;
    if (motion.frame_count() < 6) return done;
    std::vector<Track> tracks;
    tracks.reserve(at(motion.joint_count()));
    for (int j = 0; j < motion.joint_count(); ++j) tracks.emplace_back(motion, j);
    mend_dropped(motion, tracks, options, done);
    for (Track& track : tracks) {
        mend_spikes(motion, track, options, true, done);
        mend_spikes(motion, track, options, false, done);
        mend_flips(motion, track, options, done);
        mend_jitter(motion, track, options, done);
    }
    if (options.legs)
        for (const Leg& leg : options.legs->side) mend_toes(motion, leg, options, done);
    std::stable_sort(done.begin(), done.end(),
                     [](const GlitchRepair& a, const GlitchRepair& b) { return a.first < b.first; });
    return done;
}

std::string describe(const GlitchRepair& repair, const Skeleton& skeleton) {
    const auto number = [](float value, int decimals) {
        const float scale = decimals > 0 ? 10.0f : 1.0f;
        std::string text = std::to_string(static_cast<int>(value * scale + 0.5f));
        if (decimals == 0) return text;
        if (text.size() < 2) text.insert(0, 1, '0');
        return text.insert(text.size() - 1, 1, '.');
    };
    const std::string frames = repair.first == repair.last
                                   ? "frame " + std::to_string(repair.first)
                                   : "frames " + std::to_string(repair.first) + " to " + std::to_string(repair.last);
    const std::string joint = repair.joint == k_no_joint ? "all joints" : skeleton.names[at(repair.joint)];
    const std::string size = repair.degrees > 0.05f || !(repair.metres > 0) ? number(repair.degrees, 0) + " deg"
                                                                            : number(100 * repair.metres, 1) + " cm";
    switch (repair.kind) {
        case Glitch::dropped:
            return joint + ": " + frames + " dropped, filled in";
        case Glitch::spike:
            return joint + ": spike of " + size + " at " + frames;
        case Glitch::flip:
            return joint + ": flipped by " + size + " in " + frames;
        case Glitch::jitter:
            return joint + ": jitter of up to " + size + " smoothed in " + frames;
        case Glitch::toes:
            return joint + ": toe tip up to " + number(100 * repair.metres, 1) + " cm under the floor in " + frames;
    }
    return {};
}

}  // namespace surefoot
