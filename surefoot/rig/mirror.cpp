#include <surefoot/rig/mirror.h>

namespace surefoot {

void mirror_pose(const Skeleton& skeleton, const MirrorMap& map, std::span<const Transform> locals,
                 std::span<Transform> out, std::span<Transform> scratch) noexcept {
    const std::size_t count = skeleton.rest.size();
    const std::span<Transform> models = scratch.first(count), turned = scratch.subspan(count, count);
    local_to_model(skeleton, locals, models);
    for (std::size_t j = 0; j < count; ++j) {
        const auto partner = static_cast<std::size_t>(map.partner[j]);
        turned[j].rotation = normalized(reflected(models[partner].rotation) * map.correction[j]);
    }
    for (std::size_t j = 0; j < count; ++j) {
        const int parent = skeleton.parents[j];
        const auto partner = static_cast<std::size_t>(map.partner[j]);
        const bool below = parent != k_no_joint;
        const auto up = static_cast<std::size_t>(below ? parent : 0);
        out[j].rotation = normalized((below ? conjugate(turned[up].rotation) : Quat{}) * turned[j].rotation);
        const Quat back = below ? conjugate(map.correction[up]) : Quat{};
        const bool carries = map.carries[j] != 0;
        const Vec3 own = carries ? Vec3{} : skeleton.rest[j].translation;
        const Vec3 moved = locals[partner].translation - (carries ? Vec3{} : skeleton.rest[partner].translation);
        out[j].translation = own + rotate(back, reflected(moved));
    }
}

std::string problem(const MirrorMap& map, const Skeleton& skeleton) {
    const std::size_t count = skeleton.rest.size();
    if (map.partner.size() != count || map.correction.size() != count || map.carries.size() != count)
        return "the mirror map is of another skeleton";
    for (const std::int16_t partner : map.partner)
        if (partner < 0 || static_cast<std::size_t>(partner) >= count)
            return "the mirror map names a joint that is not there";
    return {};
}

}  // namespace surefoot
