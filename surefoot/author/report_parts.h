#pragma once
// The parts of the report's page, as HTML. Private to the room.

#include <surefoot/author/clip_figures.h>
#include <surefoot/author/report.h>

#include <string>
#include <string_view>

namespace surefoot {

/// "1 clip", "3 clips".
std::string counted(std::size_t count, const char* one, const char* many);

/// A space: its drawing, legend, place of the preview, heat maps, and the clips that it lacks.
std::string space_section(const Project& project, std::size_t space, bool with_preview);
/// What the drawing of a space (space_svg) shows, mark by mark.
std::string space_legend(const Project& project, const ProjectSpace& space, std::string_view drawing);

/// Heat maps of what the probe found in a space; empty where nobody probed.
std::string probe_section(const Project& project, const ProjectSpace& space);

/// Findings by rule, the worst first, each linked with its marks in the drawings.
std::string findings_section(const Project& project);

/// What was repaired and how to take it back; empty where nothing was.
std::string repairs_section(const Project& project);

/// The clips of the spaces with their plots, and those that were left out.
std::string clips_section(const Project& project, const ClipFigures& figures);
std::string left_out_section(const Project& project, const ReportExtras& extras);

/// Foot heights and contacts over the clip, and its phase over time, as two small SVGs.
std::string foot_plot(const ClipFacts& facts, const ClipFigure& figure);
std::string phase_plot(const ClipFacts& facts, const ClipFigure& figure);

/// What the page's preview plays, as JSON that is safe inside a script element; empty where there is nothing to play.
std::string preview_json(const Project& project, const ClipFigures& figures);

}  // namespace surefoot
