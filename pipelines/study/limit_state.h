#pragma once
#include <Eigen/Core>
#include <map>
#include <optional>
#include <vector>

#include "pipelines/study/least_on_sphere.h"
#include "pipelines/study/random_space.h"

/// What a search of a reliable design asks of variants: private to it.
namespace nurbeam {

/// Variants, each run once however often it is asked for.
class KnownVariants {
 public:
  KnownVariants(const StudyFile& study, const StudyEvaluation& evaluate, const StudyDerivatives& derivatives);

  StudyPoints quantities(const StudyPoints& points);
  /// The derivatives of quantities by the free variables; by differences those alone whose step is not 0.
  /// None where variants are not done.
  StudyGradient gradient(const std::vector<double>& point, const std::vector<double>& steps);
  /// How many have run.
  std::size_t count() const { return known_.size(); }

 private:
  StudyGradient differences(const std::vector<double>& point, const std::vector<double>& steps);

  const StudyFile& study_;
  const StudyEvaluation& evaluate_;
  const StudyDerivatives& derivatives_;
  std::map<std::vector<double>, std::vector<double>> known_;
};

/// The limit state g = lesser - greater of what is to be improbable, at one design: it fails below 0.
class LimitState {
 public:
  LimitState(const StudyFile& study, const StudyOptimum::Constraint& fails, KnownVariants& variants,
             const std::vector<double>& design);

  const RandomSpace& space() const { return space_; }
  /// The values of the free variables there.
  std::vector<double> point(const Eigen::VectorXd& u) const;
  /// Runs the variants of these points together.
  void run(const StudyPoints& points) { variants_.quantities(points); }
  /// What must not be greater, and the limit; nothing where the variant is not done.
  std::optional<std::pair<double, double>> sides(const std::vector<double>& point);
  std::optional<double> value(const std::vector<double>& point);
  /// dg/dx by the random variables; none where variants are not done.
  std::optional<std::vector<double>> by_random(const std::vector<double>& point);
  /// dg/du.
  std::optional<Eigen::VectorXd> by_standard(const Eigen::VectorXd& u);
  /// dg/dd by the design variables at the same place of standard space, where random ones go along with them;
  /// `moved`: the derivatives of the free variables' values by each design variable.
  std::optional<std::vector<double>> by_design(const Eigen::VectorXd& u, const StudyPoints& moved);
  /// In standard space.
  SphereFunction function();

 private:
  std::optional<std::vector<double>> by_free(const std::vector<double>& point, bool with_design);

  const StudyFile& study_;
  const StudyOptimum::Constraint& fails_;
  KnownVariants& variants_;
  std::vector<double> design_;
  RandomSpace space_;
};

/// By how much variables are changed for differences of what a design makes of them: of their ranges.
std::vector<double> design_steps(const StudyFile& study);

}  // namespace nurbeam
