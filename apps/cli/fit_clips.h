#pragma once
// The cycles that `surefoot fit` is given: found in clips and takes, put onto another character, played backwards.

#include "actor.h"

#include <surefoot/analysis/analyze.h>

#include <functional>
#include <string>
#include <vector>

namespace surefoot::cli {

struct FitInput {
    std::vector<std::string> in, roles;
    std::string to;        ///< character to put them onto; empty: they stay on their own
    bool reverse = false;  ///< played backwards
};

using FindCycles = std::function<std::vector<AnalyzedClip>(const AnalyzedClip&)>;

/// What `find` finds in each clip, in order; clips that cannot be measured are told and left out. Throws Error where
/// nothing is left.
std::vector<AnalyzedClip> cycles_to_fit(const FitInput& input, const FindCycles& find);

}  // namespace surefoot::cli
