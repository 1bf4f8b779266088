#include "cad_import/export_curves.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "cad_import/files/ask_program.h"
#include "cad_import/files/atomic_file.h"
#include "cad_import/files/cad_file_name.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

namespace fs = std::filesystem;

// BREP declares no unit: what reads it takes it for millimetres.
void check_unit(const fs::path& file, CadFormat format, LengthUnit unit) {
  if (format == CadFormat::brep && unit != LengthUnit::millimetre)
    throw std::invalid_argument(
        file.string() +
        ": BREP declares no length unit and is read in millimetres; write it in mm, or "
        "STEP, IGES or DXF");
}

// A control character, which a curve may have brought from its file, would break a line, and with it the
// columns of IGES: a space stands for it.
void put_in_line(std::string& name, std::string& part) {
  for (std::string* text : {&name, &part})
    std::replace_if(
        text->begin(), text->end(), [](unsigned char c) { return std::iscntrl(c); }, ' ');
}

void put_in_line(NamedPipe& pipe) { put_in_line(pipe.axis.name, pipe.axis.part); }
void put_in_line(SweptProfile& profile) { put_in_line(profile.name, profile.part); }

constexpr std::chrono::seconds patience{120};

// The text, or why there is none.
std::string reason_of(const ChildResult& result, const char* work) {
  if (result.status == ChildResult::Status::timed_out)
    return std::string(work) + " takes longer than " + std::to_string(patience.count()) + " s";
  if (result.status == ChildResult::Status::crashed)
    return "OpenCASCADE crashed while " + std::string(work) + " (" + result.complaint + ")";
  return result.complaint;
}

void check_solid(const NamedPipe& pipe) {
  if (!(pipe.radius > 0 && std::isfinite(pipe.radius)))
    throw std::invalid_argument("the radius of '" + pipe.axis.name + "' is " + text_of(pipe.radius) +
                                " m; it must be positive");
  if (!(pipe.bore >= 0 && pipe.bore < pipe.radius))
    throw std::invalid_argument("the bore of '" + pipe.axis.name + "' has the radius " + text_of(pipe.bore) +
                                " m; it must be from 0 to below that of the pipe, " + text_of(pipe.radius) +
                                " m");
}

void check_solid(const SweptProfile& profile) {
  if (!(profile.volume > 0 && std::isfinite(profile.volume)))
    throw std::invalid_argument("the volume of '" + profile.name + "' is " + text_of(profile.volume) +
                                " m^3; it must be positive");
  bool has_cubics = !profile.loops.empty();
  for (const std::vector<SweptCubic>& loop : profile.loops) {
    has_cubics = has_cubics && !loop.empty();
    for (const SweptCubic& cubic : loop)
      for (const NurbsCurve& rail : cubic.rails)
        if (rail.knots() != cubic.rails[0].knots())
          throw std::invalid_argument("rails of '" + profile.name + "' have different knots");
  }
  if (!has_cubics) throw std::invalid_argument("'" + profile.name + "' has a loop without cubics");
}

WriteCurvesRequest request_for(const CurvesFile& file) {
  const CadFormat format = written_format(file.path);
  check_unit(file.path, format, file.unit);
  if (file.curves.empty())
    throw std::invalid_argument("no curve to write to " + file.path.string() + "; give at least one");
  std::vector<NamedCurve> curves = file.curves;
  for (NamedCurve& curve : curves) put_in_line(curve.name, curve.part);
  return {format, std::move(curves), file.unit, file.schema};
}

}  // namespace

CadFormat written_format(const fs::path& file) {
  const std::optional<CadFormat> format = format_by_name(file);
  if (!format || *format == CadFormat::ifc)
    throw std::invalid_argument("the extension '" + file.extension().string() + "' of " + file.string() +
                                " names no CAD format that is written; known are .step .stp .igs .iges .dxf .brep .brp");
  return *format;
}

std::vector<Diagnostic> export_curves(const fs::path& file, const std::vector<NamedCurve>& curves,
                                      LengthUnit unit, StepSchema schema) {
  const ChildResult result = asked(request_for({file, curves, unit, schema}), {patience});
  if (result.status != ChildResult::Status::finished)
    return {{Severity::error, file.string(), "not written: " + reason_of(result, "writing")}};
  return write_at_once(file, result.output);
}

std::vector<Diagnostic> export_curves(const std::vector<CurvesFile>& files) {
  WriteFilesRequest request;
  for (const CurvesFile& file : files) request.files.push_back(request_for(file));
  std::vector<Diagnostic> problems;
  const auto add = [&](const std::vector<Diagnostic>& found) {
    problems.insert(problems.end(), found.begin(), found.end());
  };
  const ChildResult result = asked(request, {patience});
  if (result.status == ChildResult::Status::finished) {
    const std::vector<std::string> texts = texts_from_bytes(result.output);
    for (std::size_t i = 0; i < files.size(); ++i) add(write_at_once(files[i].path, texts.at(i)));
  } else {  // one by one, so that what ails one file costs no other
    for (const CurvesFile& file : files) add(export_curves(file.path, file.curves, file.unit, file.schema));
  }
  return problems;
}

std::vector<Diagnostic> export_solids(const fs::path& file, const std::vector<NamedPipe>& pipes,
                                      LengthUnit unit, StepSchema schema) {
  return export_solids(file, std::vector<NamedSolid>(pipes.begin(), pipes.end()), unit, schema);
}

std::vector<Diagnostic> export_solids(const fs::path& file, const std::vector<NamedSolid>& solids,
                                      LengthUnit unit, StepSchema schema) {
  const CadFormat format = written_format(file);
  if (format != CadFormat::step && format != CadFormat::brep)
    throw std::invalid_argument("solids are written to STEP and BREP only; name " + file.string() +
                                " .step or .brep");
  check_unit(file, format, unit);
  if (solids.empty())
    throw std::invalid_argument("no pipe to write to " + file.string() + "; give at least one");
  std::vector<NamedSolid> in_line = solids;
  for (NamedSolid& solid : in_line)
    std::visit(
        [](auto& of_kind) {
          check_solid(of_kind);
          put_in_line(of_kind);
        },
        solid);
  const ChildResult result = asked(WriteSolidsRequest{format, std::move(in_line), unit, schema}, {patience});
  if (result.status == ChildResult::Status::finished) return write_at_once(file, result.output);
  return {{Severity::error, file.string(),
           "not written: " + reason_of(result, "sweeping") + "; write the curves, which have every shape"}};
}

}  // namespace nurbeam
