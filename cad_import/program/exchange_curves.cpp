#include "cad_import/program/exchange_curves.h"

#include <BRep_Tool.hxx>
#include <STEPConstruct_ExternRefs.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_ErrorHandler.hxx>
#include <Standard_Failure.hxx>
#include <StepData_StepModel.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>

#include "cad_import/files/cad_format.h"
#include "cad_import/occt/centre_line.h"
#include "cad_import/occt/edge_curve.h"
#include "cad_import/occt/occt_session.h"
#include "cad_import/occt/placed_curve.h"
#include "cad_import/program/composite_ends.h"
#include "cad_import/program/drawing_text.h"
#include "cad_import/program/edge_senses.h"
#include "cad_import/program/lost_curves.h"
#include "cad_import/program/memory_file.h"
#include "cad_import/program/restated_curves.h"
#include "cad_import/step/bspline_text.h"
#include "cad_import/step/encoded_text.h"
#include "cad_import/step/representations.h"
#include "cad_import/step/step_instances.h"
#include "cad_import/step/step_units.h"
#include "cad_import/step/supplemental_geometry.h"

namespace nurbeam {
namespace {

constexpr double import_tolerance = 1e-7;  ///< of ImportOptions [m]

/// Where a drawn curve stands in the file.
struct FoundCurve {
  int instance;
  Eigen::Affine3d to_world = Eigen::Affine3d::Identity();  // of its part [m]
  bool backwards = false;                                  // against the instance
  bool free = true;
  int places = 1;      // how often its part is placed
  bool piece = false;  // of the instance, a composite curve
};

bool is_same(const NurbsCurve& a, const NurbsCurve& b) {
  return a.knots() == b.knots() && a.control_points() == b.control_points();
}

/// The instance that OpenCASCADE made of such a shape, an edge or a wire, that has the edge; 0 for none.
int instance_with(const TopoDS_Edge& edge, TopAbs_ShapeEnum kind, const STEPControl_Reader& reader) {
  const Handle(Transfer_TransientProcess) process = reader.WS()->TransferReader()->TransientProcess();
  const auto model = Handle(StepData_StepModel)::DownCast(reader.Model());
  for (int i = 1; i <= process->NbMapped(); ++i) {
    const TopoDS_Shape result = TransferBRep::ShapeResult(process, process->Mapped(i));
    const int label = model->IdentLabel(process->Mapped(i));
    if (label <= 0 || result.IsNull() || result.ShapeType() != kind) continue;
    for (TopExp_Explorer part(result, TopAbs_EDGE); part.More(); part.Next())
      if (part.Current().TShape() == edge.TShape()) return label;
  }
  return 0;
}

FoundCurve found_curve(const TopoDS_Edge& edge, const STEPControl_Reader& reader) {
  if (const int own = instance_with(edge, TopAbs_EDGE, reader)) return {.instance = own};
  if (const int composite = instance_with(edge, TopAbs_WIRE, reader))
    return {.instance = composite, .piece = true};
  throw std::runtime_error("OpenCASCADE does not tell which instance of the file an edge came from");
}

/// `same`: whether a curve of the file is the one that was drawn.
template <class Same>
std::optional<FoundCurve> find_edge(const NurbsCurve& drawn, const Same& same, const TruePlaces& true_places,
                                    const STEPControl_Reader& reader) {
  TopTools_IndexedDataMapOfShapeListOfShape faces;
  const TopoDS_Shape shape = reader.OneShape();
  if (!shape.IsNull()) TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces);
  const EdgeSenses senses(reader);
  for (int i = 1; i <= faces.Extent(); ++i) {
    const TopoDS_Edge& edge = TopoDS::Edge(faces.FindKey(i));
    if (BRep_Tool::Degenerated(edge)) continue;
    try {
      ImportedCurve curve = imported_curve(faces(i).IsEmpty() ? senses.of(edge) : edge, import_tolerance);
      if (!true_places.put_in_place(edge.Location(), curve) || !same(curve.curve, drawn)) continue;
    } catch (const std::exception&) {
      continue;  // no valid curve, and so none that import_curves() gave
    }
    FoundCurve found = found_curve(edge, reader);
    found.to_world = *true_places.to_world(edge.Location());
    found.free = faces(i).IsEmpty();
    const bool as_its_vertices = found.free && senses.know(edge);  // and so it is written
    found.backwards = edge.Orientation() == TopAbs_REVERSED && !as_its_vertices;
    found.places = 0;
    for (int k = 1; k <= faces.Extent(); ++k) found.places += faces.FindKey(k).TShape() == edge.TShape();
    return found;
  }
  return std::nullopt;
}

/// One that OpenCASCADE makes no edge of.
std::optional<FoundCurve> find_lost(const NurbsCurve& drawn, const RestatedCurves& restated,
                                    const STEPControl_Reader& reader) {
  const auto model = Handle(StepData_StepModel)::DownCast(reader.Model());
  const std::set<double> units = length_units_of(*model);
  ImportReport report;
  report.unit_in_metres = units.empty() ? metres_per_millimetre : *units.begin();
  const auto recovered = add_lost_curves(reader, restated, import_tolerance, report).recovered;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto known = recovered.find(model->Value(i).get());
    if (known == recovered.end()) continue;
    const auto& [first, places, at_each] = known->second;
    for (std::size_t k = 0; k < places.size() * at_each; ++k)
      if (is_same(report.curves[first + k].curve, drawn))
        return FoundCurve{.instance = model->IdentLabel(model->Value(i)),
                          .to_world = in_metres(places[k / at_each], metres_per_millimetre),
                          .places = static_cast<int>(places.size()),
                          .piece = at_each > 1};
  }
  return std::nullopt;
}

