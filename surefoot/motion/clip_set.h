#pragma once
// Clips of one character, ready to be authored.

#include <surefoot/motion/motion.h>
#include <surefoot/rig/roles.h>

#include <memory>
#include <vector>

namespace surefoot {

struct ClipSet {
    std::shared_ptr<const Skeleton> skeleton;
    RoleMap roles;
    std::vector<Motion> clips;
};

}  // namespace surefoot
