#include "fem/structure/turn.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "fem/element/cross_matrix.h"

namespace nurbeam {

AngleMotion AngleMotion::at_speed(double speed, double ramp) {
  if (!(ramp > 0)) return AngleMotion([speed](double t) { return Moment{speed * t, speed, 0}; });
  return AngleMotion([speed, ramp](double t) {
    constexpr double two_pi = 2 * std::numbers::pi;
    if (t >= ramp) return Moment{speed * (t - ramp / 2), speed, 0};
    if (t <= 0) return Moment{0, 0, 0};
    const double x = t / ramp, phase = two_pi * x;
    return Moment{speed * ramp * (x * x / 2 + (std::cos(phase) - 1) / (two_pi * two_pi)),
                  speed * (x - std::sin(phase) / two_pi), speed / ramp * (1 - std::cos(phase))};
  });
}

double AngleMotion::way(double from, double to) const {
  if (rows_) return rows_->steepest() * std::abs(to - from);
  constexpr int parts = 16;
  double way = 0;
  for (int i = 0; i < parts; ++i)
    way +=
        std::abs(at(from + (to - from) * (i + 1) / parts).angle - at(from + (to - from) * i / parts).angle);
  return way;
}

AxisTurn::Rotation AxisTurn::by(double angle) const {
  const Eigen::Matrix3d across = cross_matrix(axis);
  Rotation rotation;
  rotation.R = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  rotation.first = across * rotation.R;
  rotation.second = across * rotation.first;
  return rotation;
}

AxisTurn::Rotation AxisTurn::at(double t, double load) const {
  const AngleMotion::Moment now = angle.at(t);
  const Rotation by_angle = by(load * now.angle);
  const double rate = load * now.rate, acceleration = load * now.acceleration;
  return {by_angle.R, rate * by_angle.first, acceleration * by_angle.first + rate * rate * by_angle.second};
}

}  // namespace nurbeam
