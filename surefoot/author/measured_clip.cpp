#include <surefoot/author/byte_archive.h>
#include <surefoot/author/measured_clip.h>
#include <surefoot/rig/fields.h>

namespace surefoot {

SUREFOOT_FIELDS(Motion, name, skeleton, fps, cyclic, root, locals)
SUREFOOT_FIELDS(RoleReport, roles, convention, lines)
SUREFOOT_FIELDS(PhaseEvent, foot, kind, time)
SUREFOOT_FIELDS(ClipFacts, name, file, frames, joints, fps, duration, forward, lateral, speed, chord, turn, travel,
                slope, climb, in_place, cyclic, locomotion, not_locomotion, cadence, stride, duty, events, contacts,
                skate, seam, seam_speed, loop_error, closing, disagreement_speed, disagreement_turn, hip_height, height,
                unit_scale, warnings, custom)
SUREFOOT_FIELDS(AnalyzedClip, motion, roles, legs, facts, source, first, last)
SUREFOOT_FIELDS(Candidate, clip, provenance, cut_from_take, retargeted, out)
SUREFOOT_FIELDS(MeasuredClip, kept, left_out, failed, searched)

// Of a clip that was left out only what left_out() fills.
template <class Archive, class Value>
requires(std::is_same_v<std::remove_const_t<Value>, ProjectClip>) void fields(Archive& archive, Value& clip) {
    archive(clip.name, clip.facts, clip.source, clip.source_first, clip.source_last, clip.excluded, clip.reason);
}

CacheKey cache_key(const ResultCache& cache, const LoadedClip& loaded, const RoleOverrides& overrides) {
    ByteWriter writer;
    writer(loaded.motion, loaded.file, loaded.unit_scale, loaded.warnings, loaded.custom, overrides);
    return cache.key(writer.bytes);
}

std::string to_bytes(const MeasuredClip& measured) {
    ByteWriter writer;
    writer(measured);
    return std::move(writer.bytes);
}

std::optional<MeasuredClip> measured_from_bytes(std::string_view bytes,
                                                const std::shared_ptr<const Skeleton>& skeleton) {
    MeasuredClip measured;
    ByteReader reader(bytes);
    reader(measured);
    if (!reader.complete()) return {};
    for (Candidate& candidate : measured.kept) {
        Motion& motion = candidate.clip.motion;
        if (!problem(motion).empty()) return {};
        if (*motion.skeleton == *skeleton) motion.skeleton = skeleton;
    }
    return measured;
}

}  // namespace surefoot
