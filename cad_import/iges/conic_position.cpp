#include "cad_import/iges/conic_position.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <IGESGeom_CircularArc.hxx>
#include <IGESGeom_ConicArc.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Pnt2d.hxx>
#include <gp_XY.hxx>
#include <stdexcept>
#include <string>
#include <tuple>

#include "cad_import/iges/arc_centre.h"
#include "cad_import/iges/location.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

using Eigen::Matrix2d, Eigen::Vector2d, Eigen::Vector3d;

/// x^T quadratic x + linear^T x + constant = 0; the larger curvature of it is 1.
struct Equation {
  Matrix2d quadratic;
  Vector2d linear;
  double constant;
};

/// The principal directions of the quadratic part and its values there: the one that is 1 comes last.
struct Principal {
  Vector2d values;
  Matrix2d directions;
};

Vector2d vector_of(const gp_Pnt2d& point) { return {point.X(), point.Y()}; }

std::string point_text(const Vector2d& point) {
  return "(" + text_of(point.x()) + ", " + text_of(point.y()) + ")";
}

Principal principal(const Matrix2d& quadratic) {
  const Eigen::SelfAdjointEigenSolver<Matrix2d> solver(quadratic);
  Principal result{solver.eigenvalues(), solver.eigenvectors()};
  if (std::abs(result.values(0)) > std::abs(result.values(1))) {
    std::swap(result.values(0), result.values(1));
    result.directions.col(0).swap(result.directions.col(1));
  }
  return result;
}

Equation equation_of(const IGESGeom_ConicArc& arc) {
  double a = 0, b = 0, c = 0, d = 0, e = 0, f = 0;
  arc.Equation(a, b, c, d, e, f);
  Equation equation{(Matrix2d() << a, b / 2, b / 2, c).finished(), {d, e}, f};
  const double scale = principal(equation.quadratic).values(1);
  if (!(scale != 0 && std::isfinite(scale)))
    throw std::runtime_error("its equation has no term of second degree; A, B or C must not be zero");
  equation.quadratic /= scale;
  equation.linear /= scale;
  equation.constant /= scale;
  return equation;
}

const char* name_of(int kind) {
  return kind == ConicPosition::ellipse     ? "ellipse"
         : kind == ConicPosition::hyperbola ? "hyperbola"
         : kind == ConicPosition::parabola  ? "parabola"
                                            : "nothing";
}

/// That of the equation; one that the form number calls a parabola may be none by the digits of the file.
ConicPosition::Kind kind_of(const IGESGeom_ConicArc& arc, double smaller_value) {
  const int form = arc.FormNumber();
  const double zero = form == ConicPosition::parabola ? 1e-4 : 1e-12;
  const auto kind = std::abs(smaller_value) <= zero ? ConicPosition::parabola
                    : smaller_value > 0             ? ConicPosition::ellipse
                                                    : ConicPosition::hyperbola;
  if (form != 0 && form != kind)
    throw std::runtime_error("its form number " + std::to_string(form) + " says " + name_of(form) +
                             ", its equation is that of form " + std::to_string(kind) + ", " + name_of(kind) +
                             "; correct one of them");
  return kind;
}

/// The changes of two relative unknowns that put the ends on the curve; the least where these say too little.
Vector2d correction(const Matrix2d& sensitivity, const Vector2d& residual) {
  Eigen::CompleteOrthogonalDecomposition<Matrix2d> solver;
  solver.setThreshold(1e-2);
  solver.compute(sensitivity);
  return solver.solve(residual);
}

/// In the middle of being found: the axes, and the ends in them.
struct Search {
  Vector2d first, last;
  Leniency leniency;
  Vector2d origin = {};
  Matrix2d axes = {};             // main axis first
  Vector2d start = {}, end = {};  // in the axes
  double repair = 0;              // how far the ends were off, where that is told

  void locate() {
    start = axes.transpose() * (first - origin);
    end = axes.transpose() * (last - origin);
  }
  double size() const { return std::max(start.norm(), end.norm()); }
};

/// An end that lies so far off the curve of its equation.
void allow_distance(double distance, double size, const Vector2d& end, Search& found) {
  if (!found.leniency.repairs(distance, size))
    throw std::runtime_error("its end " + point_text(end) + " is " + text_of(distance) +
                             " off the curve of its equation; correct one of them");
  // An equation of few digits is as near as points of the file are.
  constexpr double few_digits = 1e-4;
  if (distance > found.leniency.resolution ? Leniency::is_told(distance, size) : distance > few_digits * size)
    found.repair = std::max(found.repair, distance);
}

