#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pipelines/accuracy/error_bars.h"

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

/// "trolley.x".
std::string name_of_column(const HistoryColumn& column);

}  // namespace nurbeam
