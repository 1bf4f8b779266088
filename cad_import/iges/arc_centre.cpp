#include "cad_import/iges/arc_centre.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

/// Also where start and end lie in one direction from the centre.
bool turns_more_than_half(const PlaneArc& arc) {
  constexpr double one_direction = 1e-9;
  const Eigen::Vector2d start = arc.start - arc.centre, end = arc.end - arc.centre;
  const double sine = (start.x() * end.y() - start.y() * end.x()) / (start.norm() * end.norm());
  return sine < 0 || (sine <= one_direction && start.dot(end) > 0);
}

}  // namespace

double make_consistent(PlaneArc& arc, const Leniency& leniency) {
  const double first = (arc.start - arc.centre).norm(), last = (arc.end - arc.centre).norm();
  const double off = std::abs(last - first), radius = std::max(first, last);
  if (!leniency.repairs(off, radius))
    throw std::runtime_error("its start lies " + text_of(first) + " from its centre and its end " +
                             text_of(last) +
                             ", more than the 1 % apart that is repaired; both must be its radius: correct "
                             "the points");
  if (off == 0) return 0;
  const Eigen::Vector2d chord = arc.end - arc.start;
  const double length = chord.norm();
  const double move = ((arc.start + arc.end) / 2 - arc.centre).dot(chord) / length;
  const bool closes = turns_more_than_half(arc) && !leniency.repairs(std::abs(move), radius);
  if (closes)
    arc.end = arc.start;
  else
    arc.centre += move / length * chord;
  const double size = closes ? length : std::min(std::abs(move), length);  // it stays near its chord
  return Leniency::is_told(off, radius) ? size : 0;
}

}  // namespace nurbeam
