#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <set>
#include <stdexcept>

#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/study/allowed_region.h"
#include "pipelines/study/openturns_study.h"

namespace nurbeam {

namespace {

constexpr double difference_step = 1e-3;  // of variables, in their units

/// Runs as functions of (number of a measurement, the variables), in units of the measurement's noise.
/// Instead of one that would be rejected the nearest that is not runs, and its derivatives say the rest.
/// Variables count from where the search begins, as parts of half their ranges or of their standard
/// deviations.
class MeasuredRuns {
 public:
  MeasuredRuns(const StudyFile& study, const StudyCalibration& calibration, const StudyEvaluation& evaluate,
               const StudyDerivatives& derivatives)
      : calibration_(calibration),
        evaluate_(evaluate),
        derivatives_(derivatives),
        region_(study, [this](const std::vector<double>& place) { return point_of(place); }) {
    for (const std::size_t i : study.free_variables()) {
      const StudyVariable& variable = study.variables[i];
      const std::vector<double>& p = variable.distribution.parameters;
      origin_.push_back(calibration.prior ? p[0] : variable.nominal);
      unit_.push_back(calibration.prior ? p[1] : (p[1] - p[0]) / 2);
    }
    for (const StudyCalibration::Observation& observation : calibration.observations)
      for (const double value : observation.measured) {
        measured_.push_back(value / observation.sd);
        sd_.push_back(observation.sd);
      }
    while (!study.quantities[first_].observed) ++first_;
  }

  std::size_t variables() const { return unit_.size(); }
  const std::vector<double>& measured() const { return measured_; }
  const std::vector<double>& units() const { return unit_; }
  int evaluations() const { return static_cast<int>(runs_.size()); }
  bool used_up() const { return used_up_; }
  void throw_if_stopped() const {
    if (stopped_) std::rethrow_exception(stopped_);
  }

  /// All quantities at this place.
  const std::vector<double>& quantities(const std::vector<double>& place) {
    return runs_.at(point_of(place));
  }
  AllowedRegion& region() { return region_; }
  /// The place itself, or what runs instead.
  std::vector<double> allowed(const std::vector<double>& place) {
    return region_.nearest(place).value_or(place);
  }
  std::vector<double> point_of(const std::vector<double>& place) const {
    std::vector<double> point;
    for (std::size_t i = 0; i < unit_.size(); ++i) point.push_back(origin_[i] + place[i] * unit_[i]);
    return point;
  }

  /// Of a row (number, place), by the place; nothing where there are none.
  std::vector<double> derivatives(const OT::Point& row) {
    const std::vector<double> place = allowed({row.begin() + 1, row.end()});
    const StudyGradient& of_quantities = gradient_at(place);
    if (of_quantities.empty()) return {};
    const auto number = static_cast<std::size_t>(std::lround(row[0]));
    std::vector<double> derivatives;
    for (std::size_t i = 0; i < unit_.size(); ++i)
      derivatives.push_back(of_quantities[first_ + number][i] * unit_[i] / sd_[number]);
    return derivatives;
  }
  /// Whether derivatives come with the run at a place, else they are differences.
  bool has_derivatives(const std::vector<double>& place) const {
    return with_derivatives_.contains(point_of(place));
  }
  /// Whether all runs that f() asks for are done.
  template <class Function>
  bool are_done(const Function& f) {
    all_done_ = true;
    f();
    return all_done_;
  }
  /// Of rows (number, place): each place runs once.
  std::vector<double> values(const OT::Sample& rows) {
    StudyPoints places;
    for (std::size_t r = 0; r < rows.getSize(); ++r) places.push_back(allowed(place_of(rows, r)));
    run(places);
    std::vector<double> values;
    for (std::size_t r = 0; r < rows.getSize(); ++r) {
      const auto number = static_cast<std::size_t>(std::lround(rows(r, 0)));
      const auto found = runs_.find(point_of(places[r]));
      constexpr double far_off = 1e6;  // what is not done: the search turns back
      const bool done = found != runs_.end() && !found->second.empty();
      all_done_ = all_done_ && done;
      values.push_back(done ? found->second[first_ + number] / sd_[number] + beyond(rows[r], places[r])
                            : far_off);
    }
    return values;
  }

