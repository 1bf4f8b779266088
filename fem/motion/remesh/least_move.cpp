#include "fem/motion/remesh/least_move.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>

namespace nurbeam {

namespace {

// The least move by Newton's method for 1 / mu, in which small moves are linear, from a value near by.
// Nothing where this does not converge fast.
std::optional<LeastMove> refined(const EnergyParabola& energy, double e, double mu) {
  constexpr int most = 6;
  constexpr double small = 1e-8;  // a smaller correction is followed by one that is lost in round-off
  const double sign = e > 0 ? 1 : -1;
  for (int i = 0; i < most && sign * mu > 0; ++i) {
    const Eigen::LLT<Eigen::MatrixXd> stiff(sign * (energy.K + mu * energy.M));
    if (stiff.info() != Eigen::Success) return std::nullopt;
    const Eigen::VectorXd d = stiff.solve(-sign * energy.g), inertia = energy.M * d;
    const Eigen::VectorXd rate = stiff.solve(-sign * inertia);  // derivative of d by mu
    const double open = energy.g.dot(d) + 0.5 * d.dot(energy.K * d) + e;
    const double part = open / (mu * mu * inertia.dot(rate));  // relative change of 1 / mu
    if (!(part < 1)) return std::nullopt;
    const double correction = mu / (1 - part) - mu;
    mu += correction;
    if (std::abs(correction) <= small * std::abs(mu)) return LeastMove{d + correction * rate, mu};
  }
  return std::nullopt;
}

// The least move by the modes of K in M.
LeastMove searched(const EnergyParabola& energy, double e) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(energy.K, energy.M);
  const Eigen::ArrayXd K = modes.eigenvalues().array();
  const Eigen::ArrayXd g = (modes.eigenvectors().transpose() * energy.g).array();
  const double largest = K.abs().maxCoeff();
  // The change of energy falls to zero as mu moves outwards from where K + mu M loses its sign.
  const double end = e > 0 ? std::max(0.0, -K.minCoeff()) : -std::max(0.0, K.maxCoeff());
  const auto mu = [&](double exponent) { return end + (e > 0 ? 1 : -1) * largest * std::pow(10, exponent); };
  const auto change = [&](double exponent) {
    const Eigen::ArrayXd stiff = K + mu(exponent);
    return (g.square() * (0.5 * K / stiff - 1) / stiff).sum();
  };
  double low = -12, high = 6;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (std::abs(change(middle)) > std::abs(e) ? low : high) = middle;
  }
  return {modes.eigenvectors() * (-g / (K + mu(high))).matrix(), mu(high)};
}

}  // namespace

LeastMove least_move(const EnergyParabola& energy, double e, double near) {
  if (auto move = refined(energy, e, near)) return *std::move(move);
  return searched(energy, e);
}

LeastMove least_move(const EnergyParabola& energy, double e) {
  // mu for small moves, where the curvature of the parabola does not count.
  const double small_move = energy.g.dot(Eigen::LLT<Eigen::MatrixXd>(energy.M).solve(energy.g)) / e;
  return least_move(energy, e, small_move);
}

}  // namespace nurbeam
