// The total energy with what is lost, less what is put in, at every feature of the mechanics beside the beam.

#include <cmath>

#include "pipelines/verification/feature_models.h"
#include "pipelines/verification/verify.h"
#include "pipelines/verification/verify_run.h"

namespace nurbeam {

namespace {

using namespace verification;

// Root mean square of how far the total energy departs from its start, without what changes of the mesh make
// of it, over the energy that moves.
double departure(const FeatureModel& feature, double step) {
  const RunRecord run = run_model(feature.model, even_times(feature.end, 100), step, 1.0);
  const std::vector<RunEvent>& events = run.report.events;
  double of_mesh = 0, sum = 0;
  std::size_t next = 0;
  for (const Snapshot& frame : run.frames) {
    for (; next < events.size() && events[next].time <= frame.time + 1e-12; ++next)
      if (!is_booked(events[next].kind)) of_mesh += events[next].energy_after - events[next].energy_before;
    const double departed = frame.energy.total - run.frames.front().energy.total - of_mesh;
    sum += departed * departed;
  }
  return std::sqrt(sum / static_cast<double>(run.frames.size())) / run.report.energy_scale();
}

VerifyResult energy_of(const FeatureModel& feature) {
  constexpr double negligible = 1e-7;  // what events and iterations leave
  VerifyResult result;
  ConvergenceTable table{"the total energy's departure from its start", "steps", {}};
  for (const double part : {1.0, 0.125})
    table.rows.emplace_back(feature.end / (part * feature.step), departure(feature, part * feature.step));
  const double coarse = table.rows.front().second;
  result.add("departure of the total energy from its start", 0, "what is lost and put in is booked", coarse,
             feature.most_departure);
  if (coarse > negligible) result.add(std::move(table), 2, 0.5, "order of the method");
  return result;
}

}  // namespace

std::vector<VerifyProblem> energy_problems() {
  std::vector<VerifyProblem> problems;
  for (const FeatureModel& feature : feature_models())
    problems.push_back(
        {"energy-" + feature.name, feature.measures, [feature] { return energy_of(feature); }});
  return problems;
}

}  // namespace nurbeam
