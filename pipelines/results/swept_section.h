#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cad_import/report/named_curve.h"
#include "fem/motion/record/snapshot.h"
#include "pipelines/section/profile_polygon.h"

namespace nurbeam {

/// Why the sections of a beam cannot be swept: it has no torsion, and so no orientation, or at a corner its
/// sections do not meet in a mitre, as those do that are carried over it by the smallest rotation. Nothing
/// where they can.
std::optional<std::string> sweeping_obstacle(const BeamRecord& beam);

/// The curve that the material point of the section at (x, y) [m] makes along a beam without an obstacle: a
/// cubic spline through the elements' samples, from corner to corner, where it goes on to the plane of the
/// mitre.
NurbsCurve section_line(const BeamRecord& beam, const Eigen::Vector2d& place);

/// The profile, of this area [m^2], moved and turned as the sections of a beam without an obstacle are; its
/// volume that of the area times the length.
SweptProfile swept_section(const BeamRecord& beam, const std::vector<Loop>& profile, double area,
                           const std::string& name, const std::string& part);

/// The sharp corners of a profile, or where it has none the four places of its outline that are farthest
/// along its axes [m].
std::vector<Eigen::Vector2d> marked_places(const std::vector<Loop>& profile);

}  // namespace nurbeam
