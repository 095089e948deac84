#pragma once
// Packs: a character and all that it can do, in one file that a game reads into memory, embeds or maps.
//
//     std::string why;
//     const std::optional<Pack> pack = Pack::open(bytes, &why);       // checks everything, once
//     if (!pack) return report(why);
//     LocomotionFrame f = update(pack->graph(), state, request, dt);  // of a project: graph/locomotion.h
//     update(pack->program, state, input, scratch, frame);            // of a graph: program/evaluate.h
//
// `surefoot bake` writes them. A pack stores definitions: skeleton, clips, blend spaces, nodes, gaits. Keyframes are
// not copied: the pack points into the bytes, which have to stay where they are for as long as it or a copy of it
// lives. What can be made from definitions (velocities of samples, state layouts, lanes of live gaits) is made again
// when the pack is opened, by the functions that made it when it was baked: what plays is the same to the bit.
//
// docs/packs.md has the format and what its versions promise.

#include <surefoot/program/program.h>
#include <surefoot/rig/roles.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace surefoot {

/// What this library writes, and all that it reads: packs are made anew from their sources, not carried along.
inline constexpr std::uint32_t k_pack_version = 2;
/// Of the bytes given to `open`: the least, and what a game should give so that keyframes lie in whole cache lines.
inline constexpr std::size_t k_least_pack_alignment = 4, k_pack_alignment = 64;

inline constexpr std::size_t k_max_pack_gaits = 64;  ///< live ones of a graph

struct Pack {
    /// Of a project it has no nodes, and its body plays by itself (`graph`).
    Program program;
    RoleMap roles;
    Legs legs;
    std::vector<Transform> standing;  ///< model space: the pose that `legs` was made from
    float hip_height = 0;             ///< [m] of the standing character

    const LocomotionGraph& graph() const noexcept { return program.body; }
    const Skeleton& skeleton() const noexcept { return *program.body.skeleton; }
    bool has_program() const noexcept { return !program.nodes.empty(); }
    /// Index of the clip of that name in graph().clips, or -1.
    int clip(std::string_view name) const noexcept;

    /// Nothing, and in `problem` what is wrong, at which byte and what to do, where the bytes are no sound pack:
    /// whatever they are, nothing crashes or hangs, and time and memory stay in proportion to their size. Allocates;
    /// what plays afterwards does not.
    static std::optional<Pack> open(std::span<const std::byte> bytes, std::string* problem = nullptr);
};

/// What is wrong with a pack, as a sentence; empty: nothing, and then neither update nor pose of it can fail.
std::string problem(const Pack& pack);

/// What takes how much of a pack.
struct PackPart {
    const char* name = "";  ///< "skeleton", "clips" (keyframes included), "spaces", "gaits", "nodes"
    std::size_t bytes = 0;
};

/// A pack as bytes: the same pack, the same bytes. A multiple of k_pack_alignment; `parts`, where it is asked for, says
/// what takes how much. Needs a pack without `problem`, whose live gaits have no footfall patterns of the host's own.
std::vector<std::byte> pack_bytes(const Pack& pack, std::vector<PackPart>* parts = nullptr);

}  // namespace surefoot
