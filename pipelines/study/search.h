#pragma once
#include <exception>
#include <map>
#include <utility>
#include <vector>

#include "pipelines/study/allowed_region.h"
#include "pipelines/study/openturns_study.h"

/// What a search of `optimise` sees: private to it.
namespace nurbeam {

/// Whether a constraint with this margin holds.
inline bool is_satisfied(double margin) { return margin >= -1e-9; }

/// Of a constraint at a variant: what must be greater, and the other.
std::pair<double, double> sides_of(const StudyFile& study, const StudyOptimum::Constraint& constraint,
                                   const std::vector<double>& quantities, const std::vector<double>& point);

/// What a search minimises and holds, of one variant: what it is subject to and, by the methods that know
/// constraints, those that a variant must hold to run.
class Goal {
 public:
  Goal(const StudyFile& study, const StudyOptimum& optimum);

  /// Whether the method takes constraints; to the others variants that are not done are bad.
  bool knows_constraints() const {
    using Method = StudyOptimum::Method;
    return optimum_.method == Method::cobyla || optimum_.method == Method::gradient;
  }
  bool takes_slopes() const { return optimum_.method == StudyOptimum::Method::gradient; }
  std::size_t count() const { return indices_.size(); }
  /// The first objective; else it maximises it.
  bool minimises() const { return optimum_.objectives.front().minimise; }
  std::size_t constraints() const { return constraints_.size(); }
  const std::string& text(std::size_t constraint) const { return constraints_[constraint].text; }
  std::vector<double> objectives(const std::vector<double>& quantities) const;
  /// Each 0 or more where it holds, as a part of its unit; NaN where a variant that is not done does not
  /// tell.
  std::vector<double> margins(const std::vector<double>& quantities, const std::vector<double>& point) const;
  /// The units of constraints are the larger sides in the first variant that tells.
  void measure(const std::vector<double>& quantities, const std::vector<double>& point);
  double unit(std::size_t constraint) const { return units_[constraint]; }
  bool holds(const std::vector<double>& quantities, const std::vector<double>& point) const;
  /// Whether a constraint keeps variants from running.
  bool rejects_by(std::size_t constraint) const { return constraint >= optimum_.constraints.size(); }

 private:
  using Sides = std::pair<double, double>;  // of a constraint: what must be greater, and the other

  std::vector<Sides> sides(const std::vector<double>& quantities, const std::vector<double>& point) const;

  const StudyFile& study_;
  const StudyOptimum& optimum_;
  std::vector<std::size_t> indices_;
  std::vector<StudyOptimum::Constraint> constraints_;
  std::vector<bool> of_variables_;  // alone, of the constraints
  std::vector<double> units_;       // of the constraints; 0 before a variant tells
};

/// The variants that a search asks for. It sees the free variables as parts of their ranges, 0 to 1, so that
/// lengths and moduli weigh the same, and never leaves them.
class Search {
 public:
  Search(const StudyFile& study, const StudyEvaluation& evaluate, const StudyDerivatives& derivatives,
         Goal& goal);

  /// Each variant runs once, however often it is asked for: objective and constraints ask for the same
  /// points. Instead of one that would be rejected the nearest that is not runs, and the first counts as what
  /// the derivatives of that say.
  StudyPoints quantities(const StudyPoints& parts);
  /// Whether it has slopes: of the variants, else by differences of them.
  bool has_slopes() const { return goal_.takes_slopes(); }
  /// The objectives and the margins by the parts; none of a variant that is not done.
  StudyGradient objective_gradient(const std::vector<double>& part);
  StudyGradient margin_gradient(const std::vector<double>& part);
  /// What a search sees of objectives from now on is in this unit.
  void set_unit(double unit) { unit_ = unit; }

  bool stopped() const { return stopped_ != nullptr; }
  void throw_if_stopped() const {
    if (stopped_) std::rethrow_exception(stopped_);
  }
  /// How many variants ran that were asked for one by one: those of differences and of generations come in
  /// batches.
  std::size_t single() const { return single_; }
  /// The numbers of the variants that were asked for one by one, in that order, also of those that had run.
  const std::vector<std::size_t>& asked() const { return asked_; }

  std::vector<double> objectives(const std::vector<double>& quantities) const;
  /// Less what they are to hold by.
  std::vector<double> margins(const std::vector<double>& quantities, const std::vector<double>& part) const;
  /// From now on a search sees a constraint tighter than it is, by twice as much in its unit as it was and as
  /// it is missed by.
  void tighten(std::size_t constraint, double missed) {
    tightened_[constraint] = 2 * (tightened_[constraint] + missed);
  }
  /// Takes back most of it where it is more than `least`; whether there was such.
  bool relax(double least);

  /// The nominal values, or those next to them that are not rejected.
  std::vector<double> start();

  const StudyPoints& points() const { return points_; }
  const StudyPoints& quantities() const { return quantities_; }
  std::vector<double> part_of(const std::vector<double>& point) const;
  std::vector<double> point_of(const std::vector<double>& part) const;

 private:
  template <class Function>
  StudyGradient gradient(const std::vector<double>& part, const Function& f);
  std::vector<double> allowed(const std::vector<double>& part);
  std::vector<double> moved_quantities(const std::vector<double>& part);
  StudyGradient derivatives_at(const std::vector<double>& part);
  StudyGradient differences_at(const std::vector<double>& part);
  void keep(const StudyPoints& fresh, const StudyPoints& quantities);
  std::vector<double> worse_than_all() const;

  const StudyFile& study_;
  const StudyEvaluation& evaluate_;
  const StudyDerivatives& derivatives_;
  Goal& goal_;
  bool knows_constraints_;
  OT::Interval range_;
  AllowedRegion region_;
  std::map<std::vector<double>, std::size_t> indices_;  // of points, in the order in which they ran
  StudyPoints points_, quantities_;
  std::vector<double> least_, most_;   // of each objective
  std::vector<double> least_margins_;  // and what a variant that is not done counts as
  std::vector<double> tightened_;
  double unit_ = 1;
  std::size_t single_ = 0;
  std::vector<std::size_t> asked_;
  std::exception_ptr stopped_;
};

}  // namespace nurbeam
