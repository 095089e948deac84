#include <surefoot/course/filmstrip.h>
#include <surefoot/course/walk_report.h>
#include <surefoot/course/walk_table.h>
#include <surefoot/io/gltf.h>
#include <surefoot/mannequin/mannequin.h>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace surefoot {
namespace {

using Out = std::back_insert_iterator<std::string>;

/// Runs of true as [[first, last], …].
std::string ranges(const std::vector<bool>& on) {
    std::string out = "[";
    for (std::size_t i = 0; i < on.size(); ++i) {
        if (!on[i]) continue;
        std::size_t last = i;
        while (last + 1 < on.size() && on[last + 1]) ++last;
        fmt::format_to(Out(out), "{}[{}, {}]", out.size() > 1 ? ", " : "", i, last);
        i = last;
    }
    return out + "]";
}

std::string vec_json(Vec3 v) { return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", v.x, v.y, v.z); }

constexpr const char* k_side_names[] = {"left", "right"};

/// One foot: when it stands, its sole's points in the joints' frames, and what the twin says of each point.
std::string foot_json(const WalkComparison& walks, FootMode mode, const Skeleton& skeleton, std::size_t side) {
    const WalkTrack& twin = walks.twin_track;
    const Leg& leg = walks.legs.side[side];
    const auto name = [&](int joint) { return json_quoted(skeleton.names[static_cast<std::size_t>(joint)]); };
    const std::string foot = name(leg.foot), toes = name(leg.toes == k_no_joint ? leg.foot : leg.toes);
    std::string out = fmt::format(
        "{{\"contacts\": {}, \"joints\": {{\"upper_leg\": {}, \"lower_leg\": {}, \"foot\": {}}}, \"sole_up\": {}, "
        "\"sole\": {{",
        ranges(walks.walked[static_cast<std::size_t>(mode)].planted[side]), name(leg.upper), name(leg.lower), foot,
        vec_json(leg.up));
    const std::pair<const char*, Vec3> points[] = {
        {"heel", leg.heel}, {"mid", leg.mid}, {"ball", leg.ball}, {"toe_tip", leg.toe_tip}};
    for (std::size_t p = 0; p < k_sole_points; ++p) {
        std::string heights;
        for (const TrackFrame& frame : twin.frames)
            fmt::format_to(Out(heights), "{}{:.4f}", heights.empty() ? "" : ",", frame.legs[side].sole[p].y);
        fmt::format_to(Out(out),
                       "{}\"{}\": {{\"joint\": {}, \"offset\": {}, \"planted\": {}, \"flat_height_m\": [{}]}}",
                       p ? ", " : "", points[p].first, p == 3 ? toes : foot, vec_json(points[p].second),
                       ranges(planted_frames(twin, side, p)), heights);
    }
    return out + "}}";
}

MeasuredWalk row_of(const WalkInfo& info, const WalkComparison& walks, FootMode mode) {
    for (const MeasuredWalk& row : measured_walks(info, walks))
        if (row.mode == mode) return row;
    return {};
}

std::string extras_json(const WalkInfo& info, const WalkComparison& walks, FootMode mode) {
    const Legs& legs = walks.legs;
    const Skeleton& skeleton = *walks.twin.motion.skeleton;
    const TwinFigures& flat = walks.twin_figures;
    std::string out = fmt::format(
        "{{\"surefoot_walk\": {{\"course\": {}, \"reverse\": {}, \"grade_deg\": {}, \"path\": {}, \"speed_mps\": {}, "
        "\"mode\": {}, "
        "\"fps\": {}, \"hips\": {}, \"flat_twin\": {{\"knee_peak_deg_s2\": {}, \"hip_jerk_m_s3\": {}, "
        "\"skate_cm_s\": {}}}",
        json_quoted(info.course), info.reverse, json_number(static_cast<double>(info.grade_deg)),
        json_quoted(info.path), json_number(static_cast<double>(info.speed_mps)), json_quoted(foot_mode_name(mode)),
        json_number(static_cast<double>(k_walk_fps)), json_quoted(skeleton.names[static_cast<std::size_t>(legs.hips)]),
        json_number(flat.knee_peak_deg_s2), json_number(flat.hip_jerk_m_s3), json_number(flat.skate_cm_s));
    for (std::size_t side = 0; side < 2; ++side)
        fmt::format_to(Out(out), ", \"{}\": {}", k_side_names[side], foot_json(walks, mode, skeleton, side));
    fmt::format_to(Out(out), ", \"metrics\": {}}}}}", figures_json(row_of(info, walks, mode)));
    return out;
}

/// Triangles apart, so that every facet is lit as it lies.
StaticMesh terrain_of(const SurfaceMesh& surface) {
    StaticMesh mesh;
    mesh.name = "terrain";
    mesh.color = {0.62f, 0.55f, 0.42f, 1};
    for (std::size_t t = 0; t + 2 < surface.indices.size(); t += 3) {
        const Vec3 a = surface.positions[surface.indices[t]], b = surface.positions[surface.indices[t + 1]],
                   c = surface.positions[surface.indices[t + 2]];
        const Vec3 across = cross(b - a, c - a);
        if (length_squared(across) < 1e-12f) continue;
        for (const Vec3 p : {a, b, c}) {
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
            mesh.positions.push_back(p);
            mesh.normals.push_back(normalized(across));
        }
    }
    return mesh;
}

std::string caption(const WalkMetrics& m) {
    return fmt::format("feet sink up to {:.1f} cm and float up to {:.1f} cm; sole {:.1f}° off the ground",
                       m.penetration_max_cm, m.float_max_cm, m.sole_angle_deg);
}

}  // namespace

std::string metrics_table(const WalkInfo& info, const WalkComparison& walks) {
    const std::vector<MeasuredWalk> rows = measured_walks(info, walks);
    std::string out = fmt::format("{} on {}, {:g} s\n{}", info.character, walk_title(info), info.seconds,
                                  walk_table(rows, TableLayout::one_walk));
    if (!rows.empty() && (std::isnan(rows[0].metrics.skate_cm_s) || std::isnan(rows[0].metrics.sole_angle_deg)))
        out +=
            "  –: on flat ground the clip never stands there (heel and ball at once, for the sole's angle), so "
            "nothing\n"
            "     was measured; look at its contacts with `surefoot analyze`\n";
    return out;
}

std::string metrics_json(const WalkInfo& info, const WalkComparison& walks) {
    return walk_json(measured_walks(info, walks));
}

std::string walk_glb(const WalkInfo& info, const Course& course, const WalkComparison& walks, FootMode mode,
                     const RoleMap& roles) {
    GltfScene scene;
    scene.motions.push_back(walks.walked[static_cast<std::size_t>(mode)].motion);
    scene.motions.back().name = "walk_" + info.course;
    scene.mesh = make_mannequin(scene.motions.back(), roles, walks.legs);
    scene.statics.push_back(terrain_of(course.mesh));
    scene.extras = extras_json(info, walks, mode);
    return write_glb(scene);
}

std::string walk_filmstrip(const WalkInfo& info, const Course& course, const WalkComparison& walks, FootMode mode,
                           const RoleMap& roles) {
    const auto with = static_cast<std::size_t>(mode), without = static_cast<std::size_t>(FootMode::none);
    Filmstrip strip;
    strip.title = walk_title(info);
    strip.ground = course.ground.get();
    strip.legs = walks.legs;
    strip.roles = roles;
    const Motion& plain = walks.walked[without].motion;
    const float travelled = planar_length(plain.root.back().position - plain.root.front().position);
    strip.length = std::clamp(travelled, 2.0f, strip.length);
    strip.from = most_telling_stretch(plain, walks.twin.motion, walks.legs, *course.ground, strip.length);
    strip.rows.push_back({"without foot placement", caption(walks.metrics[without]), &plain});
    if (mode != FootMode::none)
        strip.rows.push_back({mode == FootMode::surefoot ? "with Surefoot's foot placement" : "Colvin & Kajala 2013",
                              caption(walks.metrics[with]), &walks.walked[with].motion});
    return draw_filmstrip(strip);
}

}  // namespace surefoot
