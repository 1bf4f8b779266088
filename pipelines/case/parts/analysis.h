#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "fem/motion/remesh/mesh_rules.h"
#include "fem/motion/run/integrators.h"
#include "pipelines/case/fields.h"

namespace nurbeam {

/// Of modes and buckling.
struct CaseModes {
  int count = 10;
  bool about_equilibrium = true;  ///< else as drawn, without loads
  bool bodies_held = true;
  std::vector<double> speeds =
      {};  ///< of rotors, or of the frame, of each a set of modes [rad/s], increasing
};

/// What is asked of the errors of mesh and step.
struct CaseAccuracy {
  bool is_on = false;
  std::optional<double> target = {};  ///< part of the scales; empty: no refinement
  std::vector<std::string> of = {};   ///< names of numbers; empty: the usual ones
  double limit = 64;                  ///< most work, over that of the plain run
};

struct CaseAnalysis {
  enum class Type { dynamic, statics, modes, buckling } type = Type::dynamic;
  CaseModes modes;
  bool start_from_equilibrium = false;
  double end_time = 0;               ///< [s]; of a static analysis the last of its factors
  std::vector<double> load_factors;  ///< of a static analysis, increasing; empty: 1
  bool reads_tables = false;         ///< at the factor, of a static analysis (has_tables)
  std::optional<double> step;        ///< fixed steps [s]; else those of the integrator's tolerance
  IntegratorSettings integrator;
  LengthControl length_control;
  CaseAccuracy accuracy;

  /// Of the states of a static analysis; empty: one under full loads, in which nothing is read at a factor.
  std::vector<double> factors() const {
    return load_factors.empty() && reads_tables ? std::vector<double>{1} : load_factors;
  }
  /// Whether a time that is asked for is that of a state.
  bool is_same_time(double a, double b) const { return std::abs(a - b) < 1e-9 * std::max(end_time, 1e-9); }
  bool has_modes() const { return type == Type::modes || type == Type::buckling; }
  /// An explicit method, which is for models without constraints between moving parts.
  bool is_explicit() const { return std::holds_alternative<ExplicitRungeKutta>(integrator); }
};

/// The shape of "analysis"; case_analysis.h reads it.
Shape analysis_shape();

/// What a target of accuracy may be, in parts of the scales.
inline Range accuracy_target_range() {
  return {.lower = 1e-6, .upper = 0.5, .reason = "less is round-off, more no longer a measure"};
}

}  // namespace nurbeam
