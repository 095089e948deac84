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
    SurfaceMesh mesh;   ///< the same surface, for showing
    float length = 20;  ///< [m] from the start to where one turns back, its last obstacle passed
};

/// What of an endless ground the mesh shows.
inline constexpr Extent k_course_extent{-6, 6, -4, 60};

/// flat, hills, slope_up, slope_down, cross_slope, stairs_up, stairs_down, ledge, rubble, curb_oblique.
const std::vector<std::string>& course_names();

/// `grade_deg` is the steepness of the slope courses; `reverse`: walked from its far end, so that stairs that lead up
/// lead down. `shown` is how much of a ground without an end its mesh shows. Throws Error for a name that is not a
/// course.
Course make_course(const std::string& name, float grade_deg = 15, bool reverse = false,
                   const Extent& shown = k_course_extent);

}  // namespace surefoot
