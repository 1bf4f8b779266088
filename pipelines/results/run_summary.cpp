#include "pipelines/results/run_summary.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

#include "cad_import/files/atomic_file.h"
#include "pipelines/diagnostics/print_diagnostics.h"
#include "pipelines/diagnostics/simulation_text.h"
#include "pipelines/results/checked_json.h"

namespace nurbeam {

namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Eigen::Vector3d& v) { return Json::array({v.x(), v.y(), v.z()}); }

Json to_json(const RunEvent& event, const RunSummary& summary) {
  const auto name = [](const std::vector<std::string>& names, int i) { return i < 0 ? "" : names.at(i); };
  return {{"time [s]", event.time},
          {"kind", name_of(event.kind)},
          {"beam", name(summary.beams, event.beam)},
          {"body", name(summary.bodies, event.body)},
          {"s [m]", event.s ? Json(*event.s) : Json()},
          {"energy_before [J]", event.energy_before},
          {"energy_after [J]", event.energy_after},
          {"momentum_before [kg m/s]", to_json(event.momentum_before)},
          {"momentum_after [kg m/s]", to_json(event.momentum_after)},
          {"length_before [m]", event.length_before},
          {"length_after [m]", event.length_after}};
}

Json to_json(const Diagnostic& d) {
  return {{"severity", severity_name(d.severity)}, {"where", d.where}, {"message", d.message}};
}

Json to_json(const RunInput& input) { return {{"file", input.file.string()}, {"sha256", input.sha256}}; }
Json to_json(const std::filesystem::path& path) { return path.string(); }

Json to_json(const Mismatch& mismatch) {
  return {{"largest", mismatch.value},
          {"beam", mismatch.beam},
          {"s [m]", mismatch.s},
          {"time [s]", mismatch.time}};
}

Json to_json(const RunExtreme& extreme) {
  Json json = {{"quantity", extreme.quantity},
               {"unit", extreme.unit},
               {"value", extreme.value},
               {"s [m]", extreme.s ? Json(*extreme.s) : Json()},
               {"time [s]", extreme.time}};
  if (extreme.layer) json["in a layer of [m]"] = *extreme.layer;
  return json;
}

Json or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json to_json(const ForceStatistics& force) {
  return {{"frequencies [Hz]", {force.low, or_null(force.high)}},
          {"mean [N]", force.mean},
          {"standard deviation [N]", force.deviation},
          {"mean - 3 deviations [N]", force.mean - 3 * force.deviation},
          {"mean + 3 deviations [N]", force.mean + 3 * force.deviation},
          {"least [N]", force.least},
          {"greatest [N]", force.greatest},
          {"1 % quantile [N]", force.quantile_1},
          {"99 % quantile [N]", force.quantile_99},
          {"histogram", force.histogram}};
}

Json to_json(const CollectorOutcome& collector) {
  const ContactStatistics& contact = collector.contact;
  Json json = {{"name", collector.name},
               {"evaluate [m]", {or_null(collector.from), or_null(collector.to)}},
               {"samples", contact.samples}};
  if (contact.samples > 0) {
    Json bands = Json::array();
    for (const ForceStatistics& band : contact.bands) bands.push_back(to_json(band));
    json.update({{"from [s]", contact.start},
                 {"to [s]", contact.end},
                 {"force", to_json(contact.filtered)},
                 {"unfiltered force", to_json(contact.unfiltered)},
                 {"bands", bands},
                 {"loss of contact",
                  {{"part of the time [%]", 100 * contact.lost_part},
                   {"number", contact.losses},
                   {"longest [s]", contact.longest_loss}}}});
  }
  Json uplifts = Json::array();
  for (const Uplift& uplift : collector.uplift)
    uplifts.push_back({{"probe", uplift.probe}, {"value [m]", uplift.value}, {"time [s]", uplift.time}});
  json["uplift"] = uplifts;
  return json;
}

