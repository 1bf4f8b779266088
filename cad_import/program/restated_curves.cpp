#include "cad_import/program/restated_curves.h"

#include <HeaderSection_FileName.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_EntityIterator.hxx>
#include <Interface_Graph.hxx>
#include <StepData_StepModel.hxx>
#include <StepGeom_Axis2Placement3d.hxx>
#include <StepGeom_BSplineCurve.hxx>
#include <StepGeom_CartesianTransformationOperator3d.hxx>
#include <StepGeom_CurveReplica.hxx>
#include <StepGeom_OffsetCurve3d.hxx>
#include <StepGeom_TrimmedCurve.hxx>
#include <StepRepr_ItemDefinedTransformation.hxx>
#include <StepRepr_MappedItem.hxx>
#include <StepRepr_ProductDefinitionShape.hxx>
#include <StepRepr_RepresentationMap.hxx>
#include <StepRepr_RepresentationRelationshipWithTransformation.hxx>
#include <StepShape_ContextDependentShapeRepresentation.hxx>
#include <StepShape_ShapeRepresentation.hxx>
#include <TopoDS_Shape.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <cctype>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "cad_import/program/part_places.h"
#include "cad_import/program/remarks.h"
#include "cad_import/program/restated_iges.h"
#include "cad_import/program/unsound_curves.h"
#include "cad_import/report/length_unit.h"
#include "cad_import/step/axis_placement.h"
#include "cad_import/step/between_placements.h"
#include "cad_import/step/closed_spline.h"
#include "cad_import/step/curve_replica.h"
#include "cad_import/step/nested_piece.h"
#include "cad_import/step/sound_spline.h"
#include "cad_import/step/step_units.h"
#include "cad_import/step/transformation_operator.h"
#include "cad_import/step/trimmed_conic.h"
#include "cad_import/step/trimmed_spline.h"

