#include "pipelines/command/commands.h"

#include <charconv>
#include <cmath>
#include <ostream>

#include "nurbs/number_text.h"
#include "pipelines/case/case_file.h"
#include "pipelines/case/case_schema.h"
#include "pipelines/case/quantity.h"
#include "pipelines/command/catenary_entry.h"
#include "pipelines/command/check.h"
#include "pipelines/command/compare.h"
#include "pipelines/command/convert_entries.h"
#include "pipelines/command/curves_schema.h"
#include "pipelines/command/inspect.h"
#include "pipelines/command/manual.h"
#include "pipelines/command/route.h"
#include "pipelines/command/study.h"
#include "pipelines/command/verify.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/diagnostics/print_diagnostics.h"
#include "pipelines/report/report.h"
#include "pipelines/results/export_results.h"
#include "pipelines/run/run.h"
#include "pipelines/run/run_messages.h"
#include "pipelines/run/signals.h"

namespace nurbeam {

namespace {

int inspect_command(const Arguments& arguments, Streams streams) {
  if (arguments.has("--profile")) {
    if (arguments.has("--json")) throw UsageError("--profile and --json exclude each other");
    return inspect_profiles({arguments.positional.begin(), arguments.positional.end()}, streams.out,
                            streams.err);
  }
  return inspect_files({arguments.positional.begin(), arguments.positional.end()}, arguments.has("--json"),
                       streams.out, streams.err);
}

/// The case with its overrides; its diagnostics are told.
std::optional<CaseFile> read_case(const Arguments& arguments, RunMessages& messages) {
  CaseFileReport report = read_case_file(arguments.positional[0], arguments.values("--set"));
  messages.findings(report.diagnostics);
  return std::move(report.value);
}

int check_command(const Arguments& arguments, Streams streams) {
  RunMessages messages(streams.err, RunMessages::Form::text);
  const auto case_file = read_case(arguments, messages);
  return case_file ? check_case(*case_file, streams.out, streams.err) : exit_bad_input;
}

bool progress_is_json(const Arguments& arguments) {
  const std::string form = arguments.value("--progress", "text");
  if (form != "text" && form != "json")
    throw UsageError("--progress: there is no " + in_quotes(form) + known_names(form, {"text", "json"}));
  return form == "json";
}

// What --accuracy asks for besides the case.
void ask_for_accuracy(const Arguments& arguments, CaseAccuracy& accuracy) {
  if (!arguments.has("--accuracy")) return;
  accuracy.is_on = true;
  const std::string target = arguments.value("--accuracy", "true");
  if (target == "true") return;
  accuracy.target = quantity_argument("--accuracy", target, Dimension::part);
  const Range range = accuracy_target_range();
  if (!range.contains(*accuracy.target))
    throw UsageError("--accuracy: is " + text_of(100 * *accuracy.target) + " %; must be between " +
                     text_of(100 * range.lower) + " % and " + text_of(100 * range.upper) + " % (" +
                     range.reason + ")");
}

int run_command(const Arguments& arguments, Streams streams) {
  if (arguments.value("--out", "results").empty())
    throw UsageError("--out: is empty; give the directory for the results");
  const int threads = whole_number(arguments, "--threads", 0, 1, 1024);
  const bool json = progress_is_json(arguments);
  const BrokenPipeGuard guard;  // a run outlives the reader of its messages
  CaseAccuracy asked;
  ask_for_accuracy(arguments, asked);
  RunMessages messages(streams.err, json ? RunMessages::Form::json : RunMessages::Form::text);
  auto case_file = read_case(arguments, messages);
  if (!case_file) {
    messages.end(exit_bad_input, arguments.value("--out", ""));
    return exit_bad_input;
  }
  ask_for_accuracy(arguments, case_file->analysis.accuracy);
  const std::string default_out = case_file->path.stem().string() + "_results";
  return run_case(*case_file, {.out = arguments.value("--out", default_out),
                               .quiet = arguments.has("--quiet"),
                               .resume = arguments.has("--resume"),
                               .threads = threads,
                               .json = json});
}

std::pair<double, std::vector<NamedCurve>> read_results(const std::filesystem::path& directory, double time,
                                                        CurveParameter parameter, WholeConics conics,
                                                        double exaggeration) {
  try {
    return stored_curves(directory, time, parameter, conics, exaggeration);
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(error.what());  // what cannot be read is bad input
  }
}

CurveParameter curve_parameter(const std::string& name) {
  if (name == "free") return CurveParameter::free;
  if (name == "material") return CurveParameter::material;
  throw UsageError("--parameter: there is no " + in_quotes(name) + known_names(name, {"free", "material"}));
}

StepSchema step_schema(const std::string& name) {
  if (name == "ap214") return StepSchema::ap214;
  if (name == "ap242") return StepSchema::ap242;
  throw UsageError("--schema: there is no " + in_quotes(name) + known_names(name, {"ap214", "ap242"}));
}

int export_command(const Arguments& arguments, Streams streams) {
  const double time = quantity_argument("--time", arguments.value("--time", ""), Dimension::time);
  const std::string file = arguments.value("--to", "");
  const LengthUnit unit = parse_length_unit(arguments.value("--unit", "mm"));
  const CurveParameter parameter = curve_parameter(arguments.value("--parameter", "free"));
  const StepSchema schema = step_schema(arguments.value("--schema", "ap214"));
  if (arguments.has("--schema") && written_format(file) != CadFormat::step)
    throw UsageError("--schema: is that of a STEP file, which " + file + " is not; name it .step or .stp");
  const WholeConics conics =
      arguments.has("--solid") ? WholeConics::smooth : whole_conics_in(written_format(file));
  const auto [stored_time, curves] = read_results(
      arguments.positional[0], time, parameter, conics,
      quantity_argument("--exaggerate", arguments.value("--exaggerate", "1"), Dimension::number));
  if (const auto warning = missing_checksum(arguments.positional[0]))
    print_diagnostics(streams.err, {*warning});
  std::vector<Diagnostic> found;
  if (arguments.has("--solid")) {
    const double radius = quantity_argument("--solid", arguments.value("--solid", ""), Dimension::length);
    const double bore = quantity_argument("--bore", arguments.value("--bore", "0"), Dimension::length);
    std::vector<NamedPipe> pipes;
    for (const NamedCurve& curve : curves) pipes.push_back({curve, radius, bore});
    found = export_solids(file, pipes, unit, schema);
  } else if (arguments.has("--bore")) {
    throw UsageError("--bore: is the bore of a solid; give its radius with --solid");
  } else {
    found = export_curves(file, curves, unit, schema);
  }
  print_diagnostics(streams.err, found);
  if (has_errors(found)) return exit_not_written;
  if (text_of(stored_time) != text_of(time))
    streams.err << "note: " << file << ": the curves at " << text_of(stored_time)
                << " s, the stored time nearest to " << text_of(time) << " s\n";
  return exit_done;
}

int compare_command(const Arguments& arguments, Streams streams) {
  std::optional<double> tolerance;
  if (arguments.has("--tolerance"))
    tolerance = quantity_argument("--tolerance", arguments.value("--tolerance", ""), Dimension::length);
  if (tolerance && !(*tolerance > 0))
    throw UsageError("--tolerance: is " + arguments.value("--tolerance", "") + "; must be greater than 0");
  return compare_files(arguments.positional[0], arguments.positional[1], tolerance, streams.out, streams.err);
}

int schema_command(const Arguments& arguments, Streams streams) {
  const std::string what = arguments.positional.empty() ? "case" : arguments.positional[0];
  if (what == "study") return study_schema_command();
  if (what == "curves") {
    streams.out << curves_schema;
    return exit_done;
  }
  if (what != "case")
    throw UsageError("there is no schema " + in_quotes(what) +
                     known_names(what, {"case", "study", "curves"}));
  streams.out << case_file_schema();
  return exit_done;
}

int report_command(const Arguments& arguments, Streams streams) {
  const std::filesystem::path directory = arguments.positional[0];
  write_report(directory);
  if (const auto warning = missing_checksum(directory)) print_diagnostics(streams.err, {*warning});
  streams.err << "note: " << (directory / "report.html").string() << " written\n";
  return exit_done;
}

int completion_command(const Arguments& arguments, Streams streams) {
  const std::string shell = arguments.positional.empty() ? "bash" : arguments.positional[0];
  if (shell != "bash")
    throw UsageError("there is no completion for " + in_quotes(shell) + known_names(shell, {"bash"}));
  streams.out << bash_completion(commands());
  return exit_done;
}

int manual_command(const Arguments&, Streams streams) {
  streams.out << manual_page(commands());
  return exit_done;
}

constexpr std::size_t any_number = std::string::npos;

CommandOption set_option() {
  return {"--set", "path=value",
          "changes the case before it is checked; null removes a key or an item, LIST[+]=value appends one",
          false, true};
}

Command inspect_entry() {
  return {
      "inspect",
      "FILE...",
      "lists the curves of STEP, IGES, DXF, IFC, BREP and JSON files; with --profile: the section that they draw",
      1,
      any_number,
      {{"--json", "", "as JSON"}, {"--profile", "", "area, moments and torsion constant of the section"}},
      inspect_command};
}

Command check_entry() {
  return {"check",        "CASE.json",  "reads and resolves a case, runs nothing", 1, 1,
          {set_option()}, check_command};
}

Command run_entry() {
  return {
      "run",
      "CASE.json",
      "runs a case",
      1,
      1,
      {{"--out", "DIR", "the directory for the results; otherwise CASE_results"},
       {"--resume", "", "goes on from the restart point in that directory"},
       {"--quiet", "", "no progress"},
       {"--progress", "text|json", "json: progress and findings as one JSON object a line; otherwise text"},
       {"--threads", "N", "the most threads that share a long beam; otherwise one a core"},
       {"--accuracy", "[TARGET]",
        "errors of mesh and step, from runs with other elements and steps; with a target, as 1%, finer ones "
        "until the errors are below it",
        false, false, true},
       set_option()},
      run_command,
      exit_not_written};
}

Command export_entry() {
  return {
      "export",
      "RESULTS_DIR",
      "writes the deformed curves at a stored time; with --solid, as rods of that radius, with --bore as "
      "pipes",
      1,
      1,
      {{"--time", "T", "the nearest stored one is taken", true},
       {"--to", "FILE",
        "STEP, IGES, DXF, BREP, JSON or SVG by its ending: .step, .igs, .dxf, .brep, .json, .svg", true},
       {"--unit", "mm|m|inch", "of the file; otherwise mm"},
       {"--parameter", "free|material", "fewest control points, or the material coordinate; otherwise free"},
       {"--schema", "ap214|ap242", "of a STEP file; otherwise ap214"},
       {"--exaggerate", "N", "displacements from the drawing times N; otherwise 1, as they are"},
       {"--solid", "RADIUS", "solids instead of curves, in STEP or BREP"},
       {"--bore", "RADIUS", "makes the solids pipes"}},
      export_command,
      exit_not_written};
}

Command route_entry() {
  return {"route",
          "CABLES.json",
          "finds the shape in which cables of a given length, slack or bend radius hang between two places",
          1,
          1,
          {{"--to", "FILE", "the curves, in STEP, IGES, DXF, BREP, JSON or SVG by its ending"},
           {"--unit", "mm|m|inch", "of that file; otherwise mm"},
           {"--solid", "RADIUS", "solids instead of curves, in STEP or BREP"},
           {"--json", "", "what the cables have come to, as JSON"},
           {"--time-limit", "TIME", "for the equilibrium of one cable; otherwise 3 s"},
           {"--tolerance", "N", "error of positions over the length; otherwise 1e-6"}},
          route_command,
          exit_not_written};
}

Command compare_entry() {
  return {"compare",
          "A B",
          "largest distance between the curves of two CAD files",
          2,
          2,
          {{"--tolerance", "LENGTH", "above which they differ [m]; otherwise 1e-6 of their size"}},
          compare_command};
}

Command schema_entry() {
  return {"schema",
          "[case | study | curves]",
          "prints the JSON schema of the case file, of the study file, or of files of curves",
          0,
          1,
          {},
          schema_command};
}

Command report_entry() {
  return {"report",
          "RESULTS_DIR",
          "writes report.html anew: the 3-D view, plots and tables of a run",
          1,
          1,
          {},
          report_command,
          exit_not_written};
}

Command study_entry() {
  return {"study",
          "[check] STUDY.json",
          "runs the variants of a study and answers its question; with check: says what it would run",
          1,
          2,
          {{"--out", "DIR", "the directory for the results; otherwise STUDY_study"},
           {"--jobs", "N", "variants that run at a time; otherwise one for each core"},
           {"--resume", "", "goes on with the variants that are not there yet"},
           {"--quiet", "", "no progress"}},
          study_command_line,
          exit_not_written};
}

Command completion_entry() {
  return {"completion",
          "[bash]",
          "prints a script that completes commands and options in the shell",
          0,
          1,
          {},
          completion_command};
}

Command manual_entry() { return {"manual", "", "prints the manual page (roff)", 0, 0, {}, manual_command}; }

}  // namespace

double quantity_argument(const std::string& option, const std::string& text, Dimension dimension) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc{} && end == text.data() + text.size() && std::isfinite(number)) return number;
  const ParsedQuantity quantity = parse_quantity(text, dimension);
  if (!quantity.value) throw UsageError(option + ": " + quantity.error);
  return *quantity.value;
}

int whole_number(const Arguments& arguments, const std::string& option, int otherwise, int least, int most) {
  if (!arguments.has(option)) return otherwise;
  const std::string text = arguments.value(option, "");
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || number < least || number > most)
    throw UsageError(option + ": " + in_quotes(text) + " is not a number from " + std::to_string(least) +
                     " to " + std::to_string(most));
  return number;
}

const std::vector<Command>& commands() {
  static const std::vector<Command> table = {inspect_entry(),
                                             check_entry(),
                                             run_entry(),
                                             export_entry(),
                                             convert_entry(),
                                             transform_entry(),
                                             compare_entry(),
                                             route_entry(),
                                             schema_entry(),
                                             report_entry(),
                                             verify_entry(become_verify),
                                             bench_entry(become_bench),
                                             study_entry(),
                                             catenary_entry(),
                                             completion_entry(),
                                             manual_entry()};
  return table;
}

}  // namespace nurbeam
