#include <surefoot/synthetic/biped.h>

#include <fmt/format.h>

namespace surefoot {

Rig make_biped(float stature) { return make_rig("adult", std::vector{fmt::format("stature={}", stature)}); }

LegSize leg_size(const Rig& rig) noexcept {
    const auto offset = [&](Role role) {
        return rig.skeleton->rest[static_cast<std::size_t>(rig.roles[role])].translation;
    };
    const Leg& leg = rig.legs[Side::left];
    LegSize size;
    size.thigh = leg.upper_length;
    size.shank = leg.lower_length;
    size.hip_half_width = offset(Role::left_upper_leg).x;
    size.hip_drop = -offset(Role::left_upper_leg).y;
    size.ankle_height = -leg.heel.y;
    size.heel_back = -leg.heel.z;
    size.ball_ahead = leg.ball.z;
    size.toe_length = leg.toe_tip.z - (leg.toes == k_no_joint ? leg.ball.z : 0);
    return size;
}

}  // namespace surefoot
