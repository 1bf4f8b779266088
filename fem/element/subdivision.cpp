#include "fem/element/subdivision.h"

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace nurbeam {

namespace {

template <class... Parts>
std::invalid_argument refusal(const Parts&... parts) {
  std::ostringstream stream;
  stream.precision(10);
  (stream << ... << parts);
  return std::invalid_argument(stream.str());
}

void check_positive(const char* what, double value) {
  if (!(value > 0 && std::isfinite(value))) throw refusal(what, " is ", value, "; it must be positive");
}

// Rows of the nodal coordinates' map applied to columns of e, with positions relative to r_A.
NodalCoordinates mapped(const Eigen::Matrix4d& rows, NodalCoordinates e) {
  const Eigen::Vector3d origin = e.col(0);
  e.col(0).setZero();
  e.col(2) -= origin;
  NodalCoordinates part = e * rows.transpose();
  part.col(0) += origin;
  part.col(2) += origin;
  return part;
}

}  // namespace

std::pair<RancfElement, RancfElement> split(const RancfElement& element, double u_j) {
  if (!(u_j > 0 && u_j < 1)) throw refusal("cannot split an element at u = ", u_j, "; 0 < u < 1 is needed");
  // Letters of [S], Eqs. (4)-(6).
  const double w0 = element.weights[0], w1 = element.weights[1], w2 = element.weights[2],
               w3 = element.weights[3];
  const double a = 1 - u_j, b = u_j, a2 = a * a, b2 = b * b, a3 = a2 * a, b3 = b2 * b;
  const double l = element.l, l1 = l * b, l2 = l * a;
  const double c = a3 * w0 + 3 * b * a2 * w1 + 3 * b2 * a * w2 + b3 * w3, cc = c * c;
  const double A = -a3 * w1 - 2 * b * a2 * w2 - b2 * a * w3;
  const double B = a3 * w0 - 3 * b2 * a * w2 - 2 * b3 * w3;
  const double C = 2 * a3 * w0 + 3 * b * a2 * w1 - b3 * w3;
  const double D = b * a2 * w0 + 2 * b2 * a * w1 + b3 * w2;

  Eigen::Matrix4d weights1, weights2, nodes1, nodes2;
  weights1 << 1, 0, 0, 0,    //
      a, b, 0, 0,            //
      a2, 2 * b * a, b2, 0,  //
      a3, 3 * b * a2, 3 * b2 * a, b3;
  weights2 << a3, 3 * b * a2, 3 * b2 * a, b3,  //
      0, a2, 2 * b * a, b2,                    //
      0, 0, a, b,                              //
      0, 0, 0, 1;
  const Eigen::RowVector4d rider((a3 * w0 + 3 * b * a2 * w1) / c, l * b * a2 * w0 / c,
                                 (3 * b2 * a * w2 + b3 * w3) / c, -b2 * a * l * w3 / c);
  nodes1 << 1, 0, 0, 0,     //
      0, l / l1 * b, 0, 0,  //
      rider,                //
      3 * b * a / l1 * (A * w0 + B * w1) / cc, l * b * a / l1 * B * w0 / cc,
      3 * b2 / l1 * (C * w2 + D * w3) / cc, -l * b2 / l1 * C * w3 / cc;
  nodes2 << rider,  //
      3 * a2 / l2 * (A * w0 + B * w1) / cc, l * a2 / l2 * B * w0 / cc,
      3 * b * a / l2 * (C * w2 + D * w3) / cc, -l * b * a / l2 * C * w3 / cc,  //
      0, 0, 1, 0,                                                              //
      0, 0, 0, l * a / l2;
  return {{mapped(nodes1, element.e), weights1 * element.weights, l1},
          {mapped(nodes2, element.e), weights2 * element.weights, l2}};
}

std::vector<RancfElement> subdivide(const RancfElement& element, const std::vector<double>& parameters) {
  std::vector<RancfElement> parts{element};
  double from = 0;
  for (const double u : parameters) {
    if (!(u > from && u < 1))
      throw refusal("cannot split an element at u = ", u, " after ", from, "; it must increase in (0, 1)");
    const auto [left, right] = split(parts.back(), (u - from) / (1 - from));
    parts.back() = left;
    parts.push_back(right);
    from = u;
  }
  return parts;
}

RancfElement reparametrised(const RancfElement& element, double c, double lambda, double new_l) {
  check_positive("the factor c of a change of parameter", c);
  check_positive("the factor lambda of weights", lambda);
  check_positive("the length l of an element", new_l);
  RancfElement changed{element.e, element.weights, new_l};
  for (int i = 0; i < 4; ++i) changed.weights[i] *= lambda * std::pow(c, i);
  changed.e.col(1) *= c * element.l / new_l;
  changed.e.col(3) *= element.l / new_l / c;
  return changed;
}

ShapeFactors shape_factors(const RancfElement& element) {
  const Eigen::Vector4d& w = element.weights;
  return {w[0] * w[2] / (w[1] * w[1]), w[1] * w[3] / (w[2] * w[2]),
          element.l * element.l * element.e.col(1).dot(element.e.col(3))};
}

double parameter_density(const ArcLengthMap& map, double x) {
  if (!(x > 0 && x <= map.length()))
    throw refusal("the parameter density at x = ", x, " m; 0 < x <= ", map.length(), " m is needed");
  return map.parameter(x) / x * map.length();
}

double grading_limit(double length, int parts) {
  return parts > 1 ? 2 * length / (double(parts) * (parts - 1)) : std::numeric_limits<double>::infinity();
}

std::vector<double> graded_places(double length, int parts, double k) {
  check_positive("the length to divide", length);
  if (parts < 1) throw refusal("cannot divide a length into ", parts, " parts; at least 1 is needed");
  const double limit = grading_limit(length, parts), n = parts;
  if (!std::isfinite(k) || std::abs(k) >= limit * (1 - 1e-9))
    throw refusal("an increment of ", k, " m leaves no room for all ", parts, " parts of a length of ",
                  length, " m; it must be greater than ", -limit, " m and less than ", limit, " m");
  std::vector<double> places;
  for (int j = 1; j < parts; ++j) places.push_back(length * j / n - k * j * (n - j) / 2);
  return places;
}

std::vector<double> graded_parameters(const ArcLengthMap& map, int parts, double k) {
  std::vector<double> parameters = graded_places(map.length(), parts, k);
  for (double& x : parameters) x = map.parameter(x);
  return parameters;
}

}  // namespace nurbeam
