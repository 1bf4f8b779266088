#include "cad_import/occt/spline_defect.h"

#include <IGESGeom_BSplineCurve.hxx>
#include <StepGeom_BSplineCurveWithKnots.hxx>
#include <StepGeom_BSplineCurveWithKnotsAndRationalBSplineCurve.hxx>
#include <TColStd_HArray1OfInteger.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Pnt.hxx>
#include <vector>

#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

std::vector<double> values_of(const Handle(TColStd_HArray1OfReal) & array) {
  if (array.IsNull()) return {};
  return {array->begin(), array->end()};
}

std::optional<std::string> knots_defect(const std::vector<double>& knots) {
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!std::isfinite(knots[i])) return "knot " + std::to_string(i + 1) + " is not finite";
    if (i > 0 && knots[i] < knots[i - 1]) {
      return "knot " + std::to_string(i + 1) + " (" + text_of(knots[i]) + ") is less than the one before (" +
             text_of(knots[i - 1]) + "); knots must not decrease";
    }
  }
  return std::nullopt;
}

std::optional<std::string> weights_defect(const std::vector<double>& weights) {
  for (double weight : weights)
    if (!(std::isfinite(weight) && weight > 0))
      return "a weight is " + text_of(weight) + "; weights must be positive";
  return std::nullopt;
}

std::optional<std::string> step_defect(const std::vector<double>& knots,
                                       const Handle(TColStd_HArray1OfInteger) & multiplicities,
                                       const std::vector<double>& weights,
                                       const StepGeom_BSplineCurve& curve) {
  if (curve.ControlPointsList().IsNull() || multiplicities.IsNull())
    return "its control points or knots are missing";
  int count = 0;
  for (int multiplicity : *multiplicities) count += multiplicity;
  const int expected = curve.NbControlPointsList() + curve.Degree() + 1;
  const bool counts_agree = multiplicities->Length() == static_cast<int>(knots.size()) && count == expected;
  if (!counts_agree) {
    return "it has " + std::to_string(count) + " knots; " + std::to_string(expected) +
           " must go with its control points and degree";
  }
  const std::optional<std::string> defect = knots_defect(knots);
  return defect ? defect : weights_defect(weights);
}

/// That the curve is in two pieces inside, which OpenCASCADE makes one of, without a control point.
std::optional<std::string> gap_defect(const std::vector<double>& knots, const IGESGeom_BSplineCurve& curve) {
  const int degree = curve.Degree(), poles = curve.NbPoles();
  constexpr double together = 1e-9;  // of the curve's size
  double size = 0;
  for (int i = 1; i < poles; ++i) size = std::max(size, curve.Pole(i).Distance(curve.Pole(0)));
  for (int i = 1; i + degree < static_cast<int>(knots.size()) - 1; ++i) {
    if (knots[i] != knots[i + degree] || knots[i] == knots.front() || knots[i] == knots.back()) continue;
    if (i < poles && curve.Pole(i - 1).Distance(curve.Pole(i)) <= together * size) continue;
    return "its knot " + text_of(knots[i]) + " stands " + std::to_string(degree + 1) + " times; at most " +
           std::to_string(degree) +
           " are allowed there, as the curve is in two pieces otherwise: write them as two "
           "curves";
  }
  return std::nullopt;
}

std::optional<std::string> iges_defect(const IGESGeom_BSplineCurve& curve) {
  std::vector<double> knots;
  for (int i = 0; i < curve.NbKnots(); ++i) knots.push_back(curve.Knot(i - curve.Degree()));
  std::vector<double> weights;
  for (int i = 0; i < curve.NbPoles(); ++i) weights.push_back(curve.Weight(i));
  if (const auto defect = knots_defect(knots)) return defect;
  if (const auto defect = weights_defect(weights)) return defect;
  return gap_defect(knots, curve);
}

}  // namespace

std::optional<std::string> spline_defect(const Standard_Transient& entity) {
  if (const auto* curve = dynamic_cast<const StepGeom_BSplineCurveWithKnots*>(&entity))
    return step_defect(values_of(curve->Knots()), curve->KnotMultiplicities(), {}, *curve);
  if (const auto* curve =
          dynamic_cast<const StepGeom_BSplineCurveWithKnotsAndRationalBSplineCurve*>(&entity)) {
    if (curve->BSplineCurveWithKnots().IsNull() || curve->RationalBSplineCurve().IsNull())
      return "it is incomplete";
    return step_defect(values_of(curve->Knots()), curve->KnotMultiplicities(),
                       values_of(curve->WeightsData()), *curve);
  }
  if (const auto* curve = dynamic_cast<const IGESGeom_BSplineCurve*>(&entity)) return iges_defect(*curve);
  return std::nullopt;
}

}  // namespace nurbeam
