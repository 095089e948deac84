#include <surefoot/probe/steady_play.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace surefoot {
namespace {

constexpr float k_fps = 60;
constexpr int k_margin = 15;                    // frames: ten times the smoothing before derivatives
constexpr float k_shortest = 0.6f;              // [s] less is no measure of a foot
constexpr float k_longest = 8;                  // [s] a cycle that takes longer is measured in part
constexpr float k_stand = 2, k_stand_most = 6;  // [s] of clips without steps
constexpr float k_search_step = 1 / 240.0f;     // [s]
constexpr int k_most_cycles = 4;                // clips of more different numbers of cycles never meet: a part must do

float period_of(const PackedClip& clip) { return clip.duration() * (clip.cyclic ? 1.0f : 2.0f); }

/// Cycles after which the leaves are as they were.
int cycles_of(const LocomotionGraph& graph, std::span<const Leaf> leaves) {
    int cycles = 1;
    for (const Leaf& leaf : leaves)
        if (const int own = graph.clips[static_cast<std::size_t>(leaf.clip)].cycles; own > 0)
            cycles = std::lcm(cycles, own);
    return std::min(cycles, k_most_cycles);
}

/// Time of standing clips: once there (and back).
float standing_time(const LocomotionGraph& graph, std::span<const Leaf> leaves) {
    float time = k_stand;
    for (const Leaf& leaf : leaves) time = std::max(time, period_of(graph.clips[static_cast<std::size_t>(leaf.clip)]));
    return std::min(time, k_stand_most);
}

/// Seconds for `cycles` cycles from phase 0; 0 where the phase does not get that far in k_longest.
float time_for(const LocomotionGraph& graph, const LocomotionRequest& request, int cycles) {
    LocomotionState state;
    float time = 0, before = 0;
    while (time < k_longest) {
        update(graph, state, request, k_search_step);
        time += k_search_step;
        const float phase = static_cast<float>(static_cast<std::int32_t>(state.cycle)) + state.phase;
        if (phase >= static_cast<float>(cycles))
            return time - k_search_step * (phase - static_cast<float>(cycles)) / (phase - before);
        before = phase;
    }
    return 0;
}

/// An empty recording of `seconds` with its margins; the rate is such that they are a whole number of frames.
SteadyPlay blank(const Character& character, float seconds) {
    SteadyPlay play;
    const int frames = std::max(1, static_cast<int>(seconds * k_fps + 0.5f));
    play.first = k_margin;
    play.last = k_margin + frames;
    play.motion.skeleton = character.skeleton;
    play.motion.fps = static_cast<float>(frames) / seconds;
    const auto count = static_cast<std::size_t>(play.last + k_margin + 1);
    play.motion.root.resize(count);
    play.motion.locals.resize(count * static_cast<std::size_t>(character.skeleton->joint_count()));
    return play;
}

void note_leaves(SteadyPlay& play, std::span<const Leaf> leaves) {
    play.leaves.assign(leaves.begin(), leaves.end());
    std::stable_sort(play.leaves.begin(), play.leaves.end(), [](const Leaf& a, const Leaf& b) {
        return a.weight > b.weight || (a.weight == b.weight && a.clip < b.clip);
    });
}

}  // namespace

SteadyPlay play_request(const Character& character, const LocomotionRequest& request) {
    const LocomotionGraph& graph = character.graph;
    LocomotionState state;
    LocomotionFrame frame = update(graph, state, request, 0);
    if (frame.clamped) {
        SteadyPlay play;
        play.clamped = true;
        return play;
    }
    float seconds = standing_time(graph, frame.leaves());
    if (frame.stepping) {
        const float time = time_for(graph, request, cycles_of(graph, frame.leaves()));
        if (time > 0) seconds = time * std::max(1.0f, std::ceil(k_shortest / time));
    }
    SteadyPlay play = blank(character, seconds);
    note_leaves(play, frame.leaves());
    play.velocity = frame.velocity;
    play.turn = frame.turn;
    RootFrame root;
    for (int f = 0; f < play.motion.frame_count(); ++f) {
        if (f > 0) frame = update(graph, state, request, 1 / play.motion.fps);
        root = root * frame.root_delta;
        play.motion.root[static_cast<std::size_t>(f)] = root;
        pose(graph, frame, play.motion.frame(f));
    }
    return play;
}

SteadyPlay play_clip(const Character& character, int clip) {
    const PackedClip& packed = character.graph.clips[static_cast<std::size_t>(clip)];
    const float own = period_of(packed);
    const float seconds = packed.cycles > 0 ? own * std::max(1.0f, std::ceil(k_shortest / own))
                                            : std::min(std::max(own, k_stand), k_stand_most);
    SteadyPlay play = blank(character, seconds);
    play.velocity = packed.velocity;
    play.turn = packed.turn_rate * k_degrees_per_radian;
    Leaf leaf{clip, 0, 1};
    note_leaves(play, {&leaf, 1});
    for (int f = 0; f < play.motion.frame_count(); ++f) {
        const float now = static_cast<float>(f - play.first) / play.motion.fps;
        const float within = now - std::floor(now / own) * own;
        leaf.time = within <= packed.duration() ? within : own - within;
        play.motion.root[static_cast<std::size_t>(f)] = integrate(packed.velocity, packed.turn_rate, now);
        sample_pose(*character.skeleton, character.graph.clips, {&leaf, 1}, play.motion.frame(f));
    }
    return play;
}

}  // namespace surefoot