 private:
  static std::vector<double> place_of(const OT::Sample& rows, std::size_t r) {
    const OT::Point row = rows[r];
    return {row.begin() + 1, row.end()};
  }

  /// How much more it is at a row than at the place that ran for it.
  double beyond(const OT::Point& row, const std::vector<double>& place) {
    const std::vector<double> wanted(row.begin() + 1, row.end());
    if (wanted == place) return 0;
    const std::vector<double> slopes = derivatives(row);
    double more = 0;
    for (std::size_t i = 0; i < slopes.size(); ++i) more += slopes[i] * (wanted[i] - place[i]);
    return more;
  }

  /// Of the quantities by the variables: of the run where it has them; where constraints are near,
  /// differences.
  const StudyGradient& gradient_at(const std::vector<double>& place) {
    const std::vector<double> point = point_of(place);
    const auto [at, is_fresh] = gradients_.try_emplace(point);
    StudyGradient& gradient = at->second;
    if (!is_fresh) return gradient;
    gradient = gradient_of_run(point);
    if (!gradient.empty()) with_derivatives_.insert(point);
    if (gradient.empty() && !region_.is_whole()) gradient = differences_at(place);
    return gradient;
  }
  StudyGradient gradient_of_run(const std::vector<double>& point) {
    if (!derivatives_ || stopped_) return {};
    try {
      return derivatives_(point);
    } catch (...) {  // the methods are written in C
      stopped_ = std::current_exception();
      return {};
    }
  }
  /// To both sides of a place, to one where the other would be rejected.
  StudyGradient differences_at(const std::vector<double>& place) {
    StudyPoints sides{place};
    for (std::size_t i = 0; i < place.size(); ++i)
      for (const double by : {-difference_step, difference_step}) {
        sides.push_back(place);
        sides.back()[i] += by;
        if (!region_.has(sides.back())) sides.back() = place;
      }
    run(sides);
    StudyPoints values;
    for (const std::vector<double>& side : sides) {
      const auto found = runs_.find(point_of(side));
      if (found == runs_.end() || found->second.empty()) return {};
      values.push_back(found->second);
    }
    StudyGradient slopes(values[0].size(), std::vector<double>(place.size()));
    for (std::size_t i = 0; i < place.size(); ++i) {
      const double between = (sides[2 * i + 2][i] - sides[2 * i + 1][i]) * unit_[i];
      for (std::size_t k = 0; k < slopes.size() && between > 0; ++k)
        slopes[k][i] = (values[2 * i + 2][k] - values[2 * i + 1][k]) / between;
    }
    return slopes;
  }

  void run(const StudyPoints& places) {
    StudyPoints fresh;
    for (const std::vector<double>& place : places) {
      const std::vector<double> point = point_of(place);
      if (!runs_.contains(point) && std::find(fresh.begin(), fresh.end(), point) == fresh.end())
        fresh.push_back(point);
    }
    if (fresh.empty() || stopped_) return;
    try {
      used_up_ = evaluations() >= calibration_.evaluations;
      if (used_up_)
        throw std::runtime_error("the calibration has not ended after " + std::to_string(evaluations()) +
                                 " variants; take more \"evaluations\" or narrower ranges");
      const StudyPoints quantities = evaluate_(fresh);
      for (std::size_t i = 0; i < fresh.size(); ++i) runs_[fresh[i]] = quantities[i];
    } catch (...) {  // the methods are written in C
      stopped_ = std::current_exception();
    }
  }