/// The length unit of a representation context [mm].
double unit_of(int context, const StepData_StepModel& model) {
  for (int i = 1; i <= model.NbEntities(); ++i)
    if (model.IdentLabel(model.Value(i)) == context)
      if (const auto unit = length_unit_of(model.Value(i))) return *unit * millimetres_per_metre;
  return 1;  // import_curves() takes a file without unit for one in millimetres, too
}

/// The curve in the coordinates and the unit [mm] of its part.
NurbsCurve in_part(const NurbsCurve& world, const Eigen::Affine3d& to_world, double unit) {
  const Eigen::Affine3d to_part = to_world.inverse();
  return placed(world, Eigen::Scaling(millimetres_per_metre / unit) * to_part);
}

// ---------------------------------------------------------------------------------------------- exchange

/// The instance that holds the curve from now on: `was`, so that styles and layers attached to it are those
/// of the curve, or a new one where other geometry is made of `was`, too.
int put_in_place(int was, const NurbsCurve& curve, StepInstances& step) {
  const std::string value = bspline_value(curve, step.encoded_name(was), step);
  const std::vector<int>& users = step.users(was);
  const auto is_geometry = [&](int user) {
    const std::string keyword = step.keyword(user);
    return !keyword.ends_with("STYLED_ITEM") && keyword != "PRESENTATION_LAYER_ASSIGNMENT";
  };
  if (std::count_if(users.begin(), users.end(), is_geometry) > 1) return step.add(value);
  step.replace(was, value);
  return was;
}

void exchange(int instance, const NurbsCurve& curve, StepInstances& step) {
  const std::string kind = step.keyword(instance), name = "'" + step.encoded_name(instance) + "',";
  const auto number = [](int n) { return "#" + std::to_string(n); };
  const double start = curve.knots().start(), end = curve.knots().end();
  if (kind == "EDGE_CURVE") {  // vertex, vertex, geometry
    const int geometry = put_in_place(step.references(instance).at(2), curve, step);
    const auto vertex = [&](double u) {
      return number(step.add("VERTEX_POINT(''," + number(add_point(curve.point(u), step)) + ")")) + ",";
    };
    const std::string first = vertex(start);
    const std::string last = is_closed(curve, 1e-12 * length(curve)) ? first : vertex(end);
    step.replace(instance, "EDGE_CURVE(" + name + first + last + number(geometry) + ",.T.)");
  } else if (kind == "TRIMMED_CURVE") {
    const int basis = put_in_place(step.references(instance).at(0), curve, step);
    const auto trim = [](double u) { return "(PARAMETER_VALUE(" + step_real(u) + ")),"; };
    step.replace(instance, "TRIMMED_CURVE(" + name + number(basis) + "," + trim(start) + trim(end) +
                               ".T.,.PARAMETER.)");
  } else {
    step.replace(instance, bspline_value(curve, step.encoded_name(instance), step));
  }
}