namespace nurbeam {
namespace {

using Entity = Handle(Standard_Transient);

/// Whether the file was written by OpenCASCADE, or a program that has it.
bool is_by_open_cascade(const StepData_StepModel& model) {
  const auto file =
      Handle(HeaderSection_FileName)::DownCast(model.HeaderEntity(STANDARD_TYPE(HeaderSection_FileName)));
  if (file.IsNull()) return false;
  std::string systems = trimmed_text(file->PreprocessorVersion()) + trimmed_text(file->OriginatingSystem());
  std::erase(systems, ' ');
  std::transform(systems.begin(), systems.end(), systems.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return systems.find("opencascade") != std::string::npos || systems.find("freecad") != std::string::npos;
}

bool places_a_shape(const StepRepr_MappedItem& item) {
  return !item.MappingSource().IsNull() && !item.MappingSource()->MappedRepresentation().IsNull() &&
         item.MappingSource()->MappedRepresentation()->IsKind(STANDARD_TYPE(StepShape_ShapeRepresentation));
}

bool is_placement(const Entity& entity) {
  return !Handle(StepGeom_Axis2Placement3d)::DownCast(entity).IsNull();
}

bool is_between_axes(const StepRepr_MappedItem& item) {
  return is_placement(item.MappingSource()->MappingOrigin()) && is_placement(item.MappingTarget());
}

using Operator = Handle(StepGeom_CartesianTransformationOperator3d);

Operator operator_of(const StepRepr_MappedItem& item) {
  const auto known = Operator::DownCast(item.MappingTarget());
  if (known.IsNull())
    throw std::runtime_error(
        "its target is neither AXIS2_PLACEMENT_3D nor CARTESIAN_TRANSFORMATION_OPERATOR_3D; place it by one");
  return known;
}

/// What has the shape of a part where a relation puts it.
std::vector<Entity> placed_by(const Entity& relation, const Interface_Graph& graph) {
  std::vector<Entity> placed;
  for (Interface_EntityIterator next = graph.Sharings(relation); next.More(); next.Next()) {
    const auto representation = Handle(StepShape_ContextDependentShapeRepresentation)::DownCast(next.Value());
    if (representation.IsNull()) continue;
    placed.push_back(representation);
    const Handle(StepRepr_ProductDefinitionShape) shape = representation->RepresentedProductRelation();
    if (!shape.IsNull()) placed.push_back(shape->Definition().Value());
  }
  return placed;
}

/// Before the curves, which are placed by them.
void restate_placements(const StepData_StepModel& model) {
  for (int i = 1; i <= model.NbEntities(); ++i)
    if (const auto placement = Handle(StepGeom_Axis2Placement3d)::DownCast(model.Value(i)))
      complete_axes(*placement);
}

void restate_splines(const StepData_StepModel& model, Remarks& remarks) {
  for (int i = 1; i <= model.NbEntities(); ++i)
    if (model.Value(i)->IsKind(STANDARD_TYPE(StepGeom_BSplineCurve)))
      remarks.attempt(model.Value(i), [&] {
        if (const double knots = make_sound(model.Value(i)).knots; knots > 0)
          remarks.repaired_relative(model.Value(i), repaired_knots, knots);
      });
  remarks.tell_repairs();
}

class StepCurves {
 public:
  StepCurves(const StepData_StepModel& model, const Interface_Graph& graph, Remarks& remarks)
      : model_(model), graph_(graph), remarks_(remarks), by_open_cascade_(is_by_open_cascade(model)) {
    for (int i = 1; i <= model.NbEntities(); ++i)
      if (length_unit_of(model.Value(i))) context_ = model.Value(i);
    has_one_unit_ = length_units_of(model).size() <= 1;
  }

  /// What it is made of first.
  void restate(const Entity& entity) {
    if (entity.IsNull() || remarks_.refused().contains(entity.get()) || !seen_.insert(entity.get()).second)
      return;
    if (const auto offset = Handle(StepGeom_OffsetCurve3d)::DownCast(entity)) {
      restate(offset->BasisCurve());
      remarks_.attempt(entity, [&] { offset->SetDistance(offset->Distance() * use_unit(entity)); });
    } else if (const auto replica = Handle(StepGeom_CurveReplica)::DownCast(entity)) {
      restate(replica->ParentCurve());
      parents_.insert(replica->ParentCurve().get());
      remarks_.attempt(entity, [&] {
        use_unit(entity);
        restate_replica(*replica);
      });
    } else if (const auto trimmed = Handle(StepGeom_TrimmedCurve)::DownCast(entity)) {
      const Entity basis = trimmed->BasisCurve();
      if (!remarks_.attempt(entity, [&] { restate_nested(*trimmed); })) return;
      if (basis != Entity(trimmed->BasisCurve())) parents_.insert(basis.get());
      restate(trimmed->BasisCurve());
      restate_piece(trimmed);
    } else if (const auto item = Handle(StepRepr_MappedItem)::DownCast(entity)) {
      restate_mapped(item);
    } else if (const auto relation =
                   Handle(StepRepr_RepresentationRelationshipWithTransformation)::DownCast(entity)) {
      restate_relation(relation);
    }
  }

  const EntitySet& parents() const { return parents_; }
  const std::vector<RestatedPlace>& places() const { return places_; }

 private:
  void restate_mapped(const Handle(StepRepr_MappedItem) & item) {
    if (!places_a_shape(*item)) return;
    if (is_between_axes(*item)) {
      remarks_.attempt(item, [&] { restate_between_axes(*item); });
      return;
    }
    const auto restated = restate_operator(item, [&] { return operator_of(*item); });
    if (!restated) return;
    item->SetMappingTarget(restated->read);
    if (restated->scales) places_.push_back({Entity(item), restated->place, std::nullopt});
  }

  /// A part in an assembly.
  void restate_relation(const Handle(StepRepr_RepresentationRelationshipWithTransformation) & relation) {
    const Entity given = relation->TransformationOperator().Value();
    const auto known = Operator::DownCast(given);
    if (known.IsNull()) {
      const auto between = Handle(StepRepr_ItemDefinedTransformation)::DownCast(given);
      if (between.IsNull())
        remarks_.warn(
            relation,
            "what it places stands as if it were not placed: its transformation is neither "
            "ITEM_DEFINED_TRANSFORMATION nor CARTESIAN_TRANSFORMATION_OPERATOR_3D; place it by one");
      else if (!is_placement(between->TransformItem1()) || !is_placement(between->TransformItem2()))
        remarks_.warn(relation,
                      "what it places stands as if it were not placed: the items of its "
                      "ITEM_DEFINED_TRANSFORMATION are not both AXIS2_PLACEMENT_3D; place it between two");
      remarks_.attempt(relation, [&] { restate_between_axes(*relation); });
      return;
    }
    const auto restated = restate_operator(relation, [&] { return known; });
    if (!restated) return;
    StepRepr_Transformation transformation;
    transformation.SetValue(restated->read);
    relation->SetTransformationOperator(transformation);
    if (!restated->scales) return;
    for (const Entity& placed : placed_by(relation, graph_))
      places_.push_back({placed, restated->place, restated->stand_in});
  }

  /// An operator as OpenCASCADE is to read it.
  struct RestatedOperator {
    Operator read;
    bool scales;                           // or mirrors, or cannot be
    std::optional<Eigen::Affine3d> place;  // [m], as RestatedPlace has it
    Eigen::Affine3d stand_in;              // [m]
  };

  /// OpenCASCADE leaves out the scale, turns where the operator mirrors, and knows no axes but given ones.
  /// Nothing where it reads what `given` returns as it is meant.
  std::optional<RestatedOperator> restate_operator(const Entity& entity,
                                                   const std::function<Operator()>& given) {
    Eigen::Affine3d place = Eigen::Affine3d::Identity();
    double unit = 1;  // [mm]
    bool is_right = false;
    const bool is_read = remarks_.attempt(entity, [&] {
      is_right = is_location(*given());
      if (is_right) return;
      unit = use_unit(entity);
      place = place_of(*given());
    });
    if (is_right) return std::nullopt;
    const bool only_axes_lack = is_read && is_rigid(place);
    Eigen::Affine3d in_file = only_axes_lack ? place : stand_in(place), read = in_file;
    in_file.translation() /= unit;
    for (Eigen::Affine3d* metric : {&place, &read}) metric->translation() *= metres_per_millimetre;
    return RestatedOperator{transformation_operator(in_file), !only_axes_lack,
                            is_read ? std::optional(place) : std::nullopt, read};
  }

  void restate_piece(const Handle(StepGeom_TrimmedCurve) & trimmed) {
    std::optional<std::string> warning;
    remarks_.attempt(trimmed, [&] {
      use_unit(trimmed);
      warning = restate_trims(*trimmed, graph_, by_open_cascade_);
      if (!warning) warning = trims_beyond_ends(*trimmed);
      if (!warning) warning = misplaced_trims(trimmed);
    });
    if (warning) remarks_.warn(trimmed, *warning);
  }

  /// Makes OpenCASCADE go by the units of the entity; returns that of length [mm].
  double use_unit(const Entity& entity) const {
    Entity context = context_;
    if (!has_one_unit_) {
      const std::optional<Holder> holder = holder_of(entity, graph_);
      if (holder) context = holder->context;
      if (!holder || !length_unit_of(context))
        throw std::runtime_error("its unit is not known, for the file has parts in several; write it in one");
    }
    if (context.IsNull()) return 1;
    use_units_of(context);
    return *length_unit_of(context) * millimetres_per_metre;
  }

  const StepData_StepModel& model_;
  const Interface_Graph& graph_;
  Remarks& remarks_;
  bool by_open_cascade_;
  Entity context_;
  bool has_one_unit_;
  EntitySet seen_, parents_;
  std::vector<RestatedPlace> places_;
};

}  // namespace

RestatedCurves restate_curves(const XSControl_Reader& reader, ImportReport& report) {
  RestatedCurves restated;
  Remarks remarks(*reader.Model(), report);
  if (const auto iges = Handle(IGESData_IGESModel)::DownCast(reader.Model()))
    restated.places = restate_iges(*iges, remarks);
  if (const auto step = Handle(StepData_StepModel)::DownCast(reader.Model())) {
    refuse_unsound_curves(*step, reader.WS()->Graph(), remarks);
    restate_splines(*step, remarks);
    restate_placements(*step);
    unmark_closed_splines(*step);
    StepCurves curves(*step, reader.WS()->Graph(), remarks);
    for (int i = 1; i <= step->NbEntities(); ++i) curves.restate(step->Value(i));
    restated.parents = curves.parents();
    restated.places = curves.places();
  }
  restated.refused = remarks.refused();
  return restated;
}

TruePlaces true_places(const XSControl_Reader& reader, const RestatedCurves& restated) {
  const Handle(Transfer_TransientProcess) process = reader.WS()->TransferReader()->TransientProcess();
  TruePlaces places;
  for (const RestatedPlace& restated_place : restated.places) {
    const TopoDS_Shape shape = TransferBRep::ShapeResult(process, restated_place.entity);
    if (!shape.IsNull()) places.add(shape.Location(), restated_place.place, restated_place.stand_in);
  }
  return places;
}

}  // namespace nurbeam
