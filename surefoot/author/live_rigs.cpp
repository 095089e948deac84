#include <surefoot/author/fitted_gaits.h>
#include <surefoot/author/gait_file.h>
#include <surefoot/author/live_rigs.h>
#include <surefoot/base/error.h>
#include <surefoot/fit/derive.h>
#include <surefoot/host/files.h>

#include <filesystem>
#include <utility>
#include <vector>

namespace surefoot {

namespace {

std::shared_ptr<const HarmonicGait> shared_gait(HarmonicGait gait) {
    return std::make_shared<const HarmonicGait>(std::move(gait));
}

bool steps(const HarmonicGait& gait) {
    return gait.legs.count > 0 && (gait.family() || length(rhythm_of(gait, gait.coefficients).velocity) > 0);
}

}  // namespace

HarmonicGait as_played_live(const HarmonicGait& gait) {
    const bool can_be_held = gait.foot_hold == 0 && gait.basis.climb == 0 && steps(gait);
    return can_be_held ? holding_feet(gait) : gait;
}

LiveRig live_rig_of(const HarmonicGait& gait, GaitCompany company, const std::string& name, const GaitStyle& style) {
    const auto manner = [&](const HarmonicGait& plain) {
        return shared_gait(as_played_live(with_style(plain, style)));
    };
    std::vector<LiveManner> manners{{gait.name, manner(gait), nullptr}};
    std::shared_ptr<const HarmonicGait> idle;
    if (company == GaitCompany::bundled) {
        if (gait.name == "human") manners.push_back({"crouch", manner(fitted_gait("crouch")), nullptr});
        if (gait.name != "idle") idle = shared_gait(fitted_gait("idle"));
    }
    LiveRig rig = make_live_rig(std::move(manners), std::move(idle));
    if (const std::string wrong = problem(rig); !wrong.empty())
        throw Error("the gait cannot be played live: " + wrong, name, "fit one from clips with two legs");
    return rig;
}

LiveRig read_live_rig(const std::string& name) {
    if (!std::filesystem::is_regular_file(name)) return live_rig_of(fitted_gait(name), GaitCompany::bundled, name);
    return live_rig_of(gait_from_json(read_file(name), name), GaitCompany::alone, name);
}

}  // namespace surefoot
