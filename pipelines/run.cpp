#include "pipelines/run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <optional>
#include <sstream>

#include "cad_import/export_curves.h"
#include "pipelines/build_model.h"
#include "pipelines/export_results.h"
#include "pipelines/file_hash.h"
#include "pipelines/print_diagnostics.h"
#include "pipelines/progress.h"
#include "pipelines/results.h"
#include "pipelines/results_directory.h"
#include "pipelines/run_summary.h"
#include "pipelines/signals.h"
#include "pipelines/simulation.h"

namespace nurbeam {

namespace {

enum ExitCode { done = 0, bad_input = 2, not_converged = 3, not_written = 4, interrupted = 130 };

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<double> output_times(const CaseFile& c) {
  const double end = c.analysis.end_time;
  std::vector<double> times;
  const double every = c.output.every.value_or(end / 100);
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

SimulationOptions simulation_options(const CaseFile& c) {
  SimulationOptions options;
  const CaseAnalysis& a = c.analysis;
  options.statics = a.type == CaseAnalysis::Type::statics;
  options.start_from_equilibrium = a.start_from_equilibrium;
  options.end_time = a.end_time;
  options.step = a.step;
  if (a.method == CaseAnalysis::Method::ida)
    options.integrator = Ida{.tolerance = a.tolerance.value_or(Ida{}.tolerance)};
  else if (a.method == CaseAnalysis::Method::rk4)
    options.integrator = ExplicitRungeKutta{};
  else
    options.integrator = GeneralizedAlpha{.rho_infinity = a.rho_infinity,
                                          .tolerance = a.step ? 0 : a.tolerance.value_or(1e-4)};
  options.length_control = {a.length_control_min, a.length_control_max};
  if (!options.statics) options.output_times = output_times(c);
  return options;
}

void to_world(const ModelFrame& f, PointRecord& p) {
  p.position = f.to_world(p.position);
  p.velocity = f.direction_to_world(p.velocity);
}

Frame to_world(const ModelFrame& f, Frame frame) {
  for (PointRecord& p : frame.probes) to_world(f, p);
  for (BodyRecord& body : frame.bodies) {
    to_world(f, body.point);
    body.joint_force = f.direction_to_world(body.joint_force);
  }
  for (BeamRecord& beam : frame.beams) {
    for (ElementRecord& e : beam.elements)
      for (int i = 0; i < 4; ++i) {
        const double w = e.control_points(3, i);
        const Eigen::Vector3d p = f.to_world(e.control_points.col(i).head<3>() / w);
        e.control_points.col(i).head<3>() = w * p;
        e.velocity.col(i) = f.direction_to_world(e.velocity.col(i));
      }
    for (Eigen::Vector3d& p : beam.node_positions) p = f.to_world(p);
    for (Eigen::Vector3d& p : beam.node_slopes) p = f.direction_to_world(p);
  }
  frame.energy.gravity += f.gravity_energy;
  frame.energy.total += f.gravity_energy;
  return frame;
}

// Writes deformed curves at the frames whose times the case asks for.
class CadOutput {
 public:
  CadOutput(const CaseFile& c, const BuiltModel& built, const std::filesystem::path& directory)
      : case_(c), built_(built), directory_(directory) {}

  void write(const Frame& frame, std::vector<std::filesystem::path>& files) const {
    const bool statics = case_.analysis.type == CaseAnalysis::Type::statics;
    const double same = 1e-9 * std::max(case_.analysis.end_time, 1e-9);
    const bool asked = std::any_of(case_.output.cad_times.begin(), case_.output.cad_times.end(),
                                   [&](double t) { return std::abs(t - frame.time) < same; });
    if (!asked && !statics) return;
    std::vector<NamedCurve> curves;
    for (std::size_t b = 0; b < frame.beams.size(); ++b)
      curves.push_back({built_.curve_names[b], deformed_curve(frame.beams[b].elements)});
    for (const std::string& format : case_.output.cad_formats) {
      std::ostringstream name;
      name << "deformed";
      if (!statics) name << "_t" << frame.time;
      name << (format == "iges" ? ".igs" : ".step");
      export_curves(directory_ / name.str(), curves, parse_length_unit(case_.output.cad_unit));
      files.emplace_back(name.str());
    }
  }

 private:
  const CaseFile& case_;
  const BuiltModel& built_;
  std::filesystem::path directory_;
};

FrameNames frame_names(const BuiltModel& built) {
  FrameNames names;
  for (const Probe& probe : built.probes) names.probes.push_back(probe.name);
  for (const Body& body : built.model.bodies) names.bodies.push_back(body.name);
  for (const Beam& beam : built.model.beams) names.beams.push_back(beam.name);
  return names;
}

// A warning when energy changes in a run where nothing does work but the weight.
std::optional<Diagnostic> energy_warning(const CaseFile& c, const SimulationReport& run) {
  constexpr double noticed = 0.05;  // of the largest kinetic energy
  const bool driven = !c.loads.empty() ||
                      std::any_of(c.sliding_joints.begin(), c.sliding_joints.end(), [](const auto& joint) {
                        return joint.motion_speed || !joint.motion_table.empty();
                      });
  const bool stopped = std::any_of(run.events.begin(), run.events.end(),
                                   [](const RunEvent& event) { return event.kind == "stopped at the end"; });
  const bool between_events = run.integration_error > noticed * run.peak_kinetic_energy;
  const bool over_events = !stopped && run.energy_drift > noticed * run.peak_kinetic_energy;
  if (driven || !(between_events || over_events)) return {};
  std::ostringstream message;
  message << "the total energy changed by " << (between_events ? run.integration_error : run.energy_drift)
          << " J, with a largest kinetic energy of " << run.peak_kinetic_energy
          << " J: do not trust the result; ";
  if (between_events)
    message << "take a shorter \"step\" or a \"tolerance\"";
  else
    message << "nodes were removed where the mesh is too coarse: take more elements or, for a cable that "
               "hardly resists "
               "bending, \"slope\": \"discontinuous\"";
  return Diagnostic{Severity::warning, c.path.string() + ": analysis", message.str()};
}

std::string status_text(SimulationStatus status, const std::string& message) {
  return status == SimulationStatus::done ? "done" : message;
}

ExitCode exit_code(SimulationStatus status) {
  switch (status) {
    case SimulationStatus::done:
      return done;
    case SimulationStatus::not_converged:
      return not_converged;
    case SimulationStatus::interrupted:
      return interrupted;
  }
  return not_converged;
}

}  // namespace

int run_case(const CaseFile& c, const RunOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const BuildReport report = build_model(c);
  print_diagnostics(std::cerr, report.diagnostics);
  if (!report.value) return bad_input;
  const BuiltModel& built = *report.value;

  RunSummary summary;
  summary.version = NURBEAM_VERSION;
  summary.case_name = c.name;
  summary.diagnostics = report.diagnostics;
  summary.wall_times.import = built.import_seconds;
  summary.wall_times.model = seconds_since(start) - built.import_seconds;
  summary.inputs.push_back({c.path, sha256_of_file(c.path)});
  for (const auto& file : built.inputs) summary.inputs.push_back({file, sha256_of_file(file)});

  try {
    const ResultsDirectory directory(options.out);
    ResultsWriter results(options.out, frame_names(built), c.name);
    const CadOutput cad(c, built, options.out);
    Progress progress(std::cerr, Progress::style_of_stderr(options.quiet), 0, c.analysis.end_time);
    std::vector<ProbePlace> probes;
    for (const Probe& probe : built.probes) probes.push_back({probe.beam, probe.s});

    const InterruptGuard guard;
    SimulationObserver observer;
    observer.interrupted = [&] { return guard.interrupted(); };
    observer.progress = [&](double t) { progress.update(t); };
    observer.frame = [&](const Frame& local) {
      const auto output_start = std::chrono::steady_clock::now();
      const Frame frame = to_world(built.frame, local);
      results.write(frame);
      cad.write(frame, summary.files);
      summary.wall_times.output += seconds_since(output_start);
    };
    const SimulationReport simulated = simulate(built.model, probes, simulation_options(c), observer);
    progress.finish();
    results.finish();

    summary.status = status_text(simulated.status, simulated.message);
    summary.wall_times.motion = simulated.motion_seconds - summary.wall_times.output;
    summary.wall_times.length_control = simulated.length_control_seconds;
    summary.end_time = simulated.time;
    summary.steps = simulated.steps;
    summary.rejected_steps = simulated.rejected_steps;
    summary.newton_iterations = simulated.newton_iterations;
    summary.energy_drift = simulated.energy_drift;
    summary.events = simulated.events;
    for (RunEvent& event : summary.events) {
      event.energy_before += built.frame.gravity_energy;
      event.energy_after += built.frame.gravity_energy;
      event.momentum_before = built.frame.direction_to_world(event.momentum_before);
      event.momentum_after = built.frame.direction_to_world(event.momentum_after);
    }
    for (const char* name : {"histories.csv", "results.nc", "run.json"}) summary.files.emplace_back(name);
    if (const auto warning = energy_warning(c, simulated)) {
      print_diagnostics(std::cerr, {*warning});
      summary.diagnostics.push_back(*warning);
    }
    write_run_summary(options.out / "run.json", summary);
    if (simulated.status != SimulationStatus::done)
      std::cerr << c.path.string() << ": error: " << simulated.message << "\n";
    return exit_code(simulated.status);
  } catch (const std::runtime_error& problem) {
    std::cerr << "error: " << problem.what() << "\n";
    return not_written;
  }
}

int check_case(const CaseFile& c) {
  const BuildReport report = build_model(c);
  print_diagnostics(std::cerr, report.diagnostics);
  if (!report.value) return bad_input;
  const BeamModel& model = report.value->model;
  const MeshPlan plan = initial_plan(model);
  const int dofs = model.dimension == 2 ? make_mesh<2>(model, plan).coordinate_count
                                        : make_mesh<3>(model, plan).coordinate_count;
  std::printf("case      %s\n", c.name.c_str());
  std::printf("model     %s, %d coordinates\n", model.dimension == 2 ? "planar" : "spatial", dofs);
  for (const Beam& beam : model.beams) {
    const double L = beam.curve.length();
    double shortest = L, longest = 0;
    for (std::size_t i = 1; i < beam.home.size(); ++i) {
      const double length = beam.home[i].s - beam.home[i - 1].s;
      shortest = std::min(shortest, length);
      longest = std::max(longest, length);
    }
    std::printf(
        "beam      %s: length %.9g m, mass %.6g kg, %d CAD segments, %zu elements of %.6g to %.6g m, "
        "EA %.6g N, EI %.6g N m^2, stress-free %s\n",
        beam.name.c_str(), L, L * beam.properties.mass_per_length, beam.curve.segment_count(),
        beam.home.size() - 1, shortest, longest, beam.properties.axial_stiffness,
        beam.properties.bending_stiffness, beam.straight ? "straight" : "as drawn");
  }
  for (const SlidingJoint& joint : model.joints)
    std::printf("joint     %s (%.6g kg) on %s at s = %.9g m\n", model.bodies[joint.body].name.c_str(),
                model.bodies[joint.body].mass, model.beams[joint.beam].name.c_str(), joint.s);
  for (const BeamJoint& joint : model.beam_joints)
    std::printf("joint     %s at s = %.9g m and %s at s = %.9g m, %s\n",
                model.beams[joint.beam_a].name.c_str(), joint.s_a, model.beams[joint.beam_b].name.c_str(),
                joint.s_b, joint.rigid ? "rigid" : "hinged");
  std::printf("supports  %zu, point loads %zu, distributed loads %zu\n", model.supports.size(),
              model.point_loads.size(), model.line_loads.size());
  return done;
}

}  // namespace nurbeam
