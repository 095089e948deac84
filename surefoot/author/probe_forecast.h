#pragma once
// What a probe would find in spaces that got another clip, told without playing them: enough to say which one clip is
// worth making first.

#include <surefoot/author/project.h>

namespace surefoot {

/// Sum over the grid points of `probed`'s probe of how wrong the feet of the blend would be in the spaces of `after`
/// (the same axes, other samples), if its new clips were as sound as the old ones. 1 is where lint speaks of a blend; a
/// point that no clips reach counts as 1, too. 0 without a probe. Of spaces that `after` has no more, or with other
/// axes, nothing can be told: they count as they were.
///
/// A blend's error is expected to shrink as the spread of its samples does, the sum of w |x - p|^2 in shares of the
/// axes' ranges: the bound for linear interpolation of anything smooth. A space forecast for itself has the errors
/// measured.
double forecast_error(const Project& probed, const Project& after);

}  // namespace surefoot
