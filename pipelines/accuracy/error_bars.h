#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/accuracy/differences.h"

namespace nurbeam {

/// What errors depend on besides the runs.
struct AccuracyModel {
  bool moves = true;
  std::vector<HistoryQuantity> quantities;
  std::vector<bool> has_jumps;    ///< per quantity: elements are smooth across a force inside its beam
  double radius_of_gyration = 0;  ///< the largest of the sections [m]
  double length = 0;              ///< of the longest beam [m]
};

/// The runs that errors are taken from, the finest first. `coarser` may be null in motion and where statics
/// have two runs.
struct RunsOfErrors {
  const LevelNumbers* fine;
  const LevelNumbers* coarse;
  const LevelNumbers* coarser = nullptr;
};

/// The error of the finest of some runs by their differences: in motion 1.25 times the largest difference of
/// two runs so far; else, of three, a Richardson estimate whose order is held within bounds:
///   max(1.5 max(D1, D2/8)/(2^p - 1), U/10), p = log2(D2/D1) in [1/2, 3],
/// where U is the largest D1 of numbers of the same kind. Across a force inside a beam the order is at most
/// one, and D2/2 stands for D2/8.
///
/// The run of the case itself, where it is not the finest, is off by its difference from this besides; of two
/// runs 1.5 times the difference is its error.
class ErrorBars {
 public:
  ErrorBars(const AccuracyModel& model, const RunsOfErrors& runs, const LevelNumbers& own);

  /// Of the finest run, and of the case's own, at a time.
  double fine(std::size_t quantity, double time) const;
  double own(std::size_t quantity, double time) const;
  /// Of a number apart from histories, such as an extreme, by its values in the runs, the finest first, and
  /// in the case's own; without noise().
  double fine_of(const std::vector<double>& values, bool has_jumps) const;
  double own_of(double own, const std::vector<double>& values, bool has_jumps) const;

  /// What is added to every error for round-off, and the scale that errors are parts of.
  double noise(std::size_t quantity) const;
  double noise(const std::string& unit) const;
  double scale(std::size_t quantity) const { return scales_[quantity]; }
  /// Whether a quantity is exactly 0 in all runs.
  bool is_nought(std::size_t quantity) const { return nought_[quantity]; }
  /// Whether three runs come no nearer to each other.
  bool does_not_shrink(std::size_t quantity) const;
  const RunsOfErrors& runs() const { return runs_; }
  bool is_own() const { return is_own_; }

 private:
  double largest(const std::string& group) const;
  double scale_of(const HistoryQuantity& of, double size) const;

  const AccuracyModel& model_;
  RunsOfErrors runs_;
  bool is_own_;  // whether the finest run is the case's own
  Differences first_;
  std::optional<Differences> second_, from_own_;
  std::map<std::string, double> largest_;  // number of a unit, or of a kind
  std::map<std::string, double> kinds_;    // difference of a kind
  std::vector<double> scales_;
  std::vector<bool> nought_;
};

/// The error of the finest of three numbers, as above; D2 may be missing.
double bounded_order_error(double first, std::optional<double> second, bool has_jumps);

}  // namespace nurbeam
