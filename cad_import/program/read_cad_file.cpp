#include "cad_import/program/read_cad_file.h"

#include <IGESControl_Reader.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Check.hxx>
#include <Interface_CheckIterator.hxx>
#include <Interface_Static.hxx>
#include <Message_ProgressIndicator.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_ErrorHandler.hxx>
#include <Standard_Failure.hxx>
#include <StepData_StepModel.hxx>
#include <StepGeom_Circle.hxx>
#include <StepGeom_Ellipse.hxx>
#include <StepGeom_TrimmedCurve.hxx>
#include <TopoDS_Shape.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "cad_import/dxf/read_dxf.h"
#include "cad_import/ifc/read_ifc.h"
#include "cad_import/iges/iges_global.h"
#include "cad_import/iges/line_forms.h"
#include "cad_import/json/read_curves.h"
#include "cad_import/occt/occt_session.h"
#include "cad_import/program/brep_text.h"
#include "cad_import/program/damaged_entities.h"
#include "cad_import/program/entity_origins.h"
#include "cad_import/program/external_parts.h"
#include "cad_import/program/lost_curves.h"
#include "cad_import/program/memory_file.h"
#include "cad_import/program/model_checks.h"
#include "cad_import/program/part_names.h"
#include "cad_import/program/reading_share.h"
#include "cad_import/program/restated_curves.h"
#include "cad_import/program/shape_curves.h"
#include "cad_import/program/sound_iges.h"
#include "cad_import/report/length_unit.h"
#include "cad_import/step/broken_instances.h"
#include "cad_import/step/encoded_text.h"
#include "cad_import/step/set_items.h"
#include "cad_import/step/step_units.h"
#include "cad_import/step/supplemental_geometry.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

constexpr int most_reported_failures = 20;

void note_hidden(ImportReport& report) {
  const auto hidden = std::count_if(report.curves.begin(), report.curves.end(),
                                    [](const ImportedCurve& curve) { return curve.hidden; });
  if (hidden > 0)
    add_diagnostic(
        report, Severity::note, "",
        std::to_string(hidden) + " curve(s) are hidden in the file and are taken only by name or number");
}

LostCurves add_curves(const XSControl_Reader& reader, const RestatedCurves& restated, double tolerance,
                      ImportReport& report) {
  const TopoDS_Shape shape = reader.OneShape();
  if (shape.IsNull()) return add_lost_curves(reader, restated, tolerance, report);
  const ShapeFacts facts{origins_of_edges_and_faces(reader, restated.refused, report),
                         part_names(reader, shape), true_places(reader, restated), EdgeSenses(reader)};
  join_composites(reader, add_edges(shape, facts, tolerance, report), report);
  LostCurves lost = add_lost_curves(reader, restated, tolerance, report);
  add_centre_lines(shape, facts, tolerance, report);
  return lost;
}

// What OpenCASCADE failed to read or to translate, and nobody else made a curve of or named.
void add_failures(const Interface_CheckIterator& checks, const Interface_InterfaceModel& model,
                  const LostCurves& lost, ImportReport& report) {
  Interface_CheckIterator failures = checks.Extract(Interface_CheckFail);
  int count = 0;
  for (failures.Start(); failures.More(); failures.Next()) {
    const auto entity = model.NbEntities() >= failures.Number() && failures.Number() > 0
                            ? model.Value(failures.Number())
                            : Handle(Standard_Transient)();
    if (lost.contain(entity.get()) || ++count > most_reported_failures) continue;
    add_diagnostic(report, Severity::warning, entity.IsNull() ? "" : entity_label(model, entity),
                   std::string("OpenCASCADE: ") + failures.Value()->CFail(1));
  }
  if (count > most_reported_failures) {
    add_diagnostic(report, Severity::warning, "",
                   std::to_string(count - most_reported_failures) + " more such failures");
  }
}

/// Tells how far OpenCASCADE has translated a file.
class TranslationShare : public Message_ProgressIndicator {
 private:
  void Show(const Message_ProgressScope& scope, const Standard_Boolean) override {
    const PartOfWork part = reading_share::translation;
    tell_share(part.begin + (part.end - part.begin) * GetPosition());
    (void)scope;
  }
};

// Returns what was said anew for it.
RestatedCurves transfer(XSControl_Reader& reader, double tolerance, ImportReport& report) {
  RestatedCurves restated = restate_curves(reader, report);
  tell_share(reading_share::translation.begin);
  reader.TransferRoots(Handle(TranslationShare)(new TranslationShare)->Start());
  LostCurves lost = add_curves(reader, restated, tolerance, report);
  lost.named.insert(restated.refused.begin(), restated.refused.end());
  const Handle(XSControl_WorkSession) session = reader.WS();
  add_failures(session->TransferReader()->TransientProcess()->CheckList(Standard_True), *reader.Model(), lost,
               report);
  return restated;
}

