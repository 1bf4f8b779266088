#pragma once
#include <memory>
#include <string>
#include <vector>

#include "fem/motion/record/held_extremes.h"
#include "fem/motion/record/simulation_report.h"
#include "pipelines/model/build_model.h"
#include "pipelines/results/history_columns.h"
#include "pipelines/study/study_file.h"

namespace nurbeam {

/// "trolley.x".
std::string column_name(const HistoryColumn& column);

/// The histories that a study asks for, of one run.
class Histories {
 public:
  /// `built` must outlive them.
  Histories(const StudyFile& study, const BuiltModel& built);
  /// Empty ones of the same names, of a model that outlives them.
  Histories of_neighbour(const BuiltModel& built) const;

  /// A snapshot in the model's own coordinates.
  void add(const Snapshot& local);

  /// Takes the times and values of another run of the study over.
  void begin_as(const Histories& other);
  /// Adds to the values of one time a part of what they differ by between two other runs of the study.
  void shift(std::size_t time, const Histories& from, const Histories& to, double part);
  /// Those of one time, from a snapshot in the model's own coordinates.
  void replace(std::size_t time, const Snapshot& local);
  /// Takes those of one time over from another run of the study.
  void replace(std::size_t time, const Histories& other);
  /// Adds to the values of one time, to each another part of its largest from `part` to twice that.
  void nudge(std::size_t time, double part);

  /// Moved by a part of the largest difference from another run of the variant up to each time, and a
  /// twentieth of the run beyond it. Times that the other does not have keep the difference before.
  Histories moved(const Histories& other, double part) const;

  /// What of a snapshot they are read from.
  SnapshotContents contents() const;
  std::vector<BeamPart> parts_of_beams() const;
  const std::vector<double>& times() const { return times_; }
  /// Null where the study does not ask for that column.
  const std::vector<double>* find(const std::string& name) const;

 private:
  const ModelFrame* frame_;
  std::shared_ptr<const std::vector<HistoryColumn>> columns_;
  std::vector<double> times_;
  std::vector<std::vector<double>> values_;
};

/// The number of the first event of that kind of that body or beam, that of all where there is none. Throws
/// std::invalid_argument for a kind that does not exist.
std::size_t first_event(const std::vector<RunEvent>& events, const BeamModel& model, const std::string& kind,
                        const std::string& of);

/// What variables stand for in expressions.
ExpressionScope scope_of_variables(const StudyFile& study, const std::vector<double>& values);

/// What the names of a quantity stand for after a run: variables, histories, and the times of its events.
ExpressionScope scope_of_run(const StudyFile& study, const std::vector<double>& values,
                             const Histories& histories, const BeamModel& model,
                             const std::vector<RunEvent>& events);

}  // namespace nurbeam
