#pragma once
#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "cad_import/report/diagnostic.h"
#include "pipelines/study/expression.h"

namespace nurbeam {

/// How the values of a variable are scattered; lengths and the like in SI units.
struct StudyDistribution {
  enum class Kind { uniform, normal, lognormal, triangular, gumbel, weibull } kind = Kind::uniform;
  /// uniform: lower, upper; triangular: lower, mode, upper; else mean and standard deviation.
  std::vector<double> parameters;
  std::optional<double> lower = {}, upper = {};  ///< where it is cut off
  /// What design variables make: of the parameter at this place; behind those stand `lower` and `upper`.
  struct Formula {
    std::size_t place = 0;
    Expression value;
  };
  std::vector<Formula> formulas = {};  ///< the numbers above are theirs at the nominal design

  /// With the formulas worked out for a design; it has none left.
  StudyDistribution at(const ExpressionScope& design) const;
};

/// Numbers of the case file, all of which get the variable's value.
struct CasePaths {
  std::vector<std::string> paths;  ///< as --set has them
};

/// A coordinate of a control point of a beam's curve [m], in the coordinates of the case. Counted from 0.
struct ControlPointCoordinate {
  std::string beam;
  int index = 0, axis = 0;
};

/// The weight of a control point.
struct ControlPointWeight {
  std::string beam;
  int index = 0;
};

/// Moves control points of a beam's curve, all where none are listed: by the value [m] along `direction`;
/// turned by the value [degrees] about the axis `direction` through `about`; or scaled by the value from
/// `about`.
struct CurveTransform {
  enum class Kind { translate, rotate, scale, place } kind = Kind::translate;
  std::string beam;
  std::vector<int> points = {};
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< of unit length
  Eigen::Vector3d about = Eigen::Vector3d::Zero();      ///< [m]
};

/// Derivatives of quantities, a row for each, by the free variables.
using StudyGradient = std::vector<std::vector<double>>;

using StudyTarget = std::variant<CasePaths, ControlPointCoordinate, ControlPointWeight, CurveTransform>;

/// Knots that are put into the curve of a beam, which stays as it is but gets as many control points more.
struct StudyRefinement {
  std::string beam;
  std::string path;                ///< JSON path of this object, for messages
  std::vector<double> knots = {};  ///< to be inserted once each
  int parts = 1;                   ///< into which each span of the curve is divided
};

/// A change of the case for all variants.
struct StudyChange {
  std::string text;  ///< path=value, as --set has it
  std::string path;  ///< JSON path of this text, for messages
};

/// What a study varies.
struct StudyVariable {
  std::string name;
  std::string path;       ///< JSON path of this object, for messages
  std::string unit = {};  ///< of its values: SI, degrees of a rotation; "" for a plain number
  std::optional<StudyTarget> target = {};  ///< none: it only stands in expressions
  StudyDistribution distribution = {};
  double nominal = 0;                      ///< where a search begins
  bool is_random = false;                  ///< has a distribution, no range
  std::optional<Expression> derived = {};  ///< of other variables, instead of a distribution
};

/// The columns of study.csv beside those of variables and quantities.
inline constexpr std::array<std::string_view, 4> study_table_columns{"number", "status", "wall time [s]",
                                                                     "reason"};

/// What a study asks of a variant.
struct StudyQuantity {
  std::string name, unit;
  std::string path;
  Expression value;
  bool observed = false;  ///< of a calibration, at the time of a measurement: behind all others
};

/// Which variants a study runs.
struct StudyPlan {
  enum class Kind { list, grid, latin_hypercube, sobol, monte_carlo } kind = Kind::list;
  std::vector<std::vector<double>> rows = {};  ///< of a list: values of the free variables
  std::vector<int> levels = {};                ///< of a grid, per free variable
  int count = 0;                               ///< of the others
};

/// Sobol indices of a quantity.
struct StudySensitivity {
  std::vector<std::string> quantities;
  int count = 0;             ///< base sample: (free variables + 2) times as many runs
  double confidence = 0.95;  ///< of the intervals
};

/// The probability of `quantity` above or below a threshold.
struct StudyReliability {
  enum class Method { form, importance_sampling, monte_carlo } method = Method::form;
  std::string quantity;
  bool fails_above = true;
  double threshold = 0;
  int count = 1000;                     ///< of simulated points at most
  double coefficient_of_variation = 0;  ///< simulation ends below this; 0: never before the count
};

/// The best values of the variables within their ranges.
struct StudyOptimum {
  enum class Method { cobyla, nelder_mead, gradient, genetic } method = Method::cobyla;
  struct Objective {
    std::string quantity;
    bool minimise = true;
  };
  struct Constraint {
    Expression greater, lesser;  ///< of quantities and variables
    std::string text;            ///< as it is written
  };
  /// What is to be improbable: that `fails.greater` is above `fails.lesser`.
  struct Probability {
    Constraint fails;
    double least_index = 0;  ///< of reliability, b: the probability is to be Phi(-b) at most
  };
  std::vector<Objective> objectives;  ///< several: a Pareto front, by the genetic method
  std::vector<Constraint> constraints = {};
  std::vector<Probability> probabilities =
      {};                                      ///< where there are some, variables with ranges are the design
  std::optional<StudyReliability> check = {};  ///< by simulation, of these probabilities at the optimum
  int evaluations = 100;                       ///< at most
  double tolerance = 1e-4;                     ///< of the variables, as a part of their ranges
};

/// The values of the variables at which quantities are as they were measured.
struct StudyCalibration {
  /// What was measured of one history.
  struct Observation {
    std::string value;  ///< the expression
    std::string path;   ///< JSON path of this object, for messages
    std::vector<double> times, measured;
    double sd = 1;  ///< of the noise
  };
  std::vector<Observation> observations;  ///< their times are the observed quantities, in this order
  bool prior = false;                     ///< the distributions, all normal, are what is known before
  double confidence = 0.95;               ///< of the intervals and the region
  int evaluations = 200;                  ///< at most
};

/// Surrogates of the quantities, made of the rows of a plan.
struct StudySurrogate {
  enum class Kind { chaos, kriging } kind = Kind::chaos;
  int degree = 3;          ///< of the polynomials
  double held_back = 0.2;  ///< part of the rows that validates
};

using StudyTask = std::variant<StudyPlan, StudySensitivity, StudyReliability, StudyOptimum, StudyCalibration>;

/// A study file, resolved, valid as far as the file and its case can tell.
struct StudyFile {
  std::filesystem::path path;
  std::string json;  ///< as read, without comments
  std::string name;
  std::optional<std::filesystem::path> case_file = {};  ///< absolute; none where all quantities are formulas
  std::vector<StudyChange> changes = {};
  std::vector<StudyRefinement> refinements = {};  ///< of curves, before variables move them
  std::vector<StudyVariable> variables;
  std::vector<Expression> constraints = {};  ///< a variant for which one is 0 does not run
  std::vector<StudyQuantity> quantities;
  StudyTask task;
  std::optional<StudySurrogate> surrogate = {};
  unsigned seed = 1;
  std::optional<double> time_limit = {};  ///< of one variant, in wall time [s]
  bool derivatives = false;               ///< variants come with derivatives of the quantities
  bool derivatives_where_known = false;   ///< and without where there are none

  /// Indices of the variables that are not derived.
  std::vector<std::size_t> free_variables() const;
  /// Their nominal values.
  std::vector<double> nominal() const;
  /// Whether it searches a design of which probabilities are asked.
  bool has_random_design() const;
};

/// A study file and everything that is wrong with it; `value` is empty when any diagnostic is an error.
struct StudyFileReport {
  std::optional<StudyFile> value;
  std::vector<Diagnostic> diagnostics;
  std::optional<StudyFile> with_errors =
      {};  ///< instead, as far as it could be read, to look for more errors
};

/// Reads and checks a study file, all errors at once, each with its JSON path; the case is not read.
StudyFileReport read_study_file(const std::filesystem::path& file);

/// The JSON schema of the study file.
std::string study_file_schema();

}  // namespace nurbeam
