#pragma once
// The paper that spaces are drawn on: two axes with grid, ticks and titles, and from their units to pixels. What goes
// to the character's left is drawn on the left: such axes run from right to left. Private to the room.

#include <surefoot/space/blend_space.h>

#include <string>

namespace surefoot {

std::string svg_line(const char* style, double x0, double y0, double x1, double y1);
std::string svg_text(const char* style, double x, double y, const std::string& text, const char* anchor = "start");

struct PlotFrame {
    Axis across, up;
    double width = 880, height = 620;                     ///< [px] of the whole drawing
    double low_x = 0, high_x = 1, low_y = 0, high_y = 1;  ///< what is shown, in axis units
    bool has_across = true, has_up = true;                ///< false: an axis that no clip differs in
    double left = 70, right = 26, top = 20, bottom = 58;  ///< [px] room for ticks and titles, and whatever else

    /// Makes room for a point, then (once, at the end) for a margin around all.
    void include(double x, double y);
    void add_margin();

    double x(double value) const;  ///< [px]
    double y(double value) const;

    std::string background() const;
    std::string grid() const;  ///< lines and tick numbers
    std::string titles() const;
};

}  // namespace surefoot
