#pragma once
// The report: one HTML page that opens from disk without a network, for a person to read, to play with and to print.

#include <surefoot/author/clip_figures.h>
#include <surefoot/author/project.h>

#include <span>
#include <string>

namespace surefoot {

struct ReportExtras {
    std::vector<std::string> failed;       ///< files that could not be read, with the reason
    std::vector<std::string> warnings;     ///< of this run
    const ClipFigures* figures = nullptr;  ///< for plots and preview; without them the page has neither
};

/// The page as text: each space drawn with its triangles, findings and placeholders, a figure that plays any blend of
/// it, what the probe found; the findings; the clips with plots; what was left out. Names and texts are escaped. The
/// page refers to no other file, and its content security policy lets nothing run but its own script and style sheet;
/// without scripts it still shows all but the preview. The same input gives the same bytes.
std::string report_html(const Project& project, const ReportExtras& extras = {});

/// One space as a stand-alone SVG drawing, `width` by `height` pixels.
std::string space_svg(const Project& project, const ProjectSpace& space, double width = 880, double height = 620);

/// Text made safe for HTML and XML.
std::string escape_html(std::string_view text);

}  // namespace surefoot