Json to_json(const FeatureEvidence& evidence) {
  Json problems = Json::array();
  for (const VerifiedProblem& problem : evidence.problems)
    problems.push_back({{"problem", problem.name},
                        {"rows", problem.rows},
                        {"least_error", problem.least},
                        {"greatest_error", problem.greatest}});
  return {{"feature", evidence.feature}, {"covered", evidence.is_covered()}, {"problems", problems}};
}

Json to_json(const ModeTable& table) {
  Json list = Json::array();
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const ModeRow& row = table.rows[i];
    if (table.buckling)
      list.push_back({{"number", i + 1}, {"factor", row.factor}});
    else
      list.push_back({{"number", i + 1},
                      {"frequency [Hz]", row.frequency()},
                      {"period [s]", row.omega > 0 ? Json(1 / row.frequency()) : Json()},
                      {"effective_mass [kg]", to_json(row.effective_mass())},
                      {"participation [sqrt(kg)]", to_json(row.participation)}});
    if (table.whirls()) list.back()["whirl"] = row.whirl;
  }
  return list;
}

Json to_json(const SpeedTable& table) {
  Json lines = Json::array(), critical = Json::array();
  for (const SpeedLine& line : table.lines) {
    Json frequencies = Json::array();  // null where it is none of the modes found
    for (const double omega : line.omega) frequencies.push_back(omega / (2 * std::numbers::pi));
    lines.push_back({{"name", line.name()}, {"whirl", line.whirl}, {"frequency [Hz]", frequencies}});
  }
  for (const CriticalSpeed& each : table.critical)
    critical.push_back({{"speed [rad/s]", each.speed}, {"line", each.line}});
  return {{"speeds [rad/s]", table.speeds}, {"lines", lines}, {"critical_speeds", critical}};
}

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json to_json(const AccuracyLevel& run) {
  return {{"level", run.level},
          {"elements", run.elements},
          {"step [s]", or_null(run.step)},
          {"steps", run.steps},
          {"wall_time [s]", run.seconds}};
}

Json to_json(const NumberWithError& number) {
  return {{"quantity", number.quantity},
          {"unit", number.unit},
          {"value", number.value},
          {"error", or_null(number.error)},
          {"relative", or_null(number.relative)},
          {"place", or_null(number.s)},
          {"time", or_null(number.time)},
          {"not_converged", number.not_converged.empty() ? Json() : Json(number.not_converged)}};
}

template <class Item>
Json list(const std::vector<Item>& items) {
  Json list = Json::array();
  for (const Item& item : items) list.push_back(to_json(item));
  return list;
}

Json to_json(const Accuracy& accuracy) {
  Json json = {{"runs", list(accuracy.runs)},
               {"target", or_null(accuracy.target)},
               {"reached", accuracy.target ? Json(accuracy.reached) : Json()},
               {"parted [s]", or_null(accuracy.parted)},
               {"quantities", list(accuracy.numbers)}};
  if (!accuracy.unreached.empty()) json["unreached"] = accuracy.unreached;
  return json;
}

// The errors of the run's own numbers beside them.
void add_errors(const Accuracy& accuracy, const RunSummary& summary, Json& json) {
  const auto add = [&](const char* key, const std::vector<double>& errors) {
    for (std::size_t i = 0; i < std::min(errors.size(), json[key].size()); ++i)
      json[key][i]["error"] = or_null(errors[i]);
  };
  add("extremes", accuracy.extremes);
  if (summary.modes) add(summary.modes->buckling ? "buckling" : "modes", accuracy.modes);
  std::size_t next = 0;
  for (std::size_t i = 0; i < summary.events.size(); ++i)
    if (is_booked(summary.events[i].kind) && next < accuracy.events.size())
      json["events"][i]["error"] = or_null(accuracy.events[next++]);
  json["accuracy"] = to_json(accuracy);
}

