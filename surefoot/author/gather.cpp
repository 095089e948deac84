#include <surefoot/analysis/take.h>
#include <surefoot/author/gather.h>
#include <surefoot/author/measured_clip.h>
#include <surefoot/author/one_skeleton.h>
#include <surefoot/author/place.h>
#include <surefoot/author/pose_distance.h>
#include <surefoot/base/error.h>
#include <surefoot/host/parallel.h>
#include <surefoot/host/progress.h>
#include <surefoot/io/clip_name.h>
#include <surefoot/motion/edit.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace surefoot {
namespace {

std::string closing_text(const ClipFacts& facts) {
    return fmt::format("loop closed (seam {:.1f} cm, no joint moved by more than {:.1f} cm)", 100 * facts.seam,
                       100 * facts.closing);
}

/// A loop whose ends do not quite meet is closed.
void close(Candidate& candidate) {
    constexpr float k_visible_seam = 1e-3f;  // [m]
    ClipFacts& facts = candidate.clip.facts;
    if (facts.loop_error <= k_visible_seam) return;
    const LoopClosing closing = close_loop(candidate.clip.motion);
    facts.seam = closing.seam;
    facts.seam_speed = closing.seam_speed;
    facts.closing = closing.added;
    facts.loop_error = 0;
    candidate.provenance.push_back(closing_text(facts));
}

MeasuredClip measure(LoadedClip loaded, const RoleOverrides& overrides) {
    MeasuredClip result;
    try {
        AnalyzedClip clip = analyze_clip(std::move(loaded.motion), loaded.file, loaded.unit_scale, overrides);
        clip.facts.warnings.insert(clip.facts.warnings.begin(), loaded.warnings.begin(), loaded.warnings.end());
        clip.facts.custom = loaded.custom;
        std::vector<std::string> provenance;
        if (clip.facts.in_place) provenance.push_back("in place: its root motion was made from the planted feet");
        // A long take may jump or sit somewhere and still hold steady cycles; each of those is judged by itself.
        const bool is_take = !clip.facts.cyclic && lasts_like_a_take(clip.facts);
        if (!clip.facts.locomotion && !is_take) {
            result.left_out.push_back(left_out(clip, clip.facts.not_locomotion));
            return result;
        }
        if (clip.facts.cyclic) {
            result.kept.push_back({std::move(clip), provenance, false});
            close(result.kept.back());
            return result;
        }
        std::vector<AnalyzedClip> cycles = find_cycles(clip);
        result.searched = true;
        if (cycles.empty())
            result.left_out.push_back(left_out(clip, clip.facts.locomotion
                                                         ? "it does not loop and no steady cycle was found in it"
                                                         : clip.facts.not_locomotion));
        const bool single = cycles.size() == 1;
        for (AnalyzedClip& cycle : cycles) {
            Candidate candidate{std::move(cycle), provenance, true};
            ClipFacts& facts = candidate.clip.facts;
            facts.custom = loaded.custom;
            if (single && !is_take) facts.name = clip.facts.name;  // a take called "Run1" may hold one walk
            candidate.provenance.push_back(
                fmt::format("cut from frames {} to {}", candidate.clip.source_first, candidate.clip.source_last));
            if (facts.seam > 0) candidate.provenance.push_back(closing_text(facts));
            close(candidate);
            result.kept.push_back(std::move(candidate));
        }
    } catch (const Error& error) {
        result.failed = error.what();
    }
    return result;
}

/// The same, or what an earlier run found.
MeasuredClip measure(LoadedClip loaded, const RoleOverrides& overrides, ResultCache& cache) {
    if (!cache.enabled()) return measure(std::move(loaded), overrides);
    const CacheKey key = cache_key(cache, loaded, overrides);
    if (const std::optional<std::string> known = cache.find(key))
        if (std::optional<MeasuredClip> result = measured_from_bytes(*known, loaded.motion.skeleton))
            return std::move(*result);
    MeasuredClip result = measure(std::move(loaded), overrides);
    cache.store(key, to_bytes(result));
    return result;
}

/// Percent of an axis' range below which a cycle cut from a take adds nothing to one that loops better.
constexpr double k_same_place = 4;

/// Places of clips in percent, each in the space that it will go to.
class Places {
  public:
    explicit Places(const std::vector<Candidate>& clips) : clips_(clips) {
        for (int k = 0; k < 4; ++k) {
            std::vector<float> values;
            for (const Candidate& candidate : clips) values.push_back(value(candidate, k));
            Axis axis = make_axis(k_names[k]);
            set_limits(axis, values);
            range_[k] = static_cast<double>(axis.high) - axis.low;
        }
    }
    /// Infinite for clips of different spaces, and of different numbers of the user's own.
    double distance(std::size_t a, std::size_t b) const {
        const bool facing = is_facing(clips_[a].clip.facts);
        if (facing != is_facing(clips_[b].clip.facts)) return 1e300;
        if (clips_[a].clip.facts.custom != clips_[b].clip.facts.custom) return 1e300;
        double square = 0;
        for (int k = facing ? 0 : 2; k < (facing ? 2 : 4); ++k) {
            const double delta = 100 * (static_cast<double>(value(clips_[a], k)) - value(clips_[b], k)) / range_[k];
            square += delta * delta;
        }
        return std::sqrt(square);
    }

