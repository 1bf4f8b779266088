#include "fem/forces/friction_law.h"

#include <cmath>

namespace nurbeam {

namespace {

// A number and its derivatives by the slopes left and right.
struct OfSlopes {
  double value;
  Eigen::Vector3d by_left, by_right;
};

// phi(mu, theta) for c = |t1 + t2| = 2 cos(theta/2), and its derivative by c.
std::pair<double, double> bound_factor(Friction::Law law, double mu, double c) {
  if (law == Friction::Law::coulomb) return {2 * mu / c, -2 * mu / (c * c)};
  const double half = std::acos(std::min(1.0, c / 2)), sine = std::sin(half);
  constexpr double small = 1e-4;
  if (half < small) return {mu * (1 + half * half * (1 - 2 * mu * mu) / 6), -mu * (1 - 2 * mu * mu) / 6};
  const double tanh = std::tanh(mu * half);
  const double by_half = (mu * (1 - tanh * tanh) - tanh * std::cos(half) / sine) / sine;
  return {tanh / sine, -by_half / (2 * sine)};
}

// The bound without F_c, with its derivative by the force besides.
struct Bound : OfSlopes {
  Eigen::Vector3d by_force;
};

Bound normal_bound(const FrictionOfBody& body, const FrictionPoint& at, double mu) {
  const double a = at.left.norm(), b = at.right.norm();
  const Eigen::Vector3d t1 = at.left / a, t2 = at.right / b, sum = t1 + t2;
  const double c = sum.norm();
  const Eigen::Vector3d m = sum / c;
  const double along = at.force.dot(m), e = body.least_force;
  const Eigen::Vector3d across = at.force - along * m;
  const double root = std::sqrt(across.squaredNorm() + e * e), normal = root - e;
  const auto [phi, phi_c] = bound_factor(body.friction->law, mu, c);
  // dN = (across . dforce - along force_across . dm) / root, dm = (I - m m') (dt1 + dt2) / c,
  // dc = m . (dt1 + dt2).
  const Eigen::Vector3d by_tangent = -phi * along / (root * c) * across + normal * phi_c * m;
  const auto by_slope = [&](const Eigen::Vector3d& t, double length) -> Eigen::Vector3d {
    return (by_tangent - t * t.dot(by_tangent)) / length;
  };
  return {{phi * normal, by_slope(t1, a), by_slope(t2, b)}, phi / root * across};
}

}  // namespace

FrictionForce friction_force(const FrictionOfBody& body, const FrictionPoint& at,
                             const FrictionMemory& before) {
  const Friction& friction = *body.friction;
  const double k = body.stiffness, d = body.damping, c = friction.viscous;
  const double a = at.left.norm(), b = at.right.norm(), l = (a + b) / 2;
  const Eigen::Vector3d l_left = at.left / (2 * a), l_right = at.right / (2 * b);
  const double moved = at.s - before.s;
  const double mu = before.slides == 0 ? friction.sticking_coefficient() : friction.coefficient;
  const Bound normal = normal_bound(body, at, mu);
  const double F_c = friction.force.empty() ? 0 : value_and_slope(friction.force, at.t).first;

  FrictionForce f{};
  f.per_along = l;
  f.bound = normal.value + F_c;
  f.trial = k * (before.z + l * moved) + d * l * at.rate;
  const bool holds = before.slides == 0 && f.bound > 0 && std::abs(f.trial) <= f.bound;
  const int way = before.slides != 0 ? before.slides : f.trial > 0 ? 1 : -1;
  const double held = holds ? f.trial : f.bound > 0 ? way * f.bound : 0;
  f.along = -held - c * l * at.rate;
  f.value = l * f.along;
  f.by_rate = -c * l * l;
  f.by_left = (f.along - c * l * at.rate) * l_left;
  f.by_right = (f.along - c * l * at.rate) * l_right;
  if (holds) {
    f.by_s = -k * l * l;
    f.by_rate -= d * l * l;
    f.by_left -= l * (k * moved + d * at.rate) * l_left;
    f.by_right -= l * (k * moved + d * at.rate) * l_right;
    f.memory = {before.z + l * moved, at.s, 0};
    return f;
  }
  if (f.bound > 0) {
    f.by_force = -way * l * normal.by_force;
    f.by_left -= way * l * normal.by_left;
    f.by_right -= way * l * normal.by_right;
  }
  // A body that has turned round sticks in the next step.
  const bool turned = before.slides * at.rate < 0 && friction.can_stick();
  f.memory = {held / k, at.s, turned ? 0 : way};
  return f;
}

}  // namespace nurbeam
