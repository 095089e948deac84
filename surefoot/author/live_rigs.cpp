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

LiveRig live_rig_of(std::shared_ptr<const HarmonicGait> gait, GaitCompany company, const std::string& name) {
    std::vector<LiveManner> manners{{gait->name, gait, nullptr}};
    std::shared_ptr<const HarmonicGait> idle;
    if (company == GaitCompany::bundled) {
        if (gait->name == "human") manners.push_back({"crouch", shared_gait(fitted_gait("crouch")), nullptr});
        if (gait->name != "idle") idle = shared_gait(fitted_gait("idle"));
    }
    LiveRig rig = make_live_rig(std::move(manners), std::move(idle));
    if (const std::string wrong = problem(rig); !wrong.empty())
        throw Error("the gait cannot be played live: " + wrong, name, "fit one from clips with two legs");
    return rig;
}

LiveRig read_live_rig(const std::string& name) {
    if (!std::filesystem::is_regular_file(name))
        return live_rig_of(shared_gait(fitted_gait(name)), GaitCompany::bundled, name);
    return live_rig_of(shared_gait(gait_from_json(read_file(name), name)), GaitCompany::alone, name);
}

}  // namespace surefoot
