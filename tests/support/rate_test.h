#pragma once
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <random>

namespace nurbeam::testing {

inline Eigen::VectorXd random_vector(Eigen::Index size, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  return Eigen::VectorXd::NullaryExpr(size, [&] { return unit(random); });
}

/// Expects f'(0) = derivative of a vector f: the error of central differences falls with the square of the
/// step, or is round-off at both steps.
inline void expect_rate(const std::function<Eigen::VectorXd(double)>& f, const Eigen::VectorXd& derivative,
                        double h = 4e-3) {
  double size = 0;
  const auto error = [&](double step) {
    const Eigen::VectorXd more = f(step), less = f(-step);
    size = std::max({size, more.norm(), less.norm()});
    return ((more - less) / (2 * step) - derivative).norm();
  };
  const double coarse = error(h), fine = error(h / 2);
  const double round_off = 1e-13 * size / h + 1e-11 * derivative.norm();
  if (coarse <= 100 * round_off && fine <= 100 * round_off) return;
  EXPECT_LE(coarse, 0.02 * derivative.norm() + 1e-3 * size);
  EXPECT_NEAR(coarse / fine, 4, 0.25)
      << "errors " << coarse << " and " << fine << ", derivative of size " << derivative.norm();
}

/// The same of a number.
inline void expect_rate_of_number(const std::function<double(double)>& f, double derivative,
                                  double h = 4e-3) {
  expect_rate([&](double step) { return Eigen::VectorXd::Constant(1, f(step)); },
              Eigen::VectorXd::Constant(1, derivative), h);
}

}  // namespace nurbeam::testing
