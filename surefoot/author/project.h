#pragma once
// The project file: what `author` writes, what the user may edit, and what `lint`, `walk` and `bake` read.
//
// JSON, versioned; files are relative to the folder of the project. Whatever a user pins (places, axis limits, rule
// settings, locked edges and simplices, weighting, excluded clips) survives the next run of `author`. Everything else
// is written anew.

#include <surefoot/analysis/clip_facts.h>
#include <surefoot/author/finding.h>
#include <surefoot/author/probe_result.h>
#include <surefoot/rig/roles.h>

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace surefoot {

inline constexpr int k_project_version = 1;

/// A place given by hand: it wins over what was measured.
struct PinnedPlace {
    std::string space;          ///< "facing", "lateral"
    std::vector<float> values;  ///< in axis units, one an axis

    friend bool operator==(const PinnedPlace&, const PinnedPlace&) = default;
};

struct ProjectClip {
    std::string name;  ///< unique without regard to case, safe as a file name
    std::string file;  ///< "clips/NAME.glb", relative to the project; empty for a clip that was left out
    ClipFacts facts;

    std::string source;                     ///< the file it came from, as the user gave it, with #NAME where needed
    int source_first = 0, source_last = 0;  ///< frames of the source, both included
    std::vector<std::string> provenance;    ///< what was done to it, in order: "cut from frames 120 to 184", …
    bool retargeted = false;                ///< it comes from another skeleton than the project's

    std::vector<PinnedPlace> pins;
    std::string style;              ///< "drunk": it shows that style, in a space of its own; empty: plain locomotion
    bool upper_body = false;        ///< the style is the upper body's alone
    bool excluded = false;          ///< not part of any space
    bool excluded_by_user = false;  ///< set by hand: it stays out
    std::string reason;             ///< why it is excluded
    std::string repair;             ///< id of the repair that made the clip or left it out; empty for most

    /// A repair made it: it comes from other clips, not from a file.
    bool made() const noexcept { return !repair.empty() && source.empty(); }

    friend bool operator==(const ProjectClip&, const ProjectClip&);
};

inline constexpr std::string_view k_style_prefix = "style:";

struct ProjectSpace {
    /// "facing": (speed, turn); "lateral": (forward, lateral); "style:NAME": (speed) of the clips that show a style
    std::string name;
    BlendSpace space;          ///< in axis units
    std::vector<int> clips;    ///< of each sample and copy: index into Project::clips, never an excluded one
    bool upper_body = false;   ///< of a style: legs and hips are left to the locomotion
    bool axes_pinned = false;  ///< the user set the limits; they are not recomputed
    std::vector<std::array<int, 2>> locked_edges;    ///< pairs of samples that must stay joined
    std::vector<std::vector<int>> locked_simplices;  ///< dimensions + 1 samples each that must stay a simplex

    friend bool operator==(const ProjectSpace&, const ProjectSpace&);
};

/// A space that colours locomotion rather than being it (graph/locomotion.h, LocomotionStyle).
inline bool is_style(const ProjectSpace& space) noexcept { return space.name.rfind(k_style_prefix, 0) == 0; }

/// One thing that a repair did.
struct RepairStep {
    /// "mirror", "reverse", "interpolate", "steer", "retime", "clean", "plant": make a clip. "exclude": leaves one out.
    /// "lock-edge": joins two samples of `space` whatever Delaunay thinks.
    std::string kind;
    std::vector<std::string> clips;         ///< what it works on
    std::map<std::string, double> numbers;  ///< parameters by name, units in the names; weights as "weight_0", …
    std::string makes;                      ///< name of the made clip; empty where none is made
    std::string space;                      ///< of a locked edge
    std::string reason;                     ///< of an exclusion

    friend bool operator==(const RepairStep&, const RepairStep&) = default;
};

/// A repair that was made and can be undone (author/repair.h).
struct ProjectRepair {
    std::string id;                  ///< unique in the project: "1", "2", …
    std::string rule;                ///< of the finding that it answers
    std::string space;               ///< of that finding, where it has one
    std::vector<std::string> clips;  ///< of that finding
    std::string text;                ///< what was done, in words
    std::vector<RepairStep> steps;

    friend bool operator==(const ProjectRepair&, const ProjectRepair&) = default;
};

struct Project {
    int version = k_project_version;
    std::string name;              ///< shown as the report's title
    RoleOverrides roles;           ///< (role, joint) of the skeleton that all clips of the spaces share, complete
    RoleOverrides role_overrides;  ///< set by the user, win over what is found
    LintSettings lint;
    std::vector<ProjectClip> clips;  ///< of the spaces first in order of name, then excluded ones
    std::vector<ProjectSpace> spaces;
    std::vector<Finding> findings;
    std::vector<Placeholder> placeholders;
    ProbeResult probe;                        ///< of the spaces as they are; empty where nobody probed
    std::optional<ProbeResult> probe_before;  ///< of the spaces before the repairs of the last run
    std::vector<std::string> asked_axes;  ///< axes that the user asked for, as "speed,turn"; empty: as the clips need
    std::vector<ProjectRepair> repairs;   ///< in the order in which they were made
    /// Keys of the file that this version does not know, as JSON text of one object; kept when saved.
    std::string unknown;

    friend bool operator==(const Project&, const Project&) = default;

    /// Index of the clip of that name, or -1.
    int find_clip(std::string_view clip) const noexcept;
    const ProjectSpace* find_space(std::string_view space) const noexcept;
};

/// Reads and checks a project file; `path` may be the file or its folder. Throws Error naming the file and the JSON
/// path of the offending node ("project.json: /clips/3/facts/speed_mps: …"). Keys that are not known inside a node are
/// reported in `warnings` (those at the top level are kept).
Project load_project(const std::filesystem::path& path, std::vector<std::string>* warnings = nullptr);
/// The same from text; `where` names it in messages.
Project parse_project(std::string_view json, const std::string& where, std::vector<std::string>* warnings = nullptr);

/// Gives the bytes of a file of the project, named relative to its folder; throws Error where there is none. Called
/// from several threads.
using ReadProjectFile = std::function<std::string(const std::string& file)>;

/// Writes the file in one step (host/files.h).
void save_project(const std::filesystem::path& path, const Project& project);
std::string project_json(const Project& project);

/// What travels with a clip's .glb, as a JSON object: where it comes from and when its feet strike.
std::string clip_extras_json(const ProjectClip& clip);

/// Findings in the shape of `surefoot lint --json`, with what the probe found ("probe" is {} without a probe).
std::string findings_json(const std::vector<Finding>& findings, const ProbeResult& probe = {});

}  // namespace surefoot