/// Moves the curve, of the points where `value` is zero, by the least that has its ends on it, where that is
/// little.
template <class Value, class Gradient>
void shift_to_ends(Search& found, const Value& value, const Gradient& gradient) {
  const Vector2d origin = found.origin;
  for (int step = 0; step < 5; ++step) {
    Matrix2d gradients;
    gradients << gradient(found.start).transpose(), gradient(found.end).transpose();
    const Vector2d values(value(found.start), value(found.end));
    found.origin += found.axes * gradients.completeOrthogonalDecomposition().solve(values);
    found.locate();
  }
  if (found.leniency.repairs((found.origin - origin).norm(), found.size())) return;
  found.origin = origin;
  found.locate();
}

/// p x^2 + q y^2 = 1: (p, q).
Vector2d central(const Equation& equation, ConicPosition::Kind kind, const Principal& principal,
                 Search& found) {
  found.origin = equation.quadratic.fullPivLu().solve(-equation.linear / 2);
  const double value = equation.constant + equation.linear.dot(found.origin) / 2;
  Vector2d factors = -principal.values / value;
  const bool has_points = kind == ConicPosition::hyperbola || factors(0) > 0;
  if (!factors.allFinite() || !has_points)
    throw std::runtime_error(std::string("its equation has no ") + name_of(kind) +
                             ", but lines, a point or nothing; correct it");
  const bool last_is_main = factors(0) < 0;  // of an ellipse the first factor is the smaller one
  if (last_is_main) std::swap(factors(0), factors(1));
  found.axes.col(0) = principal.directions.col(last_is_main ? 1 : 0);
  found.axes.col(1) = Vector2d(-found.axes(1, 0), found.axes(0, 0));
  found.locate();
  if (kind == ConicPosition::hyperbola && found.start.x() < 0) {
    found.axes = -found.axes;
    found.locate();
  }
  return factors;
}

void correct_circle(Vector2d& factors, Search& found) {
  PlaneArc arc{found.origin, found.first, found.last};
  make_consistent(arc, found.leniency);
  found.origin = arc.centre;
  found.last = arc.end;
  found.locate();
  factors.setConstant(1 / found.start.squaredNorm());
}

void correct_central(Vector2d& factors, Search& found) {
  Matrix2d terms;
  terms << found.start.cwiseAbs2().transpose(), found.end.cwiseAbs2().transpose();
  terms = terms * factors.asDiagonal();
  const Vector2d residual = Vector2d::Ones() - terms.rowwise().sum();
  for (const auto& [end, place, off] :
       {std::tuple{found.start, found.first, residual(0)}, std::tuple{found.end, found.last, residual(1)}})
    allow_distance(std::abs(off) / (2 * factors.cwiseProduct(end).norm()), found.size(), place, found);
  constexpr double round_off = 1e-12;
  const bool is_circle = std::abs(factors(0) - factors(1)) <= round_off * factors(1);
  if (is_circle) return correct_circle(factors, found);
  factors = factors.cwiseProduct(Vector2d::Ones() + correction(terms, residual));
  shift_to_ends(
      found, [&](const Vector2d& p) { return factors.dot(p.cwiseAbs2()) - 1; },
      [&](const Vector2d& p) -> Vector2d { return 2 * factors.cwiseProduct(p); });
}

/// y^2 = k x: k.
double parabolic(const Equation& equation, const Principal& principal, Search& found) {
  found.axes.col(0) = principal.directions.col(0);
  if (equation.linear.dot(found.axes.col(0)) > 0) found.axes.col(0) *= -1;
  found.axes.col(1) = Vector2d(-found.axes(1, 0), found.axes(0, 0));
  const Vector2d linear = found.axes.transpose() * equation.linear;
  const double k = -linear(0);
  if (!(k > 0)) throw std::runtime_error("its equation has no parabola, but lines or nothing; correct it");
  found.origin = found.axes * Vector2d((equation.constant - linear(1) * linear(1) / 4) / k, -linear(1) / 2);
  found.locate();
  return k;
}

void correct_parabolic(double& k, Search& found) {
  const Vector2d x(found.start.x(), found.end.x()), y(found.start.y(), found.end.y());
  const Vector2d residual = y.cwiseAbs2() - k * x;
  const double size = found.size() + k;
  allow_distance(std::abs(residual(0)) / std::hypot(2 * y(0), k), size, found.first, found);
  allow_distance(std::abs(residual(1)) / std::hypot(2 * y(1), k), size, found.last, found);
  Matrix2d sensitivity;  // to relative changes of k, and to shifts of the vertex in units of the size
  sensitivity << k * x, Vector2d::Constant(-k * size);
  const Vector2d change = correction(sensitivity / (k * size), residual / (k * size));
  found.origin += found.axes.col(0) * (change(1) * size / (1 + change(0)));
  k *= 1 + change(0);
  found.locate();
  shift_to_ends(
      found, [&](const Vector2d& p) { return p.y() * p.y() - k * p.x(); },
      [&](const Vector2d& p) { return Vector2d(-k, 2 * p.y()); });
}

