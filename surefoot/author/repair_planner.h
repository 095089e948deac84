#pragma once
// What plans are written with (repair_plan.h), and the plans that make new clips. Private to the room.

#include <surefoot/author/make_clip.h>
#include <surefoot/author/repair_plan.h>

#include <map>
#include <span>
#include <string>
#include <vector>

namespace surefoot {

/// A clip that can be worked on.
struct RepairSource {
    const ProjectClip* clip;
    const BenchClip* motion;
};

/// The clips in use whose motions are at hand and repeat.
std::vector<RepairSource> sources(const Workbench& bench);

/// Plans name their clips as if the earlier ones of the same plan were there.
class Planner {
  public:
    explicit Planner(const Workbench& bench) : names_(bench.project.clips) {}

    /// Adds a making step and returns the made clip's name.
    std::string make(const std::string& kind, std::vector<std::string> clips, std::map<std::string, double> numbers) {
        RepairStep step{kind, std::move(clips), std::move(numbers), "", "", ""};
        step.makes = name_for(step, names_);
        ProjectClip reserved;
        reserved.name = step.makes;
        names_.push_back(std::move(reserved));
        plan_.steps.push_back(std::move(step));
        return plan_.steps.back().makes;
    }
    /// What the last made clip promises on the axes of a space.
    void expect(const std::vector<Axis>& axes, std::span<const float> target) {
        for (std::size_t k = 0; k < axes.size() && k < target.size(); ++k)
            plan_.steps.back().numbers["expect_" + axes[k].name] = static_cast<double>(target[k]);
    }
    void exclude(const std::string& clip, std::string reason) {
        plan_.steps.push_back({"exclude", {clip}, {}, "", "", std::move(reason)});
    }
    void lock(const std::string& space, const std::string& a, const std::string& b) {
        plan_.steps.push_back({"lock-edge", {a, b}, {}, "", space, ""});
    }
    RepairPlan done(std::string text) {
        plan_.text = std::move(text);
        return std::move(plan_);
    }

  private:
    std::vector<ProjectClip> names_;
    RepairPlan plan_;
};

/// Where a clip that does so stands in a space.
std::vector<float> place_of(const ProjectSpace& space, const ClipFacts& facts);

/// A new clip where `finding.fix` asks for it: the image of another, another bent or played at another pace, or a mix.
void plan_clip_at(const Workbench& bench, const ProjectSpace& space, const Finding& finding,
                  std::vector<RepairPlan>& plans);

/// Turns that nobody recorded, bent from the clips that go straight, the walk alone or all of them: they open the
/// second dimension of a space that only knows speed. Where nothing goes backward, the reversed walk does.
void plan_second_dimension(const Workbench& bench, const ProjectSpace& space, std::vector<RepairPlan>& plans);

}  // namespace surefoot
