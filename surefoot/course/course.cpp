#include <surefoot/base/error.h>
#include <surefoot/course/course.h>
#include <surefoot/ground/height_field.h>
#include <surefoot/ground/shapes.h>
#include <surefoot/math/trig.h>

#include <algorithm>

namespace surefoot {
namespace {

constexpr float k_first_obstacle = 3;  // [m] level ground before it, to walk up to
constexpr float k_slope_length = 40;   // [m] longer than any walk of ours, but for the level rest beyond
constexpr float k_cross_slope_deg = 15;
constexpr float k_riser = 0.17f, k_tread = 0.28f;  // [m] stairs as building codes have them
constexpr int k_steps = 20;
constexpr float k_ledge = 0.30f, k_curb = 0.12f;
constexpr float k_oblique = 0.577f;  // the kerb lies at 30 degrees to the path
constexpr float k_tile = 0.30f, k_rubble = 0.08f;

/// From where a course is walked back: as far behind its last obstacle as its first lies ahead.
float far_end(const std::string& name) {
    if (name == "hills" || name == "rubble") return 50;
    if (name == "slope_up" || name == "slope_down") return k_slope_length + 2 * k_first_obstacle;
    if (name == "stairs_up" || name == "stairs_down") return k_steps * k_tread + 2 * k_first_obstacle;
    if (name == "ledge") return 13;
    if (name == "curb_oblique") return 19.5f;
    return 0;
}

template <typename Surface>
Course course_of(const std::string& name, Surface surface, SurfaceMesh mesh) {
    Course course{name, std::make_shared<const Surface>(std::move(surface)), std::move(mesh)};
    if (const float end = far_end(name); end > 0) course.length = end;
    return course;
}
template <typename Surface>
Course course_of(const std::string& name, Surface surface, const Extent& shown) {
    SurfaceMesh mesh = surface.mesh(shown);
    return course_of(name, std::move(surface), std::move(mesh));
}

Course slope(const std::string& name, float degrees, const Extent& shown) {
    const float rise = tan(degrees * k_radians_per_degree);
    return course_of(name, Ramp(rise, k_first_obstacle, k_first_obstacle + k_slope_length), shown);
}

}  // namespace

const std::vector<std::string>& course_names() {
    static const std::vector<std::string> names{"flat",      "hills",       "slope_up", "slope_down", "cross_slope",
                                                "stairs_up", "stairs_down", "ledge",    "rubble",     "curb_oblique"};
    return names;
}

namespace {

/// A ground as one finds it who comes from its far end: turned about the vertical, so that z = `length` is the origin.
class FromTheFarEnd final : public Ground {
  public:
    FromTheFarEnd(std::shared_ptr<const Ground> ground, float length) : ground_(std::move(ground)), length_(length) {}
    Vec3 turned(Vec3 p) const noexcept { return {-p.x, p.y, length_ - p.z}; }
    void query(std::span<const GroundQuery> queries, std::span<GroundHit> hits) const noexcept override {
        for (std::size_t i = 0; i < queries.size(); ++i) {
            GroundQuery query = queries[i];
            query.origin = turned(query.origin);
            ground_->query({&query, 1}, {&hits[i], 1});
            hits[i].normal = {-hits[i].normal.x, hits[i].normal.y, -hits[i].normal.z};
            hits[i].velocity = {-hits[i].velocity.x, hits[i].velocity.y, -hits[i].velocity.z};
        }
    }

  private:
    std::shared_ptr<const Ground> ground_;
    float length_;
};

Course turned(Course course) {
    const auto ground = std::make_shared<const FromTheFarEnd>(course.ground, far_end(course.name));
    for (Vec3& p : course.mesh.positions) p = ground->turned(p);
    course.ground = ground;
    return course;
}

Course make_forward(const std::string& name, float grade_deg, const Extent& shown) {
    if (!(grade_deg >= 0 && grade_deg <= 45))
        throw Error("a grade must lie between 0 and 45 degrees", "course '" + name + "'", "ask for 10, 15 or 30");
    if (name == "flat") return course_of(name, Plane(), shown);
    if (name == "hills") {
        HeightField hills = make_hills();
        SurfaceMesh mesh = hills.mesh();
        return course_of(name, std::move(hills), std::move(mesh));
    }
    if (name == "slope_up") return slope(name, grade_deg, shown);
    if (name == "slope_down") return slope(name, -grade_deg, shown);
    if (name == "cross_slope") return course_of(name, Plane(tan(k_cross_slope_deg * k_radians_per_degree), 0), shown);
    if (name == "stairs_up") return course_of(name, Stairs(k_riser, k_tread, k_first_obstacle, k_steps), shown);
    if (name == "stairs_down") return course_of(name, Stairs(-k_riser, k_tread, k_first_obstacle, k_steps), shown);
    if (name == "ledge") return course_of(name, Bands(k_ledge, 0, {{4, 9}}), shown);
    if (name == "rubble") return course_of(name, Tiles(k_tile, k_rubble, 2, 1), shown);
    if (name == "curb_oblique") return course_of(name, Bands(k_curb, k_oblique, {{4.5f, 8}, {11, 15}}), shown);
    std::string known;
    for (const std::string& each : course_names()) known += (known.empty() ? "" : ", ") + each;
    throw Error("there is no course '" + name + "'", "", "choose one of " + known);
}

}  // namespace

Course make_course(const std::string& name, float grade_deg, bool reverse, const Extent& shown) {
    Course course = make_forward(name, grade_deg, shown);
    return reverse ? turned(std::move(course)) : course;
}

}  // namespace surefoot
