// A blend space as a picture: what Figures 1 and 4 of Delicado & Pelechano 2019 show, for any space.
//
// The second axis runs across and is turned round, so that what goes to the character's left is drawn on the left; the
// first runs up. A one-dimensional space is a line, or where a clip is asked for beside it the plane that it could
// span, with the missing axis greyed. Every kind of problem has a shape of its own besides its colour.

#include <surefoot/author/labels.h>
#include <surefoot/author/place.h>
#include <surefoot/author/plot_frame.h>
#include <surefoot/author/report.h>
#include <surefoot/author/report_style.h>
#include <surefoot/math/trig.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace surefoot {
namespace {

constexpr double k_mark = 6.5;            // [px] radius of a sample
constexpr std::size_t k_most_names = 26;  // with more samples than this, marks carry numbers and the table the names

class Chart {
  public:
    Chart(const Project& project, const ProjectSpace& space, double width, double height)
        : project_(project), space_(space) {
        frame_.width = width, frame_.height = height;
        choose_axes();
        if (flat_ && up_slot_ < 0 && !asks_beside_the_axis()) frame_.height = std::min(height, 0.3 * width);
        choose_domain();
    }

    std::string draw() {
        out_ = fmt::format(
            "<svg class=\"space\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" "
            "aria-label=\"Blend space {}: {} and what lies between them\" data-map=\"{}\">\n",
            frame_.width, frame_.height, escape_html(space_.name), space_.clips.size() == 1 ? "one clip" : "its clips",
            map());
        defs();
        grid();
        triangles();
        axes();
        edges_of_findings();
        close_pairs();
        add("<g class=\"below-samples\"></g>\n");
        placeholders();
        samples();
        other_places();
        labels();
        add(frame_.titles());
        out_ += "</svg>\n";
        return std::move(out_);
    }

  private:
    // --- geometry

    void choose_axes() {
        const auto& axes = space_.space.axes;
        frame_.up = axes[0];
        if (axes.size() > 1) {
            frame_.across = axes[1];
            across_slot_ = 1;
            return;
        }
        flat_ = true;
        const std::string& name = axes[0].name;
        if (name == "turn" || name == "lateral" || !asks_beside_the_axis()) {  // the only axis lies across
            frame_.across = axes[0];
            across_slot_ = 0;
            up_slot_ = -1;
            frame_.up = make_axis(name == "turn" ? "speed" : name == "lateral" ? "forward" : "turn");
            if (name == "turn") frame_.up.low = 0;
            if (name == "lateral") frame_.up.low = -1;
        } else {
            frame_.across = make_axis(name == "forward" ? "lateral" : "turn");
            if (name == "forward") frame_.across.low = -1;
            across_slot_ = -1;
        }
    }

    /// Of a space of one axis: whether a clip is asked for that would open the plane.
    bool asks_beside_the_axis() const {
        return std::any_of(project_.placeholders.begin(), project_.placeholders.end(), [&](const Placeholder& asked) {
            if (asked.space != space_.name) return false;
            for (std::size_t k = 0; k < asked.axes.size() && k < asked.target.size(); ++k)
                if (asked.axes[k] != space_.space.axes[0].name && asked.target[k] != 0) return true;
            return false;
        });
    }

    void choose_domain() {
        frame_.has_across = across_slot_ >= 0, frame_.has_up = up_slot_ >= 0;
        frame_.low_x = frame_.across.low, frame_.high_x = frame_.across.high;
        frame_.low_y = frame_.up.low, frame_.high_y = frame_.up.high;
        frame_.include(0, 0);
        for (int i = 0; i < space_.space.original_count(); ++i)
            frame_.include(value_x(space_.space.samples[i]), value_y(space_.space.samples[i]));
        for (const Placeholder& placeholder : project_.placeholders)
            if (double x, y; placeholder_at(placeholder, x, y)) frame_.include(x, y);
        frame_.add_margin();
    }

