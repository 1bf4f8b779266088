#include "pipelines/model/drawn_beam.h"

#include <stdexcept>

#include "nurbs/arc_length.h"
#include "nurbs/closest_point.h"
#include "nurbs/number_text.h"

namespace nurbeam {

namespace {

void check_lengths(const CaseBeam& beam, const ReferenceCurve& curve, Findings& findings) {
  const double L = curve.length();
  if (!(L >= shortest_beam && L <= longest_beam))
    return findings.error(beam.path + ".axis", "is " + text_of(L) + " m long; must be between " +
                                                   text_of(shortest_beam) + " and " + text_of(longest_beam) +
                                                   " m (is the unit right?)");
  for (int j = 0; j < curve.segment_count(); ++j) {
    const double length = curve.breaks()[j + 1] - curve.breaks()[j];
    if (length < shortest_segment * L)
      findings.error(beam.path + ".axis",
                     "segment " + std::to_string(j + 1) + " of " + std::to_string(curve.segment_count()) +
                         ", at s = " + text_of(curve.breaks()[j]) + " m, is " + text_of(length) +
                         " m long; the shortest for a beam of " + text_of(L) + " m is " +
                         text_of(shortest_segment * L) + " m: remove it or merge it with its neighbour");
  }
}

// Why a curve of these segments is refused: with the place in the drawing, not in the model's own frame.
std::string reason_in_drawing(const std::vector<RationalCubic>& segments, const std::string& otherwise) {
  try {
    for (const RationalCubic& cubic : segments) (void)ArcLengthMap(cubic);
  } catch (const std::invalid_argument& problem) {
    return std::string(problem.what()) +
           ": round the cusp off, or divide the curve there into two beams with a joint";
  }
  return otherwise;
}

}  // namespace

double DrawnBeam::material_coordinate(double s) const {
  if (curve.metric() == Metric::arc_length) return s;
  const int j = measured.segment_at(s);
  return curve.arc_length(j, measured.parameter(j, s));
}

std::optional<DrawnBeam> drawn_beam(const CaseBeam& beam, const BeamAxis& axis, const ModelFrame& frame,
                                    const ReferenceCurve* like, Findings& findings) {
  try {
    std::vector<RationalCubic> local;
    for (const RationalCubic& cubic : axis.segments) local.push_back(frame.to_local(cubic));
    const ReferenceCurve measured(local, frame.dimension, Metric::arc_length, beam.ring, like);
    check_lengths(beam, measured, findings);
    if (findings.has_errors()) return {};
    return DrawnBeam{beam.name,    axis.segments,
                     axis.corners, axis.led_corners,
                     measured,     ReferenceCurve(local, frame.dimension, beam.metric, beam.ring, &measured)};
  } catch (const std::invalid_argument& problem) {
    findings.error(beam.path + ".axis", reason_in_drawing(axis.segments, problem.what()));
    return {};
  }
}

double place_on(const DrawnBeam& beam, const Place& at, const std::string& where, Findings& findings) {
  const ReferenceCurve& curve = beam.measured;
  const double L = curve.length();
  double s = 0;
  switch (at.kind) {
    case Place::Kind::start:
      s = 0;
      break;
    case Place::Kind::end:
      s = L;
      break;
    case Place::Kind::length:
      s = at.value;
      break;
    case Place::Kind::fraction:
      s = at.value * L;
      break;
    case Place::Kind::near: {
      const ClosestPoint found = closest_point(beam.axis, at.point);
      const double within = at.within.value_or(0.01 * L);
      if (found.distance > within)
        findings.error(where + ".at.near",
                       text_of(at.point) + " is " + text_of(found.distance) + " m from beam \"" + beam.name +
                           "\"; the limit is " + text_of(within) + " m (" +
                           (at.within ? "\"within\"" : "1 % of its length without \"within\"") +
                           ") and the closest point of the axis " + text_of(found.point));
      s = curve.arc_length(found.segment, found.u);
      break;
    }
  }
  if (!(s >= -1e-9 * L && s <= L * (1 + 1e-9)))
    findings.error(where + ".at", text_of(s) + " m is not on beam \"" + beam.name + "\", which is " +
                                      text_of(L) + " m long");
  if (s < 1e-9 * L || (curve.closed() && s > L * (1 - 1e-9))) return 0;
  return s > L * (1 - 1e-9) ? L : s;
}

}  // namespace nurbeam
