#include "cad_import/program/restated_curves.h"

#include <HeaderSection_FileName.hxx>
#include <IGESBasic_SingularSubfigure.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESData_TransfEntity.hxx>
#include <IGESGeom_CircularArc.hxx>
#include <IGESGeom_ConicArc.hxx>
#include <IGESGeom_Line.hxx>
#include <IGESGeom_OffsetCurve.hxx>
#include <IGESGeom_SurfaceOfRevolution.hxx>
#include <Interface_EntityIterator.hxx>
#include <Interface_Graph.hxx>
#include <Standard_ErrorHandler.hxx>
#include <Standard_Failure.hxx>
#include <StepData_StepModel.hxx>
#include <StepGeom_Axis2Placement3d.hxx>
#include <StepGeom_CartesianTransformationOperator3d.hxx>
#include <StepGeom_CurveReplica.hxx>
#include <StepGeom_OffsetCurve3d.hxx>
#include <StepGeom_TrimmedCurve.hxx>
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

#include "cad_import/iges/conic_position.h"
#include "cad_import/iges/data_points.h"
#include "cad_import/iges/line_forms.h"
#include "cad_import/iges/location.h"
#include "cad_import/iges/offset_curve.h"
#include "cad_import/iges/subfigure_instance.h"
#include "cad_import/program/part_places.h"
#include "cad_import/report/length_unit.h"
#include "cad_import/step/axis_placement.h"
#include "cad_import/step/between_placements.h"
#include "cad_import/step/closed_spline.h"
#include "cad_import/step/curve_replica.h"
#include "cad_import/step/nested_piece.h"
#include "cad_import/step/step_units.h"
#include "cad_import/step/transformation_operator.h"
#include "cad_import/step/trimmed_conic.h"
#include "cad_import/step/trimmed_spline.h"

namespace nurbeam {
namespace {

using Entity = Handle(Standard_Transient);

/// What is said of the curves of one model.
class Remarks {
 public:
  Remarks(const Interface_InterfaceModel& model, ImportReport& report) : model_(model), report_(report) {}

  /// Does it; whether that went well.
  bool attempt(const Entity& entity, const std::function<void()>& restate) {
    try {
      OCC_CATCH_SIGNALS
      restate();
      return true;
    } catch (const Standard_Failure& e) {
      refuse(entity, std::string("OpenCASCADE makes no curve of its numbers: ") + e.GetMessageString());
    } catch (const std::runtime_error& e) {
      refuse(entity, e.what());
    }
    return false;
  }
  void warn(const Entity& entity, const std::string& message) { say(Severity::warning, entity, message); }
  void note(const Entity& entity, const std::string& message) { say(Severity::note, entity, message); }
  const EntitySet& refused() const { return refused_; }

 private:
  void say(Severity severity, const Entity& entity, const std::string& message) {
    const std::string name = entity_name(entity);
    add_diagnostic(report_, severity, entity_label(model_, entity) + (name.empty() ? "" : " '" + name + "'"),
                   message);
  }
  void refuse(const Entity& entity, const std::string& why) {
    refused_.insert(entity.get());
    warn(entity, "skipped with all that is made of it: " + why);
  }