    double value_x(const SpacePoint& p) const { return across_slot_ < 0 ? 0 : p[across_slot_]; }
    double value_y(const SpacePoint& p) const { return up_slot_ < 0 ? 0 : p[up_slot_]; }
    double px(double x) const { return frame_.x(x); }
    double py(double y) const { return frame_.y(y); }
    /// How values become pixels, for whoever puts something into the drawing: slot of the axis across (-1: none), pixel
    /// of its 0, pixels a unit; then the same of the axis that runs up.
    std::string map() const {
        return fmt::format("{} {:.3f} {:.6f} {} {:.3f} {:.6f}", across_slot_, px(0), px(1) - px(0), up_slot_, py(0),
                           py(1) - py(0));
    }
    double sample_x(int i) const { return px(value_x(space_.space.samples[i])); }
    double sample_y(int i) const { return py(value_y(space_.space.samples[i])); }
    int sample_named(const std::string& name) const {
        for (std::size_t i = 0; i < space_.clips.size(); ++i)
            if (project_.clips[space_.clips[i]].name == name) return static_cast<int>(i);
        return -1;
    }
    bool placeholder_at(const Placeholder& placeholder, double& x, double& y) const {
        if (placeholder.space != space_.name) return false;
        x = y = 0;
        for (std::size_t k = 0; k < placeholder.axes.size() && k < placeholder.target.size(); ++k) {
            if (placeholder.axes[k] == frame_.across.name) x = placeholder.target[k];
            if (placeholder.axes[k] == frame_.up.name) y = placeholder.target[k];
        }
        return true;
    }

    // --- parts

    void add(const std::string& text) { out_ += text; }
    /// The mark of a finding: it leads to the finding's text, and lights up with it. Only the first bears its name.
    void spot(const Finding& finding, const std::string& mark) {
        const auto index = static_cast<std::size_t>(&finding - project_.findings.data());
        const bool named = marked_.insert(index).second;
        add(fmt::format("<a class=\"spot\" {}href=\"#finding-{}\" data-finding=\"{}\"><title>{}: {}</title>{}</a>\n",
                        named ? fmt::format("id=\"spot-{}\" ", index) : std::string("tabindex=\"-1\" "), index, index,
                        escape_html(finding.rule), escape_html(finding.message), mark));
    }
    void line(const char* style, double x0, double y0, double x1, double y1) { add(svg_line(style, x0, y0, x1, y1)); }
    void text(const char* style, double x, double y, const std::string& what, const char* anchor = "start") {
        add(svg_text(style, x, y, what, anchor));
    }

    void defs() {
        add(fmt::format(
            "<defs>\n"
            "<pattern id=\"hatch-{0}\" width=\"9\" height=\"9\" patternUnits=\"userSpaceOnUse\" "
            "patternTransform=\"rotate(45)\"><line class=\"hatch\" x1=\"0\" y1=\"0\" x2=\"0\" y2=\"9\"/></pattern>\n"
            "<pattern id=\"dots-{0}\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\"><circle class=\"dot\" "
            "cx=\"3\" cy=\"3\" r=\"1.3\"/></pattern>\n</defs>\n",
            escape_html(space_.name)));
    }

    void grid() {
        add(frame_.background());
        if (!flat_) {  // what no clip covers, within the limits of the axes
            const double a = px(frame_.across.low), b = px(frame_.across.high);
            add(
                fmt::format("<rect fill=\"url(#hatch-{})\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
                            "height=\"{:.1f}\"/>\n",
                            escape_html(space_.name), std::min(a, b), py(frame_.up.high), std::fabs(b - a),
                            py(frame_.up.low) - py(frame_.up.high)));
        }
        add(frame_.grid());
    }

    void triangles() {
        std::map<std::set<std::string>, const Finding*> acute;
        for (const Finding& finding : project_.findings)
            if (finding.rule == "acute-triangle" && finding.space == space_.name)
                acute[{finding.clips.begin(), finding.clips.end()}] = &finding;
        std::vector<std::pair<const Finding*, std::string>> slivers;
        for (const Simplex& simplex : space_.space.simplices) {
            std::string points;
            std::set<std::string> names;
            for (int k = 0; k <= k_max_dimensions && simplex[k] >= 0; ++k) {
                points += fmt::format("{:.1f},{:.1f} ", sample_x(simplex[k]), sample_y(simplex[k]));
                names.insert(project_.clips[space_.clips[space_.space.original(simplex[k])]].name);
                for (int j = 0; j < k; ++j)
                    segments_.push_back(
                        {sample_x(simplex[j]), sample_y(simplex[j]), sample_x(simplex[k]), sample_y(simplex[k])});
            }
            add(fmt::format("<polygon class=\"triangle\" points=\"{}\"/>\n", points));
            if (const auto found = acute.find(names); found != acute.end())
                slivers.emplace_back(found->second, fmt::format("<polygon class=\"acute\" points=\"{0}\"/><polygon "
                                                                "fill=\"url(#dots-{1})\" points=\"{0}\"/>",
                                                                points, escape_html(space_.name)));
        }
        for (const auto& [finding, mark] : slivers) spot(*finding, mark);
    }