void read(XSControl_Reader& reader, const std::string& content, ImportReport& report) {
  const MemoryFile file(content);
  if (reader.ReadFile(file.path().c_str()) != IFSelect_RetDone || reader.Model().IsNull())
    throw std::runtime_error("OpenCASCADE cannot read it: the syntax is damaged; export or copy it again");
  check_model(*reader.Model());
  add_damaged_entities(*reader.Model(), content, report);
}

// -------------------------------------------------------------------------------------------------------
// units

void report_unit(double in_metres, ImportReport& report) {
  const NamedUnit unit = named_unit(in_metres);
  report.unit = unit.name;
  report.unit_in_metres = unit.in_metres;
}

// -------------------------------------------------------------------------------------------------------
// STEP

// That pieces of circles and ellipses may be meant in degrees.
void warn_of_angles(const Interface_InterfaceModel& model, ImportReport& report) {
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const auto piece = Handle(StepGeom_TrimmedCurve)::DownCast(model.Value(i));
    if (piece.IsNull() || piece->BasisCurve().IsNull() ||
        !(piece->BasisCurve()->IsKind(STANDARD_TYPE(StepGeom_Circle)) ||
          piece->BasisCurve()->IsKind(STANDARD_TYPE(StepGeom_Ellipse))) ||
        piece->MasterRepresentation() == StepGeom_tpCartesian)
      continue;
    return add_diagnostic(report, Severity::warning, entity_label(model, piece),
                          "it is trimmed by angles, and the file declares no unit for these; radians are "
                          "assumed");
  }
}

void report_step_unit(const Interface_InterfaceModel& model, ImportReport& report) {
  const std::set<double> units = length_units_of(model);
  report.resolution = resolution_of(model);
  if (units.empty()) {
    add_diagnostic(report, Severity::warning, "",
                   "the file declares no length unit; millimetres are assumed");
  }
  if (units.size() > 1) {
    add_diagnostic(report, Severity::note, "",
                   "the file has parts in different length units; each is scaled by its own");
  }
  report_unit(units.empty() ? metres_per_millimetre : *units.begin(), report);
}

void leave_out(const KeptEntities& kept, const Interface_InterfaceModel& model, ImportReport& report) {
  kept.tell(model.NbEntities());
  for (const int number : kept.without)
    if (number < model.NbEntities())
      add_diagnostic(report, Severity::warning, entity_label(model, model.Value(number + 1)), crashed_on);
  if (kept.before < model.NbEntities() || !kept.without.empty())
    replace_items(model, [&](const Handle(Standard_Transient) & item) {
      return !kept.contain(model.Number(item) - 1);
    });
}

void tell_of_broken(const std::vector<BrokenInstance>& broken, ImportReport& report) {
  for (std::size_t i = 0; i < std::min<std::size_t>(broken.size(), most_reported_failures); ++i)
    add_diagnostic(report, Severity::warning, broken[i].label,
                   "left out: '" + broken[i].token + "' in it is no value of a STEP file; correct it");
  if (broken.size() > most_reported_failures)
    add_diagnostic(report, Severity::warning, "",
                   std::to_string(broken.size() - most_reported_failures) + " more instances were left out");
}

void tell_of_repeated(const std::vector<std::string>& repeated, ImportReport& report) {
  if (repeated.empty()) return;
  add_diagnostic(report, Severity::warning, repeated.front(),
                 "left out: an instance before it has its number, and is taken; so in " +
                     std::to_string(repeated.size()) + " case(s) in all; the file is damaged");
}

/// Reads the file, without the instances that the syntax of STEP does not allow, where there are such.
void read_sound(STEPControl_Reader& reader, std::string content, ImportReport& report) {
  tell_of_repeated(remove_repeated_instances(content), report);
  if (may_have_broken_numbers(content))
    tell_of_broken(remove_broken_instances(content, BrokenToken::number), report);
  try {
    return read(reader, content, report);
  } catch (const std::runtime_error&) {
    const std::vector<BrokenInstance> broken = remove_broken_instances(content, BrokenToken::any);
    if (broken.empty()) throw;
    tell_of_broken(broken, report);
  }
  reader = STEPControl_Reader();
  read(reader, content, report);
}

void read_step(const std::string& content, double tolerance, const ReadFile& read_other,
               const KeptEntities& kept, ImportReport& report) {
  start_step();
  STEPControl_Reader reader;
  read_sound(reader, with_encoded_apostrophes(content), report);
  leave_out(kept, *reader.Model(), report);
  if (restate_units(*reader.Model())) warn_of_angles(*reader.Model(), report);
  report_step_unit(*reader.Model(), report);
  join_supplemental_geometry(reader);
  const RestatedCurves restated = transfer(reader, tolerance, report);
  add_external_parts(reader, restated, read_other, report);
  note_hidden(report);
}

// -------------------------------------------------------------------------------------------------------
// IGES

