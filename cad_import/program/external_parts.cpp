#include "cad_import/program/external_parts.h"

#include <STEPConstruct_ExternRefs.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Shape.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "cad_import/files/tolerant_text.h"
#include "cad_import/occt/placed_curve.h"
#include "cad_import/program/entity_origins.h"
#include "cad_import/program/part_names.h"
#include "cad_import/program/part_places.h"
#include "cad_import/report/length_unit.h"

namespace nurbeam {
namespace {

namespace fs = std::filesystem;

// The file of that name beside `source`; nothing where there is none.
std::optional<fs::path> beside(const fs::path& source, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  const fs::path given = fs::path(name).lexically_normal();
  const bool below = given.is_relative() && !given.empty() && *given.begin() != "..";
  std::error_code error;
  for (const fs::path& path : {below ? given : given.filename(), given.filename()})
    if (const fs::path file = source.parent_path() / path; fs::is_regular_file(file, error)) return file;
  return std::nullopt;
}

// The path of a curve of the other file: its topmost part is the one that is placed.
std::string path_below(const std::string& place, const std::string& own) {
  const std::size_t first = own.find('/');
  return first == std::string::npos ? place : place + own.substr(first);
}

void add_placed(const ImportReport& part, const PartPlace& place, ImportReport& report) {
  const Eigen::Affine3d to_world = in_metres(place.to_world, metres_per_millimetre);
  for (ImportedCurve curve : part.curves) {
    curve.curve = placed(curve.curve, to_world);
    if (curve.name.empty()) curve.name = place.name.own;
    curve.part = path_below(place.name.path, curve.part);
    report.curves.push_back(std::move(curve));
  }
}

// Why the part was not added; nothing if it was.
std::optional<std::string> add_part(const Handle(StepBasic_ProductDefinition) & part, const std::string& file,
                                    const PartPlaces& assembly, const ReadFile& read, ImportReport& report) {
  if (!read) return "other files are not read";
  const auto path = beside(report.file, file);
  if (!path) return "there is no such file beside this one; put it there";
  const std::vector<PartPlace> places = assembly.of(part);
  if (places.empty()) return "the assembly has no place for it";
  if (TopExp_Explorer(assembly.shape_of(part), TopAbs_EDGE).More())
    return "the part has shapes here, too, which are taken";
  const ImportReport found = read(*path);
  for (Diagnostic diagnostic : found.diagnostics) {
    diagnostic.severity = std::min(diagnostic.severity, Severity::warning);
    report.diagnostics.push_back(std::move(diagnostic));
  }
  if (!found.ok()) return "it cannot be read (see above)";
  for (const PartPlace& place : places) add_placed(found, place, report);
  return std::nullopt;
}

}  // namespace

void add_external_parts(const XSControl_Reader& reader, const RestatedCurves& restated, const ReadFile& read,
                        ImportReport& report) {
  STEPConstruct_ExternRefs files(reader.WS());
  if (!files.LoadExternRefs()) return;
  const PartPlaces assembly(reader, true_places(reader, restated));
  for (int i = 1; i <= files.NbExternRefs(); ++i) {
    const std::string file = as_utf8(files.FileName(i)), part = product_name(files.ProdDef(i));
    if (const auto reason = add_part(files.ProdDef(i), file, assembly, read, report))
      add_diagnostic(report, Severity::warning, "",
                     (part.empty() ? "a part" : "the part '" + part + "'") + " lies in the file '" + file +
                         "', which is not read: " + *reason +
                         ", name that file as the axis's, or export the " + "assembly as one");
  }
}

}  // namespace nurbeam
