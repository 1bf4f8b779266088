#include "pipelines/command/command_line.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <ostream>
#include <stdexcept>

#include "pipelines/case/case_file.h"
#include "pipelines/case/quantity.h"
#include "pipelines/command/compare.h"
#include "pipelines/command/inspect.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/diagnostics/print_diagnostics.h"
#include "pipelines/papers/papers.h"
#include "pipelines/report/report.h"
#include "pipelines/results/export_results.h"
#include "pipelines/run/run.h"
#include "pipelines/run/signals.h"
#include "pipelines/verification/verify.h"

namespace nurbeam {

namespace {

constexpr int done = 0, bad_input = 2, not_written = 4;

/// Arguments that do not make sense; the message says what would.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Arguments {
  std::vector<std::string> positional;
  std::map<std::string, std::vector<std::string>> options;  // values by name; a flag has one empty value

  bool has(const std::string& option) const { return options.contains(option); }
  std::string value(const std::string& option, const std::string& otherwise) const {
    return has(option) ? options.at(option).back() : otherwise;
  }
  std::string required(const std::string& option) const {
    if (!has(option)) {
      throw UsageError("the option " + option + " is missing");
    }
    return options.at(option).back();
  }
  std::vector<std::string> values(const std::string& option) const {
    return has(option) ? options.at(option) : std::vector<std::string>{};
  }
};

struct Streams {
  std::ostream &out, &err;
};

struct Option {
  std::string name;
  bool takes_value;
};

struct Command {
  std::string name;
  std::string usage;  // what follows the name
  std::string help;
  std::size_t min_positional, max_positional;
  std::vector<Option> options;
  int (*run)(const Arguments&, Streams);
  int failure = bad_input;  // the exit code when files or the system fail
};

/// A number in SI units or a text with a unit.
double quantity_argument(const std::string& option, const std::string& text, Dimension dimension) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc{} && end == text.data() + text.size() && std::isfinite(number)) {
    return number;
  }
  const ParsedQuantity quantity = parse_quantity(text, dimension);
  if (!quantity.value) {
    throw UsageError(option + ": " + quantity.error);
  }
  return *quantity.value;
}

int inspect_command(const Arguments& arguments, Streams streams) {
  if (arguments.has("--profile")) {
    if (arguments.has("--json")) {
      throw UsageError("--profile and --json exclude each other");
    }
    return inspect_profiles({arguments.positional.begin(), arguments.positional.end()}, streams.out,
                            streams.err);
  }
  return inspect_files({arguments.positional.begin(), arguments.positional.end()}, arguments.has("--json"),
                       streams.out, streams.err);
}

/// The case with its overrides; its diagnostics are printed.
std::optional<CaseFile> read_case(const Arguments& arguments, Streams streams) {
  CaseFileReport report = read_case_file(arguments.positional[0], arguments.values("--set"));
  print_diagnostics(streams.err, report.diagnostics);
  return std::move(report.value);
}

int check_command(const Arguments& arguments, Streams streams) {
  const auto case_file = read_case(arguments, streams);
  return case_file ? check_case(*case_file) : bad_input;
}

int run_command(const Arguments& arguments, Streams streams) {
  if (arguments.value("--out", "results").empty()) {
    throw UsageError("--out: is empty; give the directory for the results");
  }
  const BrokenPipeGuard guard;  // a run outlives the reader of its messages
  const auto case_file = read_case(arguments, streams);
  if (!case_file) {
    return bad_input;
  }
  const std::string default_out = case_file->path.stem().string() + "_results";
  return run_case(*case_file, {.out = arguments.value("--out", default_out),
                               .quiet = arguments.has("--quiet"),
                               .resume = arguments.has("--resume")});
}

std::pair<double, std::vector<NamedCurve>> read_results(const std::filesystem::path& directory, double time,
                                                        CurveParameter parameter) {
  try {
    return stored_curves(directory, time, parameter);
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(error.what());  // what cannot be read is bad input
  }
}

CurveParameter curve_parameter(const std::string& name) {
  if (name == "free") return CurveParameter::free;
  if (name == "material") return CurveParameter::material;
  throw UsageError("--parameter: there is no " + in_quotes(name) + known_names(name, {"free", "material"}));
}

