#include <Eigen/Geometry>
#include <algorithm>

#include "pipelines/route/route.h"

namespace nurbeam {

namespace {

NurbsCurve five_point_cubic(const RouteEnd& from, const RouteEnd& to, double handle,
                            const Eigen::Vector3d& middle) {
  Eigen::Matrix<double, 3, 5> points;
  points << from.point, from.point + handle * from.outward.normalized(), middle,
      to.point + handle * to.outward.normalized(), to.point;
  return make_nurbs_curve(KnotVector(3, {0, 0, 0, 0, 0.5, 1, 1, 1, 1}), points, Eigen::VectorXd::Ones(5));
}

// Down, as far as this lengthens the curve: a weight that acts along the chord pushes nothing aside.
Eigen::Vector3d push_direction(const Eigen::Vector3d& chord, const Eigen::Vector3d& gravity) {
  constexpr double nearly_along = 0.98;
  const Eigen::Vector3d along = chord.normalized();
  if (gravity.norm() > 0 && std::abs(gravity.normalized().dot(along)) < nearly_along)
    return gravity.normalized();
  return along.unitOrthogonal();
}

// The root of an increasing function that is below 0 at `low` and above at `high`.
template <class Function>
double root_between(double low, double high, Function value) {
  constexpr int halvings = 60;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (value(middle) < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

NurbsCurve route_start(const RouteEnd& from, const RouteEnd& to, double wanted,
                       const Eigen::Vector3d& gravity) {
  const Eigen::Vector3d chord = to.point - from.point, midway = 0.5 * (from.point + to.point);
  const Eigen::Vector3d push = push_direction(chord, gravity);
  const double handle = 0.25 * std::min(wanted, chord.norm());
  const auto excess = [&](double pushed) {
    return length(five_point_cubic(from, to, handle, midway + pushed * push)) - wanted;
  };
  const double pushed = excess(0) < 0 ? root_between(0, 2 * wanted, excess) : 0.5 * handle;
  return five_point_cubic(from, to, handle, midway + pushed * push);
}

}  // namespace nurbeam