void compare_units(const IgesGlobal& ours, const IGESData_GlobalSection& theirs) {
  const double in_metres = theirs.UnitValue() * metres_per_millimetre;
  if (is_same_unit(in_metres, ours.unit_in_metres)) return;
  throw std::runtime_error("the Global section says that the length unit is " + text_of(ours.unit_in_metres) +
                           " m, but OpenCASCADE takes it for " + text_of(in_metres) +
                           " m; correct the Global section (Hollerith counts, parameters 14 and 15)");
}

void read_iges(const std::string& given, double tolerance, const KeptEntities& kept, ImportReport& report) {
  const IgesGlobal global = parse_iges_global(given);
  report_unit(global.unit_in_metres, report);
  if (global.scale != 1) {
    add_diagnostic(report, Severity::note, "",
                   "the model space scale " + text_of(global.scale) + " (drawing scale) is not applied");
  }
  if (const auto miscounted = miscounted_lines(given))
    add_diagnostic(report, Severity::warning, "", *miscounted);
  const std::string content = sound_iges(given, global, kept, report);
  start_iges();
  // Only after Init: before it, the parameter is unknown and curves are split where they are only C0.
  if (!Interface_Static::SetIVal("read.iges.bspline.continuity", 0))
    throw std::runtime_error("OpenCASCADE refuses read.iges.bspline.continuity = 0");
  IGESControl_Reader reader;
  read(reader, content, report);
  restore_line_forms(content, *reader.IGESModel());
  compare_units(global, reader.IGESModel()->GlobalSection());
  const double resolution = reader.IGESModel()->GlobalSection().Resolution();
  if (std::isfinite(resolution) && resolution > 0) report.resolution = resolution * global.unit_in_metres;
  transfer(reader, tolerance, report);
  note_hidden(report);
}

// -------------------------------------------------------------------------------------------------------
// DXF, IFC, JSON and BREP

/// What a reader without OpenCASCADE has found.
void take_over(ImportReport drawing, ImportReport& report) {
  for (Diagnostic& diagnostic : drawing.diagnostics)
    add_diagnostic(report, diagnostic.severity, diagnostic.where, diagnostic.message);
  drawing.file = report.file;
  drawing.format = report.format;
  drawing.diagnostics = std::move(report.diagnostics);
  report = std::move(drawing);
  note_hidden(report);
}

void read_brep(const std::string& content, double tolerance, ImportReport& report) {
  const TopoDS_Shape shape = brep_shape(content);
  report_unit(metres_per_millimetre, report);
  add_diagnostic(report, Severity::note, "", "BREP files declare no length unit; millimetres are assumed");
  add_edges(shape, {}, tolerance, report);
  add_centre_lines(shape, {}, tolerance, report);
}

// Why there is no curve: what was said of the entities of the file.
std::string without_curves(const ImportReport& report) {
  constexpr int most_reasons = 3;
  std::string reasons;
  int count = 0;
  for (const auto& [severity, where, message] : report.diagnostics) {
    const std::size_t file = report.file.size() + 2;  // "file: entity"
    if (severity != Severity::warning || where.size() <= file || ++count > most_reasons) continue;
    reasons += "; " + where.substr(file) + ": " + message;
  }
  if (reasons.empty())
    return "no curve in the file; expected at least one edge or free curve (line, conic, B-spline)";
  return "no curve of the file can be read" + reasons +
         (count > most_reasons ? " (and " + std::to_string(count - most_reasons) + " more warning(s))" : "");
}

void read_format(const std::string& content, CadFormat format, double tolerance, const ReadFile& read_other,
                 const KeptEntities& kept, ImportReport& report) {
  switch (format) {
    case CadFormat::step:
      return read_step(content, tolerance, read_other, kept, report);
    case CadFormat::iges:
      return read_iges(content, tolerance, kept, report);
    case CadFormat::dxf:
      return take_over(read_dxf(content), report);
    case CadFormat::ifc:
      return take_over(read_ifc(content, tolerance), report);
    case CadFormat::brep:
      return read_brep(content, tolerance, report);
    case CadFormat::json:
      return take_over(read_json(content), report);
    case CadFormat::svg:
      throw std::runtime_error("SVG is written, not read; give the drawing as DXF");
  }
}

}  // namespace

ImportReport read_cad_file(const std::filesystem::path& file, const std::string& content, CadFormat format,
                           double tolerance, const ReadFile& read_other, const KeptEntities& kept) {
  ImportReport report;
  report.file = file.string();
  report.format = format;
  be_silent();
  try {
    OCC_CATCH_SIGNALS
    read_format(content, format, tolerance, read_other, kept, report);
  } catch (const Standard_Failure& e) {
    add_diagnostic(report, Severity::error, "",
                   std::string("OpenCASCADE failed (") + e.DynamicType()->Name() + " " +
                       e.GetMessageString() +
                       "); the file is damaged or uses what OpenCASCADE cannot read; export it again");
  } catch (const std::runtime_error& e) {
    add_diagnostic(report, Severity::error, "", e.what());
  }
  if (report.ok() && report.curves.empty())
    add_diagnostic(report, Severity::error, "", without_curves(report));
  return report;
}

}  // namespace nurbeam
