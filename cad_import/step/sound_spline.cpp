#include "cad_import/step/sound_spline.h"

#include <StepGeom_BSplineCurve.hxx>
#include <StepGeom_BSplineCurveWithKnots.hxx>
#include <StepGeom_BSplineCurveWithKnotsAndRationalBSplineCurve.hxx>
#include <algorithm>
#include <vector>

#include "cad_import/report/leniency.h"
#include "cad_import/step/spline_values.h"
#include "nurbs/full_knots.h"

namespace nurbeam {
namespace {

bool has_knots(const StepGeom_BSplineCurve& curve) {
  return dynamic_cast<const StepGeom_BSplineCurveWithKnots*>(&curve) != nullptr ||
         dynamic_cast<const StepGeom_BSplineCurveWithKnotsAndRationalBSplineCurve*>(&curve) != nullptr;
}

/// Whether a knot inside stands more often than the degree.
bool is_divided(const std::vector<double>& knots, int degree) {
  for (std::size_t i = 0; i + static_cast<std::size_t>(degree) < knots.size(); ++i)
    if (knots[i] == knots[i + static_cast<std::size_t>(degree)] && knots[i] > knots.front() &&
        knots[i] < knots.back())
      return true;
  return false;
}

}  // namespace

SplineRepair make_sound(const opencascade::handle<Standard_Transient>& entity) {
  const auto curve = Handle(StepGeom_BSplineCurve)::DownCast(entity);
  if (curve.IsNull() || curve->ControlPointsList().IsNull() || !has_knots(*curve)) return {};
  std::vector<double> knots = knots_of(*curve);
  const int degree = curve->Degree(), count = curve->NbControlPointsList();
  if (degree < 1 || static_cast<int>(knots.size()) != count + degree + 1) return {};
  const double change = repair_knots(knots, degree);
  const bool divided = std::is_sorted(knots.begin(), knots.end()) && is_divided(knots, degree);
  if (change == 0 && !divided) return {};
  Eigen::Matrix4Xd points = control_points_of(*curve);
  if (divided && points.row(3).minCoeff() > 0) {
    const std::vector<NurbsCurve> pieces = split_at_full_knots(degree, knots, points);
    if (pieces.size() == 1) {
      knots = pieces[0].knots().knots();
      points = pieces[0].control_points();
    }
  }
  set_values(*curve, knots, points);
  return {change};
}

}  // namespace nurbeam
