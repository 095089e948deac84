#include <surefoot/mannequin/mannequin.h>
#include <surefoot/mannequin/sculpt.h>

#include <cassert>

namespace surefoot {

Mesh make_mannequin(const Skeleton& skeleton, const RoleMap& roles, const Legs& legs,
                    std::span<const Transform> bind_models) {
    assert(roles.has_legs() && bind_models.size() >= skeleton.parents.size());
    const Measures body(skeleton, roles, legs, bind_models);
    Cage cage;
    const Holes holes = add_trunk(cage, body);
    for (const Side side : {Side::left, Side::right}) {
        add_leg(cage, body, side, holes.leg[static_cast<std::size_t>(side)]);
        add_arm(cage, body, side, holes.arm[static_cast<std::size_t>(side)]);
    }
    Mesh mesh = subdivided(cage);
    for (const Side side : {Side::left, Side::right}) add_fingers(mesh, body, side);
    mesh.bind.assign(bind_models.begin(), bind_models.begin() + skeleton.joint_count());
    return mesh;
}

Mesh make_mannequin(const Skeleton& skeleton, const RoleMap& roles, const Legs& legs) {
    std::vector<Transform> rest(skeleton.rest.size());
    local_to_model(skeleton, skeleton.rest, rest);
    Mesh mesh = make_mannequin(skeleton, roles, legs, rest);
    mesh.bind.clear();
    return mesh;
}

Mesh make_mannequin(const Skeleton& skeleton, const RoleMap& roles, std::span<const Transform> standing_models) {
    return make_mannequin(skeleton, roles, make_legs(skeleton, roles, standing_models, 0), standing_models);
}

Mesh make_mannequin(const Motion& motion, const RoleMap& roles, const Legs& legs) {
    const int frame = mannequin_bind_frame(motion, roles);
    if (frame < 0) return make_mannequin(*motion.skeleton, roles, legs);
    std::vector<Transform> models(static_cast<std::size_t>(motion.joint_count()));
    local_to_model(*motion.skeleton, motion.frame(frame), models);
    return make_mannequin(*motion.skeleton, roles, legs, models);
}

}  // namespace surefoot
