#pragma once
// Measuring clips: what a clip does (analyze_clip) and which loops a long take holds (find_cycles).
//
//     AnalyzedClip walk = analyze_clip(read_bvh(text, "walk.bvh"), "walk.bvh", 0.01f);
//     if (!walk.facts.cyclic) cycles = find_cycles(walk);
//
// Frames and units: see motion/motion.h; facts are in SI units with degrees (clip_facts.h). Both functions depend on
// nothing but their arguments and may run on many clips at once.

#include <surefoot/analysis/clip_facts.h>
#include <surefoot/motion/motion.h>

namespace surefoot {

/// A clip ready for a blend space.
struct AnalyzedClip {
    /// Root motion extracted (made from the stance feet where the file is in place), ground at y = 0, frames that the
    /// capture dropped repaired or cut off. Same frame rate as the input.
    Motion motion;
    RoleReport roles;
    Legs legs;  ///< soles measured where the feet stand flat
    ClipFacts facts;
    std::string source;                     ///< the file it comes from, as `facts.file`
    int source_first = 0, source_last = 0;  ///< frames of the source that it was cut from
};

/// Measures one clip. `unit_scale` is only recorded: the motion is in metres already. Throws Error where the motion is
/// unsound or the skeleton has no legs (the text says which roles are missing). Costs time linear in the frames.
AnalyzedClip analyze_clip(Motion motion, const std::string& file, float unit_scale = 1,
                          const RoleOverrides& overrides = {});

/// The steady cycles of a take, best-looping first among equals, sorted by speed, then turn: each cut from one left
/// foot strike to a later one, its seam closed, named after what it does ("walk_1.40mps", "turn_left_90"), measured
/// anew. Where the actor stands, an "idle" is cut. A take that is one cycle already comes back closed; one that holds
/// none gives an empty list. Costs time linear in the frames.
std::vector<AnalyzedClip> find_cycles(const AnalyzedClip& take);

inline constexpr float k_most_stride_closing = 0.12f;  ///< [m]

/// Every stride of a take (left foot strike to left foot strike, one right strike between) as a closed cycle, in order
/// of time, steady or not: material for averages over many of them, not to be played. Those are left out that closing
/// would move by more than `most_closing` [m]. A take that is a cycle already comes back as it is.
std::vector<AnalyzedClip> find_strides(const AnalyzedClip& take, float most_closing = k_most_stride_closing);

}  // namespace surefoot
