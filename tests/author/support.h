#pragma once
// Projects made by hand: clips that exist as facts only.

#include <surefoot/author/lint.h>
#include <surefoot/author/place.h>
#include <surefoot/author/project.h>
#include <surefoot/math/trig.h>

#include <algorithm>
#include <string>
#include <vector>

namespace surefoot::test {

inline ProjectClip make_clip(const std::string& name, float speed, float turn, float lateral = 0) {
    ProjectClip clip;
    clip.name = name;
    clip.file = "clips/" + name + ".glb";
    clip.source = name + ".bvh";
    ClipFacts& facts = clip.facts;
    facts.name = name;
    facts.file = clip.source;
    facts.frames = 61, facts.joints = 20, facts.fps = 60, facts.duration = 1;
    facts.forward = speed, facts.lateral = lateral, facts.turn = turn;
    facts.speed = std::sqrt(speed * speed + lateral * lateral) * (speed < 0 ? -1.0f : 1.0f);
    facts.travel = k_degrees_per_radian * atan2(lateral, speed);
    facts.cyclic = true;
    facts.cadence = 110;
    facts.hip_height = 0.9f;
    facts.events = {{Side::left, StrideEvent::strike, 0}, {Side::right, StrideEvent::strike, 0.5f}};
    return clip;
}

/// A clip that stands at these values in a space of any axes, whatever it does.
inline ProjectClip pin_clip(const std::string& name, const std::string& space, std::vector<float> values) {
    ProjectClip clip = make_clip(name, 1, 0);
    clip.pins = {{space, std::move(values)}};
    return clip;
}

/// Places the clips in the spaces they need.
inline Project make_project(std::vector<ProjectClip> clips, const std::vector<std::string>& axes = {}) {
    Project project;
    project.name = "test";
    project.clips = std::move(clips);
    std::vector<std::string> warnings;
    place_clips(project, axes, nullptr, warnings);
    return project;
}

/// The same as one space of these axes, limits and all, whatever the clips.
inline Project make_space(std::vector<ProjectClip> clips, const std::vector<Axis>& axes) {
    std::string names;
    for (const Axis& axis : axes) names += (names.empty() ? "" : ",") + axis.name;
    Project before;
    for (const char* name : {"facing", "lateral"}) {
        before.spaces.emplace_back();
        before.spaces.back().name = name;
        before.spaces.back().axes_pinned = true;
        before.spaces.back().space.axes = axes;
    }
    Project project;
    project.name = "test";
    project.clips = std::move(clips);
    std::vector<std::string> warnings;
    place_clips(project, {&names, 1}, &before, warnings);
    return project;
}

/// One (speed, turn) space with given limits.
inline Project make_plane(std::vector<ProjectClip> clips, float low_speed, float high_speed, float turn) {
    return make_space(std::move(clips),
                      {{"speed", "m/s", low_speed, high_speed, false}, {"turn", "deg/s", -turn, turn, false}});
}

inline std::vector<Finding> of_rule(const LintResult& result, const std::string& rule) {
    std::vector<Finding> found;
    for (const Finding& finding : result.findings)
        if (finding.rule == rule) found.push_back(finding);
    return found;
}

inline bool names_both(const Finding& finding, const std::string& a, const std::string& b) {
    const auto has = [&](const std::string& n) {
        return std::find(finding.clips.begin(), finding.clips.end(), n) != finding.clips.end();
    };
    return has(a) && has(b);
}

}  // namespace surefoot::test
