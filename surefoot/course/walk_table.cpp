#include <surefoot/course/walk_table.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace surefoot {
namespace {

using Out = std::back_insert_iterator<std::string>;
using Cells = std::vector<std::string>;

/// Characters shown: all UTF-8 of ours is one column a code point.
std::size_t width(const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string padded(const std::string& text, std::size_t to, bool right) {
    const std::string room(to - std::min(to, width(text)), ' ');
    return right ? room + text : text + room;
}

constexpr std::size_t k_lead_one = 1, k_lead_many = 5;  // cells before the figures

Cells lead(const MeasuredWalk& row, TableLayout layout) {
    if (layout == TableLayout::one_walk) return {foot_mode_name(row.mode)};
    return {row.info.course, row.info.path, fmt::format("{:g}", row.info.speed_mps), row.info.reverse ? "back" : "",
            foot_mode_name(row.mode)};
}

Cells heads(TableLayout layout, bool units) {
    Cells cells = layout == TableLayout::one_walk ? Cells{""} : Cells{"course", "path", "speed", "way", "mode"};
    if (units) cells = layout == TableLayout::one_walk ? Cells{""} : Cells{"", "", "m/s", "", ""};
    for (const WalkFigure& figure : walk_figures()) cells.push_back(units ? figure.unit : figure.head);
    return cells;
}

/// What is before the figures, and the figures; `miss` decorates those that miss their mark.
template <class Miss>
Cells cells_of(const MeasuredWalk& row, TableLayout layout, const Miss& miss) {
    Cells cells = lead(row, layout);
    for (const WalkFigure& figure : walk_figures())
        cells.push_back(row.judged && figure.missed(row) ? miss(figure.text(row)) : figure.text(row));
    return cells;
}

/// Lines with columns under one another; the first `leading` columns are words.
std::string aligned(const std::vector<Cells>& table, std::size_t leading) {
    std::vector<std::size_t> widths(table.front().size());
    for (const Cells& cells : table)
        for (std::size_t i = 0; i < cells.size(); ++i) widths[i] = std::max(widths[i], width(cells[i]));
    std::string out;
    for (const Cells& cells : table) {
        std::string line = " ";
        for (std::size_t i = 0; i < cells.size(); ++i) line += " " + padded(cells[i], widths[i], i >= leading);
        out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return out;
}

std::string markdown_row(const Cells& cells) {
    std::string line = "|";
    for (const std::string& cell : cells) line += " " + cell + " |";
    return line + "\n";
}

std::string markdown_head(const Cells& titles, std::size_t leading) {
    std::string out = markdown_row(titles) + "|";
    for (std::size_t i = 0; i < titles.size(); ++i) out += i < leading ? " --- |" : " --: |";
    return out + "\n";
}

/// "8 (2)": eight walks miss the mark, in two the clip itself does.
std::string miss_count(int misses, int clips) {
    if (misses == 0) return "·";
    return clips > 0 ? fmt::format("{} ({})", misses, clips) : std::to_string(misses);
}

}  // namespace

std::string walk_table(std::span<const MeasuredWalk> rows, TableLayout layout) {
    std::vector<Cells> table{heads(layout, false), heads(layout, true)};
    for (Cells& head : table)
        for (std::string& cell : head)
            if (!cell.empty()) cell += ' ';  // over the place of the !
    for (const MeasuredWalk& row : rows) {
        table.push_back(cells_of(row, layout, [](std::string text) { return text + "!"; }));
        for (std::string& cell : table.back())
            if (cell.empty() || cell.back() != '!') cell += ' ';
    }
    return aligned(table, layout == TableLayout::one_walk ? k_lead_one : k_lead_many);
}

std::string walk_markdown(std::span<const MeasuredWalk> rows) {
    Cells titles = heads(TableLayout::many, false);
    const Cells units = heads(TableLayout::many, true);
    for (std::size_t i = 0; i < titles.size(); ++i)
        if (!units[i].empty()) titles[i] += " " + units[i];
    std::string out = markdown_head(titles, k_lead_many);
    for (const MeasuredWalk& row : rows)
        out +=
            markdown_row(cells_of(row, TableLayout::many, [](const std::string& text) { return "**" + text + "**"; }));
    return out;
}

std::string misses_table(std::span<const MeasuredWalk> rows, bool markdown) {
    std::vector<Cells> table{{"course", "walks", "meet all", "but the clip's"}};
    for (const WalkFigure& figure : walk_figures())
        if (figure.mark) table[0].push_back(figure.head);
    for (const CourseMisses& course : misses_by_course(rows)) {
        table.push_back({course.course, std::to_string(course.walks), std::to_string(course.perfect),
                         std::to_string(course.as_clip)});
        for (std::size_t i = 0; i < course.misses.size(); ++i)
            if (walk_figures()[i].mark) table.back().push_back(miss_count(course.misses[i], course.clips[i]));
    }
    if (!markdown) return aligned(table, 1);
    std::string out = markdown_head(table[0], 1);
    for (std::size_t i = 1; i < table.size(); ++i) out += markdown_row(table[i]);
    return out;
}

std::string json_quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            (out += '\\') += c;
        else if (static_cast<unsigned char>(c) < 0x20)
            fmt::format_to(Out(out), "\\u{:04x}", static_cast<unsigned>(c));
        else
            out += c;
    }
    return out + "\"";
}

std::string json_number(double x) { return std::isfinite(x) ? fmt::format("{:.6g}", x) : "null"; }

std::string figures_json(const MeasuredWalk& row) {
    std::string out = "{", misses, clips;
    for (const WalkFigure& figure : walk_figures()) {
        fmt::format_to(Out(out), "\"{}\": {}, ", figure.key, json_number(figure.value(row)));
        if (!figure.missed(row)) continue;
        fmt::format_to(Out(misses), "{}\"{}\"", misses.empty() ? "" : ", ", figure.key);
        if (figure.missed_by_clip(row)) fmt::format_to(Out(clips), "{}\"{}\"", clips.empty() ? "" : ", ", figure.key);
    }
    const WalkMetrics& m = row.metrics;
    return out + fmt::format("\"penetration_max_cm\": {}, \"misses\": [{}], \"clip_misses\": [{}]}}",
                             json_number(m.penetration_max_cm), misses, clips);
}

std::string walk_json(std::span<const MeasuredWalk> rows) {
    if (rows.empty()) return "{\"rows\": {}}\n";
    const WalkInfo& info = rows.front().info;
    std::string out =
        fmt::format("{{\"course\": {}, \"reverse\": {}, \"path\": {}, \"speed_mps\": {}, \"seconds\": {}, \"rows\": {{",
                    json_quoted(info.course), info.reverse, json_quoted(info.path),
                    json_number(static_cast<double>(info.speed_mps)), json_number(static_cast<double>(info.seconds)));
    for (const MeasuredWalk& row : rows)
        fmt::format_to(Out(out), "{}\n  \"{}\": {}", &row == &rows.front() ? "" : ",", foot_mode_name(row.mode),
                       figures_json(row));
    return out + "\n}}\n";
}

}  // namespace surefoot