  const StudyCalibration& calibration_;
  const StudyEvaluation& evaluate_;
  const StudyDerivatives& derivatives_;
  AllowedRegion region_;
  std::map<std::vector<double>, StudyGradient> gradients_;
  std::set<std::vector<double>> with_derivatives_;  // of the run, of the points
  std::vector<double> origin_, unit_, measured_, sd_;
  std::size_t first_ = 0;  // of the observed quantities
  std::map<std::vector<double>, std::vector<double>> runs_;
  bool all_done_ = true, used_up_ = false;
  std::exception_ptr stopped_;
};

class MeasuredFunction : public OT::EvaluationImplementation {
 public:
  explicit MeasuredFunction(MeasuredRuns& runs) : runs_(&runs) {
    setInputDescription(OT::Description::BuildDefault(runs.variables() + 1, "x"));
    setOutputDescription({"y"});
  }
  MeasuredFunction* clone() const override { return new MeasuredFunction(*this); }
  OT::UnsignedInteger getInputDimension() const override { return runs_->variables() + 1; }
  OT::UnsignedInteger getOutputDimension() const override { return 1; }
  OT::Point operator()(const OT::Point& x) const override { return operator()(OT::Sample(1, x))[0]; }
  OT::Sample operator()(const OT::Sample& x) const override {
    const std::vector<double> values = runs_->values(x);
    OT::Sample result(values.size(), 1);
    for (std::size_t i = 0; i < values.size(); ++i) result(i, 0) = values[i];
    return result;
  }

 private:
  MeasuredRuns* runs_;
};

/// Where runs come without derivatives these are central differences over a thousandth of the unit.
class MeasuredGradient : public OT::GradientImplementation {
 public:
  explicit MeasuredGradient(MeasuredRuns& runs)
      : runs_(&runs),
        differences_(OT::Point(runs.variables() + 1, difference_step),
                     OT::Evaluation(MeasuredFunction(runs))) {}
  MeasuredGradient* clone() const override { return new MeasuredGradient(*this); }
  OT::UnsignedInteger getInputDimension() const override { return runs_->variables() + 1; }
  OT::UnsignedInteger getOutputDimension() const override { return 1; }
  OT::Matrix gradient(const OT::Point& x) const override {
    const std::vector<double> derivatives = runs_->derivatives(x);
    if (derivatives.empty()) return differences_.gradient(x);
    OT::Matrix result(getInputDimension(), 1);  // by the number: none
    for (std::size_t i = 0; i < derivatives.size(); ++i) result(i + 1, 0) = derivatives[i];
    return result;
  }

