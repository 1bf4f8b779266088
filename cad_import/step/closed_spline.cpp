#include "cad_import/step/closed_spline.h"

#include <StepGeom_BSplineCurveWithKnotsAndRationalBSplineCurve.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <cmath>

namespace nurbeam {

void unmark_closed_splines(const Interface_InterfaceModel& model) {
  constexpr double round_off = 1e-14;
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const auto spline =
        Handle(StepGeom_BSplineCurveWithKnotsAndRationalBSplineCurve)::DownCast(model.Value(i));
    if (spline.IsNull() || spline->WeightsData().IsNull()) continue;
    const TColStd_HArray1OfReal& weights = *spline->WeightsData();
    const double first = weights.Value(weights.Lower()), last = weights.Value(weights.Upper());
    if (std::abs(last - first) > round_off * std::abs(first)) spline->SetClosedCurve(StepData_LFalse);
  }
}

}  // namespace nurbeam