  private:
    static constexpr const char* k_names[4] = {"speed", "turn", "forward", "lateral"};
    static float value(const Candidate& candidate, int axis) { return axis_value(candidate.clip.facts, k_names[axis]); }
    const std::vector<Candidate>& clips_;
    double range_[4];
};

/// Takes out the clips that have a reason to be.
void leave_out(Gathered& gathered, const std::vector<std::string>& reason) {
    std::vector<Candidate> kept;
    for (std::size_t i = 0; i < gathered.kept.size(); ++i) {
        if (reason[i].empty())
            kept.push_back(std::move(gathered.kept[i]));
        else
            gathered.left_out.push_back(left_out(gathered.kept[i].clip, reason[i]));
    }
    gathered.kept = std::move(kept);
}

/// Of cycles that takes hold at nearly the same place, the best-looping stays.
void thin_cycles(Gathered& gathered) {
    const Places places(gathered.kept);
    const std::size_t count = gathered.kept.size();
    std::vector<std::size_t> order(count);
    for (std::size_t i = 0; i < count; ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        const Candidate &x = gathered.kept[a], &y = gathered.kept[b];
        if (x.cut_from_take != y.cut_from_take) return !x.cut_from_take;
        return x.clip.facts.seam < y.clip.facts.seam;
    });
    std::vector<std::size_t> chosen;
    std::vector<std::string> reason(count);
    for (const std::size_t i : order) {
        if (gathered.kept[i].out) continue;
        if (gathered.kept[i].cut_from_take && !is_idle(gathered.kept[i].clip.facts))
            for (const std::size_t other : chosen) {
                if (places.distance(i, other) >= k_same_place) continue;
                reason[i] =
                    fmt::format("it does what \"{}\" does, which loops better", gathered.kept[other].clip.facts.name);
                break;
            }
        if (reason[i].empty()) chosen.push_back(i);
    }
    leave_out(gathered, reason);
}

bool says_idle(std::string name) {
    for (char& c : name)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return name.find("idle") != std::string::npos || name.find("stand") != std::string::npos;
}

