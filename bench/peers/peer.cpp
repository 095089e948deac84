#include "peer.h"

#include <surefoot/clip/sample.h>

namespace surefoot::bench {

PeerHero PeerHero::make() {
    PeerHero hero{make_skeleton(), {}};
    for (std::size_t c = 0; c < k_mixed; ++c) hero.clips[c] = make_clip(*hero.skeleton, c + 1, {}, 0, 1);
    return hero;
}

Quat PeerHero::rotation(std::size_t clip, int frame, std::size_t joint) const {
    const PackedClip& from = clips[clip];
    const std::size_t block = static_cast<std::size_t>(frame * from.block_count()) + joint / k_lanes;
    const std::int16_t* at = from.rotations.data() + block * 4 * k_lanes + joint % k_lanes;
    return normalized(Quat{static_cast<float>(at[0]), static_cast<float>(at[k_lanes]),
                           static_cast<float>(at[2 * k_lanes]), static_cast<float>(at[3 * k_lanes])});
}

Vec3 PeerHero::translation(std::size_t clip, int frame, std::size_t joint) const {
    return joint == 0 ? clips[clip].translations[static_cast<std::size_t>(frame)] : skeleton->rest[joint].translation;
}

Moment moment(std::size_t character, int frame) {
    const float t = static_cast<float>(frame) / 60 + 0.137f * static_cast<float>(character % 97);
    const float a = 1 + sin(0.7f * t), b = 1 + sin(1.1f * t + 2), c = 1 + sin(0.9f * t + 4);
    const float sum = a + b + c;
    return {t - std::floor(t), {a / sum, b / sum, c / sum}};
}

namespace {

/// The parts of the runtime that do this work: sample and blend, then local to model eight at a time.
class SurefootPeer : public Peer {
  public:
    SurefootPeer(const PeerHero& hero, std::size_t characters)
        : hero_(hero),
          characters_(characters),
          locals_(k_lanes * hero.joints()),
          idle_(k_lanes * hero.joints()),
          scratch_(model_scratch_floats(static_cast<int>(hero.joints()))) {}

    void play(int frame, std::span<Matrix34> matrices) override {
        for (std::size_t first = 0; first < characters_; first += k_lanes) {
            const std::size_t count = std::min<std::size_t>(k_lanes, characters_ - first);
            for (std::size_t c = 0; c < count; ++c) sample(moment(first + c, frame), c);
            to_model(count, matrices.subspan(first * hero_.joints()));
        }
    }
    void pose(const Moment& at, std::span<Matrix34> matrices) override {
        sample(at, 0);
        to_model(1, matrices);
    }

  private:
    void sample(const Moment& at, std::size_t lane) {
        std::array<Leaf, k_mixed> leaves;
        for (std::size_t i = 0; i < k_mixed; ++i) leaves[i] = {static_cast<std::int32_t>(i), at.seconds, at.weights[i]};
        sample_pose(*hero_.skeleton, hero_.clips, leaves,
                    std::span(locals_).subspan(lane * hero_.joints(), hero_.joints()));
    }
    void to_model(std::size_t count, std::span<Matrix34> matrices) {
        const Transform* in[k_lanes];
        Matrix34* out[k_lanes];
        for (std::size_t c = 0; c < k_lanes; ++c) {
            in[c] = locals_.data() + std::min(c, count - 1) * hero_.joints();
            out[c] = (c < count ? matrices.data() : idle_.data()) + c * hero_.joints();
        }
        local_to_model_8(*hero_.skeleton, in, out, scratch_.data());
    }

    const PeerHero& hero_;
    std::size_t characters_;
    std::vector<Transform> locals_;
    std::vector<Matrix34> idle_;
    std::vector<float> scratch_;
};

}  // namespace

std::unique_ptr<Peer> make_surefoot_peer(const PeerHero& hero, std::size_t characters) {
    return std::make_unique<SurefootPeer>(hero, characters);
}

}  // namespace surefoot::bench
