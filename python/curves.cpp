#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "nurbs/arc_length.h"
#include "nurbs/bezier_path.h"
#include "nurbs/closest_point.h"
#include "nurbs/curve_through.h"
#include "nurbs/joined_curve.h"
#include "nurbs/knot_insertion.h"
#include "nurbs/number_text.h"
#include "nurbs/nurbs_curve.h"
#include "nurbs/primitives.h"
#include "nurbs/split_curve.h"
#include "python/bindings.h"
#include "python/pickles.h"

namespace nurbeam::python {

namespace {

namespace py = pybind11;

using PointRows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

PointRows control_point_rows(const NurbsCurve& curve) {
  const Eigen::Matrix4Xd& p = curve.control_points();
  return (p.topRows<3>().array().rowwise() / p.row(3).array()).matrix().transpose();
}

NurbsCurve make_curve(int degree, std::vector<double> knots, const Eigen::Ref<const PointRows>& points,
                      const Eigen::VectorXd& weights) {
  return make_nurbs_curve(KnotVector(degree, std::move(knots)), points.transpose(), weights);
}

void check_parameter(const NurbsCurve& curve, double u) {
  if (!(u >= curve.knots().start() && u <= curve.knots().end()))
    throw std::invalid_argument("the parameter " + text_of(u) + " is not on the curve; must be between " +
                                text_of(curve.knots().start()) + " and " + text_of(curve.knots().end()));
}

PointRows points_at(const NurbsCurve& curve, const Eigen::VectorXd& parameters) {
  PointRows points(parameters.size(), 3);
  for (Eigen::Index i = 0; i < parameters.size(); ++i) {
    check_parameter(curve, parameters[i]);
    points.row(i) = curve.point(parameters[i]);
  }
  return points;
}

PointRows derivative_rows(const NurbsCurve& curve, double u, int n) {
  check_parameter(curve, u);
  if (n < 0) throw std::invalid_argument("derivatives up to " + std::to_string(n) + "; must be 0 or more");
  return curve.derivatives(u, n).transpose();
}

// Newton's iteration on (r - p) r' = 0 from a parameter that is nearly right; the better of both.
double refined(const NurbsCurve& curve, const Eigen::Vector3d& p, double u) {
  const auto distance = [&](double at) { return (curve.point(at) - p).norm(); };
  double best = u;
  for (int i = 0; i < 10; ++i) {
    const Eigen::Matrix3Xd d = curve.derivatives(u, 2);
    const Eigen::Vector3d away = d.col(0) - p;
    const double slope = d.col(1).squaredNorm() + away.dot(d.col(2));
    if (!(slope > 0)) break;
    u = std::clamp(u - away.dot(d.col(1)) / slope, curve.knots().start(), curve.knots().end());
    if (distance(u) < distance(best)) best = u;
  }
  return best;
}

std::tuple<double, Eigen::Vector3d, double> closest(const NurbsCurve& curve, const Eigen::Vector3d& point) {
  if (!point.allFinite()) throw std::invalid_argument("the point must be finite");
  const BezierPath path = BezierPath::from_nurbs(curve, 1e-6 * length(curve));
  const ClosestPoint near = closest_point(path.segments, point);
  const double a = path.breaks[near.segment], b = path.breaks[near.segment + 1];
  const double u = refined(curve, point, a + near.u * (b - a));
  return {u, curve.point(u), (curve.point(u) - point).norm()};
}

// One Bezier curve on [0, 1] for each non-empty span of knots.
std::vector<NurbsCurve> bezier_curves(const NurbsCurve& curve) {
  const std::vector<double>& knots = curve.knots().knots();
  const int p = curve.degree();
  std::vector<double> unit(2 * static_cast<std::size_t>(p + 1), 0);
  std::fill(unit.begin() + p + 1, unit.end(), 1);
  std::vector<NurbsCurve> pieces;
  for (int span = p; span < curve.knots().control_point_count(); ++span)
    if (knots[span] < knots[span + 1]) pieces.emplace_back(KnotVector(p, unit), curve.bezier_points(span));
  return pieces;
}

NurbsCurve through(std::vector<RationalCubic> cubics) {
  BezierPath path;
  path.segments = std::move(cubics);
  for (std::size_t i = 0; i <= path.segments.size(); ++i) path.breaks.push_back(static_cast<double>(i));
  return path.to_nurbs();
}

void check_arc(const Eigen::Vector3d& center, const Eigen::Vector3d& start, const Eigen::Vector3d& end,
               const Eigen::Vector3d& normal) {
  if (!(normal.norm() > 0)) throw std::invalid_argument("the normal of an arc must not be zero");
  const Eigen::Vector3d n = normal.normalized(), to_start = start - center, to_end = end - center;
  const double a = to_start.norm(), b = to_end.norm(), apart = (end - start).norm();
  if (!(a > 0) || !(std::abs(a - b) <= 1e-9 * std::max(a, b)))
    throw std::invalid_argument("the arc starts " + text_of(a) + " m from its centre and ends " + text_of(b) +
                                " m from it; both must be its radius");
  if (!(std::max(std::abs(n.dot(to_start)), std::abs(n.dot(to_end))) <= 1e-6 * a))
    throw std::invalid_argument(
        "the normal of the arc is not perpendicular to the plane of its centre, start and end");
  if (apart > 0 && apart <= 1e-6 * a)
    throw std::invalid_argument(
        "the arc starts and ends at points " + text_of(apart) +
        " m apart, too little for an arc; give the same point twice for a whole circle");
}

NurbsCurve nurbs_of(const py::bytes& pickled) {
  const py::tuple parts = parts_of(pickled, "the pickled curve");
  return {KnotVector(parts[0].cast<int>(), parts[1].cast<std::vector<double>>()),
          parts[2].cast<Eigen::Matrix4Xd>()};
}

// The parameter where a curve is so long from its start on.
double parameter_at(const NurbsCurve& curve, double s) {
  const double whole = length(curve);
  if (!(s >= 0 && s <= whole * (1 + 1e-12)))
    throw std::invalid_argument("the length " + text_of(s) + " m is not on the curve, which is " +
                                text_of(whole) + " m long");
  const BezierPath path = BezierPath::from_nurbs(curve, 1e-9 * whole);
  double before = 0;
  for (std::size_t i = 0; i < path.segments.size(); ++i) {
    const double here = length(path.segments[i]), a = path.breaks[i], b = path.breaks[i + 1];
    if (s <= before + here) return a + (b - a) * ArcLengthMap(path.segments[i]).parameter(s - before);
    before += here;
  }
  return curve.knots().end();
}

// The curves one behind the other as one.
NurbsCurve joined(const std::vector<NurbsCurve>& curves) {
  constexpr double gap = 1e-6;  // of the length
  double whole = 0;
  Chain chain;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    whole += length(curves[i]);
    chain.curves.push_back(static_cast<int>(i));
    chain.reversed.push_back(false);
  }
  for (std::size_t i = 1; i < curves.size(); ++i) {
    const Eigen::Vector3d end = curves[i - 1].point(curves[i - 1].knots().end()),
                          start = curves[i].point(curves[i].knots().start());
    if ((end - start).norm() > gap * whole)
      throw std::invalid_argument("curve " + std::to_string(i) + " ends at " + text_of(end) + " and curve " +
                                  std::to_string(i + 1) + " starts at " + text_of(start) + ", " +
                                  text_of((end - start).norm()) + " m apart; reverse one, or close the gap");
  }
  return joined_curve(curves, chain).curve;
}

NurbsCurve through_points(const Eigen::Ref<const PointRows>& points, int degree,
                          const std::optional<PointRows>& tangents, bool closed) {
  const auto rows = [](const auto& matrix) {
    std::vector<Eigen::Vector3d> rows;
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) rows.emplace_back(matrix.row(i));
    return rows;
  };
  return curve_through(rows(points),
                       {degree, tangents ? rows(*tangents) : std::vector<Eigen::Vector3d>{}, closed});
}

}  // namespace

