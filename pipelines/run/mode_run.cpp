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

/// The part by which a frequency is too high without shear and rotary inertia: of a beam on two supports with
/// the same half wave, by Timoshenko's equation 1 - (1 + a + a b) x + a^2 b x^2 = 0, where
///   x = (omega/omega of Euler's beam)^2, a = (pi i/half wave)^2, i the radius of gyration, b = E/(kappa G).
double excess_without_shear(double diameters, double modulus_over_shear) {
  constexpr double kappa = 0.89, radii = 4;  // of a disk: shear factor, and diameter over i
  const double a = std::pow(std::numbers::pi / (radii * diameters), 2), b = modulus_over_shear / kappa;
  const double p = 1 + a + a * b;
  return std::sqrt((p + std::sqrt(p * p - 4 * a * a * b)) / 2) - 1;
}

void note_waves(const BendingWave& wave, const BeamModel& model, ModeRow& row) {
  constexpr double usual = 2.6;  // E/G with a ratio of 0.3
  if (wave.beam < 0) return;
  const Material& material = model.beams[wave.beam].material;
  row.diameters = wave.diameters;
  row.excess = excess_without_shear(
      wave.diameters, material.shear_modulus ? material.youngs_modulus / *material.shear_modulus : usual);
}

void note_resolution(const WaveResolution& of, const BeamModel& model, ModeRow& row) {
  if (of.beam < 0) return;
  row.per_half_wave = of.per_half_wave;
  row.beam = model.beams[of.beam].name;
  row.elements = of.elements;
}

}  // namespace

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
      table.rows.push_back({mode.omega, mode.factor, built.frame.direction_to_world(mode.participation),
                            mode.round_off, mode.whirl});
      if (mode.omega > 0) note_waves(bending_wave(found.at, mode), built.model, table.rows.back());
      if (mode.omega != 0 || mode.factor != 0)
        note_resolution(wave_resolution(found.at, mode), built.model, table.rows.back());
    }
  }
  report.motion_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

std::optional<Diagnostic> short_waves_warning(const std::filesystem::path& file, const ModeTable& table) {
  constexpr double shortest = 10;  // diameters
  constexpr int digits = 2;
  const auto is_short = [](const ModeRow& row) { return row.diameters < shortest; };
  const auto first = std::ranges::find_if(table.rows, is_short);
  if (first == table.rows.end()) return std::nullopt;
  const auto last = std::ranges::max_element(
      table.rows, {}, [&](const ModeRow& row) { return is_short(row) ? row.excess : -1; });
  const auto count = std::ranges::count_if(table.rows, is_short);
  const auto name = [&](const auto& row) { return "mode " + std::to_string(row - table.rows.begin() + 1); };
  const auto percent = [](const ModeRow& row) { return text_of(100 * row.excess, digits) + " %"; };
  std::string message =
      name(first) + " bends in half waves of " + text_of(first->diameters, digits) +
      " diameters of the beam: without shear and rotary inertia, which the beams leave out, "
      "its frequency is about " +
      percent(*first) + " too high";
  if (count > 1)
    message += ", that of " + name(last) + " (" + text_of(last->diameters, digits) + " diameters) " +
               percent(*last) + "; " + std::to_string(count) + " of the modes are below ten diameters";
  return Diagnostic{Severity::warning, file.string() + ": analysis.modes",
                    message + "; use Timoshenko beams or solid elements for them"};
}

std::optional<Diagnostic> coarse_waves_warning(const std::filesystem::path& file, const ModeTable& table) {
  constexpr double least = 2, near = 0.05;  // elements a half wave
  constexpr int digits = 2;
  const auto is_coarse = [](const ModeRow& row) { return row.per_half_wave < least - near; };
  const auto first = std::ranges::find_if(table.rows, is_coarse);
  if (first == table.rows.end()) return std::nullopt;
  const auto worst = std::ranges::min_element(table.rows, {}, &ModeRow::per_half_wave);
  const auto count = std::ranges::count_if(table.rows, is_coarse);
  const auto name = [&](const auto& row) { return "mode " + std::to_string(row - table.rows.begin() + 1); };
  const int needed = static_cast<int>(std::ceil(least * worst->elements / worst->per_half_wave));
  std::string message = name(first) + " moves beam \"" + first->beam + "\" in half waves of " +
                        text_of(first->per_half_wave, digits) + " elements";
  if (count > 1)
    message += ", and " + name(worst) + " beam \"" + worst->beam + "\" in half waves of " +
               text_of(worst->per_half_wave, digits) + "; " + std::to_string(count) +
               " of the modes have fewer than two";
  return Diagnostic{Severity::warning, file.string() + ": analysis.modes",
                    message + ": the mesh does not follow " + (count > 1 ? "them" : "it") + ", and " +
                        (table.buckling ? "factors" : "frequencies") +
                        " are too high, by some percent or more; give beam \"" + worst->beam + "\" " +
                        std::to_string(needed) + " elements or more"};
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