/// Adds the element to the set: at the end of the list that is its last parameter.
void add_to_set(int element, int set, StepInstances& step) {
  std::string value = step.value(set);
  const std::size_t end_of_list = value.rfind(')', value.rfind(')') - 1);
  step.replace(set, value.insert(end_of_list, ",#" + std::to_string(element)));
}

/// Into this set of curves, else into a representation of its own beside the part's.
void add_beside(int representation, std::optional<int> own, const NurbsCurve& curve, const std::string& name,
                StepInstances& step) {
  const auto number = [](int n) { return "#" + std::to_string(n); };
  const std::string context = number(context_of(representation, step));
  const int geometry = step.add(bspline_value(curve, name, step));
  if (own) return add_to_set(geometry, *own, step);
  const int set = step.add("GEOMETRIC_CURVE_SET('" + name + "',(" + number(geometry) + "))");
  const int wires = step.add("GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION('" + name + "',(" +
                             number(set) + ")," + context + ")");
  step.add("SHAPE_REPRESENTATION_RELATIONSHIP('" + name + "',''," + number(of_product(representation, step)) +
           "," + number(wires) + ")");
}

/// Whether an instance of this kind is geometry that is made of the curves that it refers to.
bool is_made_of_curves(const std::string& keyword) {
  const auto names = [&](std::string_view part) { return keyword.find(part) != std::string::npos; };
  return (names("CURVE") || names("SURFACE") || names("SOLID")) && !keyword.ends_with("_SET") &&
         !names("STYLE") && !names("OCCURRENCE") && !names("REPRESENTATION");
}

/// Why the curve cannot change where it stands; nothing if it can.
std::optional<std::string> obstacle(const DeformedCurve& wanted, const FoundCurve& found,
                                    const StepInstances& step) {
  if (wanted.beside) return "the beam is a chain of several curves";
  if (found.piece) return "the curve is a piece of this composite curve, which stays as it is";
  if (!found.free) return "the edge bounds faces, which do not move with it";
  for (const int user : step.users(found.instance))
    if (is_made_of_curves(step.keyword(user)))
      return "#" + std::to_string(user) + " is made of the same curve";
  return std::nullopt;
}

std::vector<std::string> place_found(const DeformedCurve& wanted, const FoundCurve& found,
                                     const StepData_StepModel& model, StepInstances& step) {
  const int representation = representation_of(found.instance, step);
  const double unit = unit_of(context_of(representation, step), model);
  const NurbsCurve curve = in_part(wanted.deformed, found.to_world, unit);
  const std::string label = "#" + std::to_string(found.instance) + " '" + wanted.name + "': ";
  std::vector<std::string> warnings;
  if (const auto reason = obstacle(wanted, found, step)) {
    const std::optional<int> own = set_holding(found.instance, step);
    add_beside(representation, own ? own : curve_set_of(representation, step), curve,
               step_string(wanted.name), step);
    warnings.push_back(label + *reason + "; the deformed curve was added beside it");
  } else {
    exchange(found.instance, found.backwards ? curve.reversed() : curve, step);
  }
  if (found.places > 1)
    warnings.push_back(label + "its part stands at " + std::to_string(found.places) +
                       " places; the deformed curve shows at each of them");
  return warnings;
}

