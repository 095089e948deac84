#pragma once
// The result of a walk as a picture: the biped in side view every few frames on the ground it walks, one row a walk.

#include <surefoot/ground/ground.h>
#include <surefoot/motion/motion.h>
#include <surefoot/rig/leg.h>
#include <surefoot/rig/roles.h>

#include <string>
#include <vector>

namespace surefoot {

struct FilmstripRow {
    std::string title;    ///< "without foot placement"
    std::string caption;  ///< figures of the row
    const Motion* walk = nullptr;
};

struct Filmstrip {
    std::string title;  ///< "hills at 1.4 m/s"
    std::vector<FilmstripRow> rows;
    const Ground* ground = nullptr;
    Legs legs;
    RoleMap roles;
    float from = 2, length = 9.6f;  ///< [m] the stretch of the path that is shown
    float spacing = 0.95f;          ///< [m] between two drawn poses, about
};

/// The start of the stretch of `length` metres in which the feet of `walk` are most wrong: deepest in the ground or
/// highest above it where the flat twin's stand.
float most_telling_stretch(const Motion& walk, const Motion& twin, const Legs& legs, const Ground& ground,
                           float length);

/// An SVG of about 1,400 units width. What of a foot is inside the ground is drawn red. The same input gives the same
/// bytes.
std::string draw_filmstrip(const Filmstrip& strip);

}  // namespace surefoot
