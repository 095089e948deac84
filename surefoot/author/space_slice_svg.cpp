#include <surefoot/author/labels.h>
#include <surefoot/author/place.h>
#include <surefoot/author/plot_frame.h>
#include <surefoot/author/report.h>
#include <surefoot/author/space_slice_svg.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr double k_mark = 5.5;        // [px] radius of a sample
constexpr double k_list_width = 250;  // [px] for what plays, right of the plot

struct Extent {
    float low = 0, high = 0;
    float level(float share) const { return low + share * (high - low); }
};

Extent extent_of(const BlendSpace& space, int axis) {
    Extent extent{space.samples[0][axis], space.samples[0][axis]};
    for (int i = 0; i < space.original_count(); ++i) {
        extent.low = std::min(extent.low, space.samples[i][axis]);
        extent.high = std::max(extent.high, space.samples[i][axis]);
    }
    return extent;
}

/// All axes at the same share of what the samples cover.
SpacePoint point_at(const BlendSpace& space, float share) {
    SpacePoint point{};
    for (int k = 0; k < space.dimensions(); ++k) point[k] = extent_of(space, k).level(share);
    return point;
}

/// The point itself, or where clips are sparse one near it that lies among them: a slice shows blends, not the void.
SpacePoint among_samples(const BlendSpace& space, const SpacePoint& point) {
    const BlendWeights found = blend_weights(space, point);
    if (!found.clamped) return point;
    constexpr float k_inward = 0.1f;  // towards the samples' mean, which lies within them
    const auto count = static_cast<float>(space.samples.size());
    SpacePoint inside{};
    for (int k = 0; k < space.dimensions(); ++k) {
        float mean = 0;
        for (const SpacePoint& sample : space.samples) mean += sample[k] / count;
        inside[k] = found.point[k] + k_inward * (mean - found.point[k]);
    }
    return inside;
}

/// describe_place leaves out what is zero; where an axis is held, zero is worth saying.
std::string place_or_zero(std::span<const Axis> axes, std::span<const float> values) {
    std::string text = describe_place(axes, values);
    if (text.empty())
        for (const Axis& axis : axes) text += (text.empty() ? "" : ", ") + axis.name + " 0";
    return text;
}

class SliceChart {
  public:
    SliceChart(const Project& project, const ProjectSpace& space, const SliceView& view, double width, double height)
        : project_(project), space_(space), view_(view), slice_(slice(space.space, view.at, view.across, view.up)) {
        frame_.width = width, frame_.height = height;
        frame_.right += k_list_width;
        frame_.across = space.space.axes[view.across];
        frame_.up = space.space.axes[view.up];
        frame_.low_x = frame_.across.low, frame_.high_x = frame_.across.high;
        frame_.low_y = frame_.up.low, frame_.high_y = frame_.up.high;
        frame_.include(view.at[view.across], view.at[view.up]);
        for (int i = 0; i < space.space.original_count(); ++i) {
            const SpacePoint& sample = space.space.samples[i];
            frame_.include(sample[view.across], sample[view.up]);
        }
        frame_.add_margin();
    }

    std::string draw() {
        out_ = fmt::format(
            "<svg class=\"space slice\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" "
            "role=\"img\" aria-label=\"{}\">\n",
            frame_.width, frame_.height,
            escape_html("Slice of blend space " + space_.name + ": " + describe_slice(space_.space, view_)));
        add(frame_.background());
        add(frame_.grid());
        cells();
        live_lines();
        samples(false);
        samples(true);
        point();
        labels();
        list();
        add(frame_.titles());
        out_ += "</svg>\n";
        return std::move(out_);
    }