int export_command(const Arguments& arguments, Streams streams) {
  const double time = quantity_argument("--time", arguments.required("--time"), Dimension::time);
  const std::string file = arguments.required("--to");
  const LengthUnit unit = parse_length_unit(arguments.value("--unit", "mm"));
  const CurveParameter parameter = curve_parameter(arguments.value("--parameter", "free"));
  const auto [stored_time, curves] = read_results(arguments.positional[0], time, parameter);
  if (arguments.has("--solid")) {
    const double radius = quantity_argument("--solid", arguments.required("--solid"), Dimension::length);
    const double bore = quantity_argument("--bore", arguments.value("--bore", "0"), Dimension::length);
    std::vector<NamedPipe> pipes;
    for (const NamedCurve& curve : curves) pipes.push_back({curve, radius, bore});
    if (const auto problem = export_solids(file, pipes, unit)) {
      print_diagnostics(streams.err, {*problem});
      return not_written;
    }
  } else if (arguments.has("--bore")) {
    throw UsageError("--bore: is the bore of a solid; give its radius with --solid");
  } else {
    export_curves(file, curves, unit);
  }
  streams.err << "note: " << file << ": the curves at " << stored_time << " s, the stored time nearest to "
              << time << " s\n";
  return done;
}

int compare_command(const Arguments& arguments, Streams streams) {
  const double tolerance =
      quantity_argument("--tolerance", arguments.value("--tolerance", "1e-6"), Dimension::length);
  if (!(tolerance > 0)) {
    throw UsageError("--tolerance: is " + arguments.value("--tolerance", "") + "; must be greater than 0");
  }
  return compare_files(arguments.positional[0], arguments.positional[1], tolerance, streams.out, streams.err);
}

int schema_command(const Arguments& arguments, Streams streams) {
  const std::string what = arguments.positional.empty() ? "case" : arguments.positional[0];
  if (what == "study") {
    throw UsageError("the schema \"study\" is not available in this version; available: \"case\"");
  }
  if (what != "case") {
    throw UsageError("there is no schema " + in_quotes(what) + known_names(what, {"case"}));
  }
  streams.out << case_file_schema();
  return done;
}

template <class Item>
std::vector<std::string> names_of(const std::vector<Item>& items) {
  std::vector<std::string> names;
  for (const Item& item : items) {
    names.push_back(item.name);
  }
  return names;
}

int verify_command(const Arguments& arguments, Streams streams) {
  const std::string part = arguments.positional.empty() ? "" : arguments.positional[0];
  if (part == "papers") {
    write_papers(arguments.value("--out", "papers"), streams.err);
    return done;
  }
  std::vector<VerifyProblem> problems = verification_problems();
  const std::vector<std::string> names = names_of(problems);
  std::erase_if(problems,
                [&](const VerifyProblem& problem) { return problem.name.find(part) == std::string::npos; });
  if (problems.empty()) {
    throw UsageError("no problem has " + in_quotes(part) + " in its name" + known_names(part, names));
  }
  return verify(problems, streams.out, streams.err);
}

int report_command(const Arguments& arguments, Streams streams) {
  const std::filesystem::path directory = arguments.positional[0];
  write_report(directory);
  streams.err << "note: " << (directory / "report.html").string() << " written\n";
  return done;
}

int unavailable_command(const Arguments&, Streams) {
  throw UsageError("this command is not available in this version");
}

const std::vector<Command>& commands() {
  static const std::vector<Command> table = {
      {"inspect",
       "FILE... [--json | --profile]",
       "lists the curves of STEP and IGES files; with --profile: the section that they draw",
       1,
       std::string::npos,
       {{"--json", false}, {"--profile", false}},
       inspect_command},
      {"check",
       "CASE.json [--set path=value]...",
       "reads and resolves a case, runs nothing",
       1,
       1,
       {{"--set", true}},
       check_command},
      {"run",
       "CASE.json [--out DIR] [--resume] [--quiet] [--set path=value]...",
       "runs a case",
       1,
       1,
       {{"--out", true}, {"--quiet", false}, {"--set", true}, {"--resume", false}},
       run_command,
       not_written},
      {"export",
       "RESULTS_DIR --time T --to FILE.step|.igs [--unit mm|m|inch] [--parameter free|material] "
       "[--solid RADIUS [--bore RADIUS]]",
       "writes the deformed curves at a stored time; with --solid, as rods of that radius, with --bore as "
       "pipes",
       1,
       1,
       {{"--time", true},
        {"--to", true},
        {"--unit", true},
        {"--parameter", true},
        {"--solid", true},
        {"--bore", true}},
       export_command,
       not_written},
      {"compare",
       "A B [--tolerance 1e-6]",
       "largest distance between the curves of two CAD files",
       2,
       2,
       {{"--tolerance", true}},
       compare_command},
      {"schema", "[case]", "prints the JSON schema of the case file", 0, 1, {}, schema_command},
      {"report",
       "RESULTS_DIR",
       "writes report.html anew: the 3-D view, plots and tables of a run",
       1,
       1,
       {},
       report_command,
       not_written},
      {"study", "STUDY.json", "not available in this version", 0, std::string::npos, {}, unavailable_command},
      {"verify",
       "[NAME | papers [--out DIR]]",
       "computes problems with known answers (those with NAME in their name) and prints a table; with "
       "papers: "
       "the examples of the papers beside their tables, as a page with figures",
       0,
       1,
       {{"--out", true}},
       verify_command,
       not_written},
  };
  return table;
}

