#include <surefoot/author/byte_archive.h>
#include <surefoot/author/measured_clip.h>

namespace surefoot {

// Structured bindings name every member: whoever adds one is told here by the compiler.

template <typename Archive, typename Value>
void fields_of_skeleton(Archive& archive, Value& skeleton) {
    auto& [names, parents, rest, tips] = skeleton;
    archive(names, parents, rest, tips);
}
static void fields(ByteWriter& archive, const Skeleton& value) { fields_of_skeleton(archive, value); }
static void fields(ByteReader& archive, Skeleton& value) { fields_of_skeleton(archive, value); }

template <typename Archive, typename Value>
void fields_of_motion(Archive& archive, Value& motion) {
    auto& [name, skeleton, fps, cyclic, root, locals] = motion;
    archive(name, skeleton, fps, cyclic, root, locals);
}
static void fields(ByteWriter& archive, const Motion& value) { fields_of_motion(archive, value); }
static void fields(ByteReader& archive, Motion& value) { fields_of_motion(archive, value); }

template <typename Archive, typename Value>
void fields_of_roles(Archive& archive, Value& report) {
    auto& [roles, convention, lines] = report;
    archive(roles, convention, lines);
}
static void fields(ByteWriter& archive, const RoleReport& value) { fields_of_roles(archive, value); }
static void fields(ByteReader& archive, RoleReport& value) { fields_of_roles(archive, value); }

template <typename Archive, typename Value>
void fields_of_event(Archive& archive, Value& event) {
    auto& [foot, kind, time] = event;
    archive(foot, kind, time);
}
static void fields(ByteWriter& archive, const PhaseEvent& value) { fields_of_event(archive, value); }
static void fields(ByteReader& archive, PhaseEvent& value) { fields_of_event(archive, value); }

template <typename Archive, typename Value>
void fields_of_facts(Archive& archive, Value& facts) {
    auto& [name, file, frames, joints, fps, duration, forward, lateral, speed, chord, turn, travel, slope, climb,
           in_place, cyclic, locomotion, not_locomotion, cadence, stride, duty, events, contacts, skate, seam,
           seam_speed, loop_error, closing, disagreement_speed, disagreement_turn, hip_height, height, unit_scale,
           warnings, custom] = facts;
    archive(name, file, frames, joints, fps, duration, forward, lateral, speed, chord, turn, travel, slope, climb,
            in_place, cyclic, locomotion, not_locomotion, cadence, stride, duty, events, contacts, skate, seam,
            seam_speed, loop_error, closing, disagreement_speed, disagreement_turn, hip_height, height, unit_scale,
            warnings, custom);
}
static void fields(ByteWriter& archive, const ClipFacts& value) { fields_of_facts(archive, value); }
static void fields(ByteReader& archive, ClipFacts& value) { fields_of_facts(archive, value); }

template <typename Archive, typename Value>
void fields_of_clip(Archive& archive, Value& clip) {
    auto& [motion, roles, legs, facts, source, first, last] = clip;
    archive(motion, roles, legs, facts, source, first, last);
}
static void fields(ByteWriter& archive, const AnalyzedClip& value) { fields_of_clip(archive, value); }
static void fields(ByteReader& archive, AnalyzedClip& value) { fields_of_clip(archive, value); }

template <typename Archive, typename Value>
void fields_of_candidate(Archive& archive, Value& candidate) {
    auto& [clip, provenance, cut_from_take, retargeted, out] = candidate;
    archive(clip, provenance, cut_from_take, retargeted, out);
}
static void fields(ByteWriter& archive, const Candidate& value) { fields_of_candidate(archive, value); }
static void fields(ByteReader& archive, Candidate& value) { fields_of_candidate(archive, value); }

// Of a clip that was left out only what left_out() fills.
template <typename Archive, typename Value>
void fields_of_left_out(Archive& archive, Value& clip) {
    archive(clip.name, clip.facts, clip.source, clip.source_first, clip.source_last, clip.excluded, clip.reason);
}
static void fields(ByteWriter& archive, const ProjectClip& value) { fields_of_left_out(archive, value); }
static void fields(ByteReader& archive, ProjectClip& value) { fields_of_left_out(archive, value); }

template <typename Archive, typename Value>
void fields_of_measured(Archive& archive, Value& measured) {
    auto& [kept, left_out, failed, searched] = measured;
    archive(kept, left_out, failed, searched);
}

CacheKey cache_key(const ResultCache& cache, const LoadedClip& loaded, const RoleOverrides& overrides) {
    ByteWriter writer;
    writer(loaded.motion, loaded.file, loaded.unit_scale, loaded.warnings, loaded.custom, overrides);
    return cache.key(writer.bytes);
}

std::string to_bytes(const MeasuredClip& measured) {
    ByteWriter writer;
    fields_of_measured(writer, measured);
    return std::move(writer.bytes);
}

std::optional<MeasuredClip> measured_from_bytes(std::string_view bytes,
                                                const std::shared_ptr<const Skeleton>& skeleton) {
    MeasuredClip measured;
    ByteReader reader(bytes);
    fields_of_measured(reader, measured);
    if (!reader.complete()) return {};
    for (Candidate& candidate : measured.kept) {
        Motion& motion = candidate.clip.motion;
        if (!problem(motion).empty()) return {};
        if (*motion.skeleton == *skeleton) motion.skeleton = skeleton;
    }
    return measured;
}

}  // namespace surefoot
