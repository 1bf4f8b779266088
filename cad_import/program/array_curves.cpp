#include "cad_import/program/array_curves.h"

#include <IGESBasic_Group.hxx>
#include <IGESBasic_SubfigureDef.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Shape.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "cad_import/iges/placed_copies.h"
#include "cad_import/occt/appearance.h"
#include "cad_import/occt/edge_curve.h"
#include "cad_import/occt/placed_curve.h"
#include "cad_import/program/entity_origins.h"

namespace nurbeam {
namespace {

constexpr std::size_t most_curves = 100'000;
constexpr int deepest = 20;

using IgesEntity = Handle(IGESData_IGESEntity);

/// What an entity and all that stands in it become.
class Expansion {
 public:
  Expansion(const XSControl_Reader& reader, const RestatedCurves& restated, double unit, double tolerance)
      : reader_(reader),
        restated_(restated),
        process_(reader.WS()->TransferReader()),
        appearances_(appearances_of(*reader.WS())),
        unit_(unit),
        tolerance_(tolerance) {
    process_->BeginTransfer();
  }

  std::vector<ImportedCurve> curves_of(const IgesEntity& entity, int depth = 0) {
    if (entity.IsNull()) return {};
    if (depth > deepest || ++visited_ > most_curves) throw std::runtime_error("it is nested too deeply");
    std::vector<ImportedCurve> curves;
    if (const auto copies = placed_copies(*entity))
      curves = copied(*copies, entity->Location(), curves_of(copies->base, depth + 1));
    else if (const auto group = Handle(IGESBasic_Group)::DownCast(entity))
      for (int i = 1; i <= group->NbEntities(); ++i) append(curves_of(group->Entity(i), depth + 1), curves);
    else if (const auto figure = Handle(IGESBasic_SubfigureDef)::DownCast(entity))
      for (int i = 1; i <= figure->NbEntities(); ++i)
        append(curves_of(figure->AssociatedEntity(i), depth + 1), curves);
    else
      curves = edges_of(entity);
    for (ImportedCurve& curve : curves) describe(entity, curve);
    return curves;
  }

 private:
  std::vector<ImportedCurve> edges_of(const IgesEntity& entity) const {
    process_->TransferOne(entity);
    const TopoDS_Shape shape = process_->ShapeResult(entity);
    TopTools_IndexedMapOfShape edges;
    if (!shape.IsNull()) TopExp::MapShapes(shape, TopAbs_EDGE, edges);
    const TruePlaces places = true_places(reader_, restated_);
    std::vector<ImportedCurve> curves;
    for (int i = 1; i <= edges.Extent(); ++i) {
      ImportedCurve curve = imported_curve(TopoDS::Edge(edges(i)), tolerance_);
      if (places.put_in_place(edges(i).Location(), curve)) curves.push_back(std::move(curve));
    }
    return curves;
  }

  std::vector<ImportedCurve> copied(const PlacedCopies& copies, const gp_GTrsf& location,
                                    const std::vector<ImportedCurve>& originals) const {
    if (originals.size() * copies.places.size() > most_curves)
      throw std::runtime_error("it makes more than " + std::to_string(most_curves) + " curves");
    const Eigen::Affine3d to_world = in_metres(location, unit_);
    std::vector<ImportedCurve> curves;
    for (const Eigen::Vector3d& place : copies.places)
      for (ImportedCurve curve : originals) {
        const Eigen::Affine3d move = Eigen::Translation3d(unit_ * place) * Eigen::Scaling(copies.scale);
        curve.curve = placed(curve.curve, to_world * move);
        curves.push_back(std::move(curve));
      }
    return curves;
  }

  // What the curve does not have yet.
  void describe(const IgesEntity& entity, ImportedCurve& curve) const {
    if (curve.name.empty()) curve.name = entity_name(entity);
    const auto shown = appearances_.find(entity.get());
    if (shown == appearances_.end()) return;
    if (curve.layer.empty()) curve.layer = shown->second.layer;
    if (curve.colour.empty()) curve.colour = shown->second.colour;
    curve.hidden |= shown->second.hidden;
  }

  static void append(std::vector<ImportedCurve> more, std::vector<ImportedCurve>& curves) {
    if (curves.size() + more.size() > most_curves)
      throw std::runtime_error("it makes more than " + std::to_string(most_curves) + " curves");
    std::move(more.begin(), more.end(), std::back_inserter(curves));
  }

  const XSControl_Reader& reader_;
  const RestatedCurves& restated_;
  Handle(XSControl_TransferReader) process_;
  Appearances appearances_;
  double unit_, tolerance_;
  std::size_t visited_ = 0;
};

}  // namespace

std::vector<ImportedCurve> array_curves(const Handle(IGESData_IGESEntity) & array,
                                        const XSControl_Reader& reader, const RestatedCurves& restated,
                                        double unit, double tolerance) {
  std::vector<ImportedCurve> curves = Expansion(reader, restated, unit, tolerance).curves_of(array);
  if (curves.empty()) throw std::runtime_error("what it repeats is no curve");
  return curves;
}

}  // namespace nurbeam
