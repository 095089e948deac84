#pragma once
// From clips to a blend space: load, measure, cut, place, triangulate, lint, write. No manual step.

#include <surefoot/author/project.h>
#include <surefoot/author/repair.h>
#include <surefoot/author/retarget_clips.h>
#include <surefoot/author/snap_grid.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace surefoot {

struct AnalyzedClip;
struct Motion;

/// Plays the spaces and measures them (probe/probe.h, which leans on this room). The spaces' clips index into `clips`.
using SpaceProbe =
    std::function<ProbeResult(std::span<const AnalyzedClip> clips, std::span<const ProjectSpace> spaces)>;

/// Clips that show a style: they colour the locomotion of the others (graph/locomotion.h, LocomotionStyle).
struct StyleOption {
    std::string name;     ///< "drunk"
    std::string pattern;  ///< of clips' names, with * and ?
    bool upper_body = false;

    /// From "NAME=PATTERN". Throws Error for another form.
    static StyleOption parse(const std::string& text, bool upper_body);
};

struct AuthorOptions {
    std::string name;              ///< title of the report; default: the output folder's name
    RoleOverrides role_overrides;  ///< joint names by hand
    double unit_scale = 0;         ///< metres a file unit; 0: guess
    /// Axes of the spaces to build, as "speed,turn" or "forward,lateral,style" (author/place.h); empty: as many spaces
    /// as the clips need.
    std::vector<std::string> axes;
    std::vector<StyleOption> styles;  ///< the first whose pattern fits a clip's name has it
    /// Clips of other skeletons are retargeted to the one in use; else they are left out.
    bool retarget = true;
    /// Whose skeleton the space uses; none: that which most clips share, the first of equals.
    std::optional<Actor> actor;
    /// Measurements are kept in folder/.cache for the next run, which may be deleted at any time.
    bool cache = true;
    /// How all spaces weigh their samples, and how far they extrapolate (0: they clamp); absent: as the project says.
    std::optional<Weighting> weighting;
    std::optional<float> extrapolate;
    bool mannequin = true;  ///< clips are written with a skinned mannequin
    int grid = 0;           ///< divisions of an engine's grid that samples are moved to (snap_grid.h); 0: none
    SpaceProbe probe;       ///< measures the placed spaces, for findings and report; none: not probed
    bool fix = false;       ///< repair what can be repaired (author/repair.h)
};

struct AuthorResult {
    Project project;
    std::vector<std::string> warnings;
    std::vector<std::string> failed;  ///< files that could not be read, with the reason
    std::filesystem::path project_file, report_file;
    GridSnap snap;              ///< what the grid moved
    ProbeResult unsnapped;      ///< the probe without the grid, where there is a grid
    RepairReport repairs;       ///< of this run, where it was asked to repair
    int takes = 0;              ///< clips that do not loop as they are and were searched for cycles
    int takes_with_cycles = 0;  ///< those of them where any was found
    int cycles_found = 0, cycles_placed = 0;
};

/// Authors the clips found at `paths` (files or folders) into `folder`: clips/NAME.glb, report.html and, last,
/// project.json. A project that is already there keeps what its user pinned. Throws Error where nothing usable is
/// found.
AuthorResult author_clips(std::span<const std::string> paths, const std::filesystem::path& folder,
                          const AuthorOptions& options = {});

/// The same from clips that are loaded already, with those that could not be.
AuthorResult author_loaded(LoadResult loaded, const std::filesystem::path& folder, const AuthorOptions& options = {});

/// The same from motions in memory (the generated default set, made clips).
AuthorResult author_motions(std::vector<Motion> motions, const std::filesystem::path& folder,
                            const AuthorOptions& options = {});

/// The same without a folder: nothing is read or written, nothing is kept for a next run (give_project makes the
/// files). The project is the bench's, and `result` has the rest; what an earlier call left in it stays.
Workbench author_workbench(LoadResult loaded, const AuthorOptions& options, AuthorResult& result);
Workbench author_workbench(std::vector<Motion> motions, const AuthorOptions& options, AuthorResult& result);

}  // namespace surefoot
