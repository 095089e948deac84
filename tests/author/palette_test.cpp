// The report's colours, as eyes see them: contrasts by WCAG 2.2 (1.4.3 and 1.4.11), and differences as colour-blind
// eyes see them (Machado, Oliveira and Fernandes 2009, full severity). A palette that is known to be bad must be found
// out.
#include "support.h"

#include <surefoot/author/heat.h>
#include <surefoot/author/report_parts.h>
#include <surefoot/author/report_style.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <regex>
#include <set>

namespace surefoot {
namespace {

using Colour = std::array<double, 3>;  // linear RGB, 0 to 1
using Palette = std::map<std::string, Colour>;

Colour parse_colour(const std::string& hex) {
    Colour colour;
    for (std::size_t k = 0; k < 3; ++k) {
        const double v = std::stoi(hex.substr(1 + 2 * k, 2), nullptr, 16) / 255.0;
        colour[k] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    }
    return colour;
}

double luminance(const Colour& c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

double contrast(const Colour& a, const Colour& b) {
    const double la = luminance(a) + 0.05, lb = luminance(b) + 0.05;
    return la > lb ? la / lb : lb / la;
}

/// CIE L*a*b* under D65.
Colour lab(const Colour& c) {
    const double xyz[3] = {(0.4124 * c[0] + 0.3576 * c[1] + 0.1805 * c[2]) / 0.9505, luminance(c),
                           (0.0193 * c[0] + 0.1192 * c[1] + 0.9505 * c[2]) / 1.089};
    double f[3];
    for (int k = 0; k < 3; ++k) f[k] = xyz[k] > 0.008856 ? std::cbrt(xyz[k]) : 7.787 * xyz[k] + 16.0 / 116;
    return {116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

struct Vision {
    const char* name;
    double m[3][3];
};
constexpr Vision k_visions[] = {
    {"full colour", {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
    {"protanopia", {{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}},
    {"deuteranopia",
     {{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}},
    {"tritanopia", {{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}},
};

Colour seen(const Colour& c, const Vision& vision) {
    Colour result{};
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t k = 0; k < 3; ++k) result[r] += vision.m[r][k] * c[k];
        result[r] = std::min(std::max(result[r], 0.0), 1.0);
    }
    return result;
}

double difference(const Colour& a, const Colour& b, const Vision& vision) {
    const Colour x = lab(seen(a, vision)), y = lab(seen(b, vision));
    return std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]);
}

constexpr double k_text = 4.5, k_graphics = 3;
constexpr double k_told_apart = 20;  // CIE76; about 2.3 can just be seen side by side

/// What is wrong with a palette of the report, a sentence each.
std::vector<std::string> problems_of(const Palette& palette) {
    std::vector<std::string> problems;
    const auto need = [&](std::vector<std::string> over, std::vector<std::string> under, double least) {
        for (const std::string& a : over)
            for (const std::string& b : under) {
                const double ratio = contrast(palette.at(a), palette.at(b));
                if (ratio < least)
                    problems.push_back(a + " on " + b + ": contrast " + std::to_string(ratio) + " of " +
                                       std::to_string(least));
            }
    };
    need({"ink", "soft", "info"}, {"paper", "card", "mesh"}, k_text);  // mesh: names, and findings that are lit
    need({"error", "warning"}, {"paper", "card"}, k_text);
    need({"halo"}, {"sample", "needed"}, k_text);  // numbers and the cross inside a mark
    need({"sample", "error", "warning", "info", "close", "needed", "suggested", "edge", "live"}, {"card", "mesh"},
         k_graphics);
    need({"left", "right", "limb", "edge"}, {"card", "paper"}, k_graphics);
    need({"focus"}, {"paper", "card", "mesh"}, k_graphics);
    // The figure's legs differ by colour (and by letters at the feet).
    for (const auto& [a, b] : {std::pair("left", "right"), std::pair("left", "limb"), std::pair("right", "limb")})
        for (const Vision& vision : k_visions)
            if (const double d = difference(palette.at(a), palette.at(b), vision); d < k_told_apart)
                problems.push_back(std::string(a) + " against " + b + " with " + vision.name + ": only " +
                                   std::to_string(d));
    return problems;
}

/// The colours of a style sheet: light, dark, print, in this order.
std::vector<Palette> palettes_of(const std::string& css) {
    std::vector<Palette> palettes;
    for (std::size_t at = css.find(":root {"); at != std::string::npos; at = css.find(":root {", at + 1)) {
        const std::string block = css.substr(at, css.find('}', at) - at);
        const std::regex entry("--([a-z]+):(#[0-9a-f]{6})");
        Palette palette;
        for (std::sregex_iterator i(block.begin(), block.end(), entry), end; i != end; ++i)
            palette[(*i)[1]] = parse_colour((*i)[2]);
        palettes.push_back(palette);
    }
    return palettes;
}

TEST(palette, contrasts_suffice_in_light_in_dark_and_on_paper) {
    const std::vector<Palette> palettes = palettes_of(report_style());
    ASSERT_EQ(palettes.size(), 3u);
    for (std::size_t i = 0; i < palettes.size(); ++i) {
        ASSERT_EQ(palettes[i].size(), palettes[0].size()) << "every mode names every colour";
        for (const std::string& problem : problems_of(palettes[i])) ADD_FAILURE() << "palette " << i << ": " << problem;
    }
}

TEST(palette, pale_text_and_red_against_green_are_found_out) {
    Palette pale = palettes_of(report_style())[0];
    pale["soft"] = parse_colour("#a0a0a0");
    EXPECT_EQ(problems_of(pale).size(), 3u);
    Palette red_green = palettes_of(report_style())[0];
    red_green["left"] = parse_colour("#2f8f2f"), red_green["right"] = parse_colour("#b5651d");
    bool found = false;
    for (const std::string& problem : problems_of(red_green))
        found |= problem.find("left against right with deuteranopia") == 0;
    EXPECT_TRUE(found);
}

// --- marks

struct Mark {
    std::string meaning;
    std::string shape;                 ///< all that is seen of it but colour
    std::vector<std::string> colours;  ///< names of the palette
};

/// What a class says of shape (dashes, widths, filled or not), and which colours it takes.
void add_class(const std::string& css, const std::string& name, Mark& mark) {
    std::smatch rule;
    if (!std::regex_search(css, rule, std::regex("\n\\." + name + " \\{([^}]*)\\}"))) return;
    const std::string body = rule[1];
    const std::regex property("([a-z-]+): ([^;]+);"), paint("var\\(--([a-z]+)\\)");
    for (std::sregex_iterator i(body.begin(), body.end(), property), end; i != end; ++i) {
        const std::string key = (*i)[1], value = (*i)[2];
        std::smatch colour;
        if (!std::regex_search(value, colour, paint))
            mark.shape += key + "=" + value + " ";
        else if (colour[1] == "halo")
            mark.shape += key + "=background ";
        else
            mark.shape += key + "=paint ", mark.colours.push_back(colour[1]);
    }
}

/// The marks of a legend: an svg and what it means, each.
std::vector<Mark> marks_of(const std::string& html, const std::string& css) {
    std::vector<Mark> marks;
    const std::regex item("<li><svg[^>]*>(.*?)</svg>([^<]*)</li>"), element("<([a-z]+) class=\"([a-z -]+)\"([^>]*)>");
    std::string flat = html;
    std::replace(flat.begin(), flat.end(), '\n', ' ');
    for (std::sregex_iterator i(flat.begin(), flat.end(), item), end; i != end; ++i) {
        Mark mark{(*i)[2], {}, {}};
        const std::string inside = (*i)[1];
        for (std::sregex_iterator e(inside.begin(), inside.end(), element); e != end; ++e) {
            mark.shape += std::string((*e)[1]) + (*e)[3].str() + " ";
            add_class(css, (*e)[2], mark);
        }
        marks.push_back(mark);
    }
    return marks;
}

/// Pairs that nothing but colour tells apart, where that colour does not suffice.
std::vector<std::string> confusions(const std::vector<Mark>& marks, const Palette& palette) {
    std::vector<std::string> found;
    for (std::size_t i = 0; i < marks.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            if (marks[i].shape != marks[j].shape) continue;
            bool differ = false;
            for (std::size_t k = 0; k < std::min(marks[i].colours.size(), marks[j].colours.size()) && !differ; ++k) {
                const Colour &a = palette.at(marks[i].colours[k]), &b = palette.at(marks[j].colours[k]);
                differ = std::all_of(std::begin(k_visions), std::end(k_visions),
                                     [&](const Vision& v) { return difference(a, b, v) >= k_told_apart; });
            }
            if (!differ) found.push_back(marks[i].meaning + " and " + marks[j].meaning);
        }
    return found;
}

/// A space in which every kind of mark occurs.
Project full_of_problems() {
    Project project = test::make_plane({test::make_clip("a", 0, 0), test::make_clip("b", 1.4f, 0),
                                        test::make_clip("c", 1, 60), test::make_clip("d", 1, -60)},
                                       0, 2, 90);
    for (const char* rule : {"crossing-axis", "opposite-directions", "acute-triangle", "misaligned", "too-close",
                             "duplicate", "dissimilar-neighbours", "some-other-rule"}) {
        Finding finding;
        finding.rule = rule, finding.space = "facing", finding.at = {1, 0};
        finding.clips = {"b", "c"};
        project.findings.push_back(finding);
    }
    for (const PlaceholderKind kind : {PlaceholderKind::needed, PlaceholderKind::suggested})
        project.placeholders.push_back({"facing", kind, {"speed", "turn"}, {1, 90}, "uncovered", "a clip"});
    return project;
}

TEST(palette, no_two_marks_differ_by_colour_alone) {
    const Project project = full_of_problems();
    const std::vector<Mark> marks =
        marks_of(space_legend(project, project.spaces[0], space_svg(project, project.spaces[0])), report_style());
    ASSERT_EQ(marks.size(), 12u);
    for (const Mark& mark : marks) EXPECT_FALSE(mark.colours.empty()) << mark.meaning;
    std::set<std::string> shapes;
    for (const Mark& mark : marks) EXPECT_TRUE(shapes.insert(mark.shape).second) << mark.meaning << ": " << mark.shape;
    ClipFigures none;
    const std::vector<Mark> feet = marks_of(clips_section(project, none), report_style());
    ASSERT_EQ(feet.size(), 5u);
    for (const Mark& mark : feet) EXPECT_TRUE(shapes.insert(mark.shape).second) << mark.meaning << ": " << mark.shape;
}

TEST(palette, equal_marks_in_red_and_green_are_found_out) {
    const std::string css =
        "\n.good { stroke: var(--left); }\n.bad { stroke: var(--right); }\n.dashed { stroke: var(--right); "
        "stroke-dasharray: 2 3; }\n";
    const std::string line = "<li><svg><line class=\"";
    const Palette palette{{"left", parse_colour("#2f8f2f")}, {"right", parse_colour("#b5651d")}};
    EXPECT_EQ(
        confusions(marks_of(line + "good\"/></svg>good</li>" + line + "bad\"/></svg>bad</li>", css), palette).size(),
        1u);
    EXPECT_TRUE(confusions(marks_of(line + "good\"/></svg>good</li>" + line + "dashed\"/></svg>bad</li>", css), palette)
                    .empty());
}

TEST(palette, the_heat_scale_rises_evenly_to_every_eye) {
    const auto scale = heat_scale();
    ASSERT_GE(scale.size(), 8u);
    for (const Vision& vision : k_visions)
        for (std::size_t i = 1; i < scale.size(); ++i) {
            const double step =
                lab(seen(parse_colour(scale[i]), vision))[0] - lab(seen(parse_colour(scale[i - 1]), vision))[0];
            EXPECT_GT(step, 3) << vision.name << ", step " << i;
            EXPECT_LT(step, 14) << vision.name << ", step " << i;
        }
}

}  // namespace
}  // namespace surefoot
