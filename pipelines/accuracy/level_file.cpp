#include "pipelines/accuracy/level_file.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "cad_import/files/atomic_file.h"
#include "pipelines/results/checked_json.h"

namespace nurbeam {

namespace {

using Stored = nlohmann::json;

constexpr int most_levels = 24;

Stored number(double value) { return std::isfinite(value) ? Stored(value) : Stored(); }
double number(const Stored& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

Stored optional(const std::optional<double>& value) { return value ? Stored(*value) : Stored(); }
std::optional<double> optional(const Stored& value) {
  return value.is_null() ? std::nullopt : std::optional(value.get<double>());
}

Stored to_json(const RunEvent& event) {
  return {event.time, static_cast<int>(event.kind), event.beam, event.body, optional(event.s)};
}
RunEvent event_of(const Stored& json) {
  return {.time = json[0].get<double>(),
          .kind = static_cast<EventKind>(json[1].get<int>()),
          .beam = json[2].get<int>(),
          .body = json[3].get<int>(),
          .s = optional(json[4])};
}

Stored to_json(const RunExtreme& of) {
  return {of.quantity, of.unit, number(of.value), optional(of.s), of.time, optional(of.layer)};
}
RunExtreme extreme_of(const Stored& json) {
  return {json[0].get<std::string>(), json[1].get<std::string>(), number(json[2]),
          optional(json[3]),          json[4].get<double>(),      optional(json[5])};
}

Stored to_json(const LevelNumbers& of) {
  Stored rows = Stored::array(), extremes = Stored::array(), events = Stored::array();
  for (const std::vector<double>& row : of.rows) {
    Stored values = Stored::array();
    for (const double value : row) values.push_back(number(value));
    rows.push_back(std::move(values));
  }
  for (const RunExtreme& each : of.extremes) extremes.push_back(to_json(each));
  for (const RunEvent& each : of.events) events.push_back(to_json(each));
  return {
      {"level", of.level},     {"elements", of.elements}, {"steps", of.steps}, {"step", optional(of.step)},
      {"seconds", of.seconds}, {"done", of.done},         {"end", of.end},     {"times", of.times},
      {"rows", rows},          {"extremes", extremes},    {"events", events},  {"modes", of.modes}};
}

LevelNumbers numbers_of(const Stored& json) {
  LevelNumbers of{.level = json.at("level").get<int>(),
                  .elements = json.at("elements").get<long>(),
                  .steps = json.at("steps").get<long>(),
                  .step = optional(json.at("step")),
                  .seconds = json.at("seconds").get<double>(),
                  .done = json.at("done").get<bool>(),
                  .end = json.at("end").get<double>(),
                  .times = json.at("times").get<std::vector<double>>(),
                  .rows = {}};
  for (const Stored& row : json.at("rows")) {
    std::vector<double>& values = of.rows.emplace_back();
    for (const Stored& value : row) values.push_back(number(value));
  }
  for (const Stored& each : json.at("extremes")) of.extremes.push_back(extreme_of(each));
  for (const Stored& each : json.at("events")) of.events.push_back(event_of(each));
  of.modes = json.at("modes").get<std::vector<double>>();
  return of;
}

}  // namespace

std::string level_file_name(int level) { return "accuracy_level_" + std::to_string(level) + ".json"; }

void write_level(const std::filesystem::path& directory, const LevelNumbers& numbers,
                 const std::string& inputs) {
  Stored json = to_json(numbers);
  json["inputs"] = inputs;
  for (const Diagnostic& problem :
       write_at_once(directory / level_file_name(numbers.level), with_checksum(json.dump())))
    throw std::runtime_error(problem.where + ": " + problem.message);
}

void remove_other_levels(const std::filesystem::path& directory, const std::string& inputs) {
  for (int level = -2; level < most_levels; ++level)
    if (!read_level(directory, level, inputs)) {
      std::error_code ignored;
      std::filesystem::remove(directory / level_file_name(level), ignored);
    }
}

std::optional<LevelNumbers> read_level(const std::filesystem::path& directory, int level,
                                       const std::string& inputs) {
  const std::filesystem::path file = directory / level_file_name(level);
  if (!std::filesystem::exists(file)) return std::nullopt;
  try {
    const Stored json = Stored::parse(checked_json(file));
    if (json.at("inputs") != inputs) return std::nullopt;
    return numbers_of(json);
  } catch (const std::exception&) {
    return std::nullopt;  // the run is taken again
  }
}

}  // namespace nurbeam
