#include <surefoot/gait_text/gait.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace surefoot {

namespace {

constexpr int k_columns = 4;
constexpr double k_panel_width = 250, k_panel_height = 96, k_margin = 16, k_head = 44;  // [px]

double at(const Gait& gait, const GaitTable& table, std::size_t row, std::size_t output) {
    return table.values[row * gait.outputs.size() + output];
}

/// One output's curve in a box of its own, with its range in words.
std::string panel(const Gait& gait, const GaitTable& table, std::size_t output, double left, double top) {
    double low = 0, high = 0;
    for (std::size_t row = 0; row < table.times_s.size(); ++row) {
        const double value = at(gait, table, row, output);
        low = row == 0 ? value : std::min(low, value);
        high = row == 0 ? value : std::max(high, value);
    }
    const double width = k_panel_width - k_margin, bottom = top + k_panel_height - k_margin, room = k_panel_height - 44;
    const double span = high - low, last = std::max(table.times_s.back(), 1e-9);
    std::string svg;
    const auto out = std::back_inserter(svg);
    fmt::format_to(out,
                   "<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"{:.0f}\" height=\"{:.0f}\" class=\"box\"/>"
                   "<text x=\"{:.0f}\" y=\"{:.0f}\" class=\"name\">{}</text>"
                   "<text x=\"{:.0f}\" y=\"{:.0f}\" class=\"range\">{:.3g} … {:.3g}</text>\n",
                   left, top + 18, width, bottom - top - 18, left, top + 12, gait.outputs[output].name, left + width,
                   top + 12, low, high);
    const auto y = [&](double value) { return bottom - 5 - (span > 0 ? (value - low) / span : 0.5) * room; };
    if (low < 0 && high > 0)
        fmt::format_to(out, "<path d=\"M{:.1f} {:.1f}h{:.1f}\" class=\"zero\"/>\n", left, y(0), width);
    svg += "<path class=\"curve\" d=\"";
    for (std::size_t row = 0; row < table.times_s.size(); ++row)
        fmt::format_to(out, "{}{:.1f} {:.1f}", row == 0 ? 'M' : 'L', left + width * table.times_s[row] / last,
                       y(at(gait, table, row, output)));
    return svg + "\"/>\n";
}

}  // namespace

GaitTable sample_gait(const Gait& gait, std::span<const double> values, const GaitMoments& moments) {
    GaitTable table;
    table.period_s = gait_period(gait, values, moments.speed_mps, moments.turn_deg_s, moments.slope_deg);
    const int rows = moments.frames > 0 ? moments.frames : moments.steps + 1;
    std::vector<double> out(gait.program.outputs.size());
    for (int row = 0; row < rows; ++row) {
        const double time = moments.frames > 0 ? row / k_gait_frames_per_second : table.period_s * row / moments.steps;
        const double phase = time / table.period_s - std::floor(time / table.period_s);
        const double inputs[k_gait_inputs] = {time, phase, moments.speed_mps, moments.turn_deg_s, moments.slope_deg};
        run_exactly(gait.program, inputs, values, out);
        table.times_s.push_back(time);
        table.values.insert(table.values.end(), out.begin(), out.end() - 1);  // the last is the period
    }
    return table;
}

std::string gait_table_csv(const Gait& gait, const GaitTable& table) {
    std::string csv = "T,time";
    for (const GaitOutput& output : gait.outputs) csv += "," + output.name;
    csv += "\n";
    const auto out = std::back_inserter(csv);
    for (std::size_t row = 0; row < table.times_s.size(); ++row) {
        fmt::format_to(out, "{},{}", table.times_s[row] * k_gait_frames_per_second, table.times_s[row]);
        for (std::size_t o = 0; o < gait.outputs.size(); ++o) fmt::format_to(out, ",{}", at(gait, table, row, o));
        csv += "\n";
    }
    return csv;
}

std::string gait_table_json(const Gait& gait, const GaitTable& table) {
    nlohmann::ordered_json json;
    json["gait"] = gait.name;
    json["period_s"] = table.period_s;
    json["time_s"] = table.times_s;
    json["outputs"] = nlohmann::ordered_json::array();
    for (std::size_t o = 0; o < gait.outputs.size(); ++o) {
        std::vector<double> column;
        for (std::size_t row = 0; row < table.times_s.size(); ++row) column.push_back(at(gait, table, row, o));
        json["outputs"].push_back({{"name", gait.outputs[o].name},
                                   {"control", gait.outputs[o].control},
                                   {"unit", gait.outputs[o].unit},
                                   {"values", std::move(column)}});
    }
    return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string gait_table_svg(const Gait& gait, const GaitTable& table) {
    std::vector<std::size_t> shown;
    for (std::size_t o = 0; o < gait.outputs.size(); ++o)
        if (gait.outputs[o].control) shown.push_back(o);
    const auto rows = (static_cast<int>(shown.size()) + k_columns - 1) / k_columns;
    const double width = k_margin + k_columns * k_panel_width, height = k_head + rows * k_panel_height + 6;
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
        "height=\"{1:.0f}\">\n"
        "<style>text{{font:12px sans-serif;fill:#24323f}}.title{{font-size:15px;font-weight:600}}.range{{fill:#6b7a88;"
        "text-anchor:end;font-size:11px}}.box{{fill:#f4f7fa}}.zero{{stroke:#c3ced8;fill:none}}.curve{{stroke:#1f6fb2;"
        "stroke-width:1.6;fill:none;stroke-linejoin:round}}</style>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
        "<text x=\"{2:.0f}\" y=\"26\" class=\"title\">{3}, {4:.3g} s</text>\n",
        width, height, k_margin, gait.name.empty() ? "gait" : gait.name, table.times_s.back());
    for (std::size_t i = 0; i < shown.size(); ++i)
        svg += panel(gait, table, shown[i], k_margin + static_cast<double>(i % k_columns) * k_panel_width,
                     k_head + static_cast<double>(i / k_columns) * k_panel_height);
    return svg + "</svg>\n";
}

}  // namespace surefoot
