#include "cad_import/program/model_checks.h"

#include <IGESGeom_CompositeCurve.hxx>
#include <Interface_Check.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_CompositeCurve.hxx>
#include <StepGeom_CompositeCurveSegment.hxx>
#include <StepGeom_Curve.hxx>
#include <StepGeom_TrimmedCurve.hxx>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "cad_import/program/entity_origins.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

using Entity = Handle(Standard_Transient);

// OpenCASCADE goes on after an error of syntax, with other numbers than those of the file.
void check_syntax(const Interface_InterfaceModel& model) {
  const Handle(Interface_Check) check = model.GlobalCheck(/*syntactic=*/Standard_True);
  for (int i = 1; i <= check->NbFails(); ++i) {
    const std::string_view failure = check->CFail(i);
    const std::size_t at = failure.find("Line ");
    if (failure.find("Incorrect syntax") == std::string_view::npos) continue;
    throw std::runtime_error(std::string(failure.substr(at == std::string_view::npos ? 0 : at)) +
                             "; the file is damaged; export or copy it again");
  }
}

// OpenCASCADE computes for minutes with numbers that no drawing holds.
void check_coordinates(const Interface_InterfaceModel& model) {
  constexpr double largest = 1e15;  // in units of the file
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const auto point = Handle(StepGeom_CartesianPoint)::DownCast(model.Value(i));
    for (int k = 1; !point.IsNull() && k <= point->NbCoordinates(); ++k)
      if (!(std::abs(point->CoordinatesValue(k)) <= largest))
        throw std::runtime_error(entity_label(model, point) + " has a coordinate of " +
                                 text_of(point->CoordinatesValue(k)) + "; the limit is " + text_of(largest) +
                                 ": the file is damaged; export or copy it again");
  }
}

/// How many curves a curve is made of, those that it repeats counted as often as it does.
class CurveCount {
 public:
  double of(const Entity& curve) { return of(curve, 0); }

 private:
  static std::vector<Entity> parts_of(const Entity& curve) {
    std::vector<Entity> parts;
    if (const auto composite = Handle(StepGeom_CompositeCurve)::DownCast(curve)) {
      for (int i = 1; !composite->Segments().IsNull() && i <= composite->NbSegments(); ++i)
        if (!composite->SegmentsValue(i).IsNull())
          parts.push_back(composite->SegmentsValue(i)->ParentCurve());
    } else if (const auto trimmed = Handle(StepGeom_TrimmedCurve)::DownCast(curve)) {
      parts.push_back(trimmed->BasisCurve());
    } else if (const auto joined = Handle(IGESGeom_CompositeCurve)::DownCast(curve)) {
      for (int i = 1; i <= joined->NbCurves(); ++i) parts.push_back(joined->Curve(i));
    }
    return parts;
  }

  // One that is made of itself counts once there, one that is nested too deeply not further.
  double of(const Entity& curve, int depth) {
    constexpr int deepest_nest = 1000;
    if (curve.IsNull() || depth > deepest_nest) return 1;
    const auto [known, is_new] = counts_.emplace(curve.get(), 1);
    if (!is_new) return known->second;
    double count = 0;
    for (const Entity& part : parts_of(curve)) count += of(part, depth + 1);
    return counts_[curve.get()] = std::max(count, 1.0);
  }

  std::unordered_map<const Standard_Transient*, double> counts_;  // only ever looked up
};

void check_nesting(const Interface_InterfaceModel& model) {
  constexpr double most = 1e6;
  CurveCount count;
  for (int i = 1; i <= model.NbEntities(); ++i)
    if (const double curves = count.of(model.Value(i)); curves > most)
      throw std::runtime_error(entity_label(model, model.Value(i)) + " repeats other curves until it has " +
                               text_of(curves) + "; the limit is " + text_of(most) +
                               ": the file is damaged; export it again");
}

}  // namespace

void check_model(const Interface_InterfaceModel& model) {
  check_syntax(model);
  check_coordinates(model);
  check_nesting(model);
}

}  // namespace nurbeam
