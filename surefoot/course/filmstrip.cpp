#include <surefoot/base/error.h>
#include <surefoot/course/filmstrip.h>
#include <surefoot/course/metrics.h>
#include <surefoot/ground/shapes.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace surefoot {
namespace {

constexpr float k_width = 1400, k_margin = 26;     // [px]
constexpr float k_title = 46, k_row_title = 30;    // [px] heights of text bands
constexpr float k_above = 0.06f, k_below = 0.34f;  // of the row's body: room over the head and of ground, in statures

// Where the light comes from, on the picture.
constexpr float k_light_x = -0.45f, k_light_y = -0.6f;

struct Point {
    float x = 0, y = 0;
};
struct Circle {
    Point centre;
    float radius;
};

/// Colours of one layer of the body: what is farther away is paler.
struct Paint {
    const char *limb, *trunk, *shoe;
    float shine;
};
constexpr Paint k_near{"#1f4e79", "#2f6690", "#16324f", 0.20f};
constexpr Paint k_far{"#a9bfd3", "#a9bfd3", "#8ea7bf", 0.28f};

using Out = std::back_insert_iterator<std::string>;

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '&')
            out += "&amp;";
        else
            out += c;
    }
    return out;
}

/// The outline around two circles: two arcs joined by tangents.
std::string tapered(Circle a, Circle b) {
    if (a.radius < b.radius) std::swap(a, b);
    const float dx = b.centre.x - a.centre.x, dy = b.centre.y - a.centre.y, d = std::sqrt(dx * dx + dy * dy);
    std::string path;
    if (d <= a.radius - b.radius + 1e-3f) {  // one inside the other
        fmt::format_to(Out(path), "M{:.1f} {:.1f}a{:.1f} {:.1f} 0 1 0 {:.1f} 0a{:.1f} {:.1f} 0 1 0 {:.1f} 0z",
                       a.centre.x - a.radius, a.centre.y, a.radius, a.radius, 2 * a.radius, a.radius, a.radius,
                       -2 * a.radius);
        return path;
    }
    const float ux = dx / d, uy = dy / d, c = (a.radius - b.radius) / d, s = std::sqrt(std::max(0.0f, 1 - c * c));
    const Point n{ux * c - uy * s, uy * c + ux * s}, m{ux * c + uy * s, uy * c - ux * s};
    fmt::format_to(
        Out(path), "M{:.1f} {:.1f}A{:.1f} {:.1f} 0 1 1 {:.1f} {:.1f}L{:.1f} {:.1f}A{:.1f} {:.1f} 0 0 1 {:.1f} {:.1f}z",
        a.centre.x + n.x * a.radius, a.centre.y + n.y * a.radius, a.radius, a.radius, a.centre.x + m.x * a.radius,
        a.centre.y + m.y * a.radius, b.centre.x + m.x * b.radius, b.centre.y + m.y * b.radius, b.radius, b.radius,
        b.centre.x + n.x * b.radius, b.centre.y + n.y * b.radius);
    return path;
}

