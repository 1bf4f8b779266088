#include "fem/motion/sag.h"

#include <algorithm>
#include <limits>

#include "nurbs/golden_section.h"

namespace nurbeam {

namespace {

RationalCubic cubic_of(const ElementRecord& element) { return RationalCubic(element.control_points); }

// The line between the ends of a beam, and what is below it.
struct Chord {
  Eigen::Vector3d start, along, down, across;

  Chord(const std::vector<ElementRecord>& elements, const Eigen::Vector3d& gravity)
      : start(cubic_of(elements.front()).point(0)),
        along(cubic_of(elements.back()).point(1) - start),
        down(gravity.normalized()),
        across(along - along.dot(down) * down) {}

  bool is_vertical() const { return across.norm() <= 1e-9 * std::max(along.norm(), 1e-300); }
  double depth(const RationalCubic& cubic, double u) const {
    const Eigen::Vector3d d = cubic.point(u) - start;
    return d.dot(down) - d.dot(across) / across.squaredNorm() * along.dot(down);
  }
};

int lowest_of(const std::vector<ElementRecord>& elements, const Chord& chord) {
  int lowest = 0;
  double deepest = chord.depth(cubic_of(elements[0]), 0.5);
  for (std::size_t i = 1; i < elements.size(); ++i)
    if (const double here = chord.depth(cubic_of(elements[i]), 0.5); here > deepest) {
      deepest = here;
      lowest = static_cast<int>(i);
    }
  return lowest;
}

}  // namespace

int lowest_element(const std::vector<ElementRecord>& elements, const Eigen::Vector3d& gravity) {
  return lowest_of(elements, Chord(elements, gravity));
}

double sag(const std::vector<ElementRecord>& elements, const Eigen::Vector3d& gravity) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const Chord chord(elements, gravity);
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

}  // namespace nurbeam
