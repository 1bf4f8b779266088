#include "cad_import/program/restated_iges.h"

#include <IGESBasic_SingularSubfigure.hxx>
#include <IGESData_TransfEntity.hxx>
#include <IGESGeom_CircularArc.hxx>
#include <IGESGeom_ConicArc.hxx>
#include <IGESGeom_Line.hxx>
#include <IGESGeom_OffsetCurve.hxx>
#include <IGESGeom_SurfaceOfRevolution.hxx>
#include <string>
#include <utility>

#include "cad_import/iges/conic_position.h"
#include "cad_import/iges/copious_data.h"
#include "cad_import/iges/line_forms.h"
#include "cad_import/iges/location.h"
#include "cad_import/iges/offset_curve.h"
#include "cad_import/iges/subfigure_instance.h"
#include "cad_import/report/length_unit.h"

namespace nurbeam {
namespace {

using Entity = Handle(Standard_Transient);

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

/// `unit`: [mm]. Whether it can be read.
template <class Arc>
bool restate_arc(const Handle(Arc) & arc, double unit, const std::string& repair, const Leniency& leniency,
                 Remarks& remarks) {
  return remarks.attempt(
      arc,
      [&] {
        if (const double size = put_into_position(*arc, leniency); size > 0)
          remarks.repaired(arc, repair, size * unit * metres_per_millimetre);
      });
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

void note_drawing_lines(const IGESData_IGESModel& model, Remarks& remarks) {
  const std::vector<Handle(IGESData_IGESEntity)> lines = drawing_lines(model);
  if (lines.empty()) return;
  remarks.note(lines[0],
               "its form, 20 to 40, is that of centre, section and witness lines of a drawing, and it is not "
               "read; so are " +
                   std::to_string(lines.size()) +
                   " entities (106) in all: where the shape is meant, write lines (110), or form 11 to 13");
}

/// What stands in other files is not looked for.
void warn_of_external_references(const IGESData_IGESModel& model, Remarks& remarks) {
  constexpr int external_reference = 416;
  std::vector<Entity> references;
  for (int i = 1; i <= model.NbEntities(); ++i)
    if (model.Entity(i)->TypeNumber() == external_reference) references.push_back(model.Entity(i));
  if (references.empty()) return;
  remarks.warn(references[0],
               "refers to what stands in another file, which is not read; so do " +
                   std::to_string(references.size()) +
                   " entities (416) in all: import that file, or write what it has into this one");
}

}  // namespace

std::vector<RestatedPlace> restate_iges(const IGESData_IGESModel& model, Remarks& remarks) {
  chain_matrices(model, remarks);
  const EntitySet axes = axes_of_revolution(model);
  const double unit = model.GlobalSection().UnitValue();  // [mm]
  const Leniency leniency{model.GlobalSection().Resolution()};
  for (int i = 1; i <= model.NbEntities(); ++i)
    if (const auto offset = Handle(IGESGeom_OffsetCurve)::DownCast(model.Value(i)))
      remarks.attempt(offset, [&] { restate_offset(*offset, unit, leniency); });
  for (int i = 1; i <= model.NbEntities(); ++i) {
    if (const auto line = Handle(IGESGeom_Line)::DownCast(model.Value(i));
        !line.IsNull() && !axes.contains(line.get()))
      remarks.attempt(line, [&] { check_bounded(*line); });
    if (const auto circle = Handle(IGESGeom_CircularArc)::DownCast(model.Value(i)))
      restate_arc(circle, unit,
                  "the ends of an arc, at different distances from its centre, stay, and the centre moves "
                  "(of an almost whole circle the end moves)",
                  leniency, remarks);
    if (const auto conic = Handle(IGESGeom_ConicArc)::DownCast(model.Value(i));
        !conic.IsNull() &&
        !restate_arc(conic, unit, "the ends of a conic arc stay, and the curve of its equation moves",
                     leniency, remarks))
      make_harmless(*conic);
  }
  remarks.tell_repairs();
  note_data_points(model, remarks);
  note_drawing_lines(model, remarks);
  warn_of_external_references(model, remarks);
  return restate_instances(model, unit, remarks);
}

}  // namespace nurbeam
