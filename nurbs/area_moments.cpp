#include "nurbs/area_moments.h"

#include <cmath>

#include "nurbs/gauss_panels.h"

namespace nurbeam {
namespace {

/// Integral of f over [a, b]: halved until the halves agree with the whole to 1e-15 of `scale`.
template <typename Function>
double integral(const Function& f, double a, double b, double whole, double scale, int depth = 0) {
  const double middle = 0.5 * (a + b), left = gauss(f, a, middle), right = gauss(f, middle, b);
  constexpr int deepest = 40;
  if (std::abs(left + right - whole) <= 1e-15 * scale || depth == deepest) return left + right;
  return integral(f, a, middle, left, scale, depth + 1) + integral(f, middle, b, right, scale, depth + 1);
}

/// The integral over u in [0,1] of weight(r) (x dy - y dx) along a cubic.
template <typename Weight>
double swept(const RationalCubic& cubic, const Weight& weight) {
  const auto f = [&](double u) {
    const Eigen::Matrix<double, 3, 6> r = cubic.derivatives(u);
    return weight(r(0, 0), r(1, 0)) * (r(0, 0) * r(1, 1) - r(1, 0) * r(0, 1));
  };
  const double scale = gauss([&](double u) { return std::abs(f(u)); }, 0, 1);
  return integral(f, 0, 1, gauss(f, 0, 1), scale);
}

}  // namespace

AreaMoments& AreaMoments::operator+=(const AreaMoments& other) {
  area += other.area;
  first += other.first;
  second += other.second;
  return *this;
}

AreaMoments area_moments(const BezierPath& loop) {
  AreaMoments moments;
  for (const RationalCubic& cubic : loop.segments) {
    moments.area += swept(
                        cubic, [](double, double) { return 1.0; }) /
                    2;
    moments.first(0) += swept(
                            cubic, [](double x, double) { return x; }) /
                        3;
    moments.first(1) += swept(
                            cubic, [](double, double y) { return y; }) /
                        3;
    moments.second(0, 0) += swept(
                                cubic, [](double x, double) { return x * x; }) /
                            4;
    moments.second(0, 1) += swept(
                                cubic, [](double x, double y) { return x * y; }) /
                            4;
    moments.second(1, 1) += swept(cubic, [](double, double y) { return y * y; }) / 4;
  }
  moments.second(1, 0) = moments.second(0, 1);
  return moments;
}

}  // namespace nurbeam