 private:
  MeasuredRuns* runs_;
  OT::CenteredFiniteDifferenceGradient differences_;
};

// With the variables as parameters.
OT::Function model_of(MeasuredRuns& runs) {
  OT::Function whole{MeasuredFunction(runs)};
  whole.setGradient(MeasuredGradient(runs));
  OT::Indices parameters(runs.variables());
  parameters.fill(1);
  return OT::ParametricFunction(whole, parameters, OT::Point(runs.variables()));
}

OT::CalibrationResult calibrated(const MeasuredRuns& runs, const OT::Function& model, bool prior) {
  OT::Sample numbers(runs.measured().size(), 1), measured(runs.measured().size(), 1);
  for (std::size_t i = 0; i < runs.measured().size(); ++i) {
    numbers(i, 0) = static_cast<double>(i);
    measured(i, 0) = runs.measured()[i];
  }
  const OT::Point start(runs.variables());
  const OT::CMinpack search;  // Levenberg and Marquardt
  if (prior) {
    OT::GaussianNonLinearCalibration algorithm(
        model, numbers, measured, start, OT::CovarianceMatrix(runs.variables()), OT::CovarianceMatrix(1));
    algorithm.setBootstrapSize(0);
    algorithm.setOptimizationAlgorithm(search);
    algorithm.run();
    return algorithm.getResult();
  }
  OT::NonLinearLeastSquaresCalibration algorithm(model, numbers, measured, start);
  algorithm.setBootstrapSize(0);
  algorithm.setOptimizationAlgorithm(search);
  algorithm.run();
  return algorithm.getResult();
}

// (measurements x variables) What the variables do to the measurements at a place, in units of both; empty
// where runs for that are not done.
Eigen::MatrixXd effects_at(MeasuredRuns& runs, const std::vector<double>& place) {
  const MeasuredGradient gradient(runs);
  Eigen::MatrixXd effects(static_cast<Eigen::Index>(runs.measured().size()),
                          static_cast<Eigen::Index>(runs.variables()));
  const bool done = runs.are_done([&] {
    for (Eigen::Index i = 0; i < effects.rows(); ++i) {
      OT::Point row(1, static_cast<double>(i));
      row.add(to_point(place));
      const OT::Matrix by = gradient.gradient(row);
      for (Eigen::Index k = 0; k < effects.cols(); ++k)
        effects(i, k) = by(static_cast<std::size_t>(k) + 1, 0);
    }
  });
  return done && effects.allFinite() ? effects : Eigen::MatrixXd();
}

// What is left between runs and measurements at a place, in units of the noise.
Eigen::VectorXd left_at(MeasuredRuns& runs, const std::vector<double>& place) {
  OT::Sample rows(0, runs.variables() + 1);
  for (std::size_t i = 0; i < runs.measured().size(); ++i) {
    OT::Point row(1, static_cast<double>(i));
    row.add(to_point(place));
    rows.add(row);
  }
  const std::vector<double> values = runs.values(rows);
  Eigen::VectorXd left(static_cast<Eigen::Index>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
    left[static_cast<Eigen::Index>(i)] = values[i] - runs.measured()[i];
  return left;
}

Eigen::VectorXd to_vector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

// Half the sum of squares, of what is known before too, under the constraints of the variables: where it is
// least, by slopes.
std::vector<double> least_within(const StudyFile& study, MeasuredRuns& runs, bool prior,
                                 const std::vector<double>& begin) {
  const StudyEvaluation none = [](const StudyPoints& places) { return StudyPoints(places.size()); };
  const double known = prior ? 1 : 0;
  const auto slopes = [&](const std::vector<double>& x) -> Eigen::VectorXd {
    const Eigen::MatrixXd effects = effects_at(runs, x);
    if (effects.size() == 0) return Eigen::VectorXd::Zero(static_cast<Eigen::Index>(x.size()));
    return effects.transpose() * left_at(runs, x) + known * to_vector(x);
  };
  const double unit = std::max(slopes(begin).norm(), 1e-12);
  OT::OptimizationProblem problem(study_function(
      study, none, 1,
      [&](const std::vector<double>&, const std::vector<double>& x) {
        const double squares = left_at(runs, x).squaredNorm() + known * to_vector(x).squaredNorm();
        return std::vector<double>{squares / 2 / unit};
      },
      [&](const std::vector<double>& x) {
        const Eigen::VectorXd by = slopes(x) / unit;
        return StudyGradient{{by.begin(), by.end()}};
      }));
  problem.setInequalityConstraint(study_function(
      study, none, runs.region().margins(begin).size(),
      [&](const std::vector<double>&, const std::vector<double>& x) { return runs.region().margins(x); },
      {}));
  std::vector<double> place = begin;
  constexpr int most_rounds = 20;
  constexpr double little = 1e-6;
  for (int i = 0; i < most_rounds; ++i) {
    OT::NLopt search(problem, "LD_SLSQP");
    search.setStartingPoint(to_point(place));
    search.setMaximumAbsoluteError(1e-9);
    search.setMaximumRelativeError(1e-9);
    search.setMaximumResidualError(0);
    search.setMaximumConstraintError(1e-9);
    std::vector<double> ended = place;
    try {
      search.run();
      ended = runs.allowed(from_point(search.getResult().getOptimalPoint()));
    } catch (const OT::Exception&) {  // steps have come down to round-off
    }
    const bool has_moved = (to_vector(ended) - to_vector(place)).norm() > little;
    place = ended;
    if (!has_moved) break;
  }
  return place;
}

// The constraints at whose edge a place is.
std::vector<std::string> active_at(MeasuredRuns& runs, const std::vector<double>& place) {
  constexpr double step = 1e-6, near = 1e-4;
  const std::vector<double> margins = runs.region().margins(place);
  Eigen::VectorXd slopes = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(margins.size()));
  for (std::size_t i = 0; i < place.size(); ++i) {
    std::vector<double> more = place, less = place;
    more[i] += step;
    less[i] -= step;
    const Eigen::VectorXd by =
        (to_vector(runs.region().margins(more)) - to_vector(runs.region().margins(less))) / (2 * step);
    slopes += by.cwiseAbs();
  }
  std::vector<std::string> active;
  for (std::size_t k = 0; k < margins.size(); ++k)
    if (margins[k] <= near * slopes[static_cast<Eigen::Index>(k)]) active.push_back(runs.region().text(k));
  return active;
}

// Of the problem linear at the place, in units of the variables.
OT::CovarianceMatrix covariance_at(MeasuredRuns& runs, const std::vector<double>& place, bool prior) {
  const Eigen::MatrixXd effects = effects_at(runs, place);
  Eigen::MatrixXd normal = effects.transpose() * effects;
  double variance = 1;
  if (prior)
    normal.diagonal().array() += 1;
  else
    variance = left_at(runs, place).squaredNorm() / static_cast<double>(effects.rows() - effects.cols());
  const Eigen::MatrixXd inverse = variance * normal.inverse();
  OT::CovarianceMatrix covariance(runs.variables());
  for (std::size_t i = 0; i < runs.variables(); ++i)
    for (std::size_t k = 0; k <= i; ++k)
      covariance(i, k) = inverse(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
  return covariance;
}

// "a", "b" and "c", of the free variables for which it is so.
std::string names_where(const StudyFile& study, const std::vector<bool>& is_so) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < is_so.size(); ++i)
    if (is_so[i]) names.push_back(in_quotes(study.variables[study.free_variables()[i]].name));
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 < names.size() ? ", " : " and ") + names[i];
  return text;
}

