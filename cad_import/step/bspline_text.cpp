#include "cad_import/step/bspline_text.h"

#include <algorithm>
#include <cstdio>
#include <vector>

namespace nurbeam {
namespace {

template <typename Items, typename Text>
std::string list_of(const Items& items, const Text& text) {
  std::string list = "(";
  for (const auto& item : items) list += (list.size() > 1 ? "," : "") + text(item);
  return list + ")";
}

}  // namespace

std::string step_real(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17E", value);
  return text;
}

int add_point(const Eigen::Vector3d& point, StepInstances& step) {
  return step.add("CARTESIAN_POINT(''," + list_of(point, step_real) + ")");
}

std::string bspline_value(const NurbsCurve& curve, const std::string& encoded_name, StepInstances& step) {
  const auto reference = [](int number) { return "#" + std::to_string(number); };
  std::vector<int> points;
  std::vector<double> weights;
  for (const auto& column : curve.control_points().colwise()) {
    points.push_back(add_point(column.head<3>() / column(3), step));
    weights.push_back(column(3));
  }
  std::vector<double> knots = curve.knots().knots();
  knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
  const std::string form =
      std::to_string(curve.degree()) + "," + list_of(points, reference) + ",.UNSPECIFIED.,.F.,.F.";
  const std::string knot_lists =
      list_of(knots, [&](double u) { return std::to_string(curve.knots().multiplicity(u)); }) + "," +
      list_of(knots, step_real) + ",.UNSPECIFIED.";
  const std::string name = "'" + encoded_name + "'";
  if (!curve.is_rational()) return "B_SPLINE_CURVE_WITH_KNOTS(" + name + "," + form + "," + knot_lists + ")";
  return "(BOUNDED_CURVE()B_SPLINE_CURVE(" + form + ")B_SPLINE_CURVE_WITH_KNOTS(" + knot_lists +
         ")CURVE()GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_CURVE(" + list_of(weights, step_real) +
         ")REPRESENTATION_ITEM(" + name + "))";
}

}  // namespace nurbeam