/// Convex outline around circles (a shoe), by its sampled rims.
std::string hull(std::span<const Circle> circles) {
    constexpr int k_around = 14;
    std::vector<Point> points;
    for (const Circle& c : circles)
        for (int i = 0; i < k_around; ++i) {
            const float angle = static_cast<float>(2 * k_pi) * static_cast<float>(i) / k_around;
            points.push_back({c.centre.x + c.radius * cos(angle), c.centre.y + c.radius * sin(angle)});
        }
    std::sort(points.begin(), points.end(), [](Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    std::vector<Point> chain;
    const auto half = [&](auto first, auto last) {
        const std::size_t start = chain.size();
        for (auto p = first; p != last; ++p) {
            while (chain.size() >= start + 2) {
                const Point a = chain[chain.size() - 2], b = chain.back();
                if ((b.x - a.x) * (p->y - a.y) - (b.y - a.y) * (p->x - a.x) > 0) break;
                chain.pop_back();
            }
            chain.push_back(*p);
        }
        chain.pop_back();
    };
    half(points.begin(), points.end());
    half(points.rbegin(), points.rend());
    std::string path;
    for (std::size_t i = 0; i < chain.size(); ++i)
        fmt::format_to(Out(path), "{}{:.1f} {:.1f}", i ? "L" : "M", chain[i].x, chain[i].y);
    return path + "z";
}

void shape(std::string& svg, const std::string& path, const char* fill) {
    fmt::format_to(Out(svg), "<path d=\"{}\" fill=\"{}\"/>\n", path, fill);
}

/// A limb with a streak of light along its lit side.
void limb(std::string& svg, Circle a, Circle b, const char* fill, float shine) {
    shape(svg, tapered(a, b), fill);
    const auto lit = [](Circle c) {
        return Circle{{c.centre.x + k_light_x * 0.42f * c.radius, c.centre.y + k_light_y * 0.42f * c.radius},
                      c.radius * 0.42f};
    };
    fmt::format_to(Out(svg), "<path d=\"{}\" fill=\"#fff\" fill-opacity=\"{:.2f}\"/>\n", tapered(lit(a), lit(b)),
                   shine);
}

/// One row: maps the world onto the picture and draws into it.
class Row {
  public:
    Row(const Filmstrip& strip, const FilmstripRow& row, Vec3 along, float scale, float top, float low, float high,
        int index)
        : strip_(strip), row_(row), along_(along), scale_(scale), top_(top), low_(low), high_(high), index_(index) {
        world_.resize(static_cast<std::size_t>(row.walk->joint_count()));
        unit_ = strip.legs.side[0].length() * scale;
    }
    void draw(std::string& svg, const std::vector<int>& frames);
    float height() const { return k_row_title + (high_ - low_) * scale_; }

  private:
    Point at(Vec3 p) const {
        return {k_margin + (dot(p, along_) - strip_.from) * scale_, top_ + k_row_title + (high_ - p.y) * scale_};
    }
    Vec3 joint(int j) const { return world_[static_cast<std::size_t>(j)].translation; }
    Vec3 role(Role r, Vec3 otherwise) const { return strip_.roles.has(r) ? joint(strip_.roles[r]) : otherwise; }
    /// The picture shows the ground under the path; a foot beside it is shown as high above that as above its own.
    Vec3 over_path(Vec3 p, float share) const {
        const float own = height_at(*strip_.ground, p.x, p.z), s = dot(p, along_);
        const Vec3 middle = along_ * s;
        return p + k_up * (share * (height_at(*strip_.ground, middle.x, middle.z) - own));
    }
    std::string ground_path() const;
    void hips_line(std::string& svg) const;
    void leg(std::string& svg, std::size_t side, const Paint& paint);
    void arm(std::string& svg, bool left, const Paint& paint) const;
    void trunk(std::string& svg) const;

    const Filmstrip& strip_;
    const FilmstripRow& row_;
    Vec3 along_;
    float scale_, top_, low_, high_, unit_ = 1;
    int index_;
    std::vector<Transform> world_;
    std::string shoes_;  // paths of all shoes, for showing what is inside the ground
};

std::string Row::ground_path() const {
    constexpr float step = 2;  // [px]
    std::string path;
    const float bottom = top_ + height();
    fmt::format_to(Out(path), "M{:.1f} {:.1f}", k_margin, bottom);
    for (float x = 0; x <= strip_.length * scale_ + 0.5f; x += step) {
        const Vec3 place = along_ * (strip_.from + x / scale_);
        const Point p = at({place.x, height_at(*strip_.ground, place.x, place.z), place.z});
        fmt::format_to(Out(path), "L{:.1f} {:.1f}", p.x, std::min(p.y, bottom));
    }
    fmt::format_to(Out(path), "L{:.1f} {:.1f}z", k_margin + strip_.length * scale_, bottom);
    return path;
}

void Row::leg(std::string& svg, std::size_t side, const Paint& paint) {
    const Leg& leg = strip_.legs.side[side];
    const auto& foot = world_[static_cast<std::size_t>(leg.foot)];
    const auto& toes = world_[static_cast<std::size_t>(leg.toes == k_no_joint ? leg.foot : leg.toes)];
    const SolePoints sole = sole_points(leg, foot, toes);
    const float u = unit_;
    const Point hip = at(joint(leg.upper)), knee = at(over_path(joint(leg.lower), 0.5f)),
                ankle = at(over_path(foot.translation, 1));
    limb(svg, {hip, 0.105f * u}, {knee, 0.068f * u}, paint.limb, paint.shine);
    limb(svg, {knee, 0.066f * u}, {ankle, 0.042f * u}, paint.limb, paint.shine);
    // Circles that touch the sole from above; the toes' own frame says nothing of up, their line does.
    const auto above = [&](Vec3 p, Vec3 up, float radius) {
        return Circle{at(over_path(p, 1) + up * (radius / scale_)), radius};
    };
    const Vec3 foot_up = rotate(foot.rotation, leg.up), toe = normalized(sole.toe_tip - sole.ball);
    const Vec3 toe_up = normalized(k_up - toe * dot(toe, k_up), foot_up);
    const Circle heel = above(sole.heel, foot_up, 0.030f * u), ball = above(sole.ball, foot_up, 0.034f * u),
                 tip = above(sole.toe_tip, toe_up, 0.020f * u);
    const std::array<Circle, 3> back{Circle{ankle, 0.046f * u}, heel, ball};
    const std::string shoe = hull(back), cap = tapered(ball, tip);
    shape(svg, shoe, paint.shoe);
    shape(svg, cap, paint.shoe);
    shoes_ += shoe + cap;
}

void Row::arm(std::string& svg, bool left, const Paint& paint) const {
    const Role upper = left ? Role::left_upper_arm : Role::right_upper_arm,
               lower = left ? Role::left_lower_arm : Role::right_lower_arm,
               hand = left ? Role::left_hand : Role::right_hand;
    if (!strip_.roles.has(upper) || !strip_.roles.has(lower)) return;
    const float u = unit_;
    const Vec3 elbow = joint(strip_.roles[lower]), shoulder = joint(strip_.roles[upper]);
    const Vec3 wrist = role(hand, elbow + (elbow - shoulder) * 0.85f);
    limb(svg, {at(shoulder), 0.062f * u}, {at(elbow), 0.046f * u}, paint.limb, paint.shine);
    limb(svg, {at(elbow), 0.045f * u}, {at(wrist), 0.030f * u}, paint.limb, paint.shine);
    const Vec3 palm = wrist + normalized(wrist - elbow) * (0.07f * unit_ / scale_);
    limb(svg, {at(wrist), 0.032f * u}, {at(palm), 0.034f * u}, paint.shoe, paint.shine);
}

void Row::trunk(std::string& svg) const {
    const float u = unit_;
    const Vec3 hips = joint(strip_.legs.hips);
    const Vec3 thighs = (joint(strip_.legs.side[0].upper) + joint(strip_.legs.side[1].upper)) * 0.5f;
    const Vec3 shoulders = (role(Role::left_upper_arm, hips) + role(Role::right_upper_arm, hips)) * 0.5f;
    const Vec3 neck = role(Role::neck, shoulders), head = role(Role::head, neck + k_up * (0.15f * u / scale_));
    const Vec3 spine = normalized(neck - hips, k_up);
    const Vec3 chest = hips + (neck - hips) * 0.68f;
    limb(svg, {at(neck), 0.060f * u}, {at(head), 0.058f * u}, k_near.trunk, 0);
    limb(svg, {at(chest), 0.140f * u}, {at(thighs), 0.118f * u}, k_near.trunk, k_near.shine);
    limb(svg, {at(neck - spine * (0.06f * u / scale_)), 0.085f * u}, {at(chest), 0.138f * u}, k_near.trunk, 0);
    const Vec3 up = normalized(head - neck, k_up);
    const Vec3 crown = head + up * (0.135f * u / scale_) + along_ * (0.02f * u / scale_);
    limb(svg, {at(crown), 0.122f * u},
         {at(head + up * (0.045f * u / scale_) + along_ * (0.03f * u / scale_)), 0.088f * u}, k_near.trunk,
         k_near.shine);
}

void Row::hips_line(std::string& svg) const {
    std::vector<Transform> world(world_.size());
    std::string path;
    for (int f = 0; f < row_.walk->frame_count(); f += 3) {
        world_pose(*row_.walk, f, world);
        const Vec3 hips = world[static_cast<std::size_t>(strip_.legs.hips)].translation;
        const float s = dot(hips, along_) - strip_.from;
        if (s < 0 || s > strip_.length) continue;
        const Point p = at(hips);
        fmt::format_to(Out(path), "{}{:.1f} {:.1f}", path.empty() ? "M" : "L", p.x, p.y);
    }
    fmt::format_to(Out(svg),
                   "<path d=\"{}\" fill=\"none\" stroke=\"#d1495b\" stroke-width=\"1.2\" "
                   "stroke-dasharray=\"1 4\" stroke-linecap=\"round\" stroke-opacity=\"0.75\"/>\n",
                   path);
}

void Row::draw(std::string& svg, const std::vector<int>& frames) {
    const std::string ground = ground_path();
    fmt::format_to(Out(svg),
                   "<clipPath id=\"in{0}\"><path d=\"{1}\"/></clipPath>\n<clipPath id=\"row{0}\"><rect x=\"{2:.1f}\" "
                   "y=\"{3:.1f}\" width=\"{4:.1f}\" height=\"{5:.1f}\"/></clipPath>\n",
                   index_, ground, k_margin, top_, strip_.length * scale_, height());
    fmt::format_to(Out(svg),
                   "<g clip-path=\"url(#row{})\">\n<path d=\"{}\" fill=\"url(#earth)\" stroke=\"#8c7b62\" "
                   "stroke-width=\"1.5\"/>\n",
                   index_, ground);
    for (const int f : frames) {
        world_pose(*row_.walk, f, world_);
        arm(svg, true, k_far);
        leg(svg, 0, k_far);
        trunk(svg);
        leg(svg, 1, k_near);
        arm(svg, false, k_near);
    }
    fmt::format_to(Out(svg), "<path d=\"{}\" fill=\"#e63946\" clip-path=\"url(#in{})\"/>\n", shoes_, index_);
    hips_line(svg);
    svg += "</g>\n";
    fmt::format_to(
        Out(svg), "<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"row\">{}<tspan class=\"note\" dx=\"14\">{}</tspan></text>\n",
        k_margin, top_ + 20, escaped(row_.title), escaped(row_.caption));
}

/// Frames at which the root has gone another `spacing`, within the stretch.
std::vector<int> frames_to_draw(const Filmstrip& strip, const Motion& walk, Vec3 along) {
    std::vector<int> frames;
    constexpr float k_rim = 0.6f;  // [m] arms and legs stay inside the picture
    float next = strip.from + k_rim;
    for (int f = 0; f < walk.frame_count(); ++f) {
        const float s = dot(walk.root[static_cast<std::size_t>(f)].position, along);
        if (s < next || s > strip.from + strip.length - k_rim) continue;
        frames.push_back(f);
        next = s + strip.spacing;
    }
    return frames;
}

/// Lowest and highest thing on the picture.
void extent(const Filmstrip& strip, Vec3 along, float& low, float& high) {
    low = 1e9f;
    high = -1e9f;
    for (float s = 0; s <= strip.length; s += 0.05f) {
        const Vec3 place = along * (strip.from + s);
        const float y = height_at(*strip.ground, place.x, place.z);
        low = std::min(low, y);
        high = std::max(high, y);
    }
    const float stature = 2.02f * strip.legs.side[0].length();
    high += stature * (1 + k_above);
    low -= stature * k_below * 0.5f;
}

}  // namespace

float most_telling_stretch(const Motion& walk, const Motion& twin, const Legs& legs, const Ground& ground,
                           float length) {
    constexpr float k_step = 0.25f, k_low = 0.02f;  // [m]
    const WalkTrack walked = make_track(walk, legs), flat = make_track(twin, legs);
    std::vector<float> wrong;  // per k_step of path
    for (std::size_t i = 0; i < walked.frames.size(); ++i) {
        const auto bin =
            static_cast<std::size_t>(std::max(0.0f, planar_length(walked.frames[i].root.position) / k_step));
        if (wrong.size() <= bin) wrong.resize(bin + 1, 0.0f);
        for (std::size_t side = 0; side < 2; ++side)
            for (std::size_t p = 0; p < k_sole_points; ++p) {
                const Vec3 point = walked.frames[i].legs[side].sole[p];
                const float above = point.y - height_at(ground, point.x, point.z);
                const bool stands = flat.frames[i].legs[side].sole[p].y < k_low;
                if (above < 0 || stands) wrong[bin] += std::fabs(above);
            }
    }
    const auto bins = static_cast<std::size_t>(length / k_step);
    float best = -1, start = 0;
    for (std::size_t from = 2; from + bins <= wrong.size(); ++from) {
        float sum = 0;
        for (std::size_t i = from; i < from + bins; ++i) sum += wrong[i];
        if (sum > best) best = sum, start = static_cast<float>(from) * k_step;
    }
    return start;
}

std::string draw_filmstrip(const Filmstrip& strip) {
    if (strip.rows.empty() || !strip.ground || !(strip.length > 0.5f))
        throw Error("a filmstrip needs rows, a ground and a stretch of half a metre at least", "filmstrip", "");
    const Motion& first = *strip.rows.front().walk;
    const Vec3 travel = first.root.back().position - first.root.front().position;
    const Vec3 along = normalized(Vec3{travel.x, 0, travel.z}, {0, 0, 1});
    const float scale = (k_width - 2 * k_margin) / strip.length;
    float low, high;
    extent(strip, along, low, high);

    std::string rows;
    float top = k_title;
    for (std::size_t i = 0; i < strip.rows.size(); ++i) {
        Row row(strip, strip.rows[i], along, scale, top, low, high, static_cast<int>(i));
        row.draw(rows, frames_to_draw(strip, *strip.rows[i].walk, along));
        top += row.height() + 16;
    }
    const float height = top + 10;
    std::string svg;
    fmt::format_to(Out(svg),
                   "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
                   "height=\"{1:.0f}\" font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\">\n",
                   k_width, height);
    svg +=
        "<style>.title{font-size:20px;font-weight:700;fill:#16324f}.row{font-size:16px;font-weight:700;fill:#1f4e79}"
        ".note{font-size:14px;font-weight:400;fill:#5c6b7a}</style>\n"
        "<defs><linearGradient id=\"earth\" x1=\"0\" y1=\"0\" x2=\"0\" y2=\"1\"><stop offset=\"0\" "
        "stop-color=\"#d8cbb3\"/><stop offset=\"1\" stop-color=\"#efe8da\"/></linearGradient></defs>\n";
    fmt::format_to(Out(svg), "<rect width=\"{:.0f}\" height=\"{:.0f}\" fill=\"#fbfcfd\"/>\n", k_width, height);
    fmt::format_to(Out(svg), "<text x=\"{:.1f}\" y=\"30\" class=\"title\">{}</text>\n", k_margin, escaped(strip.title));
    return svg + rows + "</svg>\n";
}

}  // namespace surefoot
