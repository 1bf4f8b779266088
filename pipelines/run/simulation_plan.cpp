#include "pipelines/run/simulation_plan.h"

#include <algorithm>
#include <sstream>

#include "nurbs/number_text.h"
#include "pipelines/diagnostics/simulation_text.h"
#include "pipelines/run/moment_text.h"

namespace nurbeam {

namespace {

std::vector<double> output_times(const CaseFile& c) {
  const double end = c.analysis.end_time;
  std::vector<double> times;
  const double every = *c.output.every;
  for (int k = 0; k * every < end * (1 - 1e-9); ++k) times.push_back(k * every);
  times.push_back(end);
  for (double t : c.output.cad_times)
    if (t >= 0 && t <= end) times.push_back(t);
  std::sort(times.begin(), times.end());
  const double same = 1e-9 * end;
  times.erase(std::unique(times.begin(), times.end(), [=](double a, double b) { return b - a < same; }),
              times.end());
  return times;
}

}  // namespace

SimulationOptions simulation_options(const CaseFile& c) {
  SimulationOptions options;
  const CaseAnalysis& a = c.analysis;
  options.statics = a.type == CaseAnalysis::Type::statics;
  options.start_from_equilibrium = a.start_from_equilibrium;
  options.end_time = a.end_time;
  options.step = a.step;
  options.integrator = a.integrator;
  options.length_control = a.length_control;
  options.output_times = options.statics ? a.factors() : output_times(c);
  return options;
}

std::vector<ProbePlace> probe_places(const BuiltModel& built) {
  std::vector<ProbePlace> places;
  for (const Probe& probe : built.probes)
    places.push_back({.beam = probe.beam, .s = probe.s, .side = probe.side});
  return places;
}

std::optional<Diagnostic> fewer_modes_note(const CaseFile& c, const ModeTable& table) {
  const std::size_t asked = static_cast<std::size_t>(c.analysis.modes.count), found = table.rows.size();
  if (found >= asked) return {};
  const std::string what = table.buckling ? "buckling factor" : "mode";
  return Diagnostic{
      Severity::note, c.path.string() + ": analysis.modes.count",
      "is " + std::to_string(asked) + ", and there " +
          (found == 1 ? "is 1 " + what : "are " + std::to_string(found) + " " + what + "s") +
          (table.buckling
               ? ": beyond that loads would move something by a beam's length, where buckling is no longer "
                 "linear, or the mesh has no more; follow greater loads with \"load_steps\""
               : "; more elements have more")};
}

std::optional<Diagnostic> compression_warning(const CaseFile& c, const LeastStrain& strain) {
  constexpr double nothing_left = -0.5;  // Green's strain of a length of zero
  if (strain.value > nothing_left) return {};
  return Diagnostic{
      Severity::warning, c.path.string() + ": analysis",
      "beam \"" + strain.beam + "\" is compressed to nothing at s = " + text_of(strain.s, 6) + " m" +
          at_moment(c.analysis, strain.time, 6) +
          ": do not trust the result; take more elements there, and see whether the material is that soft"};
}

std::optional<Diagnostic> fold_warning(const CaseFile& c, const Fold& fold) {
  constexpr double half_gone = 0.2;  // |r_s| falls to a half inside at 0.235
  if (fold.value < half_gone) return {};
  return Diagnostic{
      Severity::warning, c.path.string() + ": analysis",
      "beam \"" + fold.beam + "\" folds back on itself inside an element, at s = " + text_of(fold.s, 6) +
          " m" + at_moment(c.analysis, fold.time, 6) +
          ": the part of its axial strain that the element cannot carry is R = " + text_of(fold.value, 2) +
          ", and above 0.2 the beam turns round there; do not trust the result, and take more "
          "elements or, of a rope that goes slack, more damping"};
}

std::vector<Diagnostic> shared_pull_warnings(const std::filesystem::path& file,
                                             const std::vector<SharedPull>& coarse) {
  std::vector<Diagnostic> warnings;
  for (const SharedPull& at : coarse)
    warnings.push_back(
        {Severity::warning, file.string() + ": beam \"" + at.beam + "\"",
         "the support at s = " + text_of(at.s, 6) + " m takes up " + text_of(at.pull, 3) +
             " N along the beam, and elements that are smooth across it share that with other supports only "
             "roughly: axial forces beside it, here up to " +
             text_of(at.force, 3) + " N, and reactions along the beam may be off by about " +
             text_of(at.error, 2) +
             " N; draw two beams that are joined there, which is exact, or take shorter elements (half as "
             "long: half as much)"});
  return warnings;
}

std::optional<Diagnostic> short_steps_note(const std::filesystem::path& file, const SimulationReport& run) {
  constexpr double noticed = 0.1;  // of the steps
  if (static_cast<double>(run.cut_steps) < noticed * static_cast<double>(run.steps) || run.cut_steps == 0)
    return {};
  return Diagnostic{
      Severity::note, file.string() + ": analysis.step",
      std::to_string(run.cut_steps) + " of " + std::to_string(run.steps) + " steps were shorter, down to " +
          text_of(run.shortest_cut, 3) +
          " s: a body that is carried as a node slides over a fifth of the element beside it in a step, at "
          "most (three tenths with \"radau\"); longer elements or \"carried_as\": \"point\" leave steps as "
          "long as asked for"};
}

std::vector<Diagnostic> given_up_node_notes(const std::filesystem::path& file, const SimulationReport& run,
                                            const BeamModel& model) {
  std::vector<Diagnostic> notes;
  for (const PointForGood& point : run.points_for_good) {
    const Rider& joint = model.riders[point.rider];
    notes.push_back(
        {Severity::note, file.string() + ": sliding joint of \"" + model.body_of(joint).name + "\"",
         "at t = " + text_of(point.time, 6) + " s, at s = " + text_of(point.s, 6) + " m of beam \"" +
             model.beam_of(joint).name +
             "\", a mesh adaptation beside its node would have changed the energy by " +
             text_of(point.energy, 3) +
             " J: from there on the body is a point of a fixed mesh, which conserves it; with more elements "
             "the node can stay, and \"carried_as\": \"point\" has none from the start"});
  }
  return notes;
}

std::optional<Diagnostic> divergence_warning(const std::filesystem::path& file, const SimulationReport& run) {
  if (!run.diverges) return {};
  return Diagnostic{
      Severity::warning, file.string() + ": loads",
      "the equilibrium is unstable, and no stable one was found: loads that follow the section and moments "
      "in space have no energy with a minimum; a damped dynamic analysis shows where the model goes"};
}

std::optional<Diagnostic> snap_warning(const std::filesystem::path& file, const SimulationReport& run,
                                       const BeamModel& model) {
  if (!run.snap) return {};
  const auto [load, t] = *run.snap;
  const double factor = t > 0 ? t : 1;  // of a load step
  constexpr double slight = 0.01;       // of the loads: what hangs loosely finds its shape
  if (load > 0 && load * factor < slight) return {};
  constexpr int digits = 3;
  const std::string weight = text_of(load, digits) + " of its weight",
                    loads = text_of(load * factor, digits) + " of its loads";
  const bool has_weight = model.gravity.norm() > 0;
  // Weight is there in full in all load steps, and comes with the first of them.
  const bool in_first_step = has_weight && load < 1 && factor != 1;
  const std::string under = load == 0       ? "buckles without any load, by tension or lengths alone"
                            : in_first_step ? "snaps through or buckles under " + weight + " and " + loads
                                            : "snaps through or buckles under " + loads;
  const bool by_steps = load > 0 && !in_first_step && !model.forces.empty();
  return Diagnostic{
      Severity::warning, file.string() + ": loads",
      "the model " + under +
          ": the path from zero load reaches a limit or bifurcation point there; the answer lies on "
          "another path and may not be unique; " +
          (by_steps ? "\"load_steps\" show the path up to there, " : "") + "a damped dynamic analysis " +
          (by_steps ? "" : "shows ") + "where it goes from there"};
}

std::optional<Diagnostic> mechanism_warning(const std::filesystem::path& file, const SimulationReport& run,
                                            const BuiltModel& built) {
  if (!run.loose) return {};
  const LoosePart& loose = *run.loose;
  constexpr int digits = 3;
  const auto component = [](double value) { return text_of(std::abs(value) < 1e-3 ? 0 : value, digits); };
  const Eigen::Vector3d direction = built.frame.direction_to_world(loose.direction);
  return Diagnostic{
      Severity::warning, file.string() + ": supports",
      "nothing resists a motion of the model in which " +
          (loose.is_body
               ? "body \"" + loose.name + "\" moves furthest"
               : "beam \"" + loose.name + "\" moves furthest, at s = " + text_of(loose.s, 6) + " m") +
          ", along [" + component(direction[0]) + ", " + component(direction[1]) + ", " +
          component(direction[2]) + "]" + turns_about_text(built.model, loose) +
          ": the equilibrium that was found is one of many; lock what moves, or let a load or gravity "
          "decide"};
}

std::optional<Diagnostic> energy_warning(const CaseFile& c, const SimulationReport& run) {
  const double noticed = std::max(0.05 * run.energy_scale(), run.energy_round_off());
  const bool between_events = run.integration_error > noticed;
  if (!between_events && !(run.energy_drift > noticed)) return {};
  std::ostringstream message;
  message << "the total energy, less the work of loads and motions, changed by "
          << (between_events ? run.integration_error : run.energy_drift)
          << " J, where kinetic, strain and gravity energy change by up to " << run.energy_scale()
          << " J: do not trust the result; ";
  if (std::ranges::any_of(c.beams, [](const CaseBeam& beam) { return beam.form == Form::virtual_work; }))
    message
        << "\"form\": \"virtual-work\" is the papers', for comparison, whose elements lose and win energy "
           "as they move over the material: leave it out";
  else if (between_events)
    message << "take a shorter \"step\" or a \"tolerance\"";
  else
    message << "nodes were removed where the mesh is too coarse: take more elements or, for a cable that "
               "hardly resists bending, \"slope\": \"discontinuous\"";
  return Diagnostic{Severity::warning, c.path.string() + ": analysis", message.str()};
}

}  // namespace nurbeam
