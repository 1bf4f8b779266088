#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/accuracy/error_bars.h"
#include "pipelines/results/accuracy.h"

namespace nurbeam {

/// What is asked of the errors of a run.
struct AccuracyQuestion {
  AccuracyModel model;
  std::vector<HistoryColumn> columns = {};
  std::vector<std::string> bodies = {};
  bool buckling = false;
  std::optional<double> target = {};  ///< part of the scales
  std::vector<std::string> of = {};   ///< names of numbers that count for it; empty: the usual ones
  /// Of beams in which bending reaches over less than an element: their names and this reach [m].
  std::vector<std::pair<std::string, double>> short_bends = {};
  /// Probes at forces across which elements are smooth: what a section carries jumps there.
  std::vector<std::string> probes_at_jumps = {};
};

/// The name of a number as a question may have it: that of a column, of an extreme, "max(COLUMN)",
/// "min(COLUMN)", "BODY left the beam", "mode 3". Which of the names in a question no number of the case
/// could have; `modes`: of an analysis of modes.
std::vector<std::string> unknown_numbers(const AccuracyQuestion& question, bool modes);
/// Names that a question may have, for messages.
std::vector<std::string> names_of_numbers(const AccuracyQuestion& question, bool modes);

/// The numbers of a run with their errors: with a target of the finest run, else of the case's own.
class AccuracyTable {
 public:
  /// `own`: the run of the case itself, which outlives this, as the question and the runs do.
  AccuracyTable(const AccuracyQuestion& question, const RunsOfErrors& runs, const LevelNumbers& own);

  const Accuracy& accuracy() const { return accuracy_; }
  /// The largest error of what is asked, in parts of its scale; infinite where one is no bound.
  double worst() const { return worst_; }
  /// Whether all that is asked and not good enough comes no nearer as the case is refined.
  bool is_stuck() const { return is_stuck_; }
  /// The error of a history of the case's own run, in the order of its columns.
  double own_error(std::size_t column, double time) const;

 private:
  void add_ends();
  void add_extremes();
  void add_asked_peaks();
  void add_events();
  void add_modes();
  void add(NumberWithError number, double scale, bool shrinks);
  std::vector<double> values_of(const std::function<double(const LevelNumbers&)>& value) const;
  std::string doubt(std::size_t quantity, double time, double relative) const;
  std::string why_large(std::size_t quantity, double time) const;
  std::string why_all(double time) const;
  bool is_asked(const std::string& name, bool usual) const;
  void find_parting();

  const AccuracyQuestion& question_;
  ErrorBars bars_;
  const LevelNumbers &own_, &shown_;
  bool refined_;
  std::vector<std::size_t> quantity_of_column_;
  std::optional<double> events_differ_;  // from when on [s]
  Accuracy accuracy_;
  double worst_ = 0;
  bool is_stuck_ = true;
};

}  // namespace nurbeam