/// Why the file itself does not have the curve, although it was imported with it; nothing if it should.
std::optional<std::string> absence(const NurbsCurve& drawn, const TruePlaces& true_places,
                                   const STEPControl_Reader& reader) {
  const TopoDS_Shape shape = reader.OneShape();
  TopTools_IndexedMapOfShape faces;
  if (!shape.IsNull()) {
    TopExp::MapShapes(shape, TopAbs_FACE, faces);
    for (CentreLines found = centre_lines(shape, import_tolerance); CentreLine & line : found.lines)
      if (true_places.put_in_place(faces(line.face).Location(), line.curve) &&
          is_same(line.curve.curve, drawn))
        return "it is the centre line of a solid, which does not move with it";
  }
  if (STEPConstruct_ExternRefs(reader.WS()).LoadExternRefs())
    return "its part lies in another file, which stays as it is";
  return std::nullopt;
}

/// Into the topmost part.
std::vector<std::string> place_on_top(const DeformedCurve& wanted, const std::string& reason,
                                      const StepData_StepModel& model, StepInstances& step) {
  const std::optional<int> representation = topmost_representation(step);
  if (!representation) throw std::runtime_error("no part of the file has a shape representation");
  const double unit = unit_of(context_of(*representation, step), model);
  add_beside(*representation, curve_set_of(*representation, step),
             in_part(wanted.deformed, Eigen::Affine3d::Identity(), unit), step_string(wanted.name), step);
  return {"'" + wanted.name + "': " + reason + "; the deformed curve was added to the topmost part"};
}

/// Into the file, whose curves `found` are; nothing: it is none of them. `others_too`: further beams deform
/// the same curve, at other places of its part.
std::vector<std::string> place(const DeformedCurve& wanted, const std::optional<FoundCurve>& found,
                               bool others_too, const TruePlaces& places, const STEPControl_Reader& reader,
                               StepInstances& step) {
  const auto model = Handle(StepData_StepModel)::DownCast(reader.Model());
  if (found && others_too)
    return place_on_top(wanted,
                        "other beams deform the same curve #" + std::to_string(found->instance) +
                            " at other places of its part",
                        *model, step);
  if (found) return place_found(wanted, *found, *model, step);
  if (const auto reason = absence(wanted.drawn, places, reader))
    return place_on_top(wanted, *reason, *model, step);
  throw std::runtime_error("the curve '" + wanted.name +
                           "' is not in the file as it was when it was imported");
}

}  // namespace

Exchanged exchange_curves(const std::filesystem::path& source, const std::vector<DeformedCurve>& curves) {
  const std::string content = drawing_text(source).content;
  if (format_of(content) != CadFormat::step)
    throw std::runtime_error("it cannot be read as a STEP file; only into one can curves be written back");
  be_silent();
  try {
    OCC_CATCH_SIGNALS
    start_step();
    STEPControl_Reader reader;
    if (reader.ReadFile(MemoryFile(content).path().c_str()) != IFSelect_RetDone)
      throw std::runtime_error("OpenCASCADE cannot read it");
    restate_units(*reader.Model());
    join_supplemental_geometry(reader);
    ImportReport remarks;  // given when it was imported
    const RestatedCurves restated = restate_curves(reader, remarks);
    reader.TransferRoots();
    StepInstances step(content);
    Exchanged result;
    const TruePlaces places = true_places(reader, restated);
    std::vector<std::optional<FoundCurve>> found;
    std::map<int, int> beams;  // by the instance of their curve
    for (const DeformedCurve& curve : curves) {
      found.push_back(find_edge(curve.drawn, is_same, places, reader));
      if (!found.back()) found.back() = find_lost(curve.drawn, restated, reader);
      if (!found.back()) found.back() = find_edge(curve.drawn, is_same_but_for_ends, places, reader);
      if (found.back() && !found.back()->piece) ++beams[found.back()->instance];
    }
    for (std::size_t i = 0; i < curves.size(); ++i) {
      const bool others_too = found[i] && beams[found[i]->instance] > 1;
      const std::vector<std::string> warnings = place(curves[i], found[i], others_too, places, reader, step);
      result.warnings.insert(result.warnings.end(), warnings.begin(), warnings.end());
    }
    result.text = step.text();
    return result;
  } catch (const Standard_Failure& e) {
    throw std::runtime_error(std::string("OpenCASCADE failed: ") + e.GetMessageString());
  }
}

}  // namespace nurbeam
