#pragma once
#include <Eigen/Geometry>

#include "cad_import/report/leniency.h"

class IGESGeom_CircularArc;
class IGESGeom_ConicArc;

namespace nurbeam {

/// An arc of a conic in its own axes: centre, or vertex of a parabola, at the origin, main axis along x, the
/// branch of a hyperbola to the right; it runs anticlockwise, that is upwards where it is open to the right.
struct ConicPosition {
  enum Kind { ellipse = 1, hyperbola = 2, parabola = 3 } kind;  ///< as forms of entity 104
  Eigen::Vector2d radii = {};  ///< along x and y; of a parabola y^2 = 4 f x the focal length f and 0
  Eigen::Vector2d start = {}, end = {};  ///< one point where the ellipse is whole
  Eigen::Affine3d axes = {};             ///< into the coordinates of the entity, in the unit of the file
  double repair = 0;  ///< how far the curve was moved to its ends, where that is more than their digits
};

/// The position of a conic arc (104), from its equation, form number and ends: these stay, and the curve is
/// moved to them. Throws std::runtime_error where they contradict each other.
ConicPosition position_of(const IGESGeom_ConicArc& arc, const Leniency& leniency);

/// Says the arc anew, the same points in the same direction, in its own axes and with a transformation that
/// puts them where they were: OpenCASCADE reads others as other curves, and goes the wrong way where a
/// transformation mirrors. Returns the size of the repair, 0 for none. Throws std::runtime_error as
/// position_of() and rigid_location() do.
double put_into_position(IGESGeom_ConicArc& arc, const Leniency& leniency);
/// The same for circular arcs (100), which are in their own axes already: where the ends are not at one
/// distance from the centre both stay, and it moves by the least that makes an arc of them.
double put_into_position(IGESGeom_CircularArc& arc, const Leniency& leniency);

/// Makes it a quarter of a circle, in the place of one that is refused: OpenCASCADE may trim that without
/// end.
void make_harmless(IGESGeom_ConicArc& arc);

}  // namespace nurbeam
