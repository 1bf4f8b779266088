#include "nurbs/area_moments.h"

#include <cmath>

#include "nurbs/gauss_panels.h"

namespace nurbeam {
namespace {

/// The integral over u in [0,1] of weight(r) (x dy - y dx) along a cubic.
template <typename Weight>
double swept(const RationalCubic& cubic, const Weight& weight) {
  const auto f = [&](double u) {
    const Eigen::Matrix<double, 3, 6> r = cubic.derivatives(u);
    return weight(r(0, 0), r(1, 0)) * (r(0, 0) * r(1, 1) - r(1, 0) * r(0, 1));
  };
  const double scale = gauss([&](double u) { return std::abs(f(u)); }, 0, 1);
  return panels_of(f, 0, 1, scale, 1e-15).integrals.back();
}

}  // namespace

AreaMoments& AreaMoments::operator+=(const AreaMoments& other) {
  area += other.area;
  first += other.first;
  second += other.second;
  return *this;
}

AreaMoments area_moments(std::span<const RationalCubic> loop) {
  const auto one = [](double, double) { return 1.0; };
  const auto x = [](double a, double) { return a; };
  const auto y = [](double, double b) { return b; };
  const auto xx = [](double a, double) { return a * a; };
  const auto xy = [](double a, double b) { return a * b; };
  const auto yy = [](double, double b) { return b * b; };
  AreaMoments moments;
  for (const RationalCubic& cubic : loop) {
    moments.area += swept(cubic, one) / 2;
    moments.first += Eigen::Vector2d(swept(cubic, x), swept(cubic, y)) / 3;
    moments.second(0, 0) += swept(cubic, xx) / 4;
    moments.second(0, 1) += swept(cubic, xy) / 4;
    moments.second(1, 1) += swept(cubic, yy) / 4;
  }
  moments.second(1, 0) = moments.second(0, 1);
  return moments;
}

}  // namespace nurbeam
