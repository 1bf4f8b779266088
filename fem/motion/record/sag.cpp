#include "fem/motion/record/sag.h"

#include <algorithm>
#include <limits>

#include "nurbs/golden_section.h"

namespace nurbeam {

namespace {

Chord chord_of(const std::vector<ElementRecord>& elements, const Eigen::Vector3d& gravity) {
  return {elements.front().control_points, elements.back().control_points, gravity};
}

Chord chord_of(const BeamSystem& system, const State& state, int beam) {
  const std::vector<int>& first_span = system.mesh().first_span;
  return {span_control_points(system, state, first_span[beam]),
          span_control_points(system, state, first_span[beam + 1] - 1), system.model().gravity};
}

// Whether a beam has no sag, without gravity or with an upright chord.
bool has_none(const Chord& chord, const Eigen::Vector3d& gravity) {
  return gravity.norm() == 0 || chord.is_upright();
}

constexpr double no_sag = std::numeric_limits<double>::quiet_NaN();

int lowest_of(const std::vector<ElementRecord>& elements, Chord chord) {
  for (const ElementRecord& element : elements) chord.look_at(element.control_points);
  return chord.lowest();
}

// The lowest place in an element and its neighbours, among elements `first` to `end`; depth 0 if none is
// below the chord.
template <class ControlPoints>
Lowest lowest_near(int element, int first, int end, const Chord& chord, const ControlPoints& control_points) {
  Lowest found{.element = element};
  for (int i = std::max(first, element - 1); i < std::min(element + 2, end); ++i) {
    const RationalCubic cubic(control_points(i));
    const double u = minimum_place([&](double v) { return -chord.depth(cubic, v); }, 0, 1, 30);
    if (const double depth = chord.depth(cubic, u); depth > found.depth) found = {i, u, depth};
  }
  return found;
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
  const Chord chord = chord_of(elements, gravity);
  if (has_none(chord, gravity)) return no_sag;
  return lowest_near(lowest_of(elements, chord), 0, static_cast<int>(elements.size()), chord,
                     [&](int i) { return elements[static_cast<std::size_t>(i)].control_points; })
      .depth;
}

Lowest sag_near(const BeamSystem& system, const State& state, int beam, int lowest) {
  const Chord chord = chord_of(system, state, beam);
  if (has_none(chord, system.model().gravity)) return {.element = lowest, .depth = no_sag};
  const std::vector<int>& first_span = system.mesh().first_span;
  return lowest_near(lowest, first_span[beam], first_span[beam + 1], chord,
                     [&](int i) { return span_control_points(system, state, i); });
}

double sag_at(const BeamSystem& system, const State& state, int beam, const Lowest& place) {
  const Chord chord = chord_of(system, state, beam);
  if (has_none(chord, system.model().gravity)) return no_sag;
  return std::max(0.0,
                  chord.depth(RationalCubic(span_control_points(system, state, place.element)), place.u));
}

}  // namespace nurbeam
