#include "pipelines/verification/hanging_string.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nurbeam::verification {

double string_stretch(double S, double EA, double T) {
  double x = 1 + (T - S) / (EA + S);
  for (int i = 0; i < 50; ++i) {
    const double f = (S + EA * (x * x - 1) / 2) * x - T, slope = S + EA * (3 * x * x - 1) / 2;
    x -= f / slope;
    if (std::abs(f) <= 1e-15 * std::abs(T)) break;
  }
  return x;
}

namespace {

constexpr int panels = 60;
constexpr double gauss_places[] = {0.5 - 0.3872983346207417, 0.5, 0.5 + 0.3872983346207417};
constexpr double gauss_weights[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};

// The way (x, z) along a length h that starts with the force (H, V).
Eigen::Vector2d way(double H, double V, double h, double tension, double stiffness, double weight) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  const double panel = h / panels;
  for (int i = 0; i < panels; ++i)
    for (int point = 0; point < 3; ++point) {
      const Eigen::Vector2d force(H, V + weight * panel * (i + gauss_places[point]));
      const double T = force.norm();
      sum += string_stretch(tension, stiffness, T) / T * gauss_weights[point] * panel * force;
    }
  return sum;
}

}  // namespace

Eigen::Vector3d pull_of_string(const Eigen::Vector3d& chord, double length, double tension, double stiffness,
                               double weight) {
  const Eigen::Vector2d end(chord.head<2>().norm(), chord.z());
  const double stretch = end.norm() / length;
  Eigen::Vector2d force = (tension + stiffness * (stretch * stretch - 1) / 2) / length * end;
  force.y() -= weight * length / 2;
  const auto error = [&](const Eigen::Vector2d& f) -> Eigen::Vector2d {
    return way(f.x(), f.y(), length, tension, stiffness, weight) - end;
  };
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector2d open = error(force);
    if (open.norm() < 1e-14 * length) break;
    const double h = 1e-6 * force.norm();
    Eigen::Matrix2d slope;
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector2d by = h * Eigen::Vector2d::Unit(k);
      slope.col(k) = (error(force + by) - error(force - by)) / (2 * h);
    }
    force -= slope.partialPivLu().solve(open);
  }
  Eigen::Vector3d pull;
  pull << force.x() / end.x() * chord.head<2>(), force.y();
  return pull;
}

// From the start to the end, for the force (H, V) at the start and the springs' pulls: the horizontal force
// changes where a spring pulls aslant, the vertical one by weight, too.
std::vector<HangingString::AtPull> HangingString::shoot(const Eigen::VectorXd& unknowns) const {
  double x = 0, z = 0, s = 0, H = unknowns[0], V = unknowns[1];
  const auto go_to = [&](double end) {
    const Eigen::Vector2d by = way(H, V, end - s, tension, stiffness, weight);
    x += by.x();
    z += by.y();
    V += weight * (end - s);
    s = end;
  };
  std::vector<AtPull> result;
  for (std::size_t i = 0; i < pulls.size(); ++i) {
    const Pull& pull = pulls[i];
    go_to(pull.s);
    const double before = std::hypot(H, V), dx = pull.x - x, dz = pull.z - z, d = std::hypot(dx, dz);
    const double N = unknowns[2 + static_cast<long>(i)];
    if (d > 0) {
      H -= N * dx / d;
      V -= N * dz / d;
    }
    V -= pull.force_z;
    result.push_back({x, z, N, before, std::hypot(H, V)});
  }
  go_to(length);
  result.push_back({x, z, 0, std::hypot(H, V), 0});
  return result;
}

// Of the end's place, and of the springs' laws, all lengths.
Eigen::VectorXd HangingString::residual(const Eigen::VectorXd& unknowns) const {
  const std::vector<AtPull> at = shoot(unknowns);
  Eigen::VectorXd error(unknowns.size());
  error[0] = at.back().x - span;
  error[1] = at.back().z;
  for (std::size_t i = 0; i < pulls.size(); ++i) {
    const double k = pulls[i].stiffness;
    const double stretched = std::hypot(pulls[i].x - at[i].x, pulls[i].z - at[i].z) - pulls[i].free_length;
    error[2 + static_cast<long>(i)] = k > 0 ? at[i].spring / k - std::max(0.0, stretched) : at[i].spring;
  }
  return error;
}

HangingString::Solution HangingString::solve() const {
  double load = weight * length;
  for (const Pull& pull : pulls) load -= pull.force_z;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2 + static_cast<long>(pulls.size()));
  x[0] = tension > 0 ? tension : 5 * std::abs(load);
  x[1] = -load / 2;
  Eigen::VectorXd error = residual(x);
  for (int i = 0; i < 100 && error.norm() > 1e-14 * span; ++i) {
    Eigen::MatrixXd slope(x.size(), x.size());
    const double h = 1e-6 * std::hypot(x[0], x[1]);
    for (long k = 0; k < x.size(); ++k) {
      const Eigen::VectorXd by = h * Eigen::VectorXd::Unit(x.size(), k);
      slope.col(k) = (residual(x + by) - residual(x - by)) / (2 * h);
    }
    const Eigen::VectorXd full = -slope.partialPivLu().solve(error);
    double share = 1;
    while (share > 1e-3 && !(residual(x + share * full).norm() < error.norm())) share /= 2;
    if (share <= 1e-3 && error.norm() < 1e-11 * span) break;  // its round-off
    x += share * full;
    error = residual(x);
  }
  if (!(error.norm() < 1e-10 * span))
    throw std::runtime_error("the string's boundary-value problem does not converge");
  return {x[0], x[1], shoot(x)};
}

}  // namespace nurbeam::verification
