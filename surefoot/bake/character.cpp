#include <surefoot/analysis/analyze.h>
#include <surefoot/analysis/footing.h>
#include <surefoot/author/place.h>
#include <surefoot/bake/baking.h>
#include <surefoot/base/error.h>
#include <surefoot/host/parallel.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

namespace {

SpaceDefinition definition_of(std::span<const ProjectSpace> spaces, std::string_view name,
                              const std::vector<std::int32_t>& used) {
    SpaceDefinition definition;
    for (const ProjectSpace& space : spaces) {
        if (space.name != name) continue;
        definition.space = space.space;
        for (const int clip : space.clips)
            definition.clips.push_back(
                static_cast<std::int32_t>(std::lower_bound(used.begin(), used.end(), clip) - used.begin()));
    }
    return definition;
}

/// The spine's first joint and all it carries; nothing where there is no spine.
std::vector<float> upper_body_mask(const Skeleton& skeleton, const RoleMap& roles) {
    std::vector<float> mask(skeleton.parents.size(), 0.0f);
    if (roles.has(Role::spine))
        for (int j = 0; j < skeleton.joint_count(); ++j)
            if (is_within(skeleton, j, roles[Role::spine])) mask[static_cast<std::size_t>(j)] = 1;
    return mask;
}

/// The motion on the character's skeleton: joints must be the same, rest poses may differ (translations then move).
Motion on_skeleton(const Motion& motion, const std::shared_ptr<const Skeleton>& skeleton) {
    if (!same_joints(*motion.skeleton, *skeleton))
        throw Error("its joints are not those of the other clips", "clip '" + motion.name + "'",
                    "retarget it to their skeleton, or leave it out");
    Motion same = motion;
    same.skeleton = skeleton;
    return same;
}

/// Roles, legs and standing pose; how far heels reach back only clips that walk can tell.
void take_body(Character& character, const AnalyzedClip& from, std::span<const Motion> motions) {
    character.roles = from.roles.roles;
    character.legs = from.legs;
    if (from.legs.known()) {
        std::vector<Tracks> clips;
        for (const Motion& motion : motions) clips.push_back(make_tracks(motion, character.roles));
        character.legs = rounded_heels(from.legs, clips);
    }
    character.hip_height = from.facts.hip_height;
    character.standing.resize(character.skeleton->rest.size());
    local_to_model(*character.skeleton, from.motion.frame(0), character.standing);
}

}  // namespace

std::vector<std::int32_t> used_clips(std::span<const ProjectSpace> spaces, std::size_t available) {
    std::vector<std::int32_t> used;
    for (const ProjectSpace& space : spaces)
        for (const int clip : space.clips) {
            if (clip < 0 || static_cast<std::size_t>(clip) >= available)
                throw Error("a sample names a clip that is not there", "space '" + space.name + "'",
                            "run 'surefoot author' again");
            used.push_back(clip);
        }
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    if (used.empty())
        throw Error("no blend space has any clip", "the project", "run 'surefoot author' on clips that walk or run");
    return used;
}

Character bake(const std::string& name, std::span<const BakeSource> sources, std::span<const ProjectSpace> spaces,
               const std::vector<std::int32_t>& used, const AnalyzedClip& body, const BakeOptions& given) {
    Character character;
    character.name = name;
    character.options = given;
    character.skeleton = sources.front().motion->skeleton;
    std::vector<Motion> motions;
    for (const BakeSource& source : sources) motions.push_back(on_skeleton(*source.motion, character.skeleton));
    take_body(character, body, motions);
    std::vector<PackedClip> packed(sources.size());
    character.packing.resize(sources.size());
    parallel_for(sources.size(), [&](std::size_t i) {
        PackOptions options;
        options.along_travel = sources[i].along_travel;
        options.legs = &character.legs;
        options.error = given.error;
        packed[i] = pack_clip(motions[i], *sources[i].facts, options, &character.packing[i]);
        packed[i].name = sources[i].facts->name.empty() ? motions[i].name : sources[i].facts->name;
    });
    for (std::size_t i = 0; i < sources.size(); ++i) {
        character.facts.push_back(*sources[i].facts);
        if (sources[i].facts->cadence > 0 && packed[i].cycles == 0)
            character.warnings.push_back("clip '" + packed[i].name +
                                         "' steps, but its strikes do not alternate: it plays out of step with others");
    }
    character.graph =
        make_locomotion_graph(character.skeleton, std::move(packed), definition_of(spaces, "facing", used),
                              definition_of(spaces, "lateral", used));
    for (const ProjectSpace& space : spaces)
        if (is_style(space))
            add_style(character.graph, space.name.substr(k_style_prefix.size()),
                      definition_of(spaces, space.name, used),
                      space.upper_body ? upper_body_mask(*character.skeleton, character.roles) : std::vector<float>{});
    if (character.legs.known()) set_legs(character.graph, character.legs, character.standing);
    if (const std::string text = problem(character.graph); !text.empty())
        throw Error(text, name.empty() ? "the character" : name, "run 'surefoot author' again");
    return character;
}

Pack to_pack(const Character& character) {
    Pack pack;
    pack.program.name = character.name;
    pack.program.body = character.graph;
    pack.roles = character.roles;
    pack.legs = character.legs;
    pack.standing = character.standing;
    pack.hip_height = character.hip_height;
    return pack;
}

Character to_character(const Pack& pack) {
    Character character;
    character.name = pack.program.name;
    character.skeleton = pack.program.body.skeleton;
    character.roles = pack.roles;
    character.legs = pack.legs;
    character.hip_height = pack.hip_height;
    character.standing = pack.standing;
    character.graph = pack.program.body;
    return character;
}

std::int32_t add_clip(Character& character, const Motion& motion, const ClipFacts& facts) {
    PackOptions options;
    options.error = character.options.error;
    options.steady_root = facts.cyclic;
    options.legs = facts.cyclic ? &character.legs : nullptr;
    PackReport report;
    PackedClip packed = pack_clip(on_skeleton(motion, character.skeleton), facts, options, &report);
    packed.name = facts.name.empty() ? motion.name : facts.name;
    character.graph.clips.push_back(std::move(packed));
    character.facts.push_back(facts);
    character.packing.push_back(report);
    return static_cast<std::int32_t>(character.graph.clips.size()) - 1;
}

std::size_t calmest(std::span<const BakeSource> sources) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < sources.size(); ++i)
        if (liveliness(*sources[i].facts) < liveliness(*sources[best].facts)) best = i;
    return best;
}

Character bake_character(std::span<const AnalyzedClip> clips, std::span<const ProjectSpace> spaces,
                         const std::string& name, const BakeOptions& options) {
    const std::vector<std::int32_t> used = used_clips(spaces, clips.size());
    std::vector<BakeSource> sources;
    for (const std::int32_t i : used) {
        const AnalyzedClip& clip = clips[static_cast<std::size_t>(i)];
        sources.push_back({&clip.motion, &clip.facts, moves_along_facing(spaces, i, clip.facts)});
    }
    return bake(name, sources, spaces, used, clips[static_cast<std::size_t>(used[calmest(sources)])], options);
}

}  // namespace surefoot
