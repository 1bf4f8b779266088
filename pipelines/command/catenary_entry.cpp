#include "pipelines/command/catenary_entry.h"

#include <charconv>
#include <filesystem>
#include <ostream>
#include <sstream>

#include "cad_import/export_curves.h"
#include "cad_import/files/atomic_file.h"
#include "pipelines/command/catenary.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/diagnostics/print_diagnostics.h"

namespace nurbeam {

namespace {

// An option that sets a number of the data.
struct NumberOption {
  const char* name;
  const char* value;
  const char* help;
  Dimension dimension;
  void (*set)(CatenaryData& data, double value);
};

const NumberOption number_options[] = {
    {"--encumbrance", "LENGTH", "of the messenger over the contact wire at masts; otherwise 1.2 m",
     Dimension::length, [](CatenaryData& d, double v) { d.encumbrance = v; }},
    {"--pre-sag", "LENGTH", "of the contact wire in the middle of a span; otherwise 0", Dimension::length,
     [](CatenaryData& d, double v) { d.pre_sag = v; }},
    {"--stagger", "LENGTH", "of the contact wire at masts, by turns to both sides; otherwise 0",
     Dimension::length, [](CatenaryData& d, double v) { d.stagger = v; }},
    {"--mast-force", "FORCE",
     "that lifts the contact wire at masts; otherwise its weight halfway to the droppers beside them",
     Dimension::force, [](CatenaryData& d, double v) { d.mast_force = v; }},
    {"--arm", "LENGTH", "of registration arms, hinged level with the wire; otherwise none", Dimension::length,
     [](CatenaryData& d, double v) { d.arm = v; }},
    {"--arm-mass", "MASS", "of an arm, where it moves with the wire; otherwise 0", Dimension::mass,
     [](CatenaryData& d, double v) { d.arm_mass = v; }},
    {"--dropper-stiffness", "STIFFNESS", "of droppers in tension; otherwise 100 kN/m", Dimension::stiffness,
     [](CatenaryData& d, double v) { d.dropper_stiffness = v; }},
    {"--clamp-mass", "MASS", "at both ends of droppers; otherwise 0", Dimension::mass,
     [](CatenaryData& d, double v) { d.clamp_mass = v; }},
    {"--contact-tension", "FORCE", "otherwise 20 kN", Dimension::force,
     [](CatenaryData& d, double v) { d.contact.tension = v; }},
    {"--contact-area", "AREA", "otherwise 150 mm^2", Dimension::area,
     [](CatenaryData& d, double v) { d.contact.area = v; }},
    {"--contact-density", "DENSITY", "otherwise 9000 kg/m^3", Dimension::density,
     [](CatenaryData& d, double v) { d.contact.density = v; }},
    {"--contact-modulus", "PRESSURE", "otherwise 100 GPa", Dimension::pressure,
     [](CatenaryData& d, double v) { d.contact.modulus = v; }},
    {"--contact-second-moment", "SIZE", "of area; otherwise 1950 mm^4", Dimension::second_moment,
     [](CatenaryData& d, double v) { d.contact.second_moment = v; }},
    {"--messenger-tension", "FORCE", "otherwise 16 kN", Dimension::force,
     [](CatenaryData& d, double v) { d.messenger.tension = v; }},
    {"--messenger-area", "AREA", "otherwise 120 mm^2", Dimension::area,
     [](CatenaryData& d, double v) { d.messenger.area = v; }},
    {"--messenger-density", "DENSITY", "otherwise 8916.67 kg/m^3", Dimension::density,
     [](CatenaryData& d, double v) { d.messenger.density = v; }},
    {"--messenger-modulus", "PRESSURE", "otherwise 110 GPa", Dimension::pressure,
     [](CatenaryData& d, double v) { d.messenger.modulus = v; }},
    {"--messenger-second-moment", "SIZE", "of area; otherwise 1197.27 mm^4", Dimension::second_moment,
     [](CatenaryData& d, double v) { d.messenger.second_moment = v; }},
    {"--mass-damping", "RATE", "of both wires; otherwise 0.0125 1/s", Dimension::rate,
     [](CatenaryData& d, double v) { d.mass_damping = v; }},
    {"--stiffness-damping", "TIME", "of both wires; otherwise 1e-4 s", Dimension::time,
     [](CatenaryData& d, double v) { d.stiffness_damping = v; }},
    {"--element", "LENGTH", "maximum length of elements; otherwise 0.8 m", Dimension::length,
     [](CatenaryData& d, double v) { d.element = v; }},
    {"--pantograph", "SPEED", "adds the one of EN 50318:2002 at that speed; otherwise the case is static",
     Dimension::speed, [](CatenaryData& d, double v) { d.speed = v; }}};

std::vector<std::string> listed(const std::string& list) {
  std::vector<std::string> items;
  std::stringstream text(list);
  for (std::string item; std::getline(text, item, ',');) items.push_back(item);
  return items;
}

std::vector<double> lengths_of(const std::string& option, const std::string& list) {
  std::vector<double> lengths;
  for (const std::string& item : listed(list))
    lengths.push_back(quantity_argument(option, item, Dimension::length));
  return lengths;
}

// "60,65" or "10x60", and both mixed.
std::vector<double> spans_of(const std::string& list) {
  std::vector<double> spans;
  for (const std::string& item : listed(list)) {
    const std::size_t times = item.find('x');
    int count = 1;
    if (times != std::string::npos) {
      const auto [end, error] = std::from_chars(item.data(), item.data() + times, count);
      if (error != std::errc{} || end != item.data() + times || count < 1 || count > 1000)
        throw UsageError("--spans: " + in_quotes(item) + " is no number of spans from 1 to 1000; as 10x60");
    }
    const double length = quantity_argument(
        "--spans", times == std::string::npos ? item : item.substr(times + 1), Dimension::length);
    spans.insert(spans.end(), static_cast<std::size_t>(count), length);
  }
  return spans;
}

CatenaryData data_of(const Arguments& arguments) {
  CatenaryData data;
  data.spans = spans_of(arguments.value("--spans", ""));
  data.droppers = lengths_of("--droppers", arguments.value("--droppers", ""));
  data.dropper_lengths = lengths_of("--dropper-lengths", arguments.value("--dropper-lengths", ""));
  for (const NumberOption& option : number_options)
    if (arguments.has(option.name))
      option.set(data, quantity_argument(option.name, arguments.value(option.name, ""), option.dimension));
  check(data);
  return data;
}

int catenary_command(const Arguments& arguments, Streams streams) {
  const CatenaryData data = data_of(arguments);
  const std::filesystem::path file = arguments.positional[0];
  std::ostringstream text;
  write_case(data, arguments.value("--name", file.stem().string()), text);
  std::vector<Diagnostic> found = write_at_once(file, text.str());
  if (arguments.has("--curves") && !has_errors(found))
    found = export_curves(arguments.value("--curves", ""), wires_of(data), parse_length_unit("mm"));
  print_diagnostics(streams.err, found);
  return has_errors(found) ? exit_not_written : exit_done;
}

}  // namespace

Command catenary_entry() {
  Command entry{"catenary",
                "CASE.json",
                "writes the case file of an overhead contact line from its data",
                1,
                1,
                {{"--spans", "LENGTHS", "as 60,65,60 or 10x60", true},
                 {"--droppers", "POSITIONS", "in the first span, as 5,17,30; in others in proportion", true},
                 {"--dropper-lengths", "LENGTHS",
                  "of each; otherwise those that hold the contact wire where it is drawn"},
                 {"--name", "TEXT", "of the case; otherwise that of the file"},
                 {"--curves", "FILE", "writes the wires too, as STEP, IGES, DXF, ... by its ending"}},
                catenary_command,
                exit_not_written};
  for (const NumberOption& option : number_options)
    entry.options.push_back({option.name, option.value, option.help});
  return entry;
}

}  // namespace nurbeam
