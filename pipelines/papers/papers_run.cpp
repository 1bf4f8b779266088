#include "pipelines/papers/papers_run.h"

#include <atomic>
#include <cmath>
#include <future>
#include <limits>
#include <sstream>

#include "pipelines/verification/verify_examples.h"

namespace nurbeam::papers {

namespace {

constexpr LengthControl papers_thresholds{.min = 0.5, .max = 1.5};

std::string thresholds_of(const Method& method) {
  std::ostringstream text;
  text << method.control.min << "/" << method.control.max << " (" << method.name << ")";
  return text.str();
}

}  // namespace

Method ours() { return {.name = "ours"}; }
Method paper_rule() {
  return {.name = "paper's rule",
          .weights = WeightRule::constant,
          .merge = MergeRule::paper,
          .control = papers_thresholds};
}
Method all_ones() {
  return {.name = "all ones",
          .weights = WeightRule::constant,
          .merge = MergeRule::ones,
          .control = papers_thresholds};
}
Method ale_ancf() {
  return {.name = "ALE-ANCF",
          .weights = WeightRule::ones,
          .merge = MergeRule::ones,
          .control = papers_thresholds};
}

Example falling_beam_example() { return {"Example 1", verification::falling_beam, 0.7, "straight"}; }
Example suspended_beam_example() { return {"Example 2", verification::suspended_beam, 1.0, "straight"}; }
Example semicircle_example(bool straight) {
  return {straight ? "Example 3, straight" : "Example 3, curved",
          [straight](int elements) { return verification::semicircle(elements, straight); }, 1.5,
          straight ? "straight, bent to the semicircle" : "curved"};
}

double Run::leave_time() const {
  for (const RunEvent& event : report.events)
    if (event.kind == EventKind::left_beam) return event.time;
  return std::numeric_limits<double>::quiet_NaN();
}

Run run(BeamModel model, const Method& method, const Pace& pace, Kept kept) {
  for (Beam& beam : model.beams) {
    beam.weights = method.weights;
    beam.merge = method.merge;
    beam.form = method.form;
    beam.properties.axial_strain = method.axial_strain;
  }
  SimulationOptions options;
  options.end_time = pace.end;
  options.step = pace.step;
  options.length_control = method.control;
  options.integrator = GeneralizedAlpha{.rho_infinity = pace.rho_infinity};
  const long count = std::lround(pace.end / pace.every);
  for (long i = 0; i <= count; ++i)
    options.output_times.push_back(pace.end * static_cast<double>(i) / static_cast<double>(count));

  Run result;
  SimulationObserver observer;
  observer.snapshot = [&](const Snapshot& frame) { result.frames.push_back(frame); };
  if (kept == Kept::shapes)
    observer.mesh_changed = [&](const RunEvent& event, const std::vector<BeamRecord>& before,
                                const std::vector<BeamRecord>& after) {
      result.changes.push_back({event, before[0], after[0]});
    };
  else
    observer.contents = {.beams = false, .probes = false, .reactions = false, .measures = false};
  const std::vector<ProbePlace> end{{0, model.beams[0].curve.length()}};
  result.report = simulate(model, end, options, observer);
  if (kept == Kept::bodies)
    for (const RunEvent& event : result.report.events)
      if (!is_booked(event.kind)) result.changes.push_back({event, {}, {}});
  return result;
}

void for_each_of(std::size_t count, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  const auto worker = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  std::future<void> second = std::async(std::launch::async, worker);
  worker();
  second.get();
}

std::string statement(const Example& example, const std::vector<Method>& methods, const Pace& pace) {
  std::ostringstream text;
  text << example.name << "; spatial curvature; Green's strain; stress-free shape " << example.stress_free
       << "; form " << (methods.front().form == Form::variational ? "V" : "P") << "; thresholds ";
  for (std::size_t i = 0; i < methods.size(); ++i) text << (i ? ", " : "") << thresholds_of(methods[i]);
  text << "; step " << pace.step << " s, ρ∞ = " << pace.rho_infinity;
  return text.str();
}

}  // namespace nurbeam::papers