  private:
    void add(const std::string& text) { out_ += text; }
    double x(const SpacePoint& p) const { return frame_.x(p[view_.across]); }
    double y(const SpacePoint& p) const { return frame_.y(p[view_.up]); }
    const std::string& name(int sample) const { return project_.clips[space_.clips[sample]].name; }
    float live_weight(int sample) const {
        for (int n = 0; n < slice_.live.count; ++n)
            if (slice_.live.samples[n] == sample) return slice_.live.weights[n];
        return 0;
    }
    /// Largest distance of a sample from the plane along an axis that is held, in shares of its range.
    double off_plane(const SpacePoint& p) const {
        double most = 0;
        for (int k = 0; k < space_.space.dimensions(); ++k) {
            const Axis& axis = space_.space.axes[k];
            if (k == view_.across || k == view_.up) continue;
            most = std::max(
                most, std::fabs(static_cast<double>(p[k]) - view_.at[k]) / (static_cast<double>(axis.high) - axis.low));
        }
        return most;
    }

    void cells() {
        std::string live;
        for (std::size_t c = 0; c < slice_.cells.size(); ++c) {
            std::string points, clips;
            for (const PlanePoint& p : slice_.cells[c].polygon)
                points += fmt::format("{:.1f},{:.1f} ", frame_.x(p[0]), frame_.y(p[1]));
            const Simplex& simplex = space_.space.simplices[slice_.cells[c].simplex];
            for (int k = 0; k <= k_max_dimensions && simplex[k] >= 0; ++k)
                clips += (k > 0 ? ", " : "") + name(simplex[k]);
            const bool is_live = static_cast<int>(c) == slice_.live_cell;
            (is_live ? live : out_) += fmt::format("<polygon class=\"{}\" points=\"{}\"><title>{}</title></polygon>\n",
                                                   is_live ? "live-cell" : "triangle", points, escape_html(clips));
        }
        add(live);  // on top, so that its outline is whole
    }

    void live_lines() {
        const double px = x(slice_.live.point), py = y(slice_.live.point);
        for (int n = 0; n < slice_.live.count; ++n) {
            const SpacePoint& sample = space_.space.samples[slice_.live.samples[n]];
            add(
                fmt::format("<line class=\"live-line{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" "
                            "stroke-width=\"{:.1f}\"/>\n",
                            slice_.live.weights[n] < 0 ? " less" : "", px, py, x(sample), y(sample),
                            1 + 5 * std::min(std::fabs(slice_.live.weights[n]), 1.0f)));
        }
    }

    void samples(bool live) {
        for (int i = 0; i < space_.space.original_count(); ++i) {
            if ((live_weight(i) != 0) != live) continue;
            const SpacePoint& p = space_.space.samples[i];
            const double faint = live ? 1 : std::max(0.2, 1 - 1.6 * off_plane(p));
            add(fmt::format(
                "<circle class=\"sample{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" opacity=\"{:.2f}\">"
                "<title>{}: {}</title></circle>\n",
                live ? " live" : "", x(p), y(p), live ? k_mark + 1.5 : k_mark, faint, escape_html(name(i)),
                escape_html(describe_place(space_.space.axes,
                                           std::span(p).first(static_cast<std::size_t>(space_.space.dimensions()))))));
        }
    }

    /// A ring and a cross where the plane's point is.
    void point() {
        const double px = x(view_.at), py = y(view_.at);
        add(fmt::format("<circle class=\"asked\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"8\"/>\n", px, py));
        add(svg_line("asked", px - 12, py, px + 12, py));
        add(svg_line("asked", px, py - 12, px, py + 12));
    }

    /// Names beside what plays.
    void labels() {
        std::vector<LabelRequest> requests;
        std::vector<Box> marks;
        const auto mark = [&](double px, double py, double radius) {
            marks.push_back({px - radius, py - radius, px + radius, py + radius});
        };
        mark(x(view_.at), y(view_.at), 12);
        for (int i = 0; i < space_.space.original_count(); ++i)
            mark(x(space_.space.samples[i]), y(space_.space.samples[i]), k_mark);
        for (int n = 0; n < slice_.live.count; ++n) {
            const SpacePoint& p = space_.space.samples[slice_.live.samples[n]];
            requests.push_back({shortened(name(slice_.live.samples[n]), 24), x(p), y(p), k_mark + 1.5, 11.5});
        }
        const Box frame{frame_.left + 2, frame_.top + 2, frame_.width - frame_.right - 2,
                        frame_.height - frame_.bottom - 2};
        const std::vector<PlacedLabel> placed = place_labels(requests, marks, {}, frame);
        for (std::size_t n = 0; n < placed.size(); ++n) {
            if (placed[n].leader)
                add(svg_line("leader", requests[n].x, requests[n].y, placed[n].leader_x, placed[n].leader_y));
            add(svg_text("name", placed[n].x, placed[n].y, requests[n].text));
        }
    }

