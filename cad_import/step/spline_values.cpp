#include "cad_import/step/spline_values.h"

#include <StepGeom_BSplineCurveWithKnots.hxx>
#include <StepGeom_BSplineCurveWithKnotsAndRationalBSplineCurve.hxx>
#include <StepGeom_BezierCurveAndRationalBSplineCurve.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_HArray1OfCartesianPoint.hxx>
#include <TColStd_HArray1OfInteger.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TCollection_HAsciiString.hxx>
#include <algorithm>
#include <stdexcept>

namespace nurbeam {
namespace {

using Rational = StepGeom_BSplineCurveWithKnotsAndRationalBSplineCurve;

Handle(TColStd_HArray1OfReal) weights_of(const StepGeom_BSplineCurve& curve) {
  if (const auto* bezier = dynamic_cast<const StepGeom_BezierCurveAndRationalBSplineCurve*>(&curve))
    return bezier->WeightsData();
  if (const auto* rational = dynamic_cast<const Rational*>(&curve)) return rational->WeightsData();
  return nullptr;
}

Handle(StepGeom_CartesianPoint) cartesian_point(const Eigen::Vector3d& place) {
  const Handle(StepGeom_CartesianPoint) point = new StepGeom_CartesianPoint;
  point->Init3D(new TCollection_HAsciiString(""), place.x(), place.y(), place.z());
  return point;
}

/// Of both classes that have knots.
template <class Curve>
void set_knots(Curve& curve, const std::vector<double>& knots) {
  std::vector<double> values;
  std::vector<int> times;
  for (const double knot : knots) {
    if (values.empty() || values.back() != knot) {
      values.push_back(knot);
      times.push_back(0);
    }
    ++times.back();
  }
  const int count = static_cast<int>(values.size());
  const Handle(TColStd_HArray1OfReal) kept = new TColStd_HArray1OfReal(1, count);
  const Handle(TColStd_HArray1OfInteger) multiplicities = new TColStd_HArray1OfInteger(1, count);
  for (int i = 1; i <= count; ++i) {
    kept->SetValue(i, values[i - 1]);
    multiplicities->SetValue(i, times[i - 1]);
  }
  curve.SetKnots(kept);
  curve.SetKnotMultiplicities(multiplicities);
}

}  // namespace

std::vector<double> clamped_knots(int degree, int spans) {
  std::vector<double> knots(degree + 1, 0);
  for (int i = 1; i < spans; ++i) knots.insert(knots.end(), degree, i);
  knots.insert(knots.end(), degree + 1, spans);
  return knots;
}

std::vector<double> knots_of(const StepGeom_BSplineCurve& curve) {
  Handle(TColStd_HArray1OfReal) values;
  Handle(TColStd_HArray1OfInteger) multiplicities;
  if (const auto* plain = dynamic_cast<const StepGeom_BSplineCurveWithKnots*>(&curve)) {
    values = plain->Knots();
    multiplicities = plain->KnotMultiplicities();
  } else if (const auto* rational = dynamic_cast<const Rational*>(&curve)) {
    values = rational->Knots();
    multiplicities = rational->KnotMultiplicities();
  } else {
    const int spans = (curve.NbControlPointsList() - 1) / curve.Degree();
    return clamped_knots(curve.Degree(), spans);
  }
  if (values.IsNull() || multiplicities.IsNull()) throw std::runtime_error("its knots are missing");
  std::vector<double> knots;
  for (int i = 1; i <= values->Length() && i <= multiplicities->Length(); ++i)
    knots.insert(knots.end(), std::clamp(multiplicities->Value(i), 0, curve.Degree() + 1), values->Value(i));
  return knots;
}

Eigen::Matrix4Xd control_points_of(const StepGeom_BSplineCurve& curve) {
  const int count = curve.NbControlPointsList();
  const Handle(TColStd_HArray1OfReal) weights = weights_of(curve);
  if (!weights.IsNull() && weights->Length() != count)
    throw std::runtime_error("it has not one weight for each control point");
  Eigen::Matrix4Xd points(4, count);
  for (int i = 0; i < count; ++i) {
    const Handle(StepGeom_CartesianPoint) point = curve.ControlPointsListValue(i + 1);
    if (point.IsNull() || point->NbCoordinates() != 3)
      throw std::runtime_error("a point has not three coordinates");
    const double weight = weights.IsNull() ? 1 : weights->Value(weights->Lower() + i);
    points.col(i) << weight * point->CoordinatesValue(1), weight * point->CoordinatesValue(2),
        weight * point->CoordinatesValue(3), weight;
  }
  return points;
}

void set_values(StepGeom_BSplineCurve& curve, const std::vector<double>& knots,
                const Eigen::Matrix4Xd& control_points) {
  const int count = static_cast<int>(control_points.cols());
  const Handle(StepGeom_HArray1OfCartesianPoint) points = new StepGeom_HArray1OfCartesianPoint(1, count);
  const Handle(TColStd_HArray1OfReal) weights = new TColStd_HArray1OfReal(1, count);
  for (int i = 1; i <= count; ++i) {
    const double weight = control_points(3, i - 1);
    points->SetValue(i, cartesian_point(control_points.col(i - 1).head<3>() / weight));
    weights->SetValue(i, weight);
  }
  curve.SetControlPointsList(points);
  if (auto* plain = dynamic_cast<StepGeom_BSplineCurveWithKnots*>(&curve)) set_knots(*plain, knots);
  if (auto* rational = dynamic_cast<Rational*>(&curve)) {
    set_knots(*rational, knots);
    rational->SetWeightsData(weights);
  }
}

}  // namespace nurbeam
