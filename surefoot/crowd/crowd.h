#pragma once
// Many characters of one kind: they share a LocomotionGraph, and each owns a state of 248 bytes, a wish and a root.
//
// The caller owns every array, and the threads. A frame is `evaluate` over ranges that cover the crowd, in any order,
// from any threads, each with a scratch of its own:
//
//     CrowdScratch scratch(graph);                                       // one a thread
//     Crowd crowd{.states = states, .wishes = wishes, .roots = roots, .matrices = matrices};
//     evaluate(graph, crowd, {0, 512}, dt, scratch);  evaluate(graph, crowd, {512, 488}, dt, scratch);
//
// What comes out does not depend on how the crowd is cut into ranges, to the bit. Saving and rolling back is copying
// states, roots and the frame number. Characters are posed eight at a time, those that are due in a frame side by side,
// whatever each of them does. Nothing here allocates but CrowdScratch's constructor, and nothing fails.
//
// On uneven ground feet are laid by crowd_feet.h if there is room for `feet`; roots then go up and down with the
// ground. Who is looked at closely asks for `locals`, places feet by ik/foot_placement.h and calls local_to_model_8
// itself.

#include <surefoot/crowd/crowd_feet.h>
#include <surefoot/graph/locomotion.h>

#include <cstdint>
#include <span>
#include <vector>

namespace surefoot {

/// The arrays of a crowd of N characters with J joints.
struct Crowd {
    std::span<LocomotionState> states;          ///< N
    std::span<const LocomotionRequest> wishes;  ///< N
    std::span<RootFrame> roots;                 ///< N, world; moved on by each frame
    /// N, or empty: all 1. How many frames a pose lasts (0 is 1): the far away need not be posed in every one. States
    /// and roots go on in each frame, and those of one period take turns, so that each frame costs alike.
    std::span<const std::uint8_t> periods{};
    std::uint32_t frame = 0;                   ///< counted up by the host; in frame 0 everybody is posed
    std::span<Transform> locals{};             ///< N * J, or empty: local poses
    std::span<Matrix34> matrices{};            ///< N * J, or empty: in model space, or for skinning
    std::span<const Matrix34> inverse_bind{};  ///< J, or empty: matrices become model * inverse bind, for skinning
    /// The ground, asked for eight characters at once, and N feet; null or empty: the ground is level. Feet go on when
    /// their character is posed. Nothing is laid where the graph does not know legs or footprints.
    const Ground* ground = nullptr;
    std::span<CrowdFeet> feet{};
    CrowdFeetSettings feet_settings{};
};

struct CrowdRange {
    std::size_t first = 0, count = 0;
};

/// Working memory of one thread, for crowds of one graph.
class CrowdScratch {
  public:
    explicit CrowdScratch(const LocomotionGraph& graph);

  private:
    friend class CrowdLanes;
    LegChains legs_;
    std::vector<LocomotionFrame> frames_;  // of eight
    std::vector<Transform> locals_;        // of eight
    std::vector<Matrix34> idle_;           // where idle lanes write
    std::vector<float> models_;
};

/// True if a character is posed in a frame.
bool is_due(const Crowd& crowd, std::size_t character) noexcept;

/// One frame of a range: states and roots move on by `dt` >= 0 seconds, and who is due gets the outputs that there is
/// room for. With neither locals nor matrices only roots move, at the cost of `update`.
/// [Limit: the range lies within the crowd; the graph has no `problem`; the scratch is for it]
void evaluate(const LocomotionGraph& graph, const Crowd& crowd, CrowdRange range, float dt,
              CrowdScratch& scratch) noexcept;

}  // namespace surefoot
