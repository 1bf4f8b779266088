#include "cad_import/program/unsound_curves.h"

#include <Interface_EntityIterator.hxx>
#include <StepGeom_Axis2Placement3d.hxx>
#include <StepGeom_CompositeCurve.hxx>
#include <StepGeom_CompositeCurveSegment.hxx>
#include <StepGeom_Conic.hxx>
#include <StepGeom_CurveReplica.hxx>
#include <StepGeom_Direction.hxx>
#include <StepGeom_Line.hxx>
#include <StepGeom_OffsetCurve3d.hxx>
#include <StepGeom_TrimmedCurve.hxx>
#include <StepGeom_Vector.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <algorithm>
#include <set>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "cad_import/program/missing_parts.h"
#include "cad_import/step/set_items.h"

namespace nurbeam {
namespace {

using Entity = Handle(Standard_Transient);

std::vector<Entity> curves_in(const Entity& curve) {
  std::vector<Entity> parts;
  if (const auto composite = Handle(StepGeom_CompositeCurve)::DownCast(curve)) {
    for (int i = 1; !composite->Segments().IsNull() && i <= composite->NbSegments(); ++i)
      if (!composite->SegmentsValue(i).IsNull()) parts.push_back(composite->SegmentsValue(i)->ParentCurve());
  } else if (const auto trimmed = Handle(StepGeom_TrimmedCurve)::DownCast(curve)) {
    parts.push_back(trimmed->BasisCurve());
  } else if (const auto offset = Handle(StepGeom_OffsetCurve3d)::DownCast(curve)) {
    parts.push_back(offset->BasisCurve());
  } else if (const auto replica = Handle(StepGeom_CurveReplica)::DownCast(curve)) {
    parts.push_back(replica->ParentCurve());
  }
  std::erase_if(parts, [](const Entity& part) { return part.IsNull(); });
  return parts;
}

/// Goes down all curves, one after another and not nested: files may be as deep as they are long.
class Circles {
 public:
  Circles(const StepData_StepModel& model, Remarks& remarks) : model_(model), remarks_(remarks) {
    for (int i = 1; i <= model.NbEntities(); ++i)
      if (!curves_in(model.Value(i)).empty()) search(model.Value(i));
  }

  bool concern(const Entity& curve) const {
    const auto known = depths_.find(curve.get());
    return known != depths_.end() && known->second > deepest;
  }
  bool empty() const { return empty_; }

 private:
  static constexpr int deepest = 1000, endless = 1'000'000;

  struct Step {
    Entity curve;
    std::vector<Entity> left;
    int depth = 1;
  };

  void search(const Entity& start) {
    if (depths_.contains(start.get())) return;
    std::vector<Step> path{{start, curves_in(start)}};
    std::unordered_set<const Standard_Transient*> open{start.get()};
    while (!path.empty()) {
      Step& step = path.back();
      if (step.left.empty()) {
        const int depth = finish(step);
        open.erase(step.curve.get());
        path.pop_back();
        if (!path.empty()) path.back().depth = std::max(path.back().depth, depth + 1);
        continue;
      }
      const Entity next = step.left.back();
      step.left.pop_back();
      if (open.contains(next.get())) {
        step.depth = endless;
        refuse(step.curve, "it is made of " + entity_label(model_, next) +
                               ", which is made of it: a circle of references");
      } else if (const auto known = depths_.find(next.get()); known != depths_.end()) {
        step.depth = std::max(step.depth, known->second + 1);
      } else {
        open.insert(next.get());
        path.push_back({next, curves_in(next)});
      }
    }
  }

  int finish(const Step& step) {
    if (step.depth == deepest + 1)
      refuse(step.curve, "it is nested more than " + std::to_string(deepest) + " deep");
    if (step.depth > deepest) remarks_.refuse_silently(step.curve);
    return depths_[step.curve.get()] = std::min(step.depth, static_cast<int>(endless));
  }

  void refuse(const Entity& curve, const std::string& why) {
    empty_ = false;
    remarks_.refuse(curve, why);
  }

  const StepData_StepModel& model_;
  Remarks& remarks_;
  std::unordered_map<const Standard_Transient*, int> depths_;  // only ever looked up
  bool empty_ = true;
};

bool is_zero(const Handle(StepGeom_Direction) & direction) {
  if (direction.IsNull() || direction->DirectionRatios().IsNull() || direction->NbDirectionRatios() != 3)
    return false;
  for (int i = 1; i <= 3; ++i)
    if (direction->DirectionRatiosValue(i) != 0) return false;
  return true;
}

/// A direction of these that is none.
Handle(StepGeom_Direction) zero_among(const std::vector<Handle(StepGeom_Direction)>& directions) {
  const auto zero = std::find_if(directions.begin(), directions.end(), is_zero);
  return zero == directions.end() ? Handle(StepGeom_Direction)() : *zero;
}

/// Directions whose values are lost become (0, 0, 0): OpenCASCADE crashes on one without any.
std::set<const Standard_Transient*> filled_directions(const StepData_StepModel& model) {
  std::set<const Standard_Transient*> filled;
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const auto direction = Handle(StepGeom_Direction)::DownCast(model.Value(i));
    if (direction.IsNull() || !direction->DirectionRatios().IsNull()) continue;
    direction->SetDirectionRatios(new TColStd_HArray1OfReal(1, 3, 0.0));
    filled.insert(direction.get());
  }
  return filled;
}

void refuse_zero_directions(const StepData_StepModel& model, const Interface_Graph& graph, Remarks& remarks) {
  const std::set<const Standard_Transient*> filled = filled_directions(model);
  const auto of_none = [&](const Handle(StepGeom_Direction) & zero) {
    return entity_label(model, zero) +
           (filled.contains(zero.get()) ? " has no values" : " is (0, 0, 0), which is no direction");
  };
  for (int i = 1; i <= model.NbEntities(); ++i) {
    if (const auto placement = Handle(StepGeom_Axis2Placement3d)::DownCast(model.Value(i))) {
      std::vector<Handle(StepGeom_Direction)> directions;
      if (placement->HasAxis()) directions.push_back(placement->Axis());
      if (placement->HasRefDirection()) directions.push_back(placement->RefDirection());
      const Handle(StepGeom_Direction) zero = zero_among(directions);
      if (zero.IsNull()) continue;
      bool has_others = false;
      for (Interface_EntityIterator next = graph.Sharings(placement); next.More(); next.Next())
        if (next.Value()->IsKind(STANDARD_TYPE(StepGeom_Conic)))
          remarks.refuse(next.Value(), "its direction " + of_none(zero) + "; correct it");
        else
          has_others = true;
      if (has_others)
        remarks.warn(placement,
                     "its direction " + of_none(zero) +
                         ": the standard axis is taken, and what it places may be wrong; correct it");
    } else if (const auto line = Handle(StepGeom_Line)::DownCast(model.Value(i));
               !line.IsNull() && !line->Dir().IsNull()) {
      const Handle(StepGeom_Direction) direction = line->Dir()->Orientation();
      if (is_zero(direction)) remarks.refuse(line, "its direction " + of_none(direction) + "; correct it");
    }
  }
}

}  // namespace

void refuse_unsound_curves(const StepData_StepModel& model, const Interface_Graph& graph, Remarks& remarks) {
  const Circles circles(model, remarks);
  if (!circles.empty()) replace_items(model, [&](const Entity& item) { return circles.concern(item); });
  fill_missing_parts(model, graph, remarks);
  refuse_zero_directions(model, graph, remarks);
}

}  // namespace nurbeam
