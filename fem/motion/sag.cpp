#include "fem/motion/sag.h"

#include <algorithm>
#include <limits>
#include <set>

#include "nurbs/golden_section.h"

namespace nurbeam {

namespace {

RationalCubic cubic_of(const ElementRecord& element) { return RationalCubic(element.control_points); }

Chord chord_of(const std::vector<ElementRecord>& elements, const Eigen::Vector3d& gravity) {
  return {elements.front().control_points, elements.back().control_points, gravity};
}

int lowest_of(const std::vector<ElementRecord>& elements, Chord chord) {
  for (const ElementRecord& element : elements) chord.look_at(element.control_points);
  return chord.lowest();
}

}  // namespace

Chord::Chord(const Eigen::Matrix4d& first, const Eigen::Matrix4d& last, const Eigen::Vector3d& gravity)
    : start_(RationalCubic(first).point(0)),
      along_(RationalCubic(last).point(1) - start_),
      down_(gravity.normalized()),
      across_(along_ - along_.dot(down_) * down_) {}

double Chord::depth(const RationalCubic& cubic, double u) const {
  const Eigen::Vector3d d = cubic.point(u) - start_;
  return d.dot(down_) - d.dot(across_) / across_.squaredNorm() * along_.dot(down_);
}

void Chord::look_at(const Eigen::Matrix4d& control_points) {
  const int element = looked_at_++;
  const double here = depth(RationalCubic(control_points), 0.5);
  if (element > 0 && !(here > deepest_)) return;
  deepest_ = here;
  lowest_ = element;
}

int lowest_element(const std::vector<ElementRecord>& elements, const Eigen::Vector3d& gravity) {
  return lowest_of(elements, chord_of(elements, gravity));
}

double sag(const std::vector<ElementRecord>& elements, const Eigen::Vector3d& gravity) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const Chord chord = chord_of(elements, gravity);
  if (gravity.norm() == 0 || chord.is_vertical()) return none;
  const int lowest = lowest_of(elements, chord), count = static_cast<int>(elements.size());
  double most = 0;
  for (int i = std::max(0, lowest - 1); i < std::min(lowest + 2, count); ++i) {
    const RationalCubic cubic = cubic_of(elements[static_cast<std::size_t>(i)]);
    const double u = minimum_place([&](double v) { return -chord.depth(cubic, v); }, 0, 1, 30);
    most = std::max(most, chord.depth(cubic, u));
  }
  return most;
}

double sag_near(const BeamSystem& system, const State& state, int beam, int lowest) {
  const Mesh& mesh = system.mesh();
  const int first = mesh.first_span[beam], last = mesh.first_span[beam + 1] - 1;
  std::vector<ElementRecord> elements;
  for (const int span :
       std::set{first, std::max(first, lowest - 1), lowest, std::min(last, lowest + 1), last})
    elements.emplace_back().control_points = span_control_points(system, state, span);
  return sag(elements, system.model().gravity);
}

}  // namespace nurbeam
