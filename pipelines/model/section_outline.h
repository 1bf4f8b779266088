#pragma once
#include <Eigen/Core>
#include <vector>

#include "pipelines/model/beam_section.h"

namespace nurbeam {

/// Closed polygons about the centroid, in the section's own axes [m].
using SectionOutline = std::vector<std::vector<Eigen::Vector2d>>;

/// The outline of a section, anticlockwise, and its holes, clockwise. Where the section is known by its
/// numbers alone that of a rectangle with the same second moments over area, or of a disk.
SectionOutline section_outline(const BeamSection& section);

}  // namespace nurbeam
