#include "cad_import/dxf/read_dxf.h"

#include <algorithm>
#include <optional>

#include "cad_import/dxf/drawing_unit.h"
#include "cad_import/dxf/dxf_entities.h"
#include "cad_import/dxf/placed_entities.h"
#include "cad_import/files/code_page.h"
#include "cad_import/report/length_unit.h"

namespace nurbeam {
namespace {

/// A drawing says its unit by $INSUNITS. Without it $MEASUREMENT tells inches from millimetres.
struct FoundUnit {
  NamedUnit unit;
  std::optional<Diagnostic> remark = {};
};

FoundUnit unit_of(const DxfDrawing& drawing) {
  const int declared = drawing.unit.value_or(0);
  if (const auto unit = drawing_unit(declared)) return {*unit};
  const std::string why = declared == 0 ? std::string("the drawing declares no length unit ($INSUNITS)")
                                        : "$INSUNITS is " + std::to_string(declared) +
                                              ", which is no unit; the units of DXF are 1 to 24";
  const NamedUnit millimetre = named_unit(metres_per_millimetre);
  if (!drawing.measurement)
    return {millimetre, Diagnostic{Severity::warning, "", why + "; millimetres are assumed"}};
  const bool is_metric = *drawing.measurement != 0;
  return {is_metric ? millimetre : named_unit(0.0254),
          Diagnostic{drawing.unit ? Severity::warning : Severity::note, "",
                     why + "; by $MEASUREMENT = " + std::to_string(*drawing.measurement) + " it is in " +
                         (is_metric ? "millimetres" : "inches")}};
}

void add_remarks(const DxfDrawing& drawing, bool is_ascii, ImportReport& report) {
  if (drawing.bytes_behind > 0)
    report.diagnostics.push_back(
        {Severity::note, "",
         "what stands behind EOF is not read: " + std::to_string(drawing.bytes_behind) + " bytes"});
  if (!drawing.strays.empty())
    report.diagnostics.push_back(
        {Severity::warning, "",
         "entities or values stand where none are read: " + drawing.strays.front() + " and " +
             std::to_string(drawing.strays.size() - 1) +
             " more; the drawing is damaged, and curves may be missing: export or copy it again"});
  if (!is_ascii && !drawing.code_page.empty() && !is_known_code_page(drawing.code_page))
    report.diagnostics.push_back({Severity::warning, "",
                                  "the code page '" + drawing.code_page +
                                      "' ($DWGCODEPAGE) is not known; letters that are no UTF-8 are taken "
                                      "for Windows-1252"});
}

}  // namespace

ImportReport read_dxf(const std::string& content) {
  const DxfDrawing drawing = dxf_drawing(content);
  const FoundUnit found = unit_of(drawing);
  ImportReport report{.file = "",
                      .unit = found.unit.name,
                      .unit_in_metres = found.unit.in_metres,
                      .curves = {},
                      .diagnostics = {}};
  if (found.remark) report.diagnostics.push_back(*found.remark);
  const bool is_ascii = std::none_of(content.begin(), content.end(),
                                     [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
  add_remarks(drawing, is_ascii, report);
  add_placed_entities(drawing, report);
  return report;
}

}  // namespace nurbeam