void bind_curves(py::module_& module) {
  py::class_<NurbsCurve>(module, "Nurbs", "A NURBS curve in metres; it does not change.")
      .def(py::init(&make_curve), py::arg("degree"), py::arg("knots"), py::arg("control_points"),
           py::arg("weights"))
      .def_property_readonly("degree", &NurbsCurve::degree)
      .def_property_readonly("knots",
                             [](const NurbsCurve& c) -> Eigen::VectorXd {
                               return Eigen::Map<const Eigen::VectorXd>(
                                   c.knots().knots().data(),
                                   static_cast<Eigen::Index>(c.knots().knots().size()));
                             })
      .def_property_readonly("control_points", &control_point_rows)
      .def_property_readonly("weights",
                             [](const NurbsCurve& c) -> Eigen::VectorXd { return c.control_points().row(3); })
      .def_property_readonly("start", [](const NurbsCurve& c) { return c.knots().start(); })
      .def_property_readonly("end", [](const NurbsCurve& c) { return c.knots().end(); })
      .def("__reduce__",
           [](const NurbsCurve& c) {
             return reduce("nurbs_of", py::make_tuple(c.degree(), c.knots().knots(), c.control_points()));
           })
      .def("points", &points_at, py::arg("parameters"))
      .def("derivatives", &derivative_rows, py::arg("parameter"), py::arg("n"))
      .def("length", [](const NurbsCurve& c) { return length(c); })
      .def("closest", &closest, py::arg("point"))
      .def("reversed", &NurbsCurve::reversed)
      .def("is_rational", &NurbsCurve::is_rational)
      .def("insert_knot", &with_knot, py::arg("parameter"), py::arg("times"))
      .def("bezier", &bezier_curves)
      .def("parameter_at", &parameter_at, py::arg("length"))
      .def(
          "split_at", [](const NurbsCurve& c, const std::vector<double>& at) { return split_at(c, at); },
          py::arg("parameters"))
      .def("moved", &moved_curve, py::arg("map"))
      .def(
          "cubics",
          [](const NurbsCurve& c, double tolerance) {
            BezierPath path = BezierPath::from_nurbs(c, tolerance);
            return std::pair(path.to_nurbs(), path.deviation);
          },
          py::arg("tolerance"));
  module.def("nurbs_of", &nurbs_of, py::arg("pickled"));
  module.def(
      "line", [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return through({line_cubic(a, b)}); },
      py::arg("start"), py::arg("end"));
  module.def("joined", &joined, py::arg("curves"));
  module.def("through", &through_points, py::arg("points"), py::arg("degree"), py::arg("tangents"),
             py::arg("closed"));
  module.def(
      "arc",
      [](const Eigen::Vector3d& center, const Eigen::Vector3d& start, const Eigen::Vector3d& end,
         const Eigen::Vector3d& normal) {
        check_arc(center, start, end, normal);
        return through(arc_cubics(center, start, end, normal));
      },
      py::arg("center"), py::arg("start"), py::arg("end"), py::arg("normal"));
}

}  // namespace nurbeam::python
