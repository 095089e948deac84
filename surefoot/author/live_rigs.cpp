#include <surefoot/author/fitted_gaits.h>
#include <surefoot/author/gait_file.h>
#include <surefoot/author/live_rigs.h>
#include <surefoot/base/error.h>
#include <surefoot/host/files.h>

#include <filesystem>
#include <utility>
#include <vector>

namespace surefoot {

namespace {

std::shared_ptr<const HarmonicGait> shared_gait(HarmonicGait gait) {
    return std::make_shared<const HarmonicGait>(std::move(gait));
}

}  // namespace

LiveRig bundled_live_rig(std::shared_ptr<const HarmonicGait> gait) {
    std::vector<LiveManner> manners{{gait->name, gait, nullptr}};
    if (gait->name == "human") manners.push_back({"crouch", shared_gait(fitted_gait("crouch")), nullptr});
    return make_live_rig(std::move(manners), gait->name == "idle" ? nullptr : shared_gait(fitted_gait("idle")));
}

LiveRig read_live_rig(const std::string& name) {
    LiveRig rig;
    if (std::filesystem::is_regular_file(name)) {
        const auto gait = shared_gait(gait_from_json(read_file(name), name));
        rig = make_live_rig({{gait->name, gait, nullptr}});
    } else {
        rig = bundled_live_rig(shared_gait(fitted_gait(name)));
    }
    if (const std::string wrong = problem(rig); !wrong.empty())
        throw Error("the gait cannot be played live: " + wrong, name, "fit one from clips with two legs");
    return rig;
}

}  // namespace surefoot
