#pragma once
// Walks as rows: for a terminal, for documents, for scripts. All are made from `walk_figures`.

#include <surefoot/course/figures.h>

#include <span>
#include <string>

namespace surefoot {

enum class TableLayout {
    one_walk,  ///< rows are the modes of one walk
    many       ///< rows begin with course, path, speed and direction
};

/// Lines of text, two of heads first. What misses its mark has a ! behind it, in rows that are judged.
std::string walk_table(std::span<const MeasuredWalk> rows, TableLayout layout);

/// The same as a Markdown table; misses are bold.
std::string walk_markdown(std::span<const MeasuredWalk> rows);

/// How many judged walks over each course miss each mark, in brackets: in how many of them the clip itself does on flat
/// ground. As text or Markdown.
std::string misses_table(std::span<const MeasuredWalk> rows, bool markdown);

/// {"key": value, …, "misses": ["key", …], "clip_misses": those of them that the clip itself misses}; null for what is
/// no number.
std::string figures_json(const MeasuredWalk& row);

/// {"course", "reverse", "path", "speed_mps", "seconds", "rows": {"none": …, "colvin2013": …, "surefoot": …}}: the rows
/// of one walk.
std::string walk_json(std::span<const MeasuredWalk> rows);

/// A string or number of JSON: six significant digits, more says nothing about feet.
std::string json_quoted(const std::string& text);
std::string json_number(double x);

}  // namespace surefoot
