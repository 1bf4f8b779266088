#include "cad_import/program/read_file.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "cad_import/files/cad_format.h"
#include "cad_import/program/drawing_text.h"
#include "cad_import/program/read_cad_file.h"

namespace nurbeam {
namespace {

namespace fs = std::filesystem;

ImportReport refusal(const fs::path& file, const std::string& message) {
  ImportReport report;
  report.file = file.string();
  report.diagnostics.push_back({Severity::error, report.file, message});
  return report;
}

ImportReport read_file_of(const fs::path& file, double tolerance, const KeptEntities& kept,
                          std::vector<fs::path> assemblies);

/// Of the text of a drawing. `assemblies`: the files that refer to this one, directly or not, and itself.
ImportReport read_text(const fs::path& file, const std::string& content, double tolerance,
                       const KeptEntities& kept, const std::vector<fs::path>& assemblies) {
  const std::optional<CadFormat> format = format_of(content);
  if (!format) {
    return refusal(
        file,
        "neither STEP or IFC (must begin with ISO-10303-21) nor IGES (must have an 'S' in column 73 of its "
        "first line) nor DXF (must begin with a SECTION) nor OpenCASCADE's BREP (must begin with "
        "DBRep_DrawableShape or CASCADE Topology) nor JSON of curves (must begin with {); export the curves as STEP AP214 or IGES");
  }
  if (const auto missing = incompleteness(content, *format)) return refusal(file, *missing);
  return read_cad_file(
      file, content, *format, tolerance,
      [&](const fs::path& part) { return read_file_of(part, tolerance, {}, assemblies); }, kept);
}

void add_left_out(const std::vector<std::string>& names, ImportReport& report) {
  constexpr std::size_t most_names = 5;
  if (names.empty()) return;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), most_names); ++i)
    list += (i == 0 ? "" : ", ") + names[i];
  report.diagnostics.push_back({Severity::warning, report.file,
                                "the archive holds " + std::to_string(names.size()) +
                                    " more CAD file(s), which are not read: " + list +
                                    (names.size() > most_names ? ", ..." : "") + "; unpack it to read them"});
}

ImportReport read_file_of(const fs::path& file, double tolerance, const KeptEntities& kept,
                          std::vector<fs::path> assemblies) {
  std::error_code error;
  const fs::path itself = fs::weakly_canonical(file, error);
  if (std::find(assemblies.begin(), assemblies.end(), itself) != assemblies.end())
    return refusal(file, "the assembly is a part of itself; export it as one file");
  assemblies.push_back(itself);
  Unpacked drawing;
  try {
    drawing = drawing_text(file);
  } catch (const std::runtime_error& e) {
    return refusal(file, e.what());
  }
  ImportReport report = read_text(file, drawing.content, tolerance, kept, assemblies);
  add_left_out(drawing.left_out, report);
  return report;
}

}  // namespace

ImportReport read_file(const fs::path& file, double tolerance, const KeptEntities& kept) {
  return read_file_of(file, tolerance, kept, {});
}

ImportReport read_content(const fs::path& file, std::string content, double tolerance) {
  try {
    return read_text(file, drawing_text_of(std::move(content)).content, tolerance, {}, {file});
  } catch (const std::runtime_error& e) {
    return refusal(file, e.what());
  }
}

}  // namespace nurbeam
