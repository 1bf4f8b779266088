#include "pipelines/run/mode_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>

#include "fem/motion/rest/mode_shape.h"
#include "fem/motion/rest/modes.h"
#include "nurbs/number_text.h"
#include "pipelines/run/simulation_plan.h"

namespace nurbeam {

namespace {

ModesOptions modes_options(const CaseAnalysis& a) {
  ModesOptions options;
  options.kind =
      a.type == CaseAnalysis::Type::buckling ? ModesOptions::Kind::buckling : ModesOptions::Kind::vibration;
  options.count = a.modes.count;
  options.about_equilibrium = a.modes.about_equilibrium;
  options.bodies_held = a.modes.bodies_held;
  options.length_control = a.length_control;
  return options;
}

/// Frames of one period, for ParaView: of a second where nothing swings.
std::vector<Snapshot> oscillation(const MeshedState& at, const Mode& mode,
                                  const std::vector<ProbePlace>& probes) {
  constexpr int frames = 24;
  const double amplitude = visible_amplitude(at, mode);
  const double period = mode.omega > 0 ? 2 * std::numbers::pi / mode.omega : 1;
  std::vector<Snapshot> turn;
  for (int i = 0; i <= frames; ++i) {
    const double phase = 2 * std::numbers::pi * i / frames;
    turn.push_back(
        record_mode(at, mode, amplitude * std::sin(phase), amplitude * mode.omega * std::cos(phase), probes));
    turn.back().time = period * i / frames;
  }
  return turn;
}

}  // namespace

SimulationReport run_modes(const CaseFile& c, const BuiltModel& built,
                           const std::function<bool()>& interrupted, const ModeShapes& shapes,
                           ModeTable& table) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<ProbePlace> probes = probe_places(built);
  const ModesReport found =
      find_modes(std::make_shared<const BeamModel>(built.model), modes_options(c.analysis), interrupted);
  SimulationReport report;
  report.steps = found.rest.load_steps;
  report.newton_iterations = found.rest.newton_iterations;
  if (found.rest.failure) report.fail(*found.rest.failure);
  if (found.rest.interrupted) report.status = SimulationStatus::interrupted;
  if (report.status == SimulationStatus::done) {
    shapes.state(record_snapshot(*found.at.system, found.at.state, probes));
    table.buckling = c.analysis.type == CaseAnalysis::Type::buckling;
    table.mass = found.mass;
    for (std::size_t i = 0; i < found.modes.size(); ++i) {
      const Mode& mode = found.modes[i];
      const double amplitude = visible_amplitude(found.at, mode);
      Snapshot shape = record_mode(found.at, mode, amplitude, amplitude * mode.omega, probes);
      shape.time = static_cast<double>(i + 1);
      shapes.shape(shape);
      if (c.output.paraview)
        shapes.turn("mode_" + std::to_string(i + 1), oscillation(found.at, mode, probes));
      table.rows.push_back(
          {mode.omega, mode.factor, built.frame.direction_to_world(mode.participation), mode.round_off});
    }
  }
  report.motion_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

std::optional<Diagnostic> round_off_warning(const std::filesystem::path& file, const BeamModel& model,
                                            const ModeTable& table) {
  constexpr double slight = 0.01, lowest = 1e-3;  // of omega^2; of the first omega that is not 0
  constexpr int rough = 3;                        // digits
  constexpr const char* cure = "; fewer elements have more digits";
  const auto warning = [&](const std::string& message) {
    return Diagnostic{Severity::warning, file.string() + ": analysis.modes", message + cure};
  };
  const auto vibration =
      std::find_if(table.rows.begin(), table.rows.end(), [](const ModeRow& row) { return row.omega > 0; });
  const bool is_attached = !model.constraints.empty() || !model.connectors.empty();
  const auto name = [&](const ModeRow& row) {
    return "mode " + std::to_string(&row - table.rows.data() + 1);
  };
  for (const ModeRow& row : table.rows) {
    const double resolved = std::sqrt(2 * row.round_off);
    // Whatever is free has rigid motions.
    if (row.omega == 0 && is_attached && vibration != table.rows.end() &&
        resolved > lowest * vibration->omega)
      return warning(name(row) + " need not be a rigid motion: a frequency below " +
                     text_of(resolved / (2 * std::numbers::pi), rough) +
                     " Hz cannot be told from 0 for round-off in the stiffness of so short elements");
  }
  for (const ModeRow& row : table.rows) {
    const double square = row.omega * row.omega;
    if (row.omega > 0 && row.round_off > slight * square)
      return warning("the frequency of " + name(row) + " is about " +
                     text_of(100 * row.round_off / (2 * square), rough) +
                     " % uncertain: round-off in the stiffness of so short elements");
  }
  return std::nullopt;
}

}  // namespace nurbeam