    void list() {
        const double left = frame_.width - k_list_width + 6;
        double row = frame_.top + 14;
        const auto line = [&](const char* style, const std::string& text) {
            add(svg_text(style, left, row, text));
            row += 19;
        };
        line("title", space_.space.dimensions() > 2 ? "held" : "here");
        for (int k = 0; k < space_.space.dimensions(); ++k)
            if (k != view_.across && k != view_.up) line("tick", place_on(k));
        row += 8;
        line("title", "at");
        line("tick", place_on(view_.up));
        line("tick", place_on(view_.across));
        row += 8;
        line("title", slice_.live.clamped ? "plays (outside: nearest)" : "plays");
        std::vector<int> order;
        for (int n = 0; n < slice_.live.count; ++n) order.push_back(n);
        std::stable_sort(order.begin(), order.end(),
                         [&](int a, int b) { return slice_.live.weights[a] > slice_.live.weights[b]; });
        for (const int n : order) {
            const float weight = slice_.live.weights[n];
            const double bar = 60 * std::min(std::fabs(weight), 1.0f);
            add(fmt::format("<rect class=\"live-bar{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"10\"/>\n",
                            weight < 0 ? " less" : "", left, row - 9, std::max(bar, 1.0)));
            add(svg_text("tick", left + 66, row,
                         fmt::format("{:.0f} %  {}", 100 * weight, shortened(name(slice_.live.samples[n]), 24))));
            row += 17;
        }
    }

    std::string place_on(int axis) const {
        return place_or_zero(std::span(space_.space.axes).subspan(static_cast<std::size_t>(axis), 1),
                             std::span(view_.at).subspan(static_cast<std::size_t>(axis), 1));
    }

    const Project& project_;
    const ProjectSpace& space_;
    SliceView view_;
    SpaceSlice slice_;
    PlotFrame frame_;
    std::string out_;
};

}  // namespace

std::vector<SliceView> default_slices(const BlendSpace& space) {
    const int d = space.dimensions();
    if (d < 2 || space.samples.empty()) return {};
    const SpacePoint middle = among_samples(space, point_at(space, 0.5f));
    if (d == 2) return {{middle, 1, 0}};
    std::vector<SliceView> views;
    constexpr float k_levels[] = {0.02f, 0.5f, 0.98f};  // just inside, where planes through samples would touch only
    for (const float level : k_levels) {
        SliceView view{point_at(space, level), 1, 0};
        view.at[0] = middle[0], view.at[1] = middle[1];
        view.at = among_samples(space, view.at);
        views.push_back(view);
    }
    for (int up = 0; up < d; ++up)
        for (int across = up + 1; across < d; ++across)
            if (across > 1) views.push_back({middle, across, up});
    return views;
}

std::string describe_slice(const BlendSpace& space, const SliceView& view) {
    std::vector<Axis> axes;
    std::vector<float> values;
    for (int k = 0; k < space.dimensions(); ++k) {
        if (k == view.across || k == view.up) continue;
        axes.push_back(space.axes[k]);
        values.push_back(view.at[k]);
    }
    return place_or_zero(axes, values);
}

std::string space_slice_svg(const Project& project, const ProjectSpace& space, const SliceView& view, double width,
                            double height) {
    return SliceChart(project, space, view, width, height).draw();
}

}  // namespace surefoot
