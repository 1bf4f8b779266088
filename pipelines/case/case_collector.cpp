#include "pipelines/case/case_collector.h"

#include <algorithm>
#include <cmath>

#include "nurbs/number_text.h"
#include "pipelines/case/case_values.h"
#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

namespace {

void check_directions(const CaseCollector& collector, Findings& findings) {
  for (const auto& [key, direction] : {std::pair{"travel", collector.travel}, std::pair{"up", collector.up}})
    if (direction.norm() == 0) findings.error(child(collector.path, key), "is [0, 0, 0]; give a direction");
  constexpr double right_angle = 1e-6;
  const double cosine = collector.travel.stableNormalized().dot(collector.up.stableNormalized());
  if (std::abs(cosine) > right_angle)
    findings.error(child(collector.path, "up"),
                   "is not across \"travel\": the cosine of the angle between them is " + text_of(cosine, 3) +
                       "; must be 0, at most 1e-6");
}

// One spring and one damper below each mass; between masses they must carry.
void check_stages(const CaseCollector& collector, Findings& findings) {
  const std::size_t masses = collector.masses.size();
  const auto check_length = [&](const char* key, const std::vector<double>& values) {
    if (values.size() != masses)
      findings.error(child(collector.path, key), "has " + std::to_string(values.size()) + " values for " +
                                                     std::to_string(masses) +
                                                     " \"masses\"; give one for what is below each mass");
  };
  check_length("stiffness", collector.stiffness);
  if (!collector.damping.empty()) check_length("damping", collector.damping);
  for (std::size_t i = 1; i < collector.stiffness.size(); ++i)
    if (collector.stiffness[i] == 0)
      findings.error(child(child(collector.path, "stiffness"), i),
                     "is 0, with which nothing lifts the mass above; must be above 0 but for the first, to "
                     "the base");
  if (static_cast<std::size_t>(collector.force_on) > masses)
    findings.error(child(collector.path, "force_on"),
                   "is " + std::to_string(collector.force_on) + ", and there " +
                       (masses == 1 ? "is 1 mass" : "are " + std::to_string(masses) + " masses") +
                       "; must be at most " + std::to_string(masses));
}

void check_statistics(const CaseCollector& collector, Findings& findings) {
  if (collector.evaluate.size() == 2 && !(collector.evaluate[0] < collector.evaluate[1]))
    findings.error(child(collector.path, "evaluate"),
                   "ends at " + text_of(collector.evaluate[1]) + " m, not behind its start, " +
                       text_of(collector.evaluate[0]) + " m; must be [from, to] with from < to");
  for (std::size_t i = 0; i < collector.bands.size(); ++i)
    if (collector.bands[i].size() == 2 && !(collector.bands[i][0] < collector.bands[i][1]))
      findings.error(child(child(collector.path, "bands"), i),
                     "ends at " + text_of(collector.bands[i][1]) + " Hz, not above its start, " +
                         text_of(collector.bands[i][0]) + " Hz; must be [low, high] with low < high");
}

// A table begins at the start and goes on to the end of the run: elsewhere it stands still.
void check_motion(const CaseCollector& collector, const CaseAnalysis& analysis, Findings& findings) {
  const TimeTable& table = collector.motion.table;
  const std::string path = child(collector.path, "motion.table");
  if (collector.motion.join == RowJoin::linear)
    findings.error(child(collector.path, "motion.interpolation"),
                   "is \"linear\", by which the speed jumps at the rows; leave it out");
  if (table.empty() || analysis.type != CaseAnalysis::Type::dynamic) return;
  constexpr double same = 1e-9;
  if (std::abs(table.front().first) > same || std::abs(table.front().second) > same)
    findings.error(path, "begins with [" + text_of(table.front().first) + ", " +
                             text_of(table.front().second) +
                             "]; it is the way since the start and must begin with [0, 0]");
  if (table.back().first < analysis.end_time * (1 - same))
    findings.error(path, "ends at " + text_of(table.back().first) + " s, before analysis.end_time, " +
                             text_of(analysis.end_time) +
                             " s: there it would stop at once; add a row at the end time or later");
}

}  // namespace

CaseCollector read_collector(const Json& json, const std::string& path, Findings& findings) {
  CaseCollector collector;
  collector.path = path;
  collector_fields().read(json, path, collector, findings);
  if (findings.has_errors()) return collector;
  check_directions(collector, findings);
  check_stages(collector, findings);
  check_statistics(collector, findings);
  return collector;
}

void check_collectors(const CaseFile& c, Findings& findings) {
  std::vector<std::string> probes;
  for (const CaseProbe& probe : c.output.probes) probes.push_back(probe.name);
  for (const CaseCollector& collector : c.collectors) {
    check_motion(collector, c.analysis, findings);
    for (std::size_t i = 0; i < collector.uplift.size(); ++i)
      if (std::ranges::find(probes, collector.uplift[i]) == probes.end())
        findings.error(
            child(child(collector.path, "uplift"), i),
            "there is no probe " + in_quotes(collector.uplift[i]) + known_names(collector.uplift[i], probes));
  }
  if (c.collectors.empty()) return;
  if (c.analysis.has_modes())
    findings.error("collectors",
                   "press on a wire from one side, which small vibrations and buckling do not know; use a "
                   "\"dynamic\" or a \"static\" analysis, or leave them out");
  if (c.analysis.is_explicit())
    findings.error("analysis.integrator.type",
                   "is \"rk4\", which is not for collectors; use \"generalized-alpha\" or \"radau\"");
}

}  // namespace nurbeam
