#include "pipelines/papers/papers_chains.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "pipelines/verification/models.h"

namespace nurbeam::papers {

namespace {

using verification::add_slider;

BeamModel hung(std::vector<RationalCubic> axis, int elements, double start) {
  BeamModel model = verification::one_beam(
      std::move(axis), 2, verification::round_bar(0.02, 7200, 200e6, CurvatureMeasure::spatial), elements,
      {{0, false}, {1e3, false}});
  add_slider(model, 0.8, start);
  return model;
}

// From direction -45 degrees to +45 degrees; the arc's centre is the origin.
std::vector<RationalCubic> line_and_arc() {
  const double h = std::numbers::sqrt2 / 2;
  const Eigen::Vector3d joint(-h, -h, 0), ahead(h, -h, 0);
  std::vector<RationalCubic> axis{line_cubic(joint - ahead, joint)};
  for (const RationalCubic& arc :
       arc_cubics({0, 0, 0}, 1, -3 * std::numbers::pi / 4, -std::numbers::pi / 4, 1))
    axis.push_back(arc);
  return axis;
}

BeamModel line_arc_line(int elements, double start) {
  const double h = std::numbers::sqrt2 / 2;
  std::vector<RationalCubic> axis = line_and_arc();
  axis.push_back(line_cubic({h, -h, 0}, {2 * h, 0, 0}));
  return hung(std::move(axis), elements, start);
}

BeamModel line_arc_spline(int elements) {
  const double h = std::numbers::sqrt2 / 2;
  std::vector<RationalCubic> axis = line_and_arc();
  Eigen::Matrix4d points;
  points << h, h + 0.35, h + 0.9, h + 1.0,  //
      -h, -h + 0.35, -h + 0.5, -h + 1.1,    //
      0, 0, 0, 0,                           //
      1, 1, 1, 1;
  axis.emplace_back(points);
  return hung(std::move(axis), elements, 0.3);
}

}  // namespace

Example line_arc_line_example() {
  return {"Line, arc, line", [](int elements) { return line_arc_line(elements, 0.3); }, 1.5, "curved"};
}

Example line_arc_spline_example() { return {"Line, arc, spline", line_arc_spline, 1.5, "curved"}; }

Example reversing_example() {
  return {"Line, arc, line, and back", [](int elements) { return line_arc_line(elements, 0.8); }, 2.0,
          "curved"};
}

}  // namespace nurbeam::papers
