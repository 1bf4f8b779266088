#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/study/study_file.h"

/// What OpenTURNS makes of a study; its only home. Points are values of the free variables, in their order.
namespace nurbeam {

using StudyPoints = std::vector<std::vector<double>>;

/// The quantities of the variants at these points, in their order; empty for a variant that is not done.
/// Throws StudyInterrupted.
using StudyEvaluation = std::function<StudyPoints(const StudyPoints& points)>;

/// The derivatives of the quantities of the variant at a point; empty where it is not done. Throws likewise.
using StudyDerivatives = std::function<StudyGradient(const std::vector<double>& point)>;

struct StudyInterrupted {};

/// Keeps OpenTURNS from writing to the terminal: what matters of its warnings stands in the answers.
void silence_openturns();

/// Of what is left of it between its ends; empty where that is nothing, to its last digit.
std::optional<double> mean_of(const StudyDistribution& distribution);

/// The points of a plan.
StudyPoints plan_points(const StudyFile& study, const StudyPlan& plan);

/// Sobol indices of one quantity: by variable, with the ends of their confidence intervals.
struct SobolIndices {
  struct Index {
    double value = 0, lower = 0, upper = 0;
  };
  std::string quantity;
  std::vector<Index> first_order, total_order;  ///< all 0 where it is the same in all variants
};
struct SensitivityResult {
  std::vector<SobolIndices> indices;
  int rows_left_out = 0;  ///< of the base sample, because a variant of theirs is not done
};
/// By Saltelli's estimators; the intervals are as wide as the estimates scatter over samples that are drawn
/// from the given one. Throws std::runtime_error where fewer than half of the variants are done.
SensitivityResult sobol_indices(const StudyFile& study, const StudySensitivity& sensitivity,
                                const StudyEvaluation& evaluate);

struct ReliabilityResult {
  double probability = 0;
  /// The standard deviation of the estimate over it; nothing where it is no estimate.
  std::optional<double> coefficient_of_variation = {};
  std::optional<double> reliability_index = {};  ///< Hasofer and Lind's; below 0 where the origin fails
  std::vector<double> design_point = {};         ///< of the free variables, where FORM finds one
  std::vector<double> importance = {};           ///< of each free variable there, their sum is 1; empty: none
  int not_done = 0;  ///< variants that are not done: a simulation counts them as ones that do not fail
};
/// With derivatives where they are given. Throws std::runtime_error where the method does not end.
ReliabilityResult failure_probability(const StudyFile& study, const StudyReliability& reliability,
                                      const StudyEvaluation& evaluate,
                                      const StudyDerivatives& derivatives = {});

/// The reliability index of a probability of failure, -Phi^-1(probability) [-].
double index_of(double probability);

/// What is known of a probability at an optimum that is subject to it.
struct ProbabilityResult {
  std::string text;        ///< of the constraint
  double least_index = 0;  ///< that it asks for
  ReliabilityResult form;  ///< FORM's
  /// The derivatives of the reliability index by the design variables: (dg/dd) / |dg/du| at the design point.
  std::vector<double> index_gradient = {};
  std::optional<ReliabilityResult> check = {};  ///< by simulation, where the study asks for one
};

struct OptimumResult {
  /// One point, or those of the Pareto front, the best one in the first objective first.
  StudyPoints points;
  StudyPoints quantities;  ///< of each
  std::vector<double>
      history;  ///< the best objective so far that holds the constraints, after each variant; NaN before
  bool cut_off = false;  ///< the search ended because it had no more variants
  /// Where and why a search came to no end that holds its constraints; empty where it did.
  std::string not_converged = {};
  std::vector<ProbabilityResult> probabilities = {};  ///< that it is subject to, in their order
  std::vector<std::string> doubts = {};               ///< why a probability may be greater than is asked
};
/// With derivatives where they are given. Throws std::runtime_error where no variant holds the
/// constraints.
OptimumResult find_optimum(const StudyFile& study, const StudyOptimum& optimum,
                           const StudyEvaluation& evaluate, const StudyDerivatives& derivatives = {});

/// The same subject to probabilities: variables with a range are the design, those with a distribution are
/// random, and stand at their nominal values in objectives and other constraints. Each probability is held by
/// FORM's performance measure: where the limit state is least at the distance from the origin of standard
/// space that is asked for, it must not fail.
OptimumResult find_reliable_optimum(const StudyFile& study, const StudyOptimum& optimum,
                                    const StudyEvaluation& evaluate,
                                    const StudyDerivatives& derivatives = {});

/// What a calibration found.
struct CalibrationResult {
  std::vector<double> point;  ///< values of the free variables
  /// Of each: standard deviation, ends of its confidence interval; none where constraints are active.
  std::vector<double> sd, lower, upper;
  std::vector<std::vector<double>> covariance;  ///< of the free variables; likewise
  std::vector<std::string> active;              ///< constraints at whose edge the point is
  int degrees_of_freedom = 0;                   ///< of the noise that is estimated; 0: its sd is given
  /// Of what is left between measurement and run, in `sd`s: the estimated standard deviation of the noise,
  /// or the root mean square where its sd is given.
  double noise = 0;
  std::vector<double> quantities;  ///< of that point
  int evaluations = 0;
};
/// By nonlinear least squares, or with what is known before by Gauss' nonlinear calibration; the covariance
/// is that of the problem linear at the point. With derivatives where they are given and known, with
/// differences of variants elsewhere. Throws std::runtime_error where no point is found.
CalibrationResult calibrate(const StudyFile& study, const StudyCalibration& calibration,
                            const StudyEvaluation& evaluate, const StudyDerivatives& derivatives = {});

/// A function of the variables that stands for one quantity.
struct SurrogateResult {
  std::string quantity;
  double q2 = 0;             ///< part of the variance of the rows held back that it explains
  double largest_error = 0;  ///< at them
  /// Of polynomial chaos: the Sobol indices that its coefficients are.
  std::vector<double> first_order = {}, total_order = {};
};
/// Why no surrogate can be made of so many variants that are done; empty where one can.
std::string too_few_for(const StudySurrogate& surrogate, std::size_t variables, std::size_t variants);

/// Made of rows (`inputs` with `outputs`, all done). Throws std::runtime_error where there are too few.
std::vector<SurrogateResult> make_surrogates(const StudyFile& study, const StudySurrogate& surrogate,
                                             const StudyPoints& inputs, const StudyPoints& outputs);

}  // namespace nurbeam
