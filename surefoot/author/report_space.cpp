// A space in the report: drawing, legend, preview, heat maps, missing clips.

#include <surefoot/author/rank.h>
#include <surefoot/author/report_parts.h>
#include <surefoot/author/report_style.h>
#include <surefoot/author/space_slice_svg.h>

#include <fmt/format.h>

#include <algorithm>

namespace surefoot {
namespace {

struct LegendEntry {
    const char *rule, *text;
    std::string drawing;
};

std::string in_legend(const std::string& drawing, const std::string& text) {
    return "<li><svg viewBox=\"0 0 30 22\" aria-hidden=\"true\">" + drawing + "</svg>" + text + "</li>";
}

const std::vector<LegendEntry>& legend_entries() {
    static const std::vector<LegendEntry> entries = {
        {"crossing-axis", "crosses an axis",
         "<line class=\"crossing\" x1=\"1\" y1=\"18\" x2=\"29\" y2=\"4\"/><line class=\"cross\" x1=\"10\" y1=\"6\" "
         "x2=\"20\" y2=\"16\"/><line class=\"cross\" x1=\"10\" y1=\"16\" x2=\"20\" y2=\"6\"/>"},
        {"opposite-directions", "blends opposite directions",
         "<line class=\"opposite\" x1=\"4\" y1=\"11\" x2=\"26\" y2=\"11\"/>"},
        {"acute-triangle", "sliver",
         "<polygon class=\"acute\" points=\"1,17 29,17 23,8\"/><circle class=\"dot\" cx=\"17\" cy=\"14\" "
         "r=\"1.3\"/><circle class=\"dot\" cx=\"22\" cy=\"13\" r=\"1.3\"/>"},
        {"misaligned", "misaligned",
         diamond("misaligned", 15, 11, 9.5) + "<circle class=\"sample\" cx=\"15\" cy=\"11\" r=\"4\"/>"},
        {"too-close", "too close to each other",
         "<rect class=\"close\" x=\"2\" y=\"4\" width=\"26\" height=\"14\" rx=\"7\"/>"},
        {"duplicate", "the same clip twice",
         "<rect class=\"close\" x=\"6\" y=\"2\" width=\"18\" height=\"18\" rx=\"9\"/>"},
        {"dissimilar-neighbours", "poses far apart",
         "<line class=\"dissimilar\" x1=\"1\" y1=\"11\" x2=\"29\" y2=\"11\"/>"},
    };
    return entries;
}

bool asks_for(const Project& project, const ProjectSpace& space, PlaceholderKind kind) {
    return std::any_of(project.placeholders.begin(), project.placeholders.end(), [&](const Placeholder& p) {
        return p.kind == kind && p.space == space.name && p.rule != "too-close";
    });
}

/// The clips that a space lacks, those first that would help most.
std::string wanted(const Project& project, const ProjectSpace& space) {
    std::vector<const Placeholder*> missing;
    for (const Placeholder& placeholder : project.placeholders)
        if (placeholder.space == space.name && placeholder.rule != "too-close") missing.push_back(&placeholder);
    if (missing.empty()) return {};
    std::stable_sort(missing.begin(), missing.end(), [](const Placeholder* a, const Placeholder* b) {
        const bool needed_a = a->kind == PlaceholderKind::needed, needed_b = b->kind == PlaceholderKind::needed;
        return needed_a != needed_b ? needed_a : helps_more(*a, *b);
    });
    const Placeholder* best = most_wanted(project);
    std::string html;
    for (const Placeholder* placeholder : missing) {
        const bool needed = placeholder->kind == PlaceholderKind::needed;
        std::string worth = describe_worth(*placeholder);
        if (placeholder == best) worth = "<b>the single clip that would help most</b>: " + worth;
        html += "<li><svg viewBox=\"0 0 24 22\" aria-hidden=\"true\">" + placeholder_mark(placeholder->kind, 12, 11) +
                "</svg><span>" + escape_html(placeholder->text) + " <span class=\"count\">(" +
                (needed ? "needed" : "suggested") + ", " + escape_html(placeholder->rule) +
                (worth.empty() ? "" : "; " + worth) + ")</span></span></li>";
    }
    return "<h3>Clips that are missing</h3>\n<ul class=\"wanted\">" + html + "</ul>\n";
}

std::string slice_figure(const Project& project, const ProjectSpace& space, const SliceView& view) {
    const std::string held = escape_html(describe_slice(space.space, view));
    // On a narrow screen the drawing scrolls, by keyboard too: nothing in it takes the focus.
    return "<figure class=\"cut-through\">\n<div class=\"wide\" tabindex=\"0\" role=\"group\" aria-label=\"Slice, "
           "held: " +
           held + "\">" + space_slice_svg(project, space, view) + "</div><figcaption class=\"hint\">Held: " + held +
           "</figcaption></figure>\n";
}

/// What a drawing of all samples on one plane cannot show: slices of a space of more than two dimensions.
std::string slices(const Project& project, const ProjectSpace& space) {
    const std::vector<SliceView> views = default_slices(space.space);
    if (space.space.dimensions() < 3 || views.empty()) return {};
    constexpr std::size_t k_lead = 1;  // of the levels that come first, the middle one
    std::string html =
        "<h3>Slices</h3>\n<p>The space cut by a plane; the axes that are not drawn are held. Clips are the fainter the "
        "farther they are from the plane. The cell around the crossed ring is lit; the list says what plays "
        "there.</p>\n" +
        slice_figure(project, space, views[k_lead]) + "<details><summary>" +
        counted(views.size() - 1, "more slice", "more slices") + "</summary>\n";
    for (std::size_t v = 0; v < views.size(); ++v)
        if (v != k_lead) html += slice_figure(project, space, views[v]);
    return html + "</details>\n";
}

}  // namespace

std::string space_legend(const Project& project, const ProjectSpace& space, std::string_view drawing) {
    std::string html =
        "<ul class=\"legend\">" + in_legend("<circle class=\"sample\" cx=\"15\" cy=\"11\" r=\"6.5\"/>", "a clip");
    const auto found_here = [&](const char* rule) {
        return std::any_of(project.findings.begin(), project.findings.end(),
                           [&](const Finding& f) { return f.rule == rule && f.space == space.name; });
    };
    for (const LegendEntry& entry : legend_entries())
        if (found_here(entry.rule)) html += in_legend(entry.drawing, entry.text);
    for (const PlaceholderKind kind : {PlaceholderKind::needed, PlaceholderKind::suggested})
        if (asks_for(project, space, kind))
            html += in_legend(placeholder_mark(kind, 15, 11),
                              kind == PlaceholderKind::needed ? "a clip is needed here" : "a clip would help here");
    if (drawing.find("class=\"place\"") != std::string_view::npos)
        html += in_legend(place_mark(15, 20), "another finding");
    if (space.space.dimensions() > 1)
        html += in_legend("<path class=\"hatch\" d=\"M2 20L20 2M9 20L27 2M16 20L29 7M2 13L13 2\"/>", "not covered");
    return html + "</ul>";
}

std::string space_section(const Project& project, std::size_t index, bool with_preview) {
    const ProjectSpace& space = project.spaces[index];
    std::string axes;
    for (const Axis& axis : space.space.axes) axes += (axes.empty() ? "" : " \xc3\x97 ") + axis.name;
    std::string html = fmt::format("<section id=\"space-{}\"><h2>Space \xe2\x80\x9c{}\xe2\x80\x9d: {}</h2>\n", index,
                                   escape_html(space.name), escape_html(axes));
    const auto parts = space.space.simplices.size();
    html += fmt::format(
        "<p>{}, {}. {} blends the clips at the corners around it. Outside, it takes the nearest point.</p>\n",
        counted(space.clips.size(), "clip", "clips"),
        space.space.dimensions() == 1   ? counted(parts, "segment", "segments")
        : space.space.dimensions() == 2 ? counted(parts, "triangle", "triangles")
                                        : counted(parts, "simplex", "simplices"),
        space.name.starts_with(k_style_prefix)
            ? "Laid over the locomotion by the weight of the style, at the same point: the root goes where the "
              "locomotion takes it, the poses are more and more these. It"
            : "The character is steered by naming a point; it then");
    const std::string drawing = space_svg(project, space);
    html += "<figure>\n<div class=\"wide\">" + drawing + "</div><figcaption>" + space_legend(project, space, drawing) +
            "</figcaption>";
    if (with_preview && (space.space.weighting != Weighting::barycentric || space.space.outside != Outside::clamp))
        html +=
            "<p class=\"hint\">The preview weighs the corners of the triangle around the puck, whatever this space "
            "asks for.</p>";
    if (with_preview) html += "<div class=\"preview\" hidden></div>";
    return html + "</figure>\n" + slices(project, space) + wanted(project, space) + probe_section(project, space) +
           "</section>\n";
}

}  // namespace surefoot
