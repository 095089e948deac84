#pragma once
// What the rules share: settings, percent coordinates, and the way findings are collected. Private to the room.

#include <surefoot/author/lint.h>

#include <optional>

namespace surefoot {

/// The two sides of an axis in words, and what lies between them.
struct SideWords {
    const char *below, *above, *between;
};
SideWords side_words(std::string_view axis);

/// "a clip that goes 1.40 m/s forward, without turning", "a clip that stands still".
std::string describe_clip(std::span<const Axis> axes, std::span<const float> values);

/// Samples in percent of each axis' range, 0 included.
class PercentSpace {
  public:
    explicit PercentSpace(const ProjectSpace& space);

    int dimensions() const { return space_->space.dimensions(); }
    int count() const { return space_->space.original_count(); }
    double at(int sample, int axis) const { return percent(space_->space.samples[sample][axis], axis); }
    double percent(double value, int axis) const { return 100 * value / range_[axis]; }
    double distance(const SpacePoint& a, const SpacePoint& b) const;
    double distance(int a, int b) const { return distance(space_->space.samples[a], space_->space.samples[b]); }
    /// Axis of that name, or -1.
    int axis(std::string_view name) const;
    /// Pairs of samples joined by an edge, ascending.
    std::vector<std::array<int, 2>> edges() const;

  private:
    const ProjectSpace* space_;
    std::array<double, k_max_dimensions> range_{};
};

class LintContext {
  public:
    LintContext(const Project& project, std::span<const PoseTable> poses) : project_(project), poses_(poses) {}

    const Project& project() const { return project_; }
    bool enabled(const char* rule) const;
    double threshold(const char* rule, const char* name) const;

    const ProjectClip& clip(const ProjectSpace& space, int sample) const { return project_.clips[space.clips[sample]]; }
    const std::string& name(const ProjectSpace& space, int sample) const { return clip(space, sample).name; }
    std::vector<float> place(const ProjectSpace& space, int sample) const;
    std::vector<float> place(const ProjectSpace& space, const SpacePoint& point) const;

    /// The beginning of a finding about two samples: rule, space, clips, and the middle between them as its place.
    Finding pair_finding(const char* rule, const ProjectSpace& space, int a, int b) const;

    /// `values` of a place, as a point.
    static SpacePoint point(std::span<const float> values);

    /// Mean pose distance [m] of two clips, absent where it is not known.
    std::optional<float> apart(int clip_a, int clip_b) const;

    /// Adds a finding (nothing where its rule is off); the severity is the rule's unless given.
    void add(Finding finding, std::optional<Severity> severity = {});
    /// A finding that asks for a new clip: adds it with its fix and, unless one is nearby, a placeholder.
    /// `extra_axes` name dimensions that the space does not have yet.
    void ask_for(const ProjectSpace& space, Finding finding, PlaceholderKind kind, const std::vector<float>& target,
                 const std::vector<std::string>& extra_axes = {}, std::optional<Severity> severity = {});
    /// Whether an earlier finding of `rule` asks for a clip nearer to `point` than two clips should be.
    bool asked_for(const char* rule, const ProjectSpace& space, const SpacePoint& point) const;
    /// The placeholder alone.
    void add_placeholder(const ProjectSpace& space, const char* rule, PlaceholderKind kind,
                         const std::vector<float>& target, const std::vector<std::string>& extra_axes,
                         const std::string& text);

    LintResult result;

  private:
    const LintRule& rule(std::string_view id) const;
    bool near_placeholder(const ProjectSpace& space, const Placeholder& placeholder) const;

    const Project& project_;
    std::span<const PoseTable> poses_;
};

void lint_crossing_axis(LintContext& context, const ProjectSpace& space);
void lint_missing_axis_end(LintContext& context, const ProjectSpace& space);
void lint_acute_triangle(LintContext& context, const ProjectSpace& space);
void lint_misaligned(LintContext& context, const ProjectSpace& space);
void lint_too_close(LintContext& context, const ProjectSpace& space);
void lint_uncovered(LintContext& context, const ProjectSpace& space);
void lint_opposite_directions(LintContext& context, const ProjectSpace& space);
void lint_dissimilar_neighbours(LintContext& context, const ProjectSpace& space);
void lint_degenerate_space(LintContext& context, const ProjectSpace& space);
void lint_missing_idle(LintContext& context, const ProjectSpace& space);
void lint_clip(LintContext& context, const ProjectClip& clip);
/// What the project's probe found; nothing where nobody probed.
void lint_probe(LintContext& context);

}  // namespace surefoot