    void axes() {
        line(up_slot_ < 0 ? "zero missing" : "zero", px(0), py(frame_.low_y), px(0), py(frame_.high_y));
        line(across_slot_ < 0 ? "zero missing" : "zero", px(frame_.low_x), py(0), px(frame_.high_x), py(0));
    }

    void edges_of_findings() {
        segments_.push_back({px(0), py(frame_.low_y), px(0), py(frame_.high_y)});
        segments_.push_back({px(frame_.low_x), py(0), px(frame_.high_x), py(0)});
        // Broad bands first, so that an edge which also crosses an axis shows both.
        for (const Finding& finding : project_.findings)
            if (int a, b; finding.rule == "opposite-directions" && edge_of(finding, a, b))
                spot(finding, edge("opposite", a, b));
        for (const Finding& finding : project_.findings) {
            int a, b;
            if (!edge_of(finding, a, b)) continue;
            if (finding.rule == "dissimilar-neighbours") spot(finding, edge("dissimilar", a, b));
            if (finding.rule != "crossing-axis") continue;
            SpacePoint at{};
            std::copy_n(finding.at.begin(), std::min(finding.at.size(), at.size()), at.begin());
            const double x = px(value_x(at)), y = py(value_y(at));
            spot(finding, edge("crossing", a, b) + svg_line("cross", x - 6, y - 6, x + 6, y + 6) +
                              svg_line("cross", x - 6, y + 6, x + 6, y - 6));
        }
    }

    /// The two samples that a finding is about, if it is about two of this space.
    bool edge_of(const Finding& finding, int& a, int& b) const {
        if (finding.space != space_.name || finding.clips.size() != 2) return false;
        a = sample_named(finding.clips[0]), b = sample_named(finding.clips[1]);
        return a >= 0 && b >= 0;
    }
    std::string edge(const char* style, int a, int b) const {
        return svg_line(style, sample_x(a), sample_y(a), sample_x(b), sample_y(b));
    }

    void close_pairs() {
        for (const Finding& finding : project_.findings) {
            int a, b;
            if ((finding.rule != "too-close" && finding.rule != "duplicate") || !edge_of(finding, a, b)) continue;
            const double x0 = sample_x(a), y0 = sample_y(a), x1 = sample_x(b), y1 = sample_y(b);
            const double dx = x1 - x0, dy = y1 - y0, length = std::sqrt(dx * dx + dy * dy), pad = k_mark + 4;
            spot(finding,
                 fmt::format("<rect class=\"close\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
                             "rx=\"{:.1f}\" transform=\"translate({:.1f} {:.1f}) rotate({:.1f})\"/>",
                             -pad, -pad, length + 2 * pad, 2 * pad, pad, x0, y0, atan2(dy, dx) * 180 / k_pi));
        }
    }

    void placeholders() {
        for (const Placeholder& placeholder : project_.placeholders) {
            double x, y;
            if (placeholder.rule == "too-close" || !placeholder_at(placeholder, x, y)) continue;
            const std::string mark = placeholder_mark(placeholder.kind, px(x), py(y));
            if (const Finding* finding = asked_by(placeholder))
                spot(*finding, mark);
            else
                add(mark);
            marks_.push_back({px(x) - 8, py(y) - 8, px(x) + 8, py(y) + 8});
        }
    }

    /// The finding that a placeholder would mend; one that no mark stands for yet.
    const Finding* asked_by(const Placeholder& placeholder) const {
        for (std::size_t i = 0; i < project_.findings.size(); ++i) {
            const Finding& finding = project_.findings[i];
            if (finding.rule == placeholder.rule && finding.space == placeholder.space && !marked_.count(i) &&
                finding.fix && finding.fix->target == placeholder.target)
                return &finding;
        }
        return nullptr;
    }

    /// Findings that name a place and have no mark of their own kind.
    void other_places() {
        for (std::size_t i = 0; i < project_.findings.size(); ++i) {
            const Finding& finding = project_.findings[i];
            if (finding.space != space_.name || finding.at.size() < space_.space.axes.size() || marked_.count(i))
                continue;
            SpacePoint at{};
            std::copy_n(finding.at.begin(), space_.space.axes.size(), at.begin());
            spot(finding, place_mark(px(value_x(at)), py(value_y(at))));
        }
    }

