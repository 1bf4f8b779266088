#include "cad_import/step/trimmed_spline.h"

#include <StepGeom_BSplineCurveWithKnots.hxx>
#include <StepGeom_BSplineCurveWithKnotsAndRationalBSplineCurve.hxx>
#include <StepGeom_HArray1OfTrimmingSelect.hxx>
#include <StepGeom_TrimmedCurve.hxx>
#include <StepGeom_TrimmingSelect.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <algorithm>
#include <vector>

#include "nurbs/number_text.h"

namespace nurbeam {

namespace {

// Those by which a curve is trimmed at one end or the other: none where its points come first.
std::vector<double> trim_parameters(const StepGeom_TrimmedCurve& trimmed) {
  std::vector<double> parameters;
  if (trimmed.MasterRepresentation() == StepGeom_tpCartesian) return parameters;
  for (const Handle(StepGeom_HArray1OfTrimmingSelect) & values : {trimmed.Trim1(), trimmed.Trim2()})
    for (int i = 1; !values.IsNull() && i <= values->Length(); ++i)
      if (values->Value(i).CaseMember() > 0) parameters.push_back(values->Value(i).ParameterValue());
  return parameters;
}

// Those of a spline with knots, also of a rational one; null for other curves.
Handle(TColStd_HArray1OfReal) knots_of(const Handle(StepGeom_Curve) & curve) {
  if (const auto plain = Handle(StepGeom_BSplineCurveWithKnots)::DownCast(curve)) return plain->Knots();
  if (const auto rational = Handle(StepGeom_BSplineCurveWithKnotsAndRationalBSplineCurve)::DownCast(curve))
    return rational->Knots();
  return {};
}

bool is_closed_spline(const Handle(StepGeom_Curve) & curve) {
  const auto spline = Handle(StepGeom_BSplineCurve)::DownCast(curve);
  return !spline.IsNull() && spline->ClosedCurve() == StepData_LTrue;
}

}  // namespace

std::optional<std::string> trims_beyond_ends(const StepGeom_TrimmedCurve& trimmed) {
  const Handle(TColStd_HArray1OfReal) knots = knots_of(trimmed.BasisCurve());
  if (knots.IsNull() || is_closed_spline(trimmed.BasisCurve())) return std::nullopt;
  constexpr double digits = 1e-9;  // of the curve's range
  const double first = knots->Value(knots->Lower()), last = knots->Value(knots->Upper());
  const double allowed = digits * (last - first);
  for (const double parameter : trim_parameters(trimmed))
    if (parameter < first - allowed || parameter > last + allowed)
      return "it is trimmed at the parameter " + text_of(parameter) +
             ", which is beyond the ends of its curve, at " + text_of(first) + " and " + text_of(last) +
             "; it is cut off at the end: correct the trim";
  return std::nullopt;
}

}  // namespace nurbeam
