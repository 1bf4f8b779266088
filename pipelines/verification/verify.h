#pragma once
#include <functional>
#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

#include "pipelines/model/features.h"
#include "pipelines/results/evidence.h"

namespace nurbeam {

/// One number of a verification problem beside what it should be.
struct VerifyRow {
  std::string quantity;  ///< with its unit
  double reference;
  std::string source;  ///< of the reference
  double computed;
  double tolerance;       ///< on the error
  bool at_least = false;  ///< more than the reference is no error (orders of convergence)

  double error() const;
  bool passes() const;  ///< never for what is not a number
};

/// Errors as something is refined: elements, steps, ...
struct ConvergenceTable {
  std::string quantity;  ///< whose error, with its unit
  std::string refined;   ///< what the first column counts, with its unit
  std::vector<std::pair<double, double>> rows;

  /// Observed order from row i to row i + 1: log(error ratio) / log(refinement), positive when errors fall.
  double order(std::size_t i) const;
  double least_order() const;
};

struct VerifyResult {
  std::vector<VerifyRow> rows;
  std::vector<ConvergenceTable> tables;
  Features features = {};  ///< of all models and analyses it was computed with

  void add(std::string quantity, double reference, std::string source, double computed, double tolerance);
  /// The table, and a row that asks for an order of at least `expected` up to the tolerance between any two
  /// successive rows of it.
  void add(ConvergenceTable table, double expected, double tolerance, std::string source);
};

/// A problem with a known answer.
struct VerifyProblem {
  std::string name;
  std::string measures;  ///< curvature measure, strain law and stress-free state of what is computed
  std::function<VerifyResult()> run;
};

/// All built-in problems, in the order of the table.
std::vector<VerifyProblem> verification_problems();
/// Its families.
std::vector<VerifyProblem> statics_problems();
std::vector<VerifyProblem> limit_problems();
std::vector<VerifyProblem> experiment_problems();
std::vector<VerifyProblem> axial_strain_problems();
std::vector<VerifyProblem> dynamics_problems();
std::vector<VerifyProblem> sliding_problems();
std::vector<VerifyProblem> invariance_problems();
std::vector<VerifyProblem> torsion_problems();
std::vector<VerifyProblem> torsion_stability_problems();
std::vector<VerifyProblem> torsion_flight_problems();
std::vector<VerifyProblem> modes_problems();
std::vector<VerifyProblem> resistance_problems();
std::vector<VerifyProblem> torsion_sliding_problems();
std::vector<VerifyProblem> mechanics_problems();
std::vector<VerifyProblem> train_problems();
std::vector<VerifyProblem> energy_problems();
std::vector<VerifyProblem> rope_problems();
std::vector<VerifyProblem> eyelet_problems();
/// Rigid bodies: alone and joined, driven, with what is felt on rails.
std::vector<VerifyProblem> body_problems();
std::vector<VerifyProblem> drive_problems();
std::vector<VerifyProblem> felt_problems();
/// Ropes on reels, and masses and tethers in frames that turn.
std::vector<VerifyProblem> reel_problems();
std::vector<VerifyProblem> collector_problems();
std::vector<VerifyProblem> rope_motion_problems();
/// Supports that turn and slide, rotational connectors.
std::vector<VerifyProblem> turning_problems();

/// Runs the problems, as many at a time as there are processors, in their order; what is done so far is
/// printed to `progress`. A problem that throws is one failed row.
std::vector<VerifyResult> run_all(const std::vector<VerifyProblem>& problems, std::ostream& progress);

/// Prints the table of results. Returns the exit code: 0, or 1 when a row fails.
int print_results(const std::vector<VerifyProblem>& problems, const std::vector<VerifyResult>& results,
                  std::ostream& out);

/// What the results are evidence for. Numbers that are 0 as they should be, by symmetry, do not count.
std::vector<VerifiedProblem> verified(const std::vector<VerifyProblem>& problems,
                                      const std::vector<VerifyResult>& results);

}  // namespace nurbeam