/// Upwards, where the curve is open to the right.
void turn_upwards(ConicPosition::Kind kind, Search& found) {
  if (kind == ConicPosition::hyperbola && found.end.x() <= 0)
    throw std::runtime_error("its ends " + point_text(found.first) + " and " + point_text(found.last) +
                             " are on two branches of the hyperbola");
  if (found.start.y() == found.end.y())
    throw std::runtime_error("both its ends are " + point_text(found.first) + "; only ellipses are closed");
  if (found.start.y() < found.end.y()) return;
  found.axes.col(1) *= -1;
  found.locate();
}

Eigen::Affine3d in_space(const Search& found, double z) {
  Eigen::Affine3d axes = Eigen::Affine3d::Identity();
  axes.linear().topLeftCorner<2, 2>() = found.axes;
  axes.linear()(2, 2) = found.axes.determinant() > 0 ? 1 : -1;
  axes.translation() << found.origin, z;
  return axes;
}

/// What is at right angles to a plane curve may point either way: so that nothing is mirrored.
Eigen::Affine3d right_handed(Eigen::Affine3d location) {
  if (location.linear().determinant() < 0) location.linear().col(2) *= -1;
  return location;
}

}  // namespace

ConicPosition position_of(const IGESGeom_ConicArc& arc, const Leniency& leniency) {
  const Equation equation = equation_of(arc);
  const Principal directions = principal(equation.quadratic);
  const ConicPosition::Kind kind = kind_of(arc, directions.values(0));
  Search found{.first = vector_of(arc.StartPoint()), .last = vector_of(arc.EndPoint()), .leniency = leniency};
  ConicPosition position{.kind = kind};
  if (kind == ConicPosition::parabola) {
    double k = parabolic(equation, directions, found);
    correct_parabolic(k, found);
    position.radii << k / 4, 0;
  } else {
    Vector2d factors = central(equation, kind, directions, found);
    correct_central(factors, found);
    position.radii = factors.cwiseAbs().cwiseSqrt().cwiseInverse();
  }
  constexpr double one_point = 1e-7;  // in radians
  const bool is_whole =
      kind == ConicPosition::ellipse && (found.end - found.start).norm() <= one_point * position.radii(0);
  if (kind != ConicPosition::ellipse) turn_upwards(kind, found);
  position.start = found.start;
  position.end = is_whole ? found.start : found.end;
  position.axes = in_space(found, arc.ZPlane());
  position.repair = found.repair;
  return position;
}

double put_into_position(IGESGeom_ConicArc& arc, const Leniency& leniency) {
  const Eigen::Affine3d location = rigid_location(arc);
  const ConicPosition position = position_of(arc, leniency);
  const double x = position.radii.x(), y = position.radii.y();
  constexpr double smallest = 1e-4;  // below which OpenCASCADE takes one axis for the other
  if (position.kind == ConicPosition::hyperbola && x <= smallest)
    throw std::runtime_error("its semi-axis is " + text_of(x) + "; it must be above " + text_of(smallest) +
                             ": write the file in a smaller unit");
  const Vector2d &start = position.start, &end = position.end;
  const gp_XY first(start.x(), start.y()), last(end.x(), end.y());
  if (position.kind == ConicPosition::parabola)
    arc.Init(0, 0, 1, -4 * x, 0, 0, 0, first, last);
  else
    arc.Init(y / x, 0, position.kind == ConicPosition::ellipse ? x / y : -x / y, 0, 0, -x * y, 0, first,
             last);
  set_location(arc, right_handed(location * position.axes));
  return position.repair;
}

double put_into_position(IGESGeom_CircularArc& arc, const Leniency& leniency) {
  const Eigen::Affine3d location = rigid_location(arc);
  PlaneArc plane{vector_of(arc.Center()), vector_of(arc.StartPoint()), vector_of(arc.EndPoint())};
  const double repair = make_consistent(plane, leniency);
  const bool mirrors = location.linear().determinant() < 0;
  const auto coordinates = [](const Vector2d& point) { return gp_XY(point.x(), point.y()); };
  arc.Init(mirrors ? -arc.ZPlane() : arc.ZPlane(), coordinates(plane.centre), coordinates(plane.start),
           coordinates(plane.end));
  if (mirrors) set_location(arc, right_handed(location));
  return repair;
}

void make_harmless(IGESGeom_ConicArc& arc) {
  arc.Init(1, 0, 1, 0, 0, -1, 0, gp_XY(1, 0), gp_XY(0, 1));
  arc.OwnCorrect();  // its form
}

}  // namespace nurbeam
