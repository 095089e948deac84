#pragma once
// A small animated arm written as ASCII FBX and as Collada, and where its joints must come out.

#include <surefoot/math/trig.h>
#include <surefoot/motion/motion.h>

#include <fmt/format.h>

#include <string>
#include <vector>

namespace surefoot::test {

struct WrittenJoint {
    std::string name;
    int parent = k_no_joint;
    Vec3 offset;                  ///< centimetres
    Vec3 pre_rotation_deg;        ///< FBX only
    Vec3 pivot;                   ///< FBX only: RotationPivot, centimetres
    std::vector<Vec3> rotations;  ///< degrees about x, then y, then z; one a frame
    std::vector<Vec3> positions;  ///< centimetres, one a frame; empty: `offset`
};

inline Quat euler_xyz(Vec3 degrees) {
    const Vec3 r = degrees * k_radians_per_degree;
    return axis_angle({0, 0, 1}, r.z) * axis_angle({0, 1, 0}, r.y) * axis_angle({1, 0, 0}, r.x);
}

/// A pelvis that travels, a leg of three below it, 30 frames a second.
inline std::vector<WrittenJoint> written_joints(bool pivots) {
    std::vector<WrittenJoint> joints{{"Hips", k_no_joint, {0, 95, 0}, {}, {}, {}, {}},
                                     {"Thigh", 0, {9, -5, 1}, {0, 0, 170}, {}, {}, {}},
                                     {"Shin", 1, {0, 42, 0}, {10, 0, 0}, {1, 2, 3}, {}, {}},
                                     {"Foot", 2, {0, 41, 0}, {60, 5, 0}, {}, {}, {}}};
    for (int f = 0; f < 7; ++f) {
        const float t = static_cast<float>(f);
        joints[0].positions.push_back({2 * t, 95 + t, 5 * t});
        joints[0].rotations.push_back({t, 10 * t, -2 * t});
        joints[1].rotations.push_back({-30 + 10 * t, 3 * t, t});
        joints[2].rotations.push_back({20 - t, 0, 0});
        joints[3].rotations.push_back({5 * t, -4 * t, 2 * t});
    }
    if (!pivots)
        for (WrittenJoint& joint : joints) joint.pre_rotation_deg = joint.pivot = {};
    return joints;
}

/// World positions in metres at a frame. The file's +Z becomes +Y where `z_up`.
inline std::vector<Vec3> written_positions(const std::vector<WrittenJoint>& joints, std::size_t frame, bool z_up) {
    std::vector<Transform> world;
    std::vector<Vec3> positions;
    for (const WrittenJoint& joint : joints) {
        // T Rp Rpre R Rp^-1, as the FBX SDK has it.
        const Quat turn = euler_xyz(joint.pre_rotation_deg) * euler_xyz(joint.rotations[frame]);
        const Transform local{turn, (joint.positions.empty() ? joint.offset : joint.positions[frame]) + joint.pivot -
                                        rotate(turn, joint.pivot)};
        world.push_back(joint.parent == k_no_joint ? local : world[static_cast<std::size_t>(joint.parent)] * local);
        const Vec3 p = world.back().translation * 0.01f;
        positions.push_back(z_up ? Vec3{p.x, p.z, -p.y} : p);
    }
    return positions;
}

inline std::string fbx_curve(long id, const std::vector<float>& values) {
    std::string times, numbers;
    for (std::size_t f = 0; f < values.size(); ++f) {
        times += fmt::format("{}{}", f > 0 ? "," : "", f * (46186158000ull / 30));  // FBX ticks a second
        numbers += fmt::format("{}{}", f > 0 ? "," : "", values[f]);
    }
    const auto n = values.size();
    return fmt::format(
        "\tAnimationCurve: {}, \"AnimCurve::\", \"\" {{\n\t\tDefault: 0\n\t\tKeyVer: 4008\n\t\tKeyTime: *{} "
        "{{\n\t\t\ta: {}\n\t\t}}\n"
        "\t\tKeyValueFloat: *{} {{\n\t\t\ta: {}\n\t\t}}\n\t\tKeyAttrFlags: *1 {{\n\t\t\ta: "
        "24836\n\t\t}}\n\t\tKeyAttrDataFloat: *4 {{\n"
        "\t\t\ta: 0,0,0,0\n\t\t}}\n\t\tKeyAttrRefCount: *1 {{\n\t\t\ta: {}\n\t\t}}\n\t}}\n",
        id, n, times, n, numbers, n);
}

inline std::string write_fbx(const std::vector<WrittenJoint>& joints, bool z_up) {
    std::string objects, links;
    const auto vector = [](const char* name, Vec3 v) {
        return fmt::format("\t\t\tP: \"{0}\", \"{1}\", \"\", \"A\",{2},{3},{4}\n", name,
                           std::string(name).substr(0, 3) == "Lcl" ? name : "Vector3D", v.x, v.y, v.z);
    };
    objects +=
        "\tAnimationStack: 900, \"AnimStack::mixamo.com\", \"\" {\n\t}\n\tAnimationLayer: 901, "
        "\"AnimLayer::BaseLayer\", \"\" {\n\t}\n";
    links += "\tC: \"OO\",901,900\n";
    for (std::size_t j = 0; j < joints.size(); ++j) {
        const WrittenJoint& joint = joints[j];
        const long id = 1000 + 100 * static_cast<long>(j);
        objects += fmt::format(
            "\tModel: {}, \"Model::{}\", \"LimbNode\" {{\n\t\tVersion: 232\n\t\tProperties70:  {{\n"
            "\t\t\tP: \"RotationActive\", \"bool\", \"\", \"\",1\n",
            id, joint.name);
        objects += vector("PreRotation", joint.pre_rotation_deg) + vector("RotationPivot", joint.pivot) +
                   vector("Lcl Translation", joint.offset) + vector("Lcl Rotation", joint.rotations[0]) +
                   "\t\t}\n\t}\n";
        links += fmt::format("\tC: \"OO\",{},{}\n", id,
                             joint.parent == k_no_joint ? 0 : 1000 + 100 * static_cast<long>(joint.parent));
        const auto curves = [&](const char* property, long node, const std::vector<Vec3>& values) {
            objects += fmt::format(
                "\tAnimationCurveNode: {}, \"AnimCurveNode::{}\", \"\" {{\n\t\tProperties70:  {{\n"
                "\t\t\tP: \"d|X\", \"Number\", \"\", \"A\",0\n\t\t\tP: \"d|Y\", \"Number\", \"\", \"A\",0\n"
                "\t\t\tP: \"d|Z\", \"Number\", \"\", \"A\",0\n\t\t}}\n\t}}\n",
                node, property[4]);
            links += fmt::format("\tC: \"OO\",{},901\n\tC: \"OP\",{},{}, \"{}\"\n", node, node, id, property);
            for (int axis = 0; axis < 3; ++axis) {
                std::vector<float> numbers;
                for (const Vec3 v : values) numbers.push_back(axis == 0 ? v.x : axis == 1 ? v.y : v.z);
                objects += fbx_curve(node + 1 + axis, numbers);
                links +=
                    fmt::format("\tC: \"OP\",{},{}, \"d|{}\"\n", node + 1 + axis, node, static_cast<char>('X' + axis));
            }
        };
        curves("Lcl Rotation", id + 10, joint.rotations);
        if (!joint.positions.empty()) curves("Lcl Translation", id + 20, joint.positions);
    }
    const int up = z_up ? 2 : 1, front = z_up ? 1 : 2, front_sign = z_up ? -1 : 1;
    return "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n\tFBXVersion: 7400\n}\n" +
           fmt::format(
               "GlobalSettings:  {{\n\tVersion: 1000\n\tProperties70:  {{\n\t\tP: \"UpAxis\", \"int\", \"Integer\", "
               "\"\",{}\n"
               "\t\tP: \"UpAxisSign\", \"int\", \"Integer\", \"\",1\n\t\tP: \"FrontAxis\", \"int\", \"Integer\", "
               "\"\",{}\n"
               "\t\tP: \"FrontAxisSign\", \"int\", \"Integer\", \"\",{}\n\t\tP: \"CoordAxis\", \"int\", \"Integer\", "
               "\"\",0\n"
               "\t\tP: \"CoordAxisSign\", \"int\", \"Integer\", \"\",1\n\t\tP: \"UnitScaleFactor\", \"double\", "
               "\"Number\", \"\",1\n"
               "\t\tP: \"TimeMode\", \"enum\", \"\", \"\",6\n\t}}\n}}\n",
               up, front, front_sign) +
           "Objects:  {\n" + objects + "}\nConnections:  {\n" + links + "}\n";
}

inline std::string write_collada(const std::vector<WrittenJoint>& joints, bool z_up) {
    std::string nodes, animations;
    std::vector<int> open;
    for (std::size_t j = 0; j < joints.size(); ++j) {
        const WrittenJoint& joint = joints[j];
        while (!open.empty() && open.back() != joint.parent) nodes += "</node>\n", open.pop_back();
        const Vec3 r = joint.rotations[0];
        nodes += fmt::format(
            "<node id=\"{0}\" sid=\"{0}\" name=\"{0}\" type=\"JOINT\"><translate sid=\"t\">{1} {2} {3}</translate>"
            "<rotate sid=\"rz\">0 0 1 {6}</rotate><rotate sid=\"ry\">0 1 0 {5}</rotate><rotate sid=\"rx\">1 0 0 "
            "{4}</rotate>\n",
            joint.name, joint.offset.x, joint.offset.y, joint.offset.z, r.x, r.y, r.z);
        open.push_back(static_cast<int>(j));
        const auto channel = [&](const char* sid, const char* target, const std::vector<float>& values, int width) {
            std::string times, numbers, curves;
            const std::size_t keys = values.size() / static_cast<std::size_t>(width);
            for (std::size_t f = 0; f < keys; ++f) {
                times += fmt::format("{:.7f} ", static_cast<double>(f) / 30);
                curves += "LINEAR ";
            }
            for (const float value : values) numbers += fmt::format("{} ", value);
            const std::string id = joint.name + "-" + sid;
            animations += fmt::format(
                "<animation><source id=\"{0}-i\"><float_array id=\"{0}-ia\" "
                "count=\"{1}\">{2}</float_array><technique_common>"
                "<accessor source=\"#{0}-ia\" count=\"{1}\" stride=\"1\"><param name=\"TIME\" "
                "type=\"float\"/></accessor></technique_common></source>"
                "<source id=\"{0}-o\"><float_array id=\"{0}-oa\" count=\"{3}\">{4}</float_array><technique_common>"
                "<accessor source=\"#{0}-oa\" count=\"{1}\" stride=\"{5}\">{6}</accessor></technique_common></source>"
                "<source id=\"{0}-n\"><Name_array id=\"{0}-na\" count=\"{1}\">{7}</Name_array><technique_common>"
                "<accessor source=\"#{0}-na\" count=\"{1}\" stride=\"1\"><param name=\"INTERPOLATION\" "
                "type=\"name\"/></accessor></technique_common></source>"
                "<sampler id=\"{0}-s\"><input semantic=\"INPUT\" source=\"#{0}-i\"/><input semantic=\"OUTPUT\" "
                "source=\"#{0}-o\"/>"
                "<input semantic=\"INTERPOLATION\" source=\"#{0}-n\"/></sampler><channel source=\"#{0}-s\" "
                "target=\"{8}/{9}\"/></animation>\n",
                id, keys, times, values.size(), numbers, width,
                width == 1 ? "<param name=\"ANGLE\" type=\"float\"/>"
                           : "<param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" "
                             "type=\"float\"/>",
                curves, joint.name, target);
        };
        std::vector<float> x, y, z, t;
        for (const Vec3 v : joint.rotations) x.push_back(v.x), y.push_back(v.y), z.push_back(v.z);
        for (const Vec3 v : joint.positions) t.insert(t.end(), {v.x, v.y, v.z});
        channel("x", "rx.ANGLE", x, 1), channel("y", "ry.ANGLE", y, 1), channel("z", "rz.ANGLE", z, 1);
        if (!t.empty()) channel("t", "t", t, 3);
    }
    while (!open.empty()) nodes += "</node>\n", open.pop_back();
    return fmt::format(
        "<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n"
        "<asset><unit meter=\"0.01\" "
        "name=\"centimeter\"/><up_axis>{}</up_axis></asset>\n<library_animations>\n{}</library_animations>\n"
        "<library_visual_scenes><visual_scene id=\"s\" name=\"s\">\n{}</visual_scene></library_visual_scenes>\n"
        "<scene><instance_visual_scene url=\"#s\"/></scene>\n</COLLADA>\n",
        z_up ? "Z_UP" : "Y_UP", animations, nodes);
}

}  // namespace surefoot::test
