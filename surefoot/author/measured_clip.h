#pragma once
// What measuring makes of one loaded clip, and how that is kept between runs. Private to the room.

#include <surefoot/author/gather.h>
#include <surefoot/author/result_cache.h>

namespace surefoot {

struct MeasuredClip {
    std::vector<Candidate> kept;
    std::vector<ProjectClip> left_out;
    std::string failed;
    bool searched = false;  ///< for cycles
};

/// Of everything that measuring depends on.
CacheKey cache_key(const ResultCache& cache, const LoadedClip& loaded, const RoleOverrides& overrides);

std::string to_bytes(const MeasuredClip& measured);
/// Nothing where the bytes are not sound. Motions share `skeleton` where theirs is equal.
std::optional<MeasuredClip> measured_from_bytes(std::string_view bytes,
                                                const std::shared_ptr<const Skeleton>& skeleton);

}  // namespace surefoot
