#pragma once
// Other libraries, and ours, on one piece of work: a crowd of the synthetic hero, three clips mixed by weights that
// change every frame, and a 3x4 matrix in model space for each joint, written where the host wants it.

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "../stage.h"

namespace surefoot::bench {

inline constexpr std::size_t k_mixed = 3;  ///< clips that play at once

/// What is to be played, as full floats: nobody gains or loses by our 16-bit keys.
struct PeerHero {
    std::shared_ptr<const Skeleton> skeleton;
    std::array<PackedClip, k_mixed> clips;  ///< one second each, so that one time serves all of them

    static PeerHero make();
    std::size_t joints() const { return skeleton->rest.size(); }
    int frames() const { return clips[0].frame_count; }
    float seconds(int frame) const { return static_cast<float>(frame) / clips[0].fps; }
    Quat rotation(std::size_t clip, int frame, std::size_t joint) const;
    Vec3 translation(std::size_t clip, int frame, std::size_t joint) const;
};

/// Where in their cycle a character's clips are, and how they are mixed.
struct Moment {
    float seconds = 0;                     ///< in [0, 1)
    std::array<float, k_mixed> weights{};  ///< their sum is 1
};
/// Never at rest and never twice the same; no two characters are alike.
Moment moment(std::size_t character, int frame);

class Peer {
  public:
    virtual ~Peer() = default;
    /// All characters at their moments of a frame; `matrices` has one for each character and joint.
    virtual void play(int frame, std::span<Matrix34> matrices) = 0;
    /// The first character at a moment, for comparison.
    virtual void pose(const Moment& moment, std::span<Matrix34> matrices) = 0;
};

using MakePeer = std::unique_ptr<Peer> (*)(const PeerHero&, std::size_t characters);
std::unique_ptr<Peer> make_surefoot_peer(const PeerHero& hero, std::size_t characters);
std::unique_ptr<Peer> make_ogre_peer(const PeerHero& hero, std::size_t characters);
std::unique_ptr<Peer> make_cal3d_peer(const PeerHero& hero, std::size_t characters);
std::unique_ptr<Peer> make_osg_peer(const PeerHero& hero, std::size_t characters);

/// For libraries that play one character after another: `Character` has pose(moment, matrices).
template <class Character>
class OneByOne : public Peer {
  public:
    std::vector<std::unique_ptr<Character>> characters;

    void play(int frame, std::span<Matrix34> matrices) override {
        const std::size_t joints = matrices.size() / characters.size();
        for (std::size_t c = 0; c < characters.size(); ++c)
            characters[c]->pose(moment(c, frame), matrices.subspan(c * joints, joints));
    }
    void pose(const Moment& at, std::span<Matrix34> matrices) override { characters[0]->pose(at, matrices); }
};

}  // namespace surefoot::bench
