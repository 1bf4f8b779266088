#include "cad_import/export_curves.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "cad_import/files/ask_program.h"
#include "cad_import/files/atomic_file.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

namespace fs = std::filesystem;

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool is_step_name(const fs::path& file) {
  const std::string extension = lower(file.extension().string());
  if (extension == ".step" || extension == ".stp") return true;
  if (extension == ".igs" || extension == ".iges") return false;
  throw std::invalid_argument("the extension '" + extension + "' of " + file.string() +
                              " names no CAD format; known are .step .stp .igs .iges");
}

// A control character would break a line of the file, and with it the columns of IGES.
void check_name(const std::string& name) {
  if (std::any_of(name.begin(), name.end(), [](unsigned char c) { return std::iscntrl(c); }))
    throw std::invalid_argument("the curve name '" + name + "' holds a control character; it must hold none");
}

constexpr std::chrono::seconds patience{120};

// The text, or why there is none.
std::string reason_of(const ChildResult& result, const char* work) {
  if (result.status == ChildResult::Status::timed_out)
    return std::string(work) + " takes longer than " + std::to_string(patience.count()) + " s";
  if (result.status == ChildResult::Status::crashed)
    return "OpenCASCADE crashed while " + std::string(work) + " (" + result.complaint + ")";
  return result.complaint;
}

void check_pipe(const NamedPipe& pipe) {
  check_name(pipe.axis.name);
  check_name(pipe.axis.part);
  if (!(pipe.radius > 0 && std::isfinite(pipe.radius)))
    throw std::invalid_argument("the radius of '" + pipe.axis.name + "' is " + text_of(pipe.radius) +
                                " m; it must be positive");
  if (!(pipe.bore >= 0 && pipe.bore < pipe.radius))
    throw std::invalid_argument("the bore of '" + pipe.axis.name + "' has the radius " + text_of(pipe.bore) +
                                " m; it must be from 0 to below that of the pipe, " + text_of(pipe.radius) +
                                " m");
}

}  // namespace

std::vector<Diagnostic> export_curves(const fs::path& file, const std::vector<NamedCurve>& curves,
                                      LengthUnit unit) {
  const bool step = is_step_name(file);
  if (curves.empty())
    throw std::invalid_argument("no curve to write to " + file.string() + "; give at least one");
  for (const NamedCurve& curve : curves) {
    check_name(curve.name);
    check_name(curve.part);
  }
  const ChildResult result = asked(WriteCurvesRequest{step, curves, unit}, {patience});
  if (result.status != ChildResult::Status::finished)
    return {{Severity::error, file.string(), "not written: " + reason_of(result, "writing")}};
  return write_at_once(file, result.output);
}

std::vector<Diagnostic> export_solids(const fs::path& file, const std::vector<NamedPipe>& pipes,
                                      LengthUnit unit) {
  if (!is_step_name(file))
    throw std::invalid_argument("solids are written to STEP only; name " + file.string() + " .step");
  if (pipes.empty())
    throw std::invalid_argument("no pipe to write to " + file.string() + "; give at least one");
  for (const NamedPipe& pipe : pipes) check_pipe(pipe);
  const ChildResult result = asked(WriteSolidsRequest{pipes, unit}, {patience});
  if (result.status == ChildResult::Status::finished) return write_at_once(file, result.output);
  return {{Severity::error, file.string(),
           "not written: " + reason_of(result, "sweeping") + "; write the curves, which have every shape"}};
}

}  // namespace nurbeam
