// The paper's figures 7 to 10, drawn from a study: orthographic, from the side of the leg they show and more or less
// from ahead.

#include <surefoot/course/colvin_study.h>
#include <surefoot/ground/shapes.h>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace surefoot {
namespace {

using Out = std::back_insert_iterator<std::string>;

constexpr float k_width = 560, k_height = 450;             // [px]
constexpr float k_from_ahead = 30 * k_radians_per_degree;  // of the camera
constexpr float k_rather_from_ahead = 62 * k_radians_per_degree;
constexpr float k_from_above = 14 * k_radians_per_degree;
constexpr float k_around = 0.75f, k_cell = 0.125f;  // [m] of ground shown
constexpr float k_axis = 0.2f;                      // [m] arms of a triad
constexpr float k_degrees = static_cast<float>(180 / k_pi);
constexpr const char* k_sides[] = {"left", "right"};

struct Point {
    float x = 0, y = 0;
};

/// Draws one moment.
class Picture {
  public:
    Picture(const ColvinStudy& study, const ColvinMoment& moment, const RoleMap& roles, float from_ahead = k_from_ahead)
        : study_(study), moment_(moment), roles_(roles) {
        const Vec3 ahead = rotate(from_yaw(moment.root.yaw), {0, 0, 1}),
                   left = rotate(from_yaw(moment.root.yaw), {1, 0, 0});
        const Vec3 level = left * ((moment.side == 0 ? -1.0f : 1.0f) * cos(from_ahead)) - ahead * sin(from_ahead);
        look_ = level * cos(k_from_above) - k_up * sin(k_from_above);
        right_ = normalized(cross(look_, k_up));
        up_ = cross(right_, look_);
        const float leg = study.legs.side[0].length();
        scale_ = 168 / leg;
        middle_ = moment.root.position + k_up * (0.83f * leg);
    }

    void ground();
    /// `style` is a class of the style sheet; `without`: a leg that is left out (2: none).
    void body(const std::vector<Transform>& joints, const char* style, std::size_t without = 2);
    void leg(Vec3 hip, Vec3 knee, Vec3 ankle, std::size_t side, const char* style);
    void triad(Vec3 at, Quat rotation, bool named = false);
    void arrow(Vec3 from, Vec3 to, const char* style, const std::string& label);
    std::string figure(int number, const std::string& title, const std::string& caption) const;

  private:
    Point at(Vec3 p) const {
        return {0.5f * k_width + dot(p - middle_, right_) * scale_, 0.5f * k_height - dot(p - middle_, up_) * scale_};
    }
    void line(Vec3 from, Vec3 to, const std::string& style) {
        const Point a = at(from), b = at(to);
        fmt::format_to(Out(svg_), "<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n",
                       style, a.x, a.y, b.x, b.y);
    }
    void text(Point p, const std::string& label) {
        fmt::format_to(Out(svg_), "<text class=\"name\" x=\"{:.1f}\" y=\"{:.1f}\"{}>{}</text>\n", p.x, p.y,
                       p.x > 0.72f * k_width ? " text-anchor=\"end\"" : "", label);
    }

    const ColvinStudy& study_;
    const ColvinMoment& moment_;
    const RoleMap& roles_;
    Vec3 look_, right_, up_, middle_;
    float scale_ = 1;
    std::string svg_;
};

void Picture::ground() {
    struct Cell {
        float depth;
        std::string svg;
    };
    std::vector<Cell> cells;
    const auto on = [&](float x, float z) { return Vec3{x, height_at(*study_.ground, x, z), z}; };
    const auto steps = static_cast<int>(k_around / k_cell);
    const auto snapped = [](float v) { return std::floor(v / k_cell) * k_cell; };
    const float x0 = snapped(moment_.root.position.x), z0 = snapped(moment_.root.position.z);
    for (int i = -steps; i < steps; ++i)
        for (int j = -steps; j < steps; ++j) {
            const float x = x0 + static_cast<float>(i) * k_cell, z = z0 + static_cast<float>(j) * k_cell;
            const Vec3 corners[] = {on(x, z), on(x + k_cell, z), on(x + k_cell, z + k_cell), on(x, z + k_cell)};
            const Vec3 normal = normalized(cross(corners[2] - corners[0], corners[1] - corners[3]), k_up);
            const float light = std::clamp(std::fabs(dot(normal, normalized(Vec3{0.5f, 1, -0.4f}))), 0.0f, 1.0f);
            std::string points;
            for (const Vec3 corner : corners) {
                const Point p = at(corner);
                fmt::format_to(Out(points), "{:.1f},{:.1f} ", p.x, p.y);
            }
            cells.push_back({dot(corners[0], look_), fmt::format("<polygon class=\"ground\" fill-opacity=\"{:.2f}\" "
                                                                 "points=\"{}\"/>\n",
                                                                 0.25f + 0.75f * light, points)});
        }
    std::stable_sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.depth > b.depth; });
    for (const Cell& cell : cells) svg_ += cell.svg;
}

