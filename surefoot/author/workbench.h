#pragma once
// A project in the making: its clips with their motions at hand, so that clips can be made of them and everything
// placed and checked again. What `author` and `fix` share.

#include <surefoot/analysis/analyze.h>
#include <surefoot/author/pose_distance.h>
#include <surefoot/author/project.h>

#include <filesystem>
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

/// Brings the clips into the project's order, places them, triangulates and lints. What the user pinned or locked is
/// taken from `before` (null: nothing is).
void place_and_lint(Workbench& bench, const Project* before, std::vector<std::string>& warnings);

/// The same without placing: after a space was changed by hand.
void lint_again(Workbench& bench, std::vector<std::string>& warnings);

/// The project of `folder` with the motions of its clips as they are on disk. Clips that cannot be read are told in
/// `warnings` and are left without motion.
Workbench load_workbench(const std::filesystem::path& project, std::vector<std::string>& warnings);

/// Writes clips (all, or only those without a file yet), report and, last, the project; removes the files of clips
/// that `before` had and the project has not. `failed`: files that could not be read, for the report.
struct WriteOptions {
    bool mannequin = true;
    bool only_new = false;
    std::vector<std::string> failed, warnings;
};
void write_project(const Workbench& bench, const std::filesystem::path& folder, const Project* before,
                   const WriteOptions& options);

}  // namespace surefoot
