#pragma once
// Marks that the report's drawing, legend and lists share, and the texts that its page carries. Private to the room.

#include <surefoot/author/finding.h>

#include <string>

namespace surefoot {

std::string diamond(const char* style, double x, double y, double radius);
std::string placeholder_mark(PlaceholderKind kind, double x, double y);
/// A pin whose tip is at (x, y).
std::string place_mark(double x, double y);

/// report.css, and the report_*.js one after the other: embedded by cmake/SurefootEmbed.cmake.
const char* report_style();
const char* report_script();
/// Their hashes in hexadecimal, for the page's content security policy.
const char* report_style_sha256();
const char* report_script_sha256();

}  // namespace surefoot