// Throws std::runtime_error where variables have no effect on the measurements, or effects that are parallel
// by the singular values of their directions, to the accuracy of derivatives.
void check_told_apart(const StudyFile& study, MeasuredRuns& runs, const std::vector<double>& place) {
  Eigen::MatrixXd effects = effects_at(runs, place);
  if (effects.size() == 0) return;
  constexpr double nothing = 1e-9, of_derivatives = 3e-6, of_differences = 3e-5, part = 0.01;
  const Eigen::RowVectorXd sizes = effects.colwise().norm();
  std::vector<bool> without(runs.variables()), parallel(runs.variables());
  for (std::size_t i = 0; i < without.size(); ++i)
    without[i] = !(sizes[static_cast<Eigen::Index>(i)] > nothing * sizes.maxCoeff());
  if (const std::string names = names_where(study, without); !names.empty())
    throw std::runtime_error("the measurements do not change with " + names +
                             ": leave it out, or measure what it changes");
  effects.colwise().normalize();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(effects, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd& values = svd.singularValues();
  const double least = (runs.has_derivatives(place) ? of_derivatives : of_differences) * values[0];
  for (Eigen::Index k = 0; k < values.size(); ++k)
    for (std::size_t i = 0; i < parallel.size() && values[k] <= least; ++i)
      parallel[i] = parallel[i] || std::abs(svd.matrixV()(static_cast<Eigen::Index>(i), k)) > part;
  if (const std::string names = names_where(study, parallel); !names.empty())
    throw std::runtime_error(
        "the measurements do not tell " + names +
        " apart: what one of them does to the runs others undo; give one of them a fixed "
        "value, or measure what they change in different ways");
}

// Throws std::runtime_error where what is known of variables is less than nothing: far more than their
// ranges.
void check_determined(const StudyFile& study, const OT::CovarianceMatrix& covariance) {
  constexpr double far = 100;  // times half the range
  std::vector<bool> open;
  for (std::size_t i = 0; i < covariance.getDimension(); ++i)
    open.push_back(!(std::sqrt(covariance(i, i)) < far));
  if (const std::string names = names_where(study, open); !names.empty())
    throw std::runtime_error("the measurements do not determine " + names + ": others can make up for it");
}

// About the estimate: the posterior of OpenTURNS is about another point. Of Student's distribution where the
// level of the noise is what is left of it.
void add_intervals(const StudyFile& study, const StudyCalibration& calibration,
                   const std::vector<double>& units, const OT::CovarianceMatrix& covariance,
                   CalibrationResult& result) {
  check_determined(study, covariance);
  const double level = (1 + calibration.confidence) / 2;
  const int freedom = result.degrees_of_freedom;
  const double quantile = freedom > 0 ? OT::DistFunc::qStudent(freedom, level) : OT::DistFunc::qNormal(level);
  for (std::size_t i = 0; i < units.size(); ++i) {
    result.covariance.emplace_back();
    for (std::size_t k = 0; k < units.size(); ++k)
      result.covariance[i].push_back(covariance(i, k) * units[i] * units[k]);
    const double sd = std::sqrt(result.covariance[i][i]);
    result.sd.push_back(sd);
    result.lower.push_back(result.point[i] - quantile * sd);
    result.upper.push_back(result.point[i] + quantile * sd);
  }
}

}  // namespace

