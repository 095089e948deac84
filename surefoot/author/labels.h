#pragma once
// Putting names beside points so that they cover neither each other nor what they name. Pixels, y down.

#include <string>
#include <vector>

namespace surefoot {

struct Box {
    double left = 0, top = 0, right = 0, bottom = 0;

    double overlap(const Box& other) const;
    bool crossed_by(double x0, double y0, double x1, double y1) const;
};

struct LabelRequest {
    std::string text;
    double x = 0, y = 0;  ///< the point
    double radius = 6;    ///< of its mark
    double font_size = 11;
};

struct PlacedLabel {
    double x = 0, y = 0;  ///< baseline, left end
    Box box;
    bool leader = false;  ///< so far off that a line should lead to the point
    double leader_x = 0, leader_y = 0;
};

struct Segment {
    double x0, y0, x1, y1;
};

/// A name of at most that many characters: what names differ in stands mostly at their ends, so the middle goes.
std::string shortened(const std::string& name, std::size_t longest);

/// Width of a text in a sans-serif font, near enough for layout.
double text_width(const std::string& text, double font_size);

/// A place for each label inside `frame`: greedy, in order, by least overlap with marks, earlier labels and `lines`.
std::vector<PlacedLabel> place_labels(const std::vector<LabelRequest>& labels, const std::vector<Box>& marks,
                                      const std::vector<Segment>& lines, const Box& frame);

}  // namespace surefoot
