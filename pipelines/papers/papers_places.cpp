#include "pipelines/papers/papers_places.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nurbs/rational_cubic.h"

namespace nurbeam::papers {

std::vector<ReferencePlace> falling_beam_places() {
  return {{0.2, 0.131866, -0.061405, 0.147474, -0.196947, 1.001414},
          {0.4, 0.213265, -0.366831, 0.438555, -0.892306, 1.006318},
          {0.5, 0.110137, -0.663964, 0.712489, -0.802103, 1.005065}};
}

std::vector<ReferencePlace> suspended_beam_places() {
  return {{0.3, 0.225178, -0.036238, 0.226584, NAN, 1.007698},
          {0.6, 0.510228, -0.097381, 0.506148, NAN, 1.023557},
          {1.0, 0.837282, -0.041253, 0.834099, NAN, 1.008379}};
}

std::vector<ReferencePlace> semicircle_places(bool straight) {
  if (straight) return {{0.5, -1.138563, -1.349098, 1.602512}, {1.0, 1.159817, -1.634351, 4.407983}};
  return {{0.5, -1.194665, -1.354761, 1.580274},
          {1.0, 1.152992, -1.625596, 4.408070},
          {1.5, 1.869061, -0.314888, 5.942009}};
}

double largest_distance(const Run& run, const std::vector<ReferencePlace>& places) {
  double largest = 0;
  for (const ReferencePlace& place : places) {
    const auto at = std::find_if(run.frames.begin(), run.frames.end(), [&](const Snapshot& frame) {
      return std::abs(frame.time - place.time) < 1e-9;
    });
    if (at == run.frames.end()) return std::numeric_limits<double>::quiet_NaN();
    largest = std::max(largest, std::hypot(body_x(*at) - place.x, body_y(*at) - place.y));
  }
  return largest;
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

}  // namespace nurbeam::papers