CalibrationResult calibrate(const StudyFile& study, const StudyCalibration& calibration,
                            const StudyEvaluation& evaluate, const StudyDerivatives& derivatives) {
  MeasuredRuns runs(study, calibration, evaluate, derivatives);
  const OT::Function model = model_of(runs);
  OT::CalibrationResult found;
  std::string problem;
  try {
    found = calibrated(runs, model, calibration.prior);
  } catch (const OT::Exception& of_search) {
    problem = of_search.what();
  }
  if (!runs.used_up()) runs.throw_if_stopped();
  const bool ended = problem.empty() && !runs.used_up();
  std::vector<double> place = runs.allowed(ended ? from_point(found.getParameterMAP())
                                                 : std::vector<double>(runs.variables()));  // where it began
  const bool is_beyond = ended && !runs.region().has(from_point(found.getParameterMAP()));
  if (is_beyond) place = least_within(study, runs, calibration.prior, place);
  if (!runs.used_up()) runs.throw_if_stopped();
  if (!calibration.prior) check_told_apart(study, runs, place);
  runs.throw_if_stopped();
  if (!ended) throw std::runtime_error("the measurements do not determine the variables: " + problem);
  CalibrationResult result{.point = runs.point_of(place), .quantities = runs.quantities(place)};
  if (result.quantities.empty()) throw std::runtime_error("the variant that was found is not done");
  const std::size_t values = runs.measured().size();
  if (!calibration.prior) result.degrees_of_freedom = static_cast<int>(values - runs.variables());
  result.noise = left_at(runs, place).norm() /
                 std::sqrt(static_cast<double>(calibration.prior ? values : values - runs.variables()));
  if (is_beyond) result.active = active_at(runs, place);
  if (result.active.empty())
    add_intervals(study, calibration, runs.units(),
                  is_beyond ? covariance_at(runs, place, calibration.prior)
                            : found.getParameterPosterior().getCovariance(),
                  result);
  runs.throw_if_stopped();
  result.evaluations = runs.evaluations();
  return result;
}

}  // namespace nurbeam
