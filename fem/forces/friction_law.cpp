#include "fem/forces/friction_law.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nurbeam {

namespace {

// A number and its derivatives by the slopes left and right.
struct OfSlopes {
  double value;
  Eigen::Vector3d by_left, by_right;
};

// The bound without F_c, with its derivative by the force besides.
struct Bound : OfSlopes {
  Eigen::Vector3d by_force;
};

// Unit tangents on both sides, and how a derivative by one becomes one by its slope.
struct Tangents {
  double a, b;
  Eigen::Vector3d t1, t2;

  explicit Tangents(const FrictionPoint& at)
      : a(at.left.norm()), b(at.right.norm()), t1(at.left / a), t2(at.right / b) {}
  Eigen::Vector3d by_left(const Eigen::Vector3d& by_t1) const { return (by_t1 - t1 * t1.dot(by_t1)) / a; }
  Eigen::Vector3d by_right(const Eigen::Vector3d& by_t2) const { return (by_t2 - t2 * t2.dot(by_t2)) / b; }
};

// Of the force across the bisector m of the tangents, phi = 2 mu / c with c = |t1 + t2| = 2 cos(theta/2).
Bound coulomb_bound(const FrictionOfBody& body, const FrictionPoint& at, double mu) {
  const Tangents t(at);
  const Eigen::Vector3d sum = t.t1 + t.t2;
  const double c = sum.norm(), phi = 2 * mu / c, phi_c = -phi / c;
  const Eigen::Vector3d m = sum / c;
  const double along = at.force.dot(m), e = body.least_force;
  const Eigen::Vector3d across = at.force - along * m;
  const double root = std::sqrt(across.squaredNorm() + e * e), normal = root - e;
  // dN = (across . dforce - along force_across . dm) / root, dm = (I - m m') (dt1 + dt2) / c,
  // dc = m . (dt1 + dt2).
  const Eigen::Vector3d by_tangent = -phi * along / (root * c) * across + normal * phi_c * m;
  return {{phi * normal, t.by_left(by_tangent), t.by_right(by_tangent)}, phi / root * across};
}

// The capstan's phi, and its derivative by x = sin^2(theta/2) = |t2 - t1|^2/4. For theta/2 = h:
// dphi/dh = (1 - tau^2) s (mu s - tau c)/S^3, with s = sin h, c = cos h and S^2 = s^2 + tau^2 c^2.
std::pair<double, double> capstan_factor(double mu, double s, double c) {
  constexpr double small = 1e-4, least_cosine = 1e-6;
  if (s < small) return {mu / std::sqrt(1 + mu * mu) * (1 + s * s / 6), mu / (6 * std::sqrt(1 + mu * mu))};
  const double tau = std::tanh(mu * std::atan2(s, c)), S = std::sqrt(s * s + tau * tau * c * c);
  return {tau / S, (1 - tau * tau) * (mu * s - tau * c) / (2 * std::max(c, least_cosine) * S * S * S)};
}

// Of the whole force.
Bound whole_bound(const FrictionOfBody& body, const FrictionPoint& at, double mu) {
  const Tangents t(at);
  const Eigen::Vector3d turn = t.t2 - t.t1;
  const bool capstan = body.friction->law == Friction::Law::capstan;
  const auto [phi, phi_x] =
      capstan ? capstan_factor(mu, turn.norm() / 2, (t.t1 + t.t2).norm() / 2) : std::pair(mu, 0.0);
  const double e = body.least_force, root = std::sqrt(at.force.squaredNorm() + e * e), whole = root - e;
  const Eigen::Vector3d by_turn = whole * phi_x / 2 * turn;
  return {{phi * whole, t.by_left(-by_turn), t.by_right(by_turn)}, phi / root * at.force};
}

// F_c by time and by travel, and its derivative by the place.
std::pair<double, double> brake(const FrictionOfBody& body, const FrictionPoint& at) {
  const Friction& friction = *body.friction;
  const double force = friction.force.empty() ? 0 : value_and_slope(friction.force, at.t).first;
  if (friction.force_over.empty()) return {force, 0};
  const double travel = at.s - body.start;
  const auto [more, slope] = value_and_slope(friction.force_over, std::abs(travel));
  return {force + more, travel < 0 ? -slope : slope};
}

}  // namespace

FrictionForce friction_force(const FrictionOfBody& body, const FrictionPoint& at,
                             const FrictionMemory& before) {
  const Friction& friction = *body.friction;
  const double k = body.stiffness, d = body.damping, c = friction.viscous, c_2 = friction.quadratic;
  const double a = at.left.norm(), b = at.right.norm(), l = (a + b) / 2;
  const Eigen::Vector3d l_left = at.left / (2 * a), l_right = at.right / (2 * b);
  const double moved = at.s - before.s;
  const double mu = before.slides == 0 ? friction.sticking_coefficient() : friction.coefficient;
  const Bound normal =
      friction.law == Friction::Law::coulomb ? coulomb_bound(body, at, mu) : whole_bound(body, at, mu);
  const auto [F_c, F_c_by_s] = brake(body, at);

  FrictionForce f{};
  f.per_along = l;
  f.bound = normal.value + F_c;
  f.trial = k * (before.z + l * moved) + d * l * at.rate;
  const bool holds = before.slides == 0 && f.bound > 0 && std::abs(f.trial) <= f.bound;
  const int way = before.slides != 0 ? before.slides : f.trial > 0 ? 1 : -1;
  const double held = holds ? f.trial : f.bound > 0 ? way * f.bound : 0;
  const double viscous = c * l * at.rate, quadratic = c_2 * l * l * at.rate * std::abs(at.rate);
  f.along = -held - viscous - quadratic;
  f.value = l * f.along;
  f.by_rate = -c * l * l - 2 * c_2 * l * l * l * std::abs(at.rate);
  f.by_left = (f.along - viscous - 2 * quadratic) * l_left;
  f.by_right = (f.along - viscous - 2 * quadratic) * l_right;
  if (holds) {
    f.by_s = -k * l * l;
    f.by_rate -= d * l * l;
    f.by_left -= l * (k * moved + d * at.rate) * l_left;
    f.by_right -= l * (k * moved + d * at.rate) * l_right;
    f.memory = {before.z + l * moved, at.s, 0};
    return f;
  }
  if (f.bound > 0) {
    f.by_s = -way * l * F_c_by_s;
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
