#pragma once
#include <cmath>
#include <vector>

#include "pipelines/papers/papers_run.h"
#include "pipelines/papers/plot.h"

namespace nurbeam::papers {

/// Where the body and the beam's end are, by two programs that share no formulation; the error is that of
/// their difference.
struct ReferencePlace {
  double time, x, y, s;  ///< body [s, m]
  double end_y = NAN;    ///< of the beam's end [m]
  double length = NAN;   ///< of the beam [m]
};
/// Errors 1e-5 m (Example 1), 2e-5 m (Example 2, s 1.5e-4 m; Example 3 as drawn), 1e-4 m (3 straight).
std::vector<ReferencePlace> falling_beam_places();
std::vector<ReferencePlace> suspended_beam_places();
std::vector<ReferencePlace> semicircle_places(bool straight);

/// Largest distance of the body from the reference places [m]; not a number if a run ended before.
double largest_distance(const Run& run, const std::vector<ReferencePlace>& places);
/// Rms over the frames of the distance between the bodies of two runs with the same frames [m]; not a number
/// if the first ended early.
double rms_distance(const Run& run, const Run& fine);
/// Largest displacement of a material point by an event, on a beam drawn straight [m].
double largest_shift(const MeshChangeRecord& change);
/// The references as marks: values picked from each.
template <class X, class Y>
PlotLine marks(const std::vector<ReferencePlace>& places, X x, Y y) {
  PlotLine line{"reference", {}, {}, PlotLine::Style::marks};
  for (const ReferencePlace& place : places) {
    line.x.push_back(x(place));
    line.y.push_back(y(place));
  }
  return line;
}

/// A line through the frames of a run: values picked from each.
template <class X, class Y>
PlotLine line_of(const std::string& label, const Run& run, X x, Y y) {
  PlotLine line{label, {}, {}};
  for (const Snapshot& frame : run.frames) {
    line.x.push_back(x(frame));
    line.y.push_back(y(frame));
  }
  return line;
}
/// The shape of a beam.
PlotLine shape_of(const std::string& label, const BeamRecord& beam);
/// Its nodes.
PlotLine nodes_of(const std::string& label, const BeamRecord& beam);

inline double time_of(const Snapshot& frame) { return frame.time; }
inline double body_x(const Snapshot& frame) { return frame.bodies[0].point.position.x(); }
inline double body_y(const Snapshot& frame) { return frame.bodies[0].point.position.y(); }

}  // namespace nurbeam::papers
