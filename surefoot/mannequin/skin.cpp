#include <surefoot/mannequin/skin.h>

#include <algorithm>

namespace surefoot {

SkinWeights SkinWeights::rigid(int joint) noexcept { return {{static_cast<std::uint16_t>(joint)}, {1, 0, 0, 0}}; }

SkinWeights SkinWeights::mix(const SkinWeights& a, const SkinWeights& b, float share) noexcept {
    SkinSum sum;
    sum.add(a, 1 - share);
    sum.add(b, share);
    return sum.result();
}

void SkinSum::add(const SkinWeights& skin, float share) noexcept {
    for (std::size_t i = 0; i < 4; ++i)
        if (const float weight = skin.weights[i] * share; weight > 0) add(skin.joints[i], weight);
}

void SkinSum::add(std::uint16_t joint, float weight) noexcept {
    for (std::size_t k = 0; k < count_; ++k)
        if (joints_[k] == joint) {
            weights_[k] += weight;
            return;
        }
    if (count_ == joints_.size()) return;
    joints_[count_] = joint;
    weights_[count_++] = weight;
}

SkinWeights SkinSum::result() const noexcept {
    SkinWeights out{{}, {0, 0, 0, 0}};
    std::array<bool, k_most> taken{};
    float sum = 0;
    for (std::size_t i = 0; i < std::min<std::size_t>(count_, 4); ++i) {
        std::size_t best = k_most;
        for (std::size_t k = 0; k < count_; ++k)
            if (!taken[k] && (best == k_most || weights_[k] > weights_[best])) best = k;
        taken[best] = true;
        out.joints[i] = joints_[best];
        out.weights[i] = weights_[best];
        sum += weights_[best];
    }
    for (float& weight : out.weights) weight = sum > 0 ? weight / sum : 0;
    return out;
}

SkinWeights SkinChain::at(float place) const noexcept {
    SkinWeights skin = SkinWeights::rigid(links.front().joint);
    for (std::size_t i = 1; i < links.size(); ++i) {
        const Link& link = links[i];
        const float t = link.reach > 0 ? std::clamp(0.5f + 0.5f * (place - link.place) / link.reach, 0.0f, 1.0f)
                                       : (place >= link.place ? 1.0f : 0.0f);
        skin = SkinWeights::mix(skin, SkinWeights::rigid(link.joint), t * t * (3 - 2 * t));
    }
    return skin;
}

}  // namespace surefoot
