#include "fem/comparison/printed_element.h"

#include <cmath>

#include "fem/element/quadrature.h"
#include "fem/material/point_law.h"

namespace nurbeam {

namespace {

using Eigen::Matrix4d;
using Eigen::Vector2d;
using Eigen::Vector4d;

// Shape functions of Eq. 1 of [S] at u with their derivatives by x, columns s, s_x, s_xx.
Eigen::Matrix<double, 4, 3> shape_functions(const Vector4d& w, double l, double u) {
  const double v = 1 - u;
  Eigen::Matrix<double, 4, 3> b;  // Bernstein polynomials and their derivatives by u
  b.col(0) << v * v * v, 3 * u * v * v, 3 * u * u * v, u * u * u;
  b.col(1) << -3 * v * v, 3 * v * v - 6 * u * v, 6 * u * v - 3 * u * u, 3 * u * u;
  b.col(2) << 6 * v, 6 * u - 12 * v, 6 * v - 12 * u, 6 * u;
  b = w.asDiagonal() * b;
  const Eigen::RowVector3d W = b.colwise().sum();
  Eigen::Matrix<double, 4, 3> R;  // R = b/W, by the rule for quotients
  R.col(0) = b.col(0) / W[0];
  R.col(1) = (b.col(1) - W[1] * R.col(0)) / (W[0] * l);
  R.col(2) = (b.col(2) - 2 * l * W[1] * R.col(1) - W[2] * R.col(0)) / (W[0] * l * l);
  Matrix4d nodal;
  nodal << 1, 1, 0, 0,                  //
      0, l * w[0] / (3 * w[1]), 0, 0,   //
      0, 0, 1, 1,                       //
      0, 0, -l * w[3] / (3 * w[2]), 0;  //
  return nodal * R;
}

struct CurvatureAt {
  double value;
  Vector2d by_rx, by_rxx;
};

CurvatureAt second_derivative(const Vector2d& rxx) {
  const double value = rxx.norm();
  return {value, Vector2d::Zero(), value > 0 ? Vector2d(rxx / value) : Vector2d::Zero()};
}

CurvatureAt spatial(const Vector2d& rx, const Vector2d& rxx) {
  const double A = rx.squaredNorm(), p = std::pow(A, -1.5);
  const double value = p * (rx.x() * rxx.y() - rx.y() * rxx.x());
  return {value, p * Vector2d(rxx.y(), -rxx.x()) - 3 * value / A * rx, p * Vector2d(-rx.y(), rx.x())};
}

CurvatureAt curvature_at(PrintedCurvature measure, const Vector2d& rx, const Vector2d& rxx) {
  return measure == PrintedCurvature::spatial ? spatial(rx, rxx) : second_derivative(rxx);
}

double strain_at(const Vector2d& rx) { return (rx.squaredNorm() - 1) / 2; }

}  // namespace

PrintedElement::PrintedElement(const RancfElement& drawn, const BeamProperties& beam,
                               PrintedCurvature curvature, PrintedStart start, int panels)
    : beam_(beam), curvature_(curvature) {
  for (int i = 0; i < panels * GaussRule::size; ++i) {
    const int panel = i / GaussRule::size, k = i % GaussRule::size;
    const double u = (panel + GaussRule::points[k]) / panels;
    const Eigen::Matrix<double, 4, 3> s = shape_functions(drawn.weights, drawn.l, u);
    Point point{s.col(1), s.col(2), GaussRule::weights[k] * drawn.l / panels};
    if (start == PrintedStart::as_drawn) {
      const Vector2d rx = drawn.e.topRows<2>() * point.d1, rxx = drawn.e.topRows<2>() * point.d2;
      point.strain0 = strain_at(rx);
      point.curvature0 = curvature_at(curvature, rx, rxx).value;
    }
    mass_ += beam.mass_per_length * point.weight * s.col(0) * s.col(0).transpose();
    load_factors_ += beam.mass_per_length * point.weight * s.col(0);
    points_.push_back(point);
  }
}

PrintedElement::Nodes PrintedElement::elastic_force(const Nodes& e) const {
  const PointLaw law(beam_);
  Nodes force = Nodes::Zero();
  for (const Point& p : points_) {
    const Vector2d rx = e * p.d1, rxx = e * p.d2;
    const CurvatureAt kappa = curvature_at(curvature_, rx, rxx);
    const double moment = law.moment(kappa.value - p.curvature0),
                 stretching = law.axial(strain_at(rx) - p.strain0).force;
    force += p.weight * ((stretching * rx + moment * kappa.by_rx) * p.d1.transpose() +
                         moment * kappa.by_rxx * p.d2.transpose());
  }
  return force;
}

PrintedElement::Energy PrintedElement::elastic_energy(const Nodes& e) const {
  const PointLaw law(beam_);
  Energy energy{0, 0};
  for (const Point& p : points_) {
    const Vector2d rx = e * p.d1, rxx = e * p.d2;
    const double bend = curvature_at(curvature_, rx, rxx).value - p.curvature0;
    energy.axial += p.weight * law.axial(strain_at(rx) - p.strain0).energy;
    energy.bending += p.weight * law.bending_energy(bend * bend);
  }
  return energy;
}

}  // namespace nurbeam
