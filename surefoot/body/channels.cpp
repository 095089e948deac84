#include <surefoot/body/channels.h>

#include <algorithm>
#include <iterator>

namespace surefoot {

namespace {

using C = BodyChannel;

struct Target {
    C channel;
    float weight = 1, reference = 0;
    bool both = false;  // a channel of the left side that stands for both
};
struct Row {
    std::string_view name;
    Target target;
};

// Controls of the whole body.
constexpr Row k_rows[] = {
    {"root.lateral", {C::root_lateral}},
    {"root.climb", {C::root_climb}},
    {"root.speed", {C::root_speed}},
    {"root.turn", {C::root_turn, k_degrees}},
    {"ground.slope", {C::ground_slope, k_degrees}},
    {"hips.tX", {C::hips_x}},
    {"hips.tY", {C::hip_y, 1, k_gait_hip_height, true}},
    {"hips.tZ", {C::hip_z, 1, 0, true}},
    {"hips.rX", {C::hips_rx}},
    {"hips.rY", {C::hips_ry}},
    {"hips.rZ", {C::hips_rz}},
    {"chest.tX", {C::chest_x}},
    {"chest.tY", {C::chest_y}},
    {"chest.tZ", {C::chest_z}},
    {"StY", {C::chest_y}},
    {"StZ", {C::chest_z}},
    {"CtY", {C::chest_y, -1}},
    {"CtZ", {C::chest_z, -1}},
    {"chest.rX", {C::chest_rx}},
    {"chest.rY", {C::chest_ry}},
    {"chest.rZ", {C::chest_rz}},
    {"head.rX", {C::head_rx}},
    {"head.rY", {C::head_ry}},
    {"head.rZ", {C::head_rz}},
};

// Controls of a side, by what follows `left_` and the paper's `Left`.
struct SidedRow {
    std::string_view name, paper;
    Target target;
};
constexpr SidedRow k_sided_rows[] = {
    {"hip.tY", "UpLeg.tY", {C::hip_y, 1, k_gait_hip_height}},
    {"hip.tZ", "UpLeg.tZ", {C::hip_z}},
    {"shoulder.tY", "Shoulder.tY", {C::shoulder_y}},
    {"shoulder.tZ", "Shoulder.tZ", {C::shoulder_z}},
    {"hand.tX", "Arm.tX", {C::hand_x}},
    {"hand.tY", "Arm.tY", {C::hand_y, 1, k_gait_wrist_height}},
    {"hand.tZ", "Arm.tZ", {C::hand_z}},
    {"hand.rX", "Arm.rX", {C::hand_rx}},
    {"hand.rY", "Arm.rY", {C::hand_ry}},
    {"hand.rZ", "Arm.rZ", {C::hand_rz}},
    {"hand.hold", "Arm.hold", {C::hand_hold}},
    {"elbow.out", "Elbow.out", {C::elbow_out}},
    {"knee.out", "Knee.out", {C::knee_out}},
    {"foot.tX", "Foot.tX", {C::foot_x}},
    {"foot.tY", "Foot.tY", {C::foot_y}},
    {"foot.tZ", "Foot.tZ", {C::foot_z}},
    {"foot.rX", "Foot.rX", {C::foot_rx}},
    {"foot.rY", "Foot.rY", {C::foot_ry}},
    {"foot.rZ", "Foot.rZ", {C::foot_rz}},
    {"foot.turned", "Foot.turned", {C::foot_turned}},
    {"foot.floor", "Foot.floor", {C::foot_floor}},
    {"toe.tY", "Toe.tY", {C::toe_y}},
    {"toe.rX", "Toe.rX", {C::toe_rx}},
};

constexpr std::string_view k_silent[] = {"f_pelvis", "f_spine", "ty",     "tz",     "Ftau",    "FtauR",   "FtauL",
                                         "AtauR",    "AtauL",   "StY_ik", "StZ_ik", "root.tX", "root.tY", "root.tZ"};

bool is_angle(C channel) {
    switch (channel) {
        case C::hips_rx:
        case C::hips_ry:
        case C::hips_rz:
        case C::chest_rx:
        case C::chest_ry:
        case C::chest_rz:
        case C::head_rx:
        case C::head_ry:
        case C::head_rz:
        case C::hand_rx:
        case C::hand_ry:
        case C::hand_rz:
        case C::elbow_out:
        case C::knee_out:
        case C::foot_rx:
        case C::foot_ry:
        case C::foot_rz:
        case C::foot_turned:
        case C::toe_rx:
            return true;
        default:
            return false;
    }
}

class Binder {
  public:
    explicit Binder(BodyBinding& binding) : binding_(binding) {}

