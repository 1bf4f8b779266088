#pragma once
#include <cmath>
#include <string>
#include <vector>

#include "pipelines/papers/papers_run.h"
#include "pipelines/papers/plot.h"
#include "pipelines/verification/references.h"

namespace nurbeam::papers {

/// Largest distance of the body from the reference places [m]; not a number if a run ended before.
double largest_distance(const Run& run, const std::vector<references::Place>& places);
/// The times of the reference places, as "0.5 and 1 s".
std::string instants(const std::vector<references::Place>& places);
/// Rms over the frames of the distance between the bodies of two runs with the same frames [m]; not a number
/// if the first ended early.
double rms_distance(const Run& run, const Run& fine);
/// Largest displacement of a material point by an event, on a beam drawn straight [m].
double largest_shift(const MeshChangeRecord& change);
/// The references as marks: values picked from each.
template <class X, class Y>
PlotLine marks(const std::vector<references::Place>& places, X x, Y y) {
  PlotLine line{"reference", {}, {}, PlotLine::Style::marks};
  for (const references::Place& place : places) {
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

/// A figure of how a run starts: the beam, its nodes and the body.
Plot start_of(const std::string& title, const Run& run);

inline double time_of(const Snapshot& frame) { return frame.time; }
inline double body_x(const Snapshot& frame) { return frame.bodies[0].point.position.x(); }
inline double body_y(const Snapshot& frame) { return frame.bodies[0].point.position.y(); }

}  // namespace nurbeam::papers
