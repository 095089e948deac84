#pragma once
// Retargeting measured clips: what motion/retarget.h needs of a character is found in its clips.

#include <surefoot/analysis/analyze.h>
#include <surefoot/analysis/footing.h>
#include <surefoot/io/load.h>
#include <surefoot/motion/retarget.h>

#include <span>
#include <string>

namespace surefoot {

/// Someone whom clips can be put onto, or taken from.
struct Actor {
    RetargetBody body;
    RoleReport roles;
    std::string name;  ///< the file it was seen in, for messages
};

/// The character that moves in a clip. Its shape is the rest pose where that agrees with how the clip turns the joints,
/// else the frame with the straightest limbs (mannequin/mannequin.h).
Actor actor_of(const AnalyzedClip& clip);

/// The same from several clips of one character: the one that stands or goes slowest shows best how its feet lie flat.
/// Needs at least one.
Actor actor_of(std::span<const AnalyzedClip* const> clips);

/// The character of loaded clips: of the first one, as seen in all that share its skeleton. Needs at least one; throws
/// Error as analyze_clip does.
Actor actor_in(std::span<const LoadedClip> clips, const RoleOverrides& overrides = {});

/// Moves a clip up or down so that the soles of `body` stand on y = 0; by less than 1.5 cm it is left alone. `footing`
/// is what the clip itself shows (analysis/footing.h): its floor holds where its soles are the body's.
void bring_to_ground(Motion& motion, const RetargetBody& body, const Footing& footing);

/// The clip of `source` on another character, measured anew: facts, roles, legs and motion are those of the result; its
/// source and what the clip was found to be (in place, locomotion, its seam before closing) stay. A cycle that was
/// named after its speed is named after its new one. Throws Error (motion/retarget.h).
AnalyzedClip retargeted(const AnalyzedClip& clip, const Actor& source, const Actor& target,
                        RetargetReport* report = nullptr);

}  // namespace surefoot