    void samples() {
        std::map<std::string, const Finding*> misaligned;
        for (const Finding& finding : project_.findings)
            if (finding.rule == "misaligned" && finding.space == space_.name)
                for (const std::string& clip : finding.clips) misaligned[clip] = &finding;
        const bool numbered = static_cast<std::size_t>(space_.space.original_count()) > k_most_names;
        const double radius = numbered ? 9 : k_mark;
        for (int i = 0; i < space_.space.original_count(); ++i) {
            const double x = sample_x(i), y = sample_y(i);
            const ProjectClip& clip = project_.clips[space_.clips[i]];
            if (const auto found = misaligned.find(clip.name); found != misaligned.end())
                spot(*found->second, diamond("misaligned", x, y, radius + 6));
            add(fmt::format(
                "<circle class=\"sample\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"><title>{}: {}</title>"
                "</circle>\n",
                x, y, radius, escape_html(clip.name),
                escape_html(describe_place(space_.space.axes, std::vector<float>(space_.space.samples[i].begin(),
                                                                                 space_.space.samples[i].begin() +
                                                                                     space_.space.dimensions())))));
            marks_.push_back({x - radius, y - radius, x + radius, y + radius});
            if (numbered) text("number", x, y + 3.5, std::to_string(space_.clips[i] + 1), "middle");
        }
    }

    void labels() {
        const auto count = static_cast<std::size_t>(space_.space.original_count());
        if (count > k_most_names) return;
        std::vector<int> order(count);
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
        std::sort(order.begin(), order.end(), [&](int a, int b) {
            return std::pair(sample_y(a), sample_x(a)) < std::pair(sample_y(b), sample_x(b));
        });
        std::vector<LabelRequest> requests;
        for (const int i : order) {
            const std::string name = shortened(project_.clips[space_.clips[i]].name, 22);
            requests.push_back({name, sample_x(i), sample_y(i), k_mark, 11.5});
        }
        const Box frame{frame_.left + 2, frame_.top + 2, frame_.width - frame_.right - 2,
                        frame_.height - frame_.bottom - 2};
        const std::vector<PlacedLabel> placed = place_labels(requests, marks_, segments_, frame);
        for (std::size_t n = 0; n < placed.size(); ++n) {
            if (placed[n].leader) line("leader", requests[n].x, requests[n].y, placed[n].leader_x, placed[n].leader_y);
        }
        for (std::size_t n = 0; n < placed.size(); ++n) text("name", placed[n].x, placed[n].y, requests[n].text);
    }

    const Project& project_;
    const ProjectSpace& space_;
    PlotFrame frame_;
    int across_slot_ = 1, up_slot_ = 0;  // -1: the axis that a 1-D space does not have
    bool flat_ = false;
    std::vector<Box> marks_;
    std::set<std::size_t> marked_;  // findings that have a mark
    std::vector<Segment> segments_;
    std::string out_;
};

}  // namespace

std::string diamond(const char* style, double x, double y, double radius) {
    return fmt::format("<polygon class=\"{}\" points=\"{:.1f},{:.1f} {:.1f},{:.1f} {:.1f},{:.1f} {:.1f},{:.1f}\"/>\n",
                       style, x, y - radius, x + radius, y, x, y + radius, x - radius, y);
}

std::string placeholder_mark(PlaceholderKind kind, double x, double y) {
    // Needed: an orange square with a cross in it; suggested: a green triangle.
    if (kind == PlaceholderKind::needed)
        return fmt::format(
            "<rect class=\"needed\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"15\" height=\"15\" rx=\"2\"/>"
            "<path class=\"plus\" d=\"M{:.1f} {:.1f}h8m-4 -4v8\"/>\n",
            x - 7.5, y - 7.5, x - 4, y);
    return fmt::format("<polygon class=\"suggested\" points=\"{:.1f},{:.1f} {:.1f},{:.1f} {:.1f},{:.1f}\"/>\n", x,
                       y - 9, x + 8.5, y + 6.5, x - 8.5, y + 6.5);
}

std::string place_mark(double x, double y) {
    return fmt::format("<path class=\"place\" d=\"M{:.1f} {:.1f}l-7 -12a8 8 0 1 1 14 0z\"/>\n", x, y);
}

std::string space_svg(const Project& project, const ProjectSpace& space, double width, double height) {
    return Chart(project, space, width, height).draw();
}

}  // namespace surefoot
