#include "solver/steps/stage_equations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/algebra/finite.h"
#include "solver/system/balance_reference.h"
#include "solver/system/mass_scale.h"

namespace nurbeam {

namespace {

using Complex = std::complex<double>;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

StageEquations::StageEquations(const SecondOrderSystem& system, const State& start)
    : system_(&system),
      n_(system.coordinate_count()),
      m_(system.constraint_count()),
      inverse_scale_(system.coordinate_scale().cwiseInverse()),
      mass_(system.tangent_pattern().matrix()),
      damping_(mass_),
      stiffness_(mass_),
      real_(mass_),
      complex_(mass_.cast<Complex>()) {
  mass_scale_ = nurbeam::mass_scale(system, start, real_);
  const int *starts = real_.outerIndexPtr(), *rows = real_.innerIndexPtr();
  for (int column = 0; column < real_.cols(); ++column)
    for (int k = starts[column]; k < starts[column + 1]; ++k)
      if (column >= n_ || rows[k] >= n_) of_constraints_.push_back(k);
}

bool StageEquations::linearise(const State& place, double h, double tolerance) {
  h_ = h;
  before_.clear();
  system_->tangents(place, {TangentWeights{.stiffness = 1}, {.damping = 1}}, {&stiffness_, &damping_});
  system_->tangent(place, {.mass = 1}, mass_);
  const double g = radau_method().gamma * h;
  const Complex g_c = radau_method().gamma_c * h;
  real_.coeffs() = (mass_.coeffs() + g * damping_.coeffs() + g * g * stiffness_.coeffs()) / mass_scale_;
  complex_.coeffs() = (mass_.coeffs().cast<Complex>() + g_c * damping_.coeffs().cast<Complex>() +
                       g_c * g_c * stiffness_.coeffs().cast<Complex>()) /
                      mass_scale_;
  for (const int k : of_constraints_) {
    complex_.valuePtr()[k] = real_.valuePtr()[k] = stiffness_.valuePtr()[k];
    damping_.valuePtr()[k] = mass_.valuePtr()[k] = 0;
  }
  if (!is_analysed_) is_regular_ = complex_solver_.analyse(complex_);
  is_analysed_ = true;
  if (!is_regular_ || !all_finite(real_.coeffs()) || !real_solver_.factorise(real_) ||
      !(complex_solver_.factorise(complex_) > 0))
    return false;
  State still = place;
  measure_balance(*system_, place, real_.valuePtr(), {g * g, mass_scale_, tolerance}, inverse_scale_, still,
                  reference_);
  return true;
}

double StageEquations::scale(Residuals& residuals) const {
  const double factor = std::pow(radau_method().gamma * h_, 2) / mass_scale_;
  double largest = 0;
  for (Eigen::VectorXd& residual : residuals) {
    residual.head(n_) *= factor;
    if (!all_finite(residual)) return not_a_number;
    largest = std::max(largest, residual.cwiseProduct(reference_).lpNorm<Eigen::Infinity>());
  }
  return largest;
}

double StageEquations::solve(const Residuals& residuals, std::array<StageCorrection, stages>& corrections) {
  const RadauMethod& method = radau_method();
  Diagonal x{Eigen::VectorXd::Zero(n_ + m_), Eigen::VectorXcd::Zero(n_ + m_)};
  for (int i = 0; i < stages; ++i) {
    x.real -= method.from[i] * residuals[i];
    x.complex -= method.from_c[i] * residuals[i];
  }
  // The residuals are scaled for the real system.
  x.complex.head(n_) *= std::pow(method.gamma_c / method.gamma, 2);
  real_solver_.solve(x.real, x.real);
  x.complex = complex_solver_.solve(x.complex);
  update(x);
  if (!all_finite(x.real) || !all_finite(x.complex.real()) || !all_finite(x.complex.imag()))
    return not_a_number;
  corrections = of_stages(x);
  double largest = 0;
  for (const StageCorrection& correction : corrections)
    largest = std::max(largest, correction.q.cwiseProduct(inverse_scale_).lpNorm<Eigen::Infinity>());
  return largest;
}

/// The product of the positions in x and y, over the coordinate scale.
double StageEquations::product(const Diagonal& x, const Diagonal& y) const {
  const Eigen::ArrayXd weights = inverse_scale_.array().square();
  const auto of_complex = x.complex.head(n_).conjugate().cwiseProduct(y.complex.head(n_)).real();
  const auto of_real = x.real.head(n_).cwiseProduct(y.real.head(n_));
  return (weights * (of_real + 2 * of_complex).array()).sum();
}

void StageEquations::update(Diagonal& correction) {
  constexpr double longest = 2;  // limit of an updated correction over the one without the last update
  for (std::size_t k = 0; k < before_.size(); ++k) {
    const double square = product(before_[k], before_[k]);
    if (square == 0) break;
    const double along = product(before_[k], correction) / square;
    if (k + 1 < before_.size()) {
      correction.real += along * before_[k + 1].real;
      correction.complex += along * before_[k + 1].complex;
    } else {
      const double factor = 1 / std::max(1 - along, 1 / longest);
      correction.real *= factor;
      correction.complex *= factor;
    }
  }
  before_.push_back(correction);
}

std::array<StageCorrection, StageEquations::stages> StageEquations::of_stages(const Diagonal& x) const {
  const RadauMethod& method = radau_method();
  const double g = method.gamma * h_;
  const Complex g_c = method.gamma_c * h_;
  std::array<StageCorrection, stages> corrections;
  for (int i = 0; i < stages; ++i) {
    // Derivatives divide by h gamma.
    const auto derivative = [&](int order, Eigen::Index first, Eigen::Index count) -> Eigen::VectorXd {
      return method.to[i] / std::pow(g, order) * x.real.segment(first, count) +
             2 * (method.to_c[i] / std::pow(g_c, order) * x.complex.segment(first, count)).real();
    };
    corrections[i] = {derivative(0, 0, n_), derivative(1, 0, n_), derivative(2, 0, n_),
                      mass_scale_ * derivative(2, n_, m_)};
  }
  return corrections;
}

double StageEquations::filtered(const Eigen::VectorXd& of_q) const {
  Eigen::VectorXd padded = Eigen::VectorXd::Zero(n_ + m_);
  padded.head(n_) = of_q / mass_scale_;
  Eigen::VectorXd x = mass_ * padded + radau_method().gamma * h_ * (damping_ * padded);
  x.tail(m_).setZero();
  real_solver_.solve(x, x);
  const auto error = x.head(n_).cwiseProduct(inverse_scale_);
  return all_finite(error) ? error.lpNorm<Eigen::Infinity>() : not_a_number;
}

}  // namespace nurbeam
