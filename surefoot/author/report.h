#pragma once
// The report: one HTML page that opens from disk without a network, for a person to read or print.

#include <surefoot/author/project.h>

#include <span>
#include <string>

namespace surefoot {

struct ReportExtras {
    std::vector<std::string> failed;    ///< files that could not be read, with the reason
    std::vector<std::string> warnings;  ///< of this run
};

/// The page as text: each space drawn with its triangles, findings and placeholders; the clips; what was left out. All
/// names and texts are escaped; the page contains no script and refers to no other file.
std::string report_html(const Project& project, const ReportExtras& extras = {});

/// One space as a stand-alone SVG drawing, `width` by `height` pixels.
std::string space_svg(const Project& project, const ProjectSpace& space, double width = 880, double height = 620);

/// Text made safe for HTML and XML.
std::string escape_html(std::string_view text);

}  // namespace surefoot
