#pragma once
#include <memory>
#include <vector>

#include "fem/sensitivity/sensitivities.h"
#include "pipelines/study/histories.h"
#include "pipelines/study/study_case.h"

namespace nurbeam {

/// By how much a variable is changed for a derivative; `settles`: of neighbours that go to equilibria of
/// their own.
double derivative_step(const StudyVariable& variable, double value, bool settles = false);

/// f(more) - f(less) over 2 step, for each free variable: of the values of all variables around those of a
/// variant.
std::vector<double> differences(const StudyFile& study, const std::vector<double>& values,
                                const std::function<double(const std::vector<double>& values)>& f);

/// The neighbours of a variant, a pair for each free variable, that go along with its run.
class VariantGradient {
 public:
  /// `case_file`, `model`: those of the variant; the model must outlive it. Throws std::invalid_argument
  /// where there are no such neighbours.
  VariantGradient(const StudyFile& study, const StudyCase& study_case, const std::vector<double>& values,
                  const CaseFile& case_file, const BuiltModel& model);
  ~VariantGradient();

  RunFollower& follower() { return *sensitivities_; }
  /// After the run, which had these histories and events. Throws std::invalid_argument for a quantity without
  /// a derivative.
  StudyGradient of_quantities(const Histories& histories, const std::vector<RunEvent>& events);
  /// Whether that may come by adjoints: with more parameters than quantities, which are all of single places.
  /// (One of whole beams changes with every coordinate: its derivatives by these take more than all
  /// solutions.)
  bool is_by_adjoint() const { return is_by_adjoint_; }

 private:
  struct NeighbouringRun;
  struct Pair;

  bool pays_by_adjoint(std::size_t variables, const Histories& histories, bool is_static) const;
  Eigen::VectorXd quantities(const std::vector<double>& values, const Histories& histories,
                             const std::vector<RunEvent>& events) const;
  Eigen::MatrixXd through_states(const Histories& histories, const std::vector<RunEvent>& events);

  const StudyFile& study_;
  const BuiltModel& model_;
  const std::vector<double> values_;
  std::vector<Pair> pairs_;
  bool is_by_adjoint_ = false;
  std::unique_ptr<Sensitivities> sensitivities_;
};

}  // namespace nurbeam
