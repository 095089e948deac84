#include <surefoot/base/error.h>
#include <surefoot/course/path.h>
#include <surefoot/graph/locomotion.h>
#include <surefoot/math/trig.h>

#include <algorithm>
#include <utility>

namespace surefoot {

const std::vector<std::string>& path_names() {
    static const std::vector<std::string> names{"straight", "curve", "eight", "start-stop", "turns", "host-turns"};
    return names;
}

std::vector<PathLeg> walk_path(const std::string& name, float seconds, float turn) {
    constexpr float k_turn = 30, k_circle = 360 / k_turn, k_bend = 1.5f;  // [deg/s], [s], [s]
    if (name == "straight") return {{true, turn, seconds}};
    std::vector<PathLeg> legs;
    if (name == "curve") legs = {{true, k_turn, k_bend}, {true, -k_turn, 2 * k_bend}, {true, k_turn, k_bend}};
    if (name == "eight") legs = {{true, k_turn, k_circle}, {true, -k_turn, k_circle}};
    if (name == "start-stop") legs = {{false, 0, 1}, {true, turn, 3}, {false, 0, 2.5f}};
    if (name == "turns")
        legs = {{true, turn, 3}, {false, 0, 2}, {false, 60, 3}, {false, 0, 1.5f}, {false, -45, 4}, {false, 0, 1.5f}};
    if (name == "host-turns") {
        const PathLeg stand{false, 0, 1.5f};
        const auto host = [](float turn, float slide) { return PathLeg{false, 0, 2, turn, slide}; };
        legs = {{true, turn, 3}, {false, 0, 2},  host(90, 0), stand,           host(-45, 0), host(-45, 0),
                stand,           host(0, 0.25f), stand,       host(0, -0.25f), stand};
    }
    if (legs.empty())
        throw Error("there is no path '" + name + "'", "--path",
                    "walk straight, curve, eight, start-stop, turns or host-turns");
    std::vector<PathLeg> all;
    float whole = 0;
    for (const PathLeg& leg : legs) whole += leg.seconds;
    for (float done = 0; done < seconds; done += whole) all.insert(all.end(), legs.begin(), legs.end());
    return all;
}

Steering::Steering(std::vector<PathLeg> legs) : legs_(std::move(legs)) {
    if (legs_.empty()) legs_.push_back({});
}

float Steering::speed(float asked) const noexcept {
    return legs_[at_].goes ? std::clamp(asked, -limit_, limit_) : 0.0f;
}

RootFrame HostWay::in(float seconds) const noexcept {
    return integrate({slide, 0, 0}, turn * k_radians_per_degree, seconds);
}

bool Steering::has_host() const noexcept {
    return std::any_of(legs_.begin(), legs_.end(),
                       [](const PathLeg& leg) { return leg.host_turn != 0 || leg.host_slide != 0; });
}

void Steering::take_over(float turn) noexcept {
    at_ = legs_.size() - 1;
    legs_[at_].goes = true;
    legs_[at_].turn = turn;
}

void Steering::advance(float dt) noexcept {
    constexpr float k_rounding = 1e-4f;  // [s]
    if (at_ + 1 < legs_.size() && spent_ >= legs_[at_].seconds - k_rounding) {
        ++at_;
        spent_ = 0;
    }
    spent_ += dt;
}

}  // namespace surefoot