void Picture::leg(Vec3 hip, Vec3 knee, Vec3 ankle, std::size_t side, const char* style) {
    const std::string name = fmt::format("bone {} {}", style, k_sides[side]);
    line(hip, knee, name);
    line(knee, ankle, name);
    const Point k = at(knee);
    fmt::format_to(Out(svg_), "<circle class=\"knee\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.2\"/>\n", k.x, k.y);
}

void Picture::body(const std::vector<Transform>& joints, const char* style, std::size_t without) {
    const auto joint = [&](int j) { return joints[static_cast<std::size_t>(j)]; };
    const auto chain = [&](std::initializer_list<Role> parts) {
        Vec3 last;
        bool begun = false;
        for (const Role part : parts) {
            if (!roles_.has(part)) continue;
            const Vec3 here = joint(roles_[part]).translation;
            if (begun) line(last, here, fmt::format("bone {} trunk", style));
            last = here;
            begun = true;
        }
    };
    const auto arm = [&](bool left) {
        chain({left ? Role::left_upper_arm : Role::right_upper_arm, left ? Role::left_lower_arm : Role::right_lower_arm,
               left ? Role::left_hand : Role::right_hand});
    };
    arm(moment_.side != 0);  // what is farther away first
    for (const std::size_t side : {1 - moment_.side, moment_.side}) {
        const Leg& leg = study_.legs.side[side];
        line(joint(study_.legs.hips).translation, joint(leg.upper).translation, fmt::format("bone {} trunk", style));
        if (side == without) continue;
        const Transform foot = joint(leg.foot);
        const SolePoints sole = sole_points(leg, foot, joint(leg.toes == k_no_joint ? leg.foot : leg.toes));
        const std::string name = fmt::format("sole {} {}", style, k_sides[side]);
        line(foot.translation, sole.heel, name);
        line(sole.heel, sole.ball, name);
        line(sole.ball, sole.toe_tip, name);
        line(foot.translation, sole.ball, name);
        this->leg(joint(leg.upper).translation, joint(leg.lower).translation, foot.translation, side, style);
    }
    chain({Role::hips, Role::spine, Role::chest, Role::upper_chest, Role::neck, Role::head});
    chain({Role::left_upper_arm, Role::neck, Role::right_upper_arm});
    arm(moment_.side == 0);
    if (!roles_.has(Role::head)) return;
    const Vec3 head = joint(roles_[Role::head]).translation + k_up * (0.09f * study_.legs.side[0].length());
    const Point h = at(head);
    fmt::format_to(Out(svg_), "<circle class=\"head {}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>\n", style, h.x, h.y,
                   0.11f * study_.legs.side[0].length() * scale_);
}

void Picture::triad(Vec3 origin, Quat rotation, bool named) {
    const std::pair<Vec3, const char*> axes[] = {{{1, 0, 0}, "x"}, {{0, 1, 0}, "y"}, {{0, 0, 1}, "z"}};
    for (const auto& [axis, name] : axes) {
        const Vec3 end = origin + rotate(rotation, axis) * k_axis;
        line(origin, end, fmt::format("axis-{}", name));
        if (!named) continue;
        const Point p = at(origin + rotate(rotation, axis) * (k_axis + 0.04f));
        fmt::format_to(Out(svg_), "<text class=\"axis-name\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", p.x, p.y + 3,
                       name);
    }
}

void Picture::arrow(Vec3 from, Vec3 to, const char* style, const std::string& label) {
    const Point a = at(from), b = at(to);
    line(from, to, fmt::format("arrow {}", style));
    const float dx = b.x - a.x, dy = b.y - a.y, d = std::max(std::sqrt(dx * dx + dy * dy), 1e-3f);
    const float ux = dx / d, uy = dy / d;
    constexpr float k_head = 11, k_half = 4.5f;  // [px]
    fmt::format_to(Out(svg_), "<polygon class=\"point {}\" points=\"{:.1f},{:.1f} {:.1f},{:.1f} {:.1f},{:.1f}\"/>\n",
                   style, b.x, b.y, b.x - ux * k_head - uy * k_half, b.y - uy * k_head + ux * k_half,
                   b.x - ux * k_head + uy * k_half, b.y - uy * k_head - ux * k_half);
    text({b.x + 8 * ux + 4, b.y + 8 * uy + 4}, label);
}

std::string Picture::figure(int number, const std::string& title, const std::string& caption) const {
    return fmt::format(
        "<figure class=\"paper\" id=\"figure-{0}\"><svg viewBox=\"0 0 {1:.0f} {2:.0f}\" role=\"img\" "
        "aria-label=\"Figure {0}: {3}\">\n{4}</svg>\n<figcaption><b>Figure {0}. {3}</b> {5}</figcaption></figure>\n",
        number, k_width, k_height, title, svg_, caption);
}

Vec3 axis_of(Quat q) { return normalized(Vec3{q.x, q.y, q.z}, {1, 0, 0}); }
float angle_of(Quat q) { return 2 * atan2(length(Vec3{q.x, q.y, q.z}), std::fabs(q.w)) * k_degrees; }

