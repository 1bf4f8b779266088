#include "pipelines/run/closing_lines.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "nurbs/number_text.h"
#include "pipelines/diagnostics/readable_quantity.h"
#include "pipelines/run/moment_text.h"

namespace nurbeam {

namespace {

/// A quantity that the lines show: the largest among all parts of the model.
struct Shown {
  const char* ending;  ///< of its name in the extremes
  const char* name;
  const char* unit;
  int sign = 0;   ///< 1 or -1: only what is positive or negative counts, and is shown without its sign
  int group = 0;  ///< of those with one number the largest alone is shown; 0: of none
};
constexpr Shown all_shown[] = {{".displacement.max", "displacement", "m"},
                               {".stress.max", "stress", "Pa", 0, 1},
                               {".von_mises.max", "von Mises stress", "Pa", 0, 1},
                               {".axial_force.max", "tension", "N", 1, 2},
                               {".axial_force.min", "compression", "N", -1, 2},
                               {".force", "support force", "N"},
                               {".joint_force", "joint force", "N"},
                               {".speed", "speed", "m/s"}};

bool is_round_off(double value, const std::string& unit, const RunSummary& summary) {
  const auto found = summary.round_off.find(unit);
  return found != summary.round_off.end() && std::abs(value) <= found->second;
}

// Extremes of connectors end as those of supports do; supports stand before them.
std::optional<RunExtreme> largest(const RunSummary& summary, const Shown& shown) {
  std::optional<RunExtreme> found;
  for (const RunExtreme& each : summary.extremes)
    if (each.quantity.ends_with(shown.ending) && each.unit == shown.unit && std::isfinite(each.value) &&
        each.value != 0 && !is_round_off(each.value, each.unit, summary) && shown.sign * each.value >= 0 &&
        (!found || std::abs(each.value) > std::abs(found->value)))
      found = each;
  return found;
}

// Whether another quantity of the group is larger.
bool is_surpassed(const RunSummary& summary, const Shown& shown, const RunExtreme& extreme) {
  return shown.group != 0 && std::ranges::any_of(
                                 all_shown,
                                 [&](const Shown& other) {
                                   if (other.group != shown.group) return false;
                                   const auto larger = largest(summary, other);
                                   return larger && std::abs(larger->value) > std::abs(extreme.value);
                                 });
}

std::string text_of_extreme(const RunExtreme& extreme, const Shown& shown, const CaseAnalysis& analysis) {
  constexpr int digits = 4;
  const std::string of =
      extreme.quantity.substr(0, extreme.quantity.size() - std::string(shown.ending).size());
  const double value = shown.sign == 0 ? extreme.value : std::abs(extreme.value);
  std::string text = std::string(shown.name) + " " + readable(value, extreme.unit) + " (" + of;
  if (extreme.s) text += ", s = " + text_of(*extreme.s, digits) + " m";
  const std::string moment = moment_text(analysis, extreme.time, digits);
  return text + (moment.empty() ? "" : ", " + moment) + ")";
}

// Whether it is the bending of a beam as a whole, or of a short layer that the line through the nodes has
// not.
std::string text_of_layer(const RunExtreme& extreme) {
  return "          local bending, within " + readable(*extreme.layer, "m") + " of the kink or clamp there";
}

void add_extremes(const RunSummary& summary, const CaseAnalysis& analysis, std::vector<std::string>& lines) {
  bool first = true;
  for (const Shown& shown : all_shown) {
    const auto extreme = largest(summary, shown);
    if (!extreme || is_surpassed(summary, shown, *extreme)) continue;
    lines.push_back((std::exchange(first, false) ? "largest " : "        ") +
                    text_of_extreme(*extreme, shown, analysis));
    if (extreme->layer) lines.push_back(text_of_layer(*extreme));
  }
}

// What bodies did at the ends of their beams, of the first few.
void add_endings(const RunSummary& summary, std::vector<std::string>& lines) {
  constexpr int most = 3, digits = 4;
  int more = -most;
  for (const RunEvent& event : summary.events) {
    const bool leaves = event.kind == EventKind::left_beam;
    if (!leaves && event.kind != EventKind::stopped_at_end) continue;
    if (++more > 0) continue;
    lines.push_back(summary.bodies.at(event.body) + (leaves ? " left " : " stopped at the end of ") +
                    summary.beams.at(event.beam) + " (" +
                    (event.s ? "s = " + text_of(*event.s, digits) + " m, " : std::string()) +
                    "t = " + text_of(event.time, digits) + " s)" +
                    (leaves ? " and flies on: that is not counted" : ""));
  }
  if (more > 0) lines.push_back("... and " + std::to_string(more) + " more at ends of beams");
}

// Of each collector: its force, loss of contact, and how far it lifts the wire.
void add_collectors(const RunSummary& summary, std::vector<std::string>& lines) {
  constexpr int digits = 4;
  for (const CollectorOutcome& collector : summary.collectors) {
    const ContactStatistics& contact = collector.contact;
    if (contact.samples == 0) continue;
    const ForceStatistics& force = contact.filtered;
    const auto newtons = [](double value) { return text_of(value, digits); };
    lines.push_back("contact of " + collector.name + " up to " + newtons(force.high) + " Hz: mean " +
                    newtons(force.mean) + " N, deviation " + newtons(force.deviation) +
                    " N, mean - 3 and + 3 deviations " + newtons(force.mean - 3 * force.deviation) + " and " +
                    newtons(force.mean + 3 * force.deviation) + " N, " + newtons(force.least) + " to " +
                    newtons(force.greatest) + " N, lost " + newtons(100 * contact.lost_part) +
                    " % of the time" +
                    (contact.losses > 0 ? " (" + std::to_string(contact.losses) + " times, at most " +
                                              readable(contact.longest_loss, "s") + ")"
                                        : ""));
    for (const Uplift& uplift : collector.uplift)
      lines.push_back("uplift of " + uplift.probe + " " + readable(uplift.value, "m") +
                      " (t = " + text_of(uplift.time, digits) + " s)");
  }
}

std::string energy_line(const RunSummary& summary, const SimulationReport& run, bool moves) {
  if (!moves) {
    double strain = 0;
    for (const RunExtreme& each : summary.extremes)
      if (each.quantity == "energy.axial" || each.quantity == "energy.bending") strain += each.value;
    return "strain energy " + readable(is_round_off(strain, "J", summary) ? 0 : strain, "J");
  }
  if (is_round_off(summary.energy_drift, "J", summary)) return "energy balance kept to round-off";
  const double most = run.energy_scale();
  std::string line = "energy balance kept to " + readable(summary.energy_drift, "J");
  if (most > 0) line += ", " + text_of(100 * summary.energy_drift / most, 2) + " % of the energy that moves";
  return line;
}

std::string counted(long count, const std::string& name) {
  return std::to_string(count) + " " + name + (count == 1 ? "" : "s");
}

std::string warnings_line(const std::vector<Diagnostic>& diagnostics) {
  const auto count = [&](Severity severity) {
    return static_cast<long>(std::ranges::count(diagnostics, severity, &Diagnostic::severity));
  };
  const long warnings = count(Severity::warning), notes = count(Severity::note);
  std::string line = warnings == 0 ? "no warnings" : counted(warnings, "warning");
  if (notes > 0) line += ", " + counted(notes, "note");
  return warnings + notes > 0 ? line + ": see above, or run.json" : line;
}

// The features of the run that no known answer covers; empty where there are none.
std::string uncovered_line(const std::vector<FeatureEvidence>& evidence) {
  std::string names;
  for (const FeatureEvidence& each : evidence)
    if (!each.is_covered()) names += (names.empty() ? "" : ", ") + each.feature;
  if (names.empty()) return {};
  return "no known answer of nurbeam verify is met within " + text_of(close_error) + " with: " + names;
}

}  // namespace

std::vector<std::string> closing_lines(const RunSummary& summary, const SimulationReport& run,
                                       const CaseAnalysis& analysis, const std::filesystem::path& out,
                                       bool report) {
  std::vector<std::string> lines;
  if (!summary.modes) {
    add_extremes(summary, analysis, lines);
    add_endings(summary, lines);
    add_collectors(summary, lines);
    lines.push_back(energy_line(summary, run, analysis.type == CaseAnalysis::Type::dynamic));
  }
  lines.push_back(warnings_line(summary.diagnostics));
  if (std::string line = uncovered_line(summary.evidence); !line.empty()) lines.push_back(line);
  lines.push_back(report ? "open " + (out / "report.html").string() : "results in " + out.string());
  return lines;
}

}  // namespace nurbeam