Json to_json(const RunSummary& summary) {
  const PhaseTimes& wall = summary.wall_times;
  Json events = Json::array();
  for (const RunEvent& event : summary.events) events.push_back(to_json(event, summary));
  Json json = {{"nurbeam", summary.version},
               {"case", summary.case_name},
               {"status", summary.status},
               {"resumed_at [s]", summary.resumed_at ? Json(*summary.resumed_at) : Json()},
               {"end_time [s]", summary.end_time},
               {"steps", summary.steps},
               {"rejected_steps", summary.rejected_steps},
               {"newton_iterations", summary.newton_iterations},
               {"energy_drift [J]", summary.energy_drift},
               {"round_off", summary.round_off},
               {"axial_mismatch", to_json(summary.axial_mismatch)},
               {"extremes", list(summary.extremes)},
               {"wall_times [s]",
                {{"import", wall.import},
                 {"model", wall.model},
                 {"motion", wall.motion},
                 {"length_control", wall.length_control},
                 {"output", wall.output}}},
               {"inputs", list(summary.inputs)},
               {"model", summary.model.empty() ? Json() : Json::parse(summary.model)},
               {"events", events},
               {"evidence", list(summary.evidence)},
               {"diagnostics", list(summary.diagnostics)},
               {"files", list(summary.files)}};
  if (!summary.collectors.empty()) json["collectors"] = list(summary.collectors);
  if (summary.modes) {
    json[summary.modes->buckling ? "buckling" : "modes"] = to_json(*summary.modes);
    if (!summary.modes->buckling) json["mass [kg]"] = summary.modes->mass;
  }
  if (summary.speeds) json["modes_over_speed"] = to_json(*summary.speeds);
  if (summary.accuracy) add_errors(*summary.accuracy, summary, json);
  return json;
}

}  // namespace

void Mismatch::look_at(std::span<const ElementRecord> elements, const std::string& of_beam, double at_time) {
  for (const ElementRecord& e : elements)
    if (e.axial_mismatch > value) *this = {e.axial_mismatch, of_beam, (e.s_start + e.s_end) / 2, at_time};
}

void LeastStrain::look_at(std::span<const ElementRecord> elements, const std::string& of_beam,
                          double at_time) {
  for (const ElementRecord& e : elements)
    for (int i = 0; i < 4; ++i)
      if (e.strain[i] < value)
        *this = {e.strain[i], of_beam, e.s_start + (e.s_end - e.s_start) * i / 3, at_time};
}

void Fold::look_at(std::span<const ElementRecord> elements, const std::string& of_beam, double at_time) {
  for (const ElementRecord& e : elements)
    if (e.folded > value) *this = {e.folded, of_beam, (e.s_start + e.s_end) / 2, at_time};
}

void write_run_summary(const std::filesystem::path& file, const RunSummary& summary) {
  // Names from files need not be valid UTF-8: what is not is replaced.
  const std::string text =
      with_checksum(to_json(summary).dump(-1, ' ', false, Json::error_handler_t::replace));
  for (const Diagnostic& problem : write_at_once(file, text))
    throw std::runtime_error(problem.where + ": " + problem.message);
}

std::string status_of_run(const std::filesystem::path& directory) {
  try {
    return Json::parse(checked_json(directory / "run.json")).at("status").get<std::string>();
  } catch (const std::exception&) {
    return {};
  }
}

std::string collectors_as_json(const std::vector<CollectorOutcome>& collectors) {
  return list(collectors).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::map<std::string, std::string> drawn_curve_names(const std::filesystem::path& directory) {
  std::map<std::string, std::string> names;
  const std::filesystem::path file = directory / "run.json";
  if (!std::filesystem::exists(file)) return names;
  const Json run = Json::parse(checked_json(file));
  const Json::json_pointer beams("/model/beams");
  if (run.contains(beams))
    for (const Json& beam : run[beams])
      if (beam.contains("curve")) names[beam.at("name")] = beam["curve"];
  return names;
}

}  // namespace nurbeam