template <class Item>
const Item& find_by_name(const std::vector<Item>& items, const std::string& name, const char* what) {
  const auto found =
      std::find_if(items.begin(), items.end(), [&](const Item& item) { return item.name == name; });
  if (found == items.end()) {
    throw UsageError(std::string("unknown ") + what + " " + in_quotes(name) +
                     known_names(name, names_of(items)));
  }
  return *found;
}

Arguments parse_arguments(const Command& command, const std::vector<std::string>& words) {
  Arguments arguments;
  bool options_ended = false;
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (options_ended || !words[i].starts_with("-")) {
      arguments.positional.push_back(words[i]);
      continue;
    }
    if (words[i] == "--") {
      options_ended = true;
      continue;
    }
    const auto equals = words[i].find('=');
    const Option& option = find_by_name(command.options, words[i].substr(0, equals), "option");
    const bool has_value = equals != std::string::npos;
    if (has_value && !option.takes_value) {
      throw UsageError("the option " + option.name + " takes no value");
    }
    if (option.takes_value && !has_value && i + 1 == words.size()) {
      throw UsageError("the option " + option.name + " needs a value");
    }
    const std::string value = has_value ? words[i].substr(equals + 1) : option.takes_value ? words[++i] : "";
    arguments.options[option.name].push_back(value);
  }
  if (arguments.positional.size() < command.min_positional ||
      arguments.positional.size() > command.max_positional) {
    throw UsageError("has " + std::to_string(arguments.positional.size()) +
                     " argument(s) besides its options");
  }
  return arguments;
}

std::string usage_of(const Command& command) { return "nurbeam " + command.name + " " + command.usage; }

void print_help(std::ostream& stream) {
  stream << "nurbeam " NURBEAM_VERSION ": CAD curves to flexible beams with sliding joints, and back\n\n";
  for (const Command& command : commands()) {
    stream << "  " << usage_of(command) << "\n      " << command.help << '\n';
  }
  stream << "\nExit codes: 0 done, 1 a comparison or verification failed, 2 bad input, 3 the solver did not "
            "converge,\n"
            "            4 results could not be written, 130 interrupted\n";
}

bool asks_for_help(const std::string& word) { return word == "--help" || word == "-h"; }

int run_command_by_name(const std::vector<std::string>& words, Streams streams) {
  const Command& command = find_by_name(commands(), words[0], "command");
  if (std::any_of(words.begin(), words.end(), asks_for_help)) {
    streams.out << usage_of(command) << "\n  " << command.help << '\n';
    return done;
  }
  const auto fail = [&](int code, const std::exception& error) {
    streams.err << "error: " << error.what() << '\n';
    return code;
  };
  try {
    return command.run(parse_arguments(command, words), streams);
  } catch (const UsageError& error) {
    streams.err << "error: nurbeam " << command.name << ": " << error.what()
                << "\nusage: " << usage_of(command) << '\n';
    return bad_input;
  } catch (const std::invalid_argument& error) {
    return fail(bad_input, error);
  } catch (const std::exception& error) {
    return fail(command.failure, error);
  }
}

int run_words(const std::vector<std::string>& words, Streams streams) {
  if (words.empty()) {
    print_help(streams.err);
    return bad_input;
  }
  if (asks_for_help(words[0]) || words[0] == "help") {
    print_help(streams.out);
    return done;
  }
  if (words[0] == "--version") {
    streams.out << "nurbeam " NURBEAM_VERSION "\n";
    return done;
  }
  try {
    return run_command_by_name(words, streams);
  } catch (const UsageError& error) {
    streams.err << "error: " << error.what() << "\nnurbeam --help lists the commands\n";
    return bad_input;
  }
}

}  // namespace

int run_command_line(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  const int code = run_words(arguments, {out, err});
  out.flush();
  if (!out) {
    err << "error: standard output cannot be written\n";
    return not_written;
  }
  return code;
}

}  // namespace nurbeam
