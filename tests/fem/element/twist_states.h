#pragma once
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "fem/element/twist_element.h"
#include "nurbs/primitives.h"

/// Elements with torsion, deformed and in motion, and what their derivatives are checked with.
namespace nurbeam {

inline RationalCubic cubic(const std::array<Eigen::Vector3d, 4>& P, const std::array<double, 4>& w) {
  Eigen::Matrix4d points;
  for (int i = 0; i < 4; ++i) points.col(i) << w[i] * P[i], w[i];
  return RationalCubic(points);
}

/// A space curve that turns by 108 degrees, of 2.67 m, with sections that turn by 2.5 rad/m.
inline ReferenceCurve bent_curve() {
  return ReferenceCurve({cubic({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0.2),
                                Eigen::Vector3d(1.2, 1, 0.4), Eigen::Vector3d(0.6, 1.5, 1.4)},
                               {1, 0.8, 1.3, 1})},
                        3)
      .oriented({Orientation::Rule::start, {0, 1, 0}, {{0, 0}, {3, 7.5}}});
}

inline BeamProperties properties(double damping = 0) {
  BeamProperties p(1e4, 0, 1, damping);
  p.sections = SectionStiffness{3, 1, 0.2, 0.7, 0.04};
  return p;
}

inline TwistLayout::Coordinates drawn_state(const ReferenceCurve& curve, double s_a, double s_b) {
  TwistLayout::Coordinates q = TwistLayout::Coordinates::Zero();
  q.segment<3>(TwistLayout::r(0)) = curve.position(s_a);
  q.segment<3>(TwistLayout::slope(0)) = curve.tangent(s_a);
  q.segment<3>(TwistLayout::r(1)) = curve.position(s_b);
  q.segment<3>(TwistLayout::slope(1)) = curve.tangent(s_b, true);
  q[TwistLayout::place(0)] = s_a;
  q[TwistLayout::place(1)] = s_b;
  return q;
}

inline TwistLayout::Coordinates random_coordinates(std::mt19937& random, double amount) {
  std::uniform_real_distribution<double> unit(-amount, amount);
  TwistLayout::Coordinates y = TwistLayout::Coordinates::NullaryExpr([&] { return unit(random); });
  y[TwistLayout::place(0)] = y[TwistLayout::place(1)] = 0;
  return y;
}

/// An element on a part of the curve, strongly deformed and in motion.
struct Deformed {
  ReferenceCurve curve = bent_curve();
  BeamProperties beam;
  double s_a, s_b;
  TwistElement element;
  TwistState x;

  explicit Deformed(int seed, double damping = 0, double from = 0.4, double to = 1.3)
      : beam(properties(damping)),
        s_a(from),
        s_b(to),
        element(curve, beam, Chart{.segment = 0, .constant_weights = {}}, from, to) {
    std::mt19937 random(seed);
    x.q = drawn_state(curve, s_a, s_b) + random_coordinates(random, 0.25);
    x.v = random_coordinates(random, 1);
    x.a = random_coordinates(random, 1);
  }
  Deformed(const Deformed&) = delete;
  Deformed& operator=(const Deformed&) = delete;

  TwistState moved(const TwistLayout::Coordinates& q, const TwistLayout::Coordinates& v,
                   const TwistLayout::Coordinates& a, double h) const {
    return {x.q + h * q, x.v + h * v, x.a + h * a};
  }
};

// Central differences of f about 0: their error must fall with the square of the step.
template <class F, class Value>
void expect_derivative(const F& f, const Value& derivative, double h) {
  const auto error = [&](double step) {
    return Value((f(step) - f(-step)) / (2 * step) - derivative).norm();
  };
  const double coarse = error(h), fine = error(h / 2);
  EXPECT_LT(coarse, 0.02 * derivative.norm());
  EXPECT_NEAR(coarse / fine, 4, 0.25) << coarse << " " << fine;
}
using Scalar = Eigen::Matrix<double, 1, 1>;

inline double strain_energy(const TwistElement& element, const TwistState& x) {
  const TwistEnergy energy = element.energy(x);
  return energy.bending + energy.torsion;
}

}  // namespace nurbeam
