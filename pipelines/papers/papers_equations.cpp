#include <algorithm>
#include <cmath>
#include <numbers>

#include "fem/comparison/merged_weights.h"
#include "fem/element/rancf_basis.h"
#include "fem/element/subdivision.h"
#include "pipelines/papers/papers.h"
#include "pipelines/papers/pendulum_motion.h"

// The equations of both papers that are identities, each tried on the element that Section 7 of [S] prints.
namespace nurbeam::papers {

namespace {

using Eigen::Vector3d;

RancfElement printed_element() {
  const RationalCubic axis = pendulum_axis(PendulumArc::paper);
  const double l = length(axis);
  return {to_rancf(axis, l), axis.points().row(3).transpose(), l};
}

RationalCubic curve_of(const RancfElement& element) {
  return to_bezier(element.e, element.weights, element.l);
}

// Nodal coordinates to control points and back.
double round_trip_error(const RancfElement& element) {
  return (to_rancf(curve_of(element), element.l) - element.e).cwiseAbs().maxCoeff();
}

// Points of both parts against the whole, and the slope that they share.
double split_error(const RancfElement& element, double u_j) {
  const auto [left, right] = split(element, u_j);
  const RationalCubic whole = curve_of(element), first = curve_of(left), second = curve_of(right);
  double largest = (left.e.col(3) - right.e.col(1)).norm();
  for (int i = 0; i <= 10; ++i) {
    const double u = i / 10.0;
    largest = std::max({largest, (first.point(u) - whole.point(u_j * u)).norm(),
                        (second.point(u) - whole.point(u_j + (1 - u_j) * u)).norm()});
  }
  return largest;
}

// How far a merged element passes from the node that it lost, the two halves having been bent apart [m].
double merge_error(const RancfElement& element) {
  const auto [left, right] = split(element, 0.45);
  const Vector3d wanted = left.e.col(2) + Vector3d(1e-3, -2e-3, 0);
  const Vector3d slope_a = element.l * element.e.col(1), slope_b = element.l * element.e.col(3);
  const auto w = merged_weights(2, element.e.col(0), slope_a, element.e.col(2), slope_b, wanted, 0.45);
  const RationalCubic merged = to_bezier(element.e, Eigen::Vector4d(w[0], w[1], w[2], w[3]), element.l);
  return (merged.point(0.45) - wanted).norm();
}

// Eq. 8 of [S] holds for r_x doubled at A and halved at B; how far the shape then moves [m].
double eq_8_misses(const RancfElement& element) {
  RancfElement other = element;
  other.e.col(1) *= 2;
  other.e.col(3) /= 2;
  return (curve_of(other).point(0.5) - curve_of(element).point(0.5)).norm();
}

double reparametrisation_error(const RancfElement& element) {
  constexpr double c = 1.7;
  const RationalCubic other = curve_of(reparametrised(element, c, 2, element.l)), same = curve_of(element);
  double largest = 0;
  for (int i = 0; i <= 10; ++i) {
    const double t = i / 10.0;
    largest = std::max(largest, (other.point(t) - same.point(c * t / (1 - t + c * t))).norm());
  }
  return largest;
}

// Arc length by quadrature against chords with their error of second order taken out.
double arc_length_error(const RancfElement& element) {
  const RationalCubic curve = curve_of(element);
  const auto by_chords = [&](int n) {
    double sum = 0;
    for (int i = 0; i < n; ++i)
      sum += (curve.point((i + 1.0) / n) - curve.point(static_cast<double>(i) / n)).norm();
    return sum;
  };
  return std::abs((4 * by_chords(4000) - by_chords(2000)) / 3 - length(curve));
}

double density_error(const RancfElement& element) {
  const ArcLengthMap map(curve_of(element));
  const double x = map.length() / 3;
  return std::abs(map.parameter(x) / parameter_density(map, x) - x / map.length());
}

// The differences of neighbouring parts from k [m].
double grading_error() {
  constexpr double L = 1, k = 0.03;
  std::vector<double> x = graded_places(L, 5, k);
  x.insert(x.begin(), 0);
  x.push_back(L);
  double largest = 0;
  for (std::size_t i = 2; i < x.size(); ++i)
    largest = std::max(largest, std::abs(x[i] - 2 * x[i - 1] + x[i - 2] - k));
  return largest;
}

}  // namespace

void write_equations(Page& page) {
  const RancfElement element = printed_element();
  const std::string rancf = "fem/element/rancf_basis.h", subdivision = "fem/element/subdivision.h";
  page.status({"[D] Eqs. 1-10, [S] Eqs. 1-2: the element", rancf, "reproduced",
               number(round_trip_error(element), 1) + ", there and back"});
  page.status({"[D] Eqs. 11-15: moving ends", "fem/element/moving_basis.h", "reproduced",
               "in tests, against nested dual numbers"});
  page.status({"[D] Eqs. 21-28, [S] Eqs. 3-7: division of an element", subdivision, "reproduced",
               number(split_error(element, 0.37), 1) + " m"});
  page.status({"[D] Eqs. 29-38: merging", "fem/comparison/merged_weights.h",
               "reproduced as a comparison (\"paper's rule\"); nurbeam merges otherwise",
               number(merge_error(element), 1) + " m from the removed node"});
  page.status({"[S] Eq. 8: equal shapes", subdivision, "corrected: necessary, not sufficient",
               number(eq_8_misses(element), 2) +
                   " m with r_x doubled at A and halved at B, which Eq. 8 allows; " +
                   number(reparametrisation_error(element), 1) + " m by nurbeam's rule"});
  page.status({"[S] Eqs. 9-12: arc length", "nurbs/arc_length.h", "reproduced",
               number(arc_length_error(element), 1) + " m from chords"});
  page.status({"[S] Eqs. 13-16: density of parameter points", subdivision, "reproduced, without counting",
               number(density_error(element), 1)});
  page.status(
      {"[S] Eqs. 17-19: graded division", subdivision, "reproduced", number(grading_error(), 1) + " m"});
  page.status({"[D] Figs. 1-7, [S] Figs. 1, 2, 10: sketches", "-", "no results in them", "-"});
}

}  // namespace nurbeam::papers
