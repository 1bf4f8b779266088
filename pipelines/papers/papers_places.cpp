#include "pipelines/papers/papers_places.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nurbs/rational_cubic.h"
#include "pipelines/papers/papers_page.h"

namespace nurbeam::papers {

double largest_distance(const Run& run, const std::vector<references::Place>& places) {
  double largest = 0;
  for (const references::Place& place : places) {
    const auto at = std::find_if(run.frames.begin(), run.frames.end(), [&](const Snapshot& frame) {
      return std::abs(frame.time - place.time) < 1e-9;
    });
    if (at == run.frames.end()) return std::numeric_limits<double>::quiet_NaN();
    largest = std::max(largest, std::hypot(body_x(*at) - place.x, body_y(*at) - place.y));
  }
  return largest;
}

std::string instants(const std::vector<references::Place>& places) {
  std::string text;
  for (std::size_t i = 0; i < places.size(); ++i)
    text += (i == 0 ? "" : i + 1 < places.size() ? ", " : " and ") + number(places[i].time);
  return text + " s";
}

double rms_distance(const Run& run, const Run& fine) {
  if (!run.complete()) return std::numeric_limits<double>::quiet_NaN();
  double squares = 0;
  for (std::size_t i = 0; i < run.frames.size(); ++i)
    squares +=
        (run.frames[i].bodies[0].point.position - fine.frames[i].bodies[0].point.position).squaredNorm();
  return std::sqrt(squares / static_cast<double>(run.frames.size()));
}

double largest_shift(const MeshChangeRecord& change) {
  const auto at = [](const BeamRecord& beam, double s) -> Eigen::Vector3d {
    const auto element = std::find_if(beam.elements.begin(), beam.elements.end() - 1,
                                      [&](const ElementRecord& e) { return s <= e.s_end; });
    const double u = (s - element->s_start) / (element->s_end - element->s_start);
    return RationalCubic(element->control_points).point(u);
  };
  double largest = 0;
  constexpr int samples = 2000;
  for (int i = 0; i <= samples; ++i) {
    const double s = change.before.elements.back().s_end * i / samples;
    largest = std::max(largest, (at(change.before, s) - at(change.after, s)).norm());
  }
  return largest;
}

PlotLine shape_of(const std::string& label, const BeamRecord& beam) {
  PlotLine line{label, {}, {}};
  for (const ElementRecord& element : beam.elements) {
    constexpr int parts = 12;
    const RationalCubic cubic(element.control_points);
    for (int i = 0; i <= parts; ++i) {
      const Eigen::Vector3d r = cubic.point(static_cast<double>(i) / parts);
      line.x.push_back(r.x());
      line.y.push_back(r.y());
    }
  }
  return line;
}

PlotLine nodes_of(const std::string& label, const BeamRecord& beam) {
  PlotLine line{label, {}, {}, PlotLine::Style::marks};
  for (const Eigen::Vector3d& r : beam.node_positions) {
    line.x.push_back(r.x());
    line.y.push_back(r.y());
  }
  return line;
}

Plot start_of(const std::string& title, const Run& run) {
  const Snapshot& frame = run.frames.front();
  Plot plot{title, "x [m]", "y [m]", {}};
  plot.equal_axes = true;
  plot.lines = {shape_of("beam", frame.beams[0]),
                nodes_of("nodes", frame.beams[0]),
                {"mass", {body_x(frame)}, {body_y(frame)}, PlotLine::Style::marks}};
  return plot;
}

}  // namespace nurbeam::papers
