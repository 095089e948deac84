#include <surefoot/io/unit_scale.h>

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace surefoot {

namespace {

constexpr int k_frames_looked_at = 10;
constexpr double k_usual_height = 1.7;  // metres

/// Largest side of the box around all joints and tips.
float extent(const Skeleton& skeleton, std::span<const Transform> models) {
    Vec3 low = models[0].translation, high = low;
    const auto include = [&](Vec3 p) {
        low = {std::fmin(low.x, p.x), std::fmin(low.y, p.y), std::fmin(low.z, p.z)};
        high = {std::fmax(high.x, p.x), std::fmax(high.y, p.y), std::fmax(high.z, p.z)};
    };
    for (std::size_t j = 0; j < models.size(); ++j) {
        include(models[j].translation);
        include(transform_point(models[j], skeleton.tips[j]));
    }
    const Vec3 size = high - low;
    return std::fmax(size.x, std::fmax(size.y, size.z));
}

}  // namespace

UnitGuess guess_unit_scale(const Motion& motion) {
    std::vector<Transform> models(static_cast<std::size_t>(motion.joint_count()));
    std::vector<float> extents;
    for (int f = 0; f < std::min(motion.frame_count(), k_frames_looked_at); ++f) {
        local_to_model(*motion.skeleton, motion.frame(f), models);
        extents.push_back(extent(*motion.skeleton, models));
    }
    std::sort(extents.begin(), extents.end());
    const double size = static_cast<double>(extents[extents.size() / 2]);  // one dropped frame does not decide
    if (size >= 0.5 && size <= 3) return {1, ""};
    if (size >= 50 && size <= 300) return {0.01, ""};
    if (size >= 500 && size <= 3000)
        return {0.001, fmt::format("the character is {:.0f} units tall: taken for millimetres", size)};
    if (!(size > 1e-6) || !std::isfinite(size))
        return {1, "the character has no size to guess its unit from: taken for metres"};
    const double scale = k_usual_height / size;
    return {scale,
            fmt::format("the character is {:.4g} units tall, neither metres nor centimetres: scaled by {:.6g} to "
                        "{} m (give the scale to decide otherwise)",
                        size, scale, k_usual_height)};
}

void scale_motion(Motion& motion, double scale) {
    if (scale == 1) return;
    const float s = static_cast<float>(scale);
    Skeleton scaled = *motion.skeleton;
    for (Transform& t : scaled.rest) t.translation *= s;
    for (Vec3& tip : scaled.tips) tip *= s;
    for (RootFrame& root : motion.root) root.position *= s;
    for (Transform& t : motion.locals) t.translation *= s;
    motion.skeleton = std::make_shared<const Skeleton>(std::move(scaled));
}

UnitGuess apply_unit_scale(std::span<Motion* const> motions, double option) {
    UnitGuess unit{option, ""};
    if (motions.empty()) return unit;
    if (!(option > 0)) unit = guess_unit_scale(*motions.front());
    for (Motion* motion : motions) {
        scale_motion(*motion, unit.scale);
        motion->skeleton = motions.front()->skeleton;
    }
    return unit;
}

}  // namespace surefoot
