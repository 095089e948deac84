#pragma once
// A project in the making: its clips with their motions at hand, so that clips can be made of them and everything
// placed and checked again. What `author` and `fix` share.

#include <surefoot/analysis/analyze.h>
#include <surefoot/author/pose_distance.h>
#include <surefoot/author/project.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace surefoot {

/// A clip's motion, and its poses for comparing. Immutable: trials share them.
struct BenchClip {
    AnalyzedClip clip;
    PoseTable poses;
};

std::shared_ptr<const BenchClip> make_bench_clip(AnalyzedClip clip);

struct Workbench {
    Project project;
    /// Of each clip of the project; null where its motion is not at hand (clips that were left out for good).
    std::vector<std::shared_ptr<const BenchClip>> clips;

    void add(ProjectClip clip, std::shared_ptr<const BenchClip> motion);
    const BenchClip* find(std::string_view name) const noexcept;
};

/// Copies of the clips of the spaces, which come first in a project: the spaces' clips index into them. Throws Error
/// where the motion of one is not at hand.
std::vector<AnalyzedClip> clips_in_use(const Workbench& bench);

/// Brings the clips into the project's order, places them, triangulates and lints. What the user pinned or locked is
/// taken from `before` (null: nothing is).
void place_and_lint(Workbench& bench, const Project* before, std::vector<std::string>& warnings);

/// The same without placing: after a space was changed by hand.
void lint_again(Workbench& bench, std::vector<std::string>& warnings);

/// The project of `folder` with the motions of its clips as they are on disk. Clips that cannot be read are told in
/// `warnings` and are left without motion.
Workbench load_workbench(const std::filesystem::path& project, std::vector<std::string>& warnings);

/// The same of a project that was read already, its clips from wherever they are. `where` stands before their names in
/// warnings.
Workbench load_workbench(Project project, const ReadProjectFile& read, std::vector<std::string>& warnings,
                         const std::string& where = {});

/// `failed`: files that could not be read, for the report.
struct WriteOptions {
    bool mannequin = true;
    bool only_new = false;  ///< only clips without a file yet
    std::vector<std::string> failed, warnings;
};

/// Takes a file of a project, named relative to its folder; clips' from several threads.
using PutProjectFile = std::function<void(const std::string& file, const std::string& bytes)>;

/// Makes the files of a project: the clips that `wanted` says, the report and, last, project.json.
void give_project(const Workbench& bench, const WriteOptions& options,
                  const std::function<bool(const ProjectClip&)>& wanted, const PutProjectFile& put);

/// Writes them into a folder, and removes the files of clips that `before` had and the project has not.
void write_project(const Workbench& bench, const std::filesystem::path& folder, const Project* before,
                   const WriteOptions& options);

}  // namespace surefoot
