#pragma once
// Colours and marks that the report's drawing, legend and lists share. Private to the room.

#include <surefoot/author/finding.h>

#include <string>

namespace surefoot {

std::string diamond(const char* style, double x, double y, double radius);
std::string placeholder_mark(PlaceholderKind kind, double x, double y);

/// The style sheet of page and drawing: light and dark, and plain light for print.
const char* report_style();

}  // namespace surefoot
