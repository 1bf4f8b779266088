#include "pipelines/accuracy/level_numbers.h"

namespace nurbeam {

void LevelRecorder::look_at(const Snapshot& frame) {
  extremes_.look_at(frame, names_);
  numbers_.times.push_back(frame.time);
  std::vector<double>& row = numbers_.rows.emplace_back();
  row.reserve(columns_.size());
  for (const HistoryColumn& column : columns_) row.push_back(column.value(frame));
}

LevelNumbers LevelRecorder::numbers(const SimulationReport& report) const {
  LevelNumbers numbers = numbers_;
  numbers.extremes = extremes_.list();
  numbers.steps = report.steps;
  numbers.seconds = report.motion_seconds + report.length_control_seconds;
  numbers.done = report.status == SimulationStatus::done;
  numbers.end = report.time;
  for (const RunEvent& event : report.events)
    if (is_booked(event.kind)) numbers.events.push_back(event);
  return numbers;
}

}  // namespace nurbeam
