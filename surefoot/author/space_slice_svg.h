#pragma once
// Spaces of three and four dimensions as pictures that a person can read: plane slices through a point, with the cells
// that the plane cuts from the simplices, the live one, and what plays there.

#include <surefoot/author/project.h>
#include <surefoot/space/slice.h>

#include <string>
#include <vector>

namespace surefoot {

struct SliceView {
    SpacePoint at{};         ///< the plane goes through it; the axes that are not free are held at its values
    int across = 1, up = 0;  ///< the free axes

    friend bool operator==(const SliceView&, const SliceView&) = default;
};

/// The slices that show a space. Three dimensions: the first two axes at three levels of the third, then the two planes
/// along the third through the middle. Four: the first two axes at low, middle and high of the others together, then
/// the five other planes through the middle. Two: the one plane that there is. One: none. The middle is that of the
/// samples; where no clips are near it, the planes go through points that lie among the clips.
std::vector<SliceView> default_slices(const BlendSpace& space);

/// What a view shows in words: "style 0.35, slope 5 deg uphill" (the axes that are held).
std::string describe_slice(const BlendSpace& space, const SliceView& view);

/// One slice as a stand-alone SVG drawing in the classes of the report's style sheet, `width` by `height` pixels.
/// Samples are drawn where they fall onto the plane, the fainter the farther they are from it; the cell around the
/// point is lit, and the clips that play there are joined to the point and listed with their weights.
std::string space_slice_svg(const Project& project, const ProjectSpace& space, const SliceView& view,
                            double width = 880, double height = 460);

}  // namespace surefoot
