#include <surefoot/author/one_skeleton.h>
#include <surefoot/base/error.h>
#include <surefoot/host/parallel.h>
#include <surefoot/motion/motion.h>

#include <fmt/format.h>

#include <algorithm>

namespace surefoot {
namespace {

/// Candidates that share a skeleton.
struct Group {
    std::vector<std::size_t> candidates;
    const Skeleton* skeleton = nullptr;
};

std::vector<Group> group_by_skeleton(const std::vector<Candidate>& clips) {
    std::vector<Group> groups;
    for (std::size_t i = 0; i < clips.size(); ++i) {
        const Skeleton* own = clips[i].clip.motion.skeleton.get();
        auto group = std::find_if(groups.begin(), groups.end(),
                                  [&](const Group& g) { return g.skeleton == own || *g.skeleton == *own; });
        if (group == groups.end()) group = groups.insert(group, Group{{}, own});
        group->candidates.push_back(i);
    }
    return groups;
}

Actor actor_of(const Group& group, const std::vector<Candidate>& clips) {
    std::vector<const AnalyzedClip*> seen;
    for (const std::size_t i : group.candidates) seen.push_back(&clips[i].clip);
    return actor_of(std::span<const AnalyzedClip* const>(seen));
}

std::string why_apart(const Skeleton& own, const Skeleton& chosen, std::size_t users) {
    if (own.names == chosen.names)
        return fmt::format("its skeleton has other bone lengths than that of the {} clips in use", users);
    return fmt::format("it moves another skeleton ({} joints) than the {} clips in use ({} joints)", own.joint_count(),
                       users, chosen.joint_count());
}

/// What came of one clip.
struct Outcome {
    bool moved = false;
    std::string failure;
};

Outcome move_onto(Candidate& candidate, const Actor& source, const Actor& target) {
    Outcome outcome;
    try {
        RetargetReport report;
        candidate.clip = retargeted(candidate.clip, source, target, &report);
        candidate.retargeted = true;
        candidate.provenance.push_back(fmt::format(
            "retargeted from another skeleton ({} joints) to that of {} ({} joints, legs {:.3f} times as long)",
            source.body.skeleton->joint_count(), target.name, target.body.skeleton->joint_count(), report.scale));
        outcome.moved = true;
    } catch (const Error& error) {
        outcome.failure = error.what();
    }
    return outcome;
}

/// "walk_2, run and 7 more".
std::string listed(const std::vector<std::string>& names) {
    constexpr std::size_t k_most = 5;
    std::string text;
    for (std::size_t i = 0; i < names.size() && i < k_most; ++i) text += (i > 0 ? ", " : "") + names[i];
    if (names.size() > k_most) text += fmt::format(" and {} more", names.size() - k_most);
    return text;
}

}  // namespace

void keep_one_skeleton(Gathered& gathered, const GatherOptions& options) {
    const std::vector<Group> groups = group_by_skeleton(gathered.kept);
    if (groups.empty() || (groups.size() < 2 && !options.actor)) return;
    const auto most = std::max_element(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
        return a.candidates.size() < b.candidates.size();
    });
    const Actor target = options.actor ? *options.actor : actor_of(*most, gathered.kept);
    std::vector<Outcome> outcomes(gathered.kept.size());
    std::vector<std::string> reasons(gathered.kept.size()), moved;
    std::size_t skeletons = 0;
    for (const Group& group : groups) {
        if (*group.skeleton == *target.body.skeleton) continue;
        ++skeletons;
        const std::string reason = why_apart(*group.skeleton, *target.body.skeleton, most->candidates.size());
        for (const std::size_t i : group.candidates) reasons[i] = reason;
        if (!options.retarget) continue;
        const Actor source = actor_of(group, gathered.kept);
        parallel_for(group.candidates.size(), [&](std::size_t k) {
            const std::size_t i = group.candidates[k];
            outcomes[i] = move_onto(gathered.kept[i], source, target);
        });
    }
    std::vector<Candidate> kept;
    for (std::size_t i = 0; i < gathered.kept.size(); ++i) {
        if (outcomes[i].moved) moved.push_back(gathered.kept[i].clip.facts.name);
        if (!outcomes[i].failure.empty()) reasons[i] += "; " + outcomes[i].failure;
        if (reasons[i].empty() || outcomes[i].moved)
            kept.push_back(std::move(gathered.kept[i]));
        else
            gathered.left_out.push_back(left_out(gathered.kept[i].clip, reasons[i]));
    }
    gathered.kept = std::move(kept);
    if (!moved.empty())
        gathered.warnings.push_back(
            fmt::format("{} of {} retargeted to the skeleton of {} ({} joints): {}",
                        moved.size() == 1 ? "1 clip" : fmt::format("{} clips", moved.size()),
                        (skeletons == 1 ? "another skeleton" : fmt::format("{} other skeletons", skeletons)) +
                            (moved.size() == 1 ? " was" : " were"),
                        target.name, target.body.skeleton->joint_count(), listed(moved)));
}

}  // namespace surefoot
