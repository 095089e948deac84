#include <surefoot/author/labels.h>
#include <surefoot/math/trig.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

std::string shortened(const std::string& name, std::size_t longest) {
    if (name.size() <= longest) return name;
    const auto is_inside = [&](std::size_t at) { return (static_cast<unsigned char>(name[at]) & 0xc0u) == 0x80u; };
    std::size_t head = longest / 2, tail = name.size() - (longest - 1 - head);
    while (head > 0 && is_inside(head)) --head;
    while (tail < name.size() && is_inside(tail)) ++tail;
    return name.substr(0, head) + "\xe2\x80\xa6" + name.substr(tail);
}

double Box::overlap(const Box& other) const {
    const double w = std::min(right, other.right) - std::max(left, other.left);
    const double h = std::min(bottom, other.bottom) - std::max(top, other.top);
    return w > 0 && h > 0 ? w * h : 0;
}

bool Box::crossed_by(double x0, double y0, double x1, double y1) const {
    // Clipping by Liang and Barsky: does anything of the segment remain inside?
    double from = 0, to = 1;
    const double dx = x1 - x0, dy = y1 - y0;
    const double p[4] = {-dx, dx, -dy, dy}, q[4] = {x0 - left, right - x0, y0 - top, bottom - y0};
    for (int k = 0; k < 4; ++k) {
        if (p[k] == 0) {
            if (q[k] < 0) return false;
            continue;
        }
        const double t = q[k] / p[k];
        if (p[k] < 0)
            from = std::max(from, t);
        else
            to = std::min(to, t);
    }
    return from < to;
}

double text_width(const std::string& text, double font_size) {
    double ems = 0;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if ((byte & 0xc0u) == 0x80u) continue;  // the rest of a UTF-8 character
        if (c == 'i' || c == 'l' || c == 'j' || c == '.' || c == ',' || c == '\'' || c == '|' || c == ' ')
            ems += 0.3;
        else if (c == 'm' || c == 'w' || c == 'M' || c == 'W' || byte >= 0xe0u)
            ems += 0.9;
        else if (c >= 'A' && c <= 'Z')
            ems += 0.68;
        else
            ems += 0.57;
    }
    return ems * font_size;
}

std::vector<PlacedLabel> place_labels(const std::vector<LabelRequest>& labels, const std::vector<Box>& marks,
                                      const std::vector<Segment>& lines, const Box& frame) {
    constexpr int k_directions = 16, k_rings = 4;
    constexpr double k_ring_gaps[k_rings] = {3, 12, 26, 44};
    std::vector<PlacedLabel> placed;
    for (const LabelRequest& label : labels) {
        const double w = text_width(label.text, label.font_size), h = label.font_size;
        double best_cost = 1e300;
        PlacedLabel best;
        for (int ring = 0; ring < k_rings; ++ring)
            for (int d = 0; d < k_directions; ++d) {
                const double angle = 2 * k_pi * d / k_directions, dx = cos(angle), dy = sin(angle);
                const double reach = label.radius + k_ring_gaps[ring];
                // The box touches the ring with the side or corner that faces the point.
                const double cx = label.x + dx * (reach + w / 2), cy = label.y + dy * (reach + h / 2);
                const Box box{cx - w / 2, cy - h / 2, cx + w / 2, cy + h / 2};
                // Straight to the right reads best, then left, then above and below.
                double cost = ring * 8.0 + (d == 0 ? 0 : d == k_directions / 2 ? 1.0 : 2.0);
                if (box.left < frame.left || box.right > frame.right || box.top < frame.top ||
                    box.bottom > frame.bottom)
                    cost += 1000;
                for (const Box& mark : marks) cost += 0.5 * box.overlap(mark);
                for (const PlacedLabel& other : placed) {
                    cost += 3 * box.overlap(other.box);
                    if (ring > 1 && other.box.crossed_by(label.x, label.y, cx, cy)) cost += 15;
                }
                for (const Segment& line : lines)
                    if (box.crossed_by(line.x0, line.y0, line.x1, line.y1)) cost += 5;
                if (cost >= best_cost) continue;
                best_cost = cost;
                best.box = box;
                best.x = box.left;
                best.y = box.bottom - 0.2 * h;
                best.leader = ring > 1;
                best.leader_x = std::clamp(label.x, box.left, box.right);
                best.leader_y = std::clamp(label.y, box.top, box.bottom);
            }
        placed.push_back(best);
    }
    return placed;
}

}  // namespace surefoot
