#include "cad_import/iges/divided_spline.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <sstream>
#include <stdexcept>

#include "cad_import/iges/iges_values.h"
#include "nurbs/full_knots.h"

namespace nurbeam {
namespace {

using SplineValues = std::vector<std::string>;

double number_at(const SplineValues& values, std::size_t at) {
  return iges_number(values.at(at)).value_or(0);
}

Eigen::Matrix4Xd control_points_in(const SplineValues& values, std::size_t knots, std::size_t count) {
  Eigen::Matrix4Xd points(4, count);
  for (std::size_t i = 0; i < count; ++i) {
    const double weight = number_at(values, 6 + knots + i);
    const std::size_t x = 6 + knots + count + 3 * i;
    points.col(static_cast<Eigen::Index>(i))
        << weight * Eigen::Vector3d(number_at(values, x), number_at(values, x + 1), number_at(values, x + 2)),
        weight;
  }
  return points;
}

/// Those of a piece that goes from V(0) to V(1), with all that stands behind these in the whole.
SplineValues values_of_piece(const NurbsCurve& curve, double first, double last, const SplineValues& whole,
                             std::size_t behind) {
  const Eigen::Matrix3Xd points = curve.control_points().colwise().hnormalized();
  SplineValues values{std::to_string(points.cols() - 1), whole[1], whole[2], "0", whole[4], "0"};
  for (const double knot : curve.knots().knots()) values.push_back(iges_real(knot));
  for (const double weight : curve.control_points().row(3)) values.push_back(iges_real(weight));
  for (const double coordinate : points.reshaped()) values.push_back(iges_real(coordinate));
  values.push_back(iges_real(first));
  values.push_back(iges_real(last));
  values.insert(values.end(), whole.begin() + static_cast<std::ptrdiff_t>(behind), whole.end());
  return values;
}

/// Whether a knot inside stands more often than the degree.
bool has_full_knot(const std::vector<double>& knots, std::size_t degree) {
  for (std::size_t i = 0; i + degree < knots.size(); ++i)
    if (knots[i] == knots[i + degree] && knots[i] > knots.front() && knots[i] < knots.back()) return true;
  return false;
}

}  // namespace

std::string iges_real(double value) {
  std::ostringstream text;
  text.precision(17);
  text << std::showpoint << value;
  return text.str();
}

DividedSpline divided_spline(const SplineValues& values, const std::vector<double>& knots) {
  DividedSpline divided{};
  const auto count = static_cast<std::size_t>(number_at(values, 0)) + 1,
             degree = static_cast<std::size_t>(number_at(values, 1));
  const std::size_t range = 6 + knots.size() + 4 * count;
  if (degree < 1 || !std::is_sorted(knots.begin(), knots.end()) || !has_full_knot(knots, degree))
    return divided;
  const Eigen::Matrix4Xd points = control_points_in(values, knots.size(), count);
  if (!points.allFinite() || !(points.row(3).minCoeff() > 0)) return divided;
  std::vector<NurbsCurve> curves;
  try {
    curves = split_at_full_knots(static_cast<int>(degree), knots, points);
  } catch (const std::invalid_argument&) {
    return divided;  // what is wrong with it is told by those who make a curve of it
  }
  if (curves.size() < 2) return divided;
  divided.knot = curves[0].knots().end();
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const KnotVector& own = curves[i].knots();
    const double first = std::max(number_at(values, range), own.start()),
                 last = std::min(number_at(values, range + 1), own.end());
    if (first < last) divided.pieces.push_back(values_of_piece(curves[i], first, last, values, range + 2));
    if (i == 0) continue;
    const NurbsCurve& before = curves[i - 1];
    divided.widest =
        std::max(divided.widest, (before.point(before.knots().end()) - curves[i].point(own.start())).norm());
  }
  return divided;
}

}  // namespace nurbeam
