#pragma once
// Terrains to walk on. Every course is walked along +Z from the origin; all begin where a character can start.

#include <surefoot/ground/ground.h>
#include <surefoot/ground/surface_mesh.h>

#include <memory>
#include <string>
#include <vector>

namespace surefoot {

struct Course {
    std::string name;
    std::shared_ptr<const Ground> ground;
    SurfaceMesh mesh;  ///< the same surface, for showing
};

/// flat, hills, slope_up, slope_down, cross_slope, stairs_up, stairs_down, ledge, rubble, curb_oblique.
const std::vector<std::string>& course_names();

/// `grade_deg` is the steepness of the slope courses; `reverse`: walked from its far end, so that stairs that lead up
/// lead down. Throws Error for a name that is not a course.
Course make_course(const std::string& name, float grade_deg = 15, bool reverse = false);

}  // namespace surefoot