std::string figure_7(const ColvinStudy& study, const RoleMap& roles) {
    const ColvinMoment& m = study.sunk;
    Picture picture(study, m, roles);
    picture.ground();
    picture.body(m.animated, "ghost");
    picture.body(m.placed, "solid");
    picture.triad(m.root.position + k_up * m.steps.lowered, from_yaw(m.root.yaw), true);
    return picture.figure(
        7, "The hips sink until the leg reaches",
        fmt::format("The {} foot’s target lies out of reach: the root, whose axes are drawn into the ground, sinks by "
                    "{:.1f} cm (step 2), and the leg is fully stretched. Pale: as animated, root on the ground.",
                    k_sides[m.side], -100 * m.steps.lowered));
}

/// Step 4: from where to where the leg swings, and about what.
void swing_arrows(Picture& picture, const ColvinInput& leg, const ColvinTrace& trace) {
    picture.arrow(leg.hip, leg.hip + trace.posed.ankle, "before", "posed");
    picture.arrow(leg.hip, leg.target, "after", "target");
    picture.arrow(leg.hip, leg.hip + axis_of(trace.swing) * 0.4f, "about", "axis");
}

std::string figure_8(const ColvinStudy& study, const RoleMap& roles) {
    const ColvinMoment& m = study.turned;
    const ColvinInput& leg = m.steps.legs[m.side];
    const ColvinTrace& trace = m.traces[m.side];
    Picture picture(study, m, roles);
    picture.ground();
    picture.body(m.placed, "solid", m.side);
    picture.leg(leg.hip, leg.hip + trace.posed.knee, leg.hip + trace.posed.ankle, m.side, "solid");
    picture.triad(leg.target, m.placed[static_cast<std::size_t>(study.legs.side[m.side].foot)].rotation);
    swing_arrows(picture, leg, trace);
    const float knee = colvin_step3_knee_angle(distance(leg.hip, leg.knee), distance(leg.knee, leg.ankle),
                                               distance(leg.hip, leg.target));
    return picture.figure(
        8, "The leg before it is swung",
        fmt::format(
            "The law of cosines bends the {} knee to {:.0f}°; the thigh is set to 90° (step 3). From hip to foot "
            "and from hip to target are {:.0f}° apart, about the axis shown (step 4): far from the 180° at which "
            "an axis is arbitrary.",
            k_sides[m.side], knee * k_degrees, angle_of(trace.swing)));
}

std::string figure_9(const ColvinStudy& study, const RoleMap& roles) {
    const ColvinMoment& m = study.turned;
    const ColvinInput& leg = m.steps.legs[m.side];
    const ColvinTrace& trace = m.traces[m.side];
    const Vec3 along = normalized(leg.target - leg.hip);
    Picture picture(study, m, roles, k_rather_from_ahead);
    picture.ground();
    picture.body(m.placed, "solid", m.side);
    picture.leg(leg.hip, leg.hip + trace.swung.knee, leg.hip + trace.swung.ankle, m.side, "solid");
    picture.leg(leg.hip, leg.knee, leg.ankle, m.side, "outline");
    picture.arrow(leg.target, leg.target + along * -0.45f, "about", "axis of the twist");
    return picture.figure(9, "The foot is there, the knee is not",
                          fmt::format("After the swing the plane of the knee is {:.1f}° from the animated one (the "
                                      "thin dashed leg). What is left is a "
                                      "turn about hip to foot, which keeps the foot where it is.",
                                      knee_plane_deg(leg, trace.swung.knee)));
}

std::string figure_10(const ColvinStudy& study, const RoleMap& roles) {
    const ColvinMoment& m = study.turned;
    const ColvinInput& leg = m.steps.legs[m.side];
    const ColvinTrace& trace = m.traces[m.side];
    Picture picture(study, m, roles);
    picture.ground();
    picture.body(m.placed, "solid");
    for (std::size_t side = 0; side < 2; ++side)
        picture.triad(m.steps.legs[side].target,
                      m.placed[static_cast<std::size_t>(study.legs.side[side].foot)].rotation);
    swing_arrows(picture, leg, trace);
    const Vec3 knee = m.placed[static_cast<std::size_t>(study.legs.side[m.side].lower)].translation - leg.hip;
    return picture.figure(
        10, "The final frame",
        fmt::format("A twist of {:.1f}° (step 5) leaves the plane of the knee {:.1f}° from the animated "
                    "one. Axes at the ankles stand where the feet were to go; the vectors from the hip "
                    "are those of figure 8.",
                    std::fabs(trace.twist) * k_degrees, knee_plane_deg(leg, knee)));
}

}  // namespace

std::string colvin_figures(const ColvinStudy& study, const RoleMap& roles) {
    return "<div class=\"papers\">\n" + figure_7(study, roles) + figure_8(study, roles) + figure_9(study, roles) +
           figure_10(study, roles) + "</div>\n";
}

}  // namespace surefoot