  const Interface_InterfaceModel& model_;
  ImportReport& report_;
  EntitySet refused_;
};

// ---------------------------------------------------------------------------------------------------- IGES

/// Those that place other entities; all are read before one is changed, for they share those that they go on
/// to.
void chain_matrices(const IGESData_IGESModel& model, Remarks& remarks) {
  EntitySet seen;
  std::vector<Entity> without_matrix;
  std::vector<std::pair<Handle(IGESData_TransfEntity), Eigen::Affine3d>> chained;
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const auto entity = Handle(IGESData_IGESEntity)::DownCast(model.Value(i));
    const Handle(IGESData_TransfEntity) matrix = entity->Transf();
    if (entity->HasTransf() && matrix.IsNull()) without_matrix.push_back(entity);
    if (entity->IsKind(STANDARD_TYPE(IGESData_TransfEntity)) || matrix.IsNull() ||
        !seen.insert(matrix.get()).second || !matrix->HasTransf())
      continue;
    remarks.attempt(matrix, [&] { chained.emplace_back(matrix, chained_location(*matrix)); });
  }
  for (const auto& [matrix, location] : chained) set_matrix(*matrix, location);
  if (!without_matrix.empty())
    remarks.warn(without_matrix[0],
                 "what field 7 of its directory entry names is no transformation matrix (124), and "
                 "it is read without; so are " +
                     std::to_string(without_matrix.size()) + " entities in all: correct the fields");
}

/// Lines that need no ends.
EntitySet axes_of_revolution(const IGESData_IGESModel& model) {
  EntitySet axes;
  for (int i = 1; i <= model.NbEntities(); ++i)
    if (const auto surface = Handle(IGESGeom_SurfaceOfRevolution)::DownCast(model.Value(i)))
      axes.insert(surface->AxisOfRevolution().get());
  return axes;
}

/// OpenCASCADE scales no shape: it leaves out the scale, or the shape. `unit`: [mm].
RestatedPlace restate_scaled(const Handle(IGESBasic_SingularSubfigure) & instance, double unit,
                             Remarks& remarks) {
  Eigen::Affine3d place = Eigen::Affine3d::Identity();
  const bool is_read = remarks.attempt(instance, [&] { place = place_of(*instance); });
  set_place(*instance, stand_in(place));
  place.translation() *= unit * metres_per_millimetre;
  return {Entity(instance), is_read ? std::optional(place) : std::nullopt, std::nullopt};
}

std::vector<RestatedPlace> restate_instances(const IGESData_IGESModel& model, double unit, Remarks& remarks) {
  std::vector<RestatedPlace> places;
  std::vector<Entity> turned_and_moved;
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const auto instance = Handle(IGESBasic_SingularSubfigure)::DownCast(model.Value(i));
    if (instance.IsNull() || instance->Subfigure().IsNull()) continue;
    if (is_moved_after_turning(*instance)) turned_and_moved.push_back(instance);
    if (is_scaled(*instance)) places.push_back(restate_scaled(instance, unit, remarks));
  }
  if (!turned_and_moved.empty())
    remarks.note(turned_and_moved[0],
                 "its X, Y, Z move what its matrix (124) has turned, and are not turned by it; so in " +
                     std::to_string(turned_and_moved.size()) +
                     " instance(s) of subfigures (408): where that is not meant, write the whole place "
                     "into the matrix");
  return places;
}

void note_data_points(const IGESData_IGESModel& model, Remarks& remarks) {
  const std::vector<Handle(IGESData_IGESEntity)> points = data_points(model);
  if (points.empty()) return;
  remarks.note(points[0],
               "its form, 1 to 3, is that of points that nothing connects, and it is read as straight lines "
               "from one to the next; so in " +
                   std::to_string(points.size()) +
                   " entities (106) in all: where a path is meant, write form 11 to 13");
}

/// Matrices before what they place, and offsets before arcs: they refer to the parameters of the arcs as
/// these are in the file. Returns what scales.
std::vector<RestatedPlace> restate_iges(const IGESData_IGESModel& model, Remarks& remarks) {
  chain_matrices(model, remarks);
  const EntitySet axes = axes_of_revolution(model);
  const double unit = model.GlobalSection().UnitValue();  // [mm]
  for (int i = 1; i <= model.NbEntities(); ++i)
    if (const auto offset = Handle(IGESGeom_OffsetCurve)::DownCast(model.Value(i)))
      remarks.attempt(offset, [&] { restate_offset(*offset, unit); });
  for (int i = 1; i <= model.NbEntities(); ++i) {
    if (const auto line = Handle(IGESGeom_Line)::DownCast(model.Value(i));
        !line.IsNull() && !axes.contains(line.get()))
      remarks.attempt(line, [&] { check_bounded(*line); });
    if (const auto circle = Handle(IGESGeom_CircularArc)::DownCast(model.Value(i)))
      remarks.attempt(circle, [&] { put_into_position(*circle); });
    if (const auto conic = Handle(IGESGeom_ConicArc)::DownCast(model.Value(i)))
      remarks.attempt(conic, [&] { put_into_position(*conic); });
  }
  note_data_points(model, remarks);
  return restate_instances(model, unit, remarks);
}

// ---------------------------------------------------------------------------------------------------- STEP

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

bool is_between_axes(const StepRepr_MappedItem& item) {
  return !Handle(StepGeom_Axis2Placement3d)::DownCast(item.MappingSource()->MappingOrigin()).IsNull() &&
         !Handle(StepGeom_Axis2Placement3d)::DownCast(item.MappingTarget()).IsNull();
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
    if (entity.IsNull() || !seen_.insert(entity.get()).second) return;
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
    const auto known = Operator::DownCast(relation->TransformationOperator().Value());
    if (known.IsNull()) {
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