/// All clips that stand share the origin of a space, where one of them can be (one for each set of the user's own
/// numbers): the one whose pose is nearest to those of the moving clips. The others are for states of their own.
void keep_one_idle(Gathered& gathered) {
    std::vector<std::size_t> idles;
    std::vector<PoseTable> moving;
    const auto table = [](const Candidate& candidate) {
        return make_pose_table(candidate.clip.motion, candidate.clip.facts, candidate.clip.roles.roles);
    };
    for (std::size_t i = 0; i < gathered.kept.size(); ++i) {
        if (gathered.kept[i].out) continue;
        if (is_idle(gathered.kept[i].clip.facts))
            idles.push_back(i);
        else
            moving.push_back(table(gathered.kept[i]));
    }
    if (idles.size() < 2) return;
    constexpr double k_name_bonus = 0.05;  // [m] that a clip called idle may be farther away
    struct Best {
        std::size_t clip = 0;
        double apart = 1e300;
    };
    std::map<std::map<std::string, float>, Best> best;
    for (const std::size_t i : idles) {
        const PoseTable own = table(gathered.kept[i]);
        double apart = says_idle(gathered.kept[i].clip.facts.name) ? 0 : k_name_bonus;
        for (const PoseTable& other : moving) apart += pose_distance(own, other) / static_cast<double>(moving.size());
        Best& of_kind = best[gathered.kept[i].clip.facts.custom];
        if (apart < of_kind.apart) of_kind = {i, apart};
    }
    std::vector<std::string> reason(gathered.kept.size());
    for (const std::size_t i : idles)
        if (const std::size_t other = best[gathered.kept[i].clip.facts.custom].clip; i != other)
            reason[i] = fmt::format(
                "it stands, as \"{}\" does, whose pose is nearer to the moving clips; a space has room for one idle",
                gathered.kept[other].clip.facts.name);
    leave_out(gathered, reason);
}

void name_clips(Gathered& gathered) {
    std::vector<std::string*> names;
    for (Candidate& candidate : gathered.kept) {
        candidate.clip.facts.name = safe_file_name(candidate.clip.facts.name);
        names.push_back(&candidate.clip.facts.name);
    }
    for (ProjectClip& clip : gathered.left_out) names.push_back(&clip.name);
    make_unique(names);
    for (Candidate& candidate : gathered.kept) candidate.clip.motion.name = candidate.clip.facts.name;
    for (ProjectClip& clip : gathered.left_out) clip.facts.name = clip.name;
    std::sort(gathered.kept.begin(), gathered.kept.end(),
              [](const Candidate& a, const Candidate& b) { return a.clip.facts.name < b.clip.facts.name; });
    std::sort(gathered.left_out.begin(), gathered.left_out.end(),
              [](const ProjectClip& a, const ProjectClip& b) { return a.name < b.name; });
}

}  // namespace

ProjectClip left_out(const AnalyzedClip& clip, std::string reason) {
    ProjectClip result;
    result.name = clip.facts.name;
    result.facts = clip.facts;
    result.source = clip.source;
    result.source_first = clip.source_first;
    result.source_last = clip.source_last;
    result.excluded = true;
    result.reason = std::move(reason);
    return result;
}

Gathered gather(std::vector<LoadedClip> clips, const RoleOverrides& overrides, const GatherOptions& options) {
    std::vector<MeasuredClip> measured(clips.size());
    {
        ResultCache cache(options.cache);
        Progress progress("measuring", clips.size());
        parallel_for(clips.size(), [&](std::size_t i) {
            measured[i] = measure(std::move(clips[i]), overrides, cache);
            progress.advance();
        });
        cache.remove_unused();
    }
    Gathered gathered;
    for (MeasuredClip& one : measured) {
        if (one.searched) {
            ++gathered.takes;
            gathered.takes_with_cycles += !one.kept.empty();
            gathered.cycles += static_cast<int>(one.kept.size());
        }
        std::move(one.kept.begin(), one.kept.end(), std::back_inserter(gathered.kept));
        std::move(one.left_out.begin(), one.left_out.end(), std::back_inserter(gathered.left_out));
        if (!one.failed.empty()) gathered.failed.push_back(one.failed);
    }
    keep_one_skeleton(gathered, options);
    name_clips(gathered);
    if (options.left_out_by_user)
        for (Candidate& candidate : gathered.kept) candidate.out = options.left_out_by_user(candidate.clip);
    thin_cycles(gathered);
    keep_one_idle(gathered);
    std::sort(gathered.left_out.begin(), gathered.left_out.end(),
              [](const ProjectClip& a, const ProjectClip& b) { return a.name < b.name; });
    return gathered;
}

}  // namespace surefoot