    bool bind(std::size_t control, const ControlName& given) {
        for (const Row& row : k_rows)
            if (row.name == given.name) {
                add(control, given, row.target, Side::left);
                return true;
            }
        for (const Side side : {Side::left, Side::right}) {
            const std::string_view ours = side == Side::left ? "left_" : "right_";
            const std::string_view paper = side == Side::left ? "Left" : "Right";
            for (const SidedRow& row : k_sided_rows)
                if (is(given.name, ours, row.name) || is(given.name, paper, row.paper)) {
                    add(control, given, row.target, side);
                    return true;
                }
        }
        return std::find(std::begin(k_silent), std::end(k_silent), given.name) != std::end(k_silent);
    }

  private:
    static bool is(std::string_view name, std::string_view start, std::string_view rest) {
        return name.size() == start.size() + rest.size() && name.starts_with(start) && name.ends_with(rest);
    }
    void add(std::size_t control, const ControlName& given, const Target& target, Side side) {
        const float unit = is_angle(target.channel) && given.unit == "deg" ? k_degrees : 1.0f;
        for (const Side s : {Side::left, Side::right}) {
            if (s != side && !target.both) continue;
            binding_.terms.push_back({static_cast<std::uint16_t>(control),
                                      static_cast<std::uint16_t>(of_side(target.channel, s)), unit * target.weight,
                                      target.reference});
        }
    }

    BodyBinding& binding_;
};

float scale_of(const BodyScale& scale, int channel) noexcept {
    const int left = channel < k_first_sided_channel + k_sided_channels ? channel : channel - k_sided_channels;
    switch (static_cast<C>(left)) {
        case C::root_lateral:
        case C::root_climb:
        case C::root_speed:
            return scale.speed();
        case C::root_turn:
            return 1 / scale.time;
        case C::ground_slope:
        case C::hand_hold:
            return 1;
        case C::hand_x:
        case C::hand_y:
        case C::hand_z:
            return scale.arm;
        default:
            return is_angle(static_cast<C>(left)) ? 1 : scale.leg;
    }
}

}  // namespace

BodyBinding bind_controls(std::span<const ControlName> controls) {
    BodyBinding binding;
    Binder binder(binding);
    for (std::size_t i = 0; i < controls.size(); ++i)
        if (!binder.bind(i, controls[i])) binding.unknown.emplace_back(controls[i].name);
    return binding;
}

void apply(const BodyBinding& binding, const BodyScale& scale, std::span<const float> outputs,
           std::span<float> channels) noexcept {
    constexpr float k_most = 1000;  // beyond that nothing is a length, an angle or a speed
    std::fill(channels.begin(), channels.end(), 0.0f);
    for (const BodyTerm& term : binding.terms) {
        const float weight = term.weight * scale_of(scale, term.channel);
        const float* from = outputs.data() + 8 * std::size_t{term.control};
        float* to = channels.data() + 8 * std::size_t{term.channel};
        for (int lane = 0; lane < 8; ++lane) to[lane] += (from[lane] - term.reference) * weight;
    }
    for (float& channel : channels) channel = channel < -k_most ? -k_most : channel > k_most ? k_most : channel;
}

}  // namespace surefoot
