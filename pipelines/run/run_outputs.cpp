#include "pipelines/run/run_outputs.h"

#include <algorithm>

#include "cad_import/files/atomic_file.h"
#include "nurbs/number_text.h"
#include "pipelines/model/inertia_box.h"
#include "pipelines/run/history_rows.h"
#include "pipelines/run/model_digest.h"

namespace nurbeam {

namespace {

/// Between two restart points, at least: what would have to be computed anew.
constexpr std::chrono::seconds restart_interval{2};
/// And this many times what the last one took to write.
constexpr int least_rest = 20;

std::vector<double> times_before(const std::filesystem::path& directory, const Checkpoint* from) {
  return from && from->snapshots > 0 ? StoredFrames(directory).times() : std::vector<double>{};
}

ResultsWriter results_writer(const CaseFile& c, const BuiltModel& built,
                             const std::filesystem::path& directory, const Checkpoint* from) {
  if (!from) return ResultsWriter(directory, snapshot_names(built), c.name);
  std::optional<RowsBefore> rows;
  if (const HistoryRows due(c.output); due.any()) {
    const double time = from->state.t;
    const std::vector<double> frames = times_before(directory, from);  // too few are told of later
    const bool is_frame =
        from->snapshots > 0 && from->snapshots <= frames.size() && frames[from->snapshots - 1] == time;
    rows = RowsBefore{time, is_frame || due.due(time - from->last_step, time)};
  }
  return ResultsWriter::resume(directory, snapshot_names(built), c.name, from->snapshots, rows);
}

// Boxes about rigid bodies, as drawn in the world; none where no body is rigid.
std::vector<Eigen::Matrix3d> boxes_of(const BuiltModel& built) {
  const std::vector<Body>& bodies = built.model.bodies;
  if (std::ranges::none_of(bodies, [](const Body& body) { return body.rigid.has_value(); })) return {};
  std::vector<Eigen::Matrix3d> boxes(bodies.size(), Eigen::Matrix3d::Zero());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].rigid) boxes[i] = built.frame.rotation.transpose() * inertia_box(bodies[i]).half_edges();
  return boxes;
}

std::vector<std::string> texts_of(const std::vector<Diagnostic>& warnings) {
  std::vector<std::string> texts;
  for (const Diagnostic& warning : warnings) texts.insert(texts.end(), {warning.where, warning.message});
  return texts;
}

std::vector<Diagnostic> warnings_of(const std::vector<std::string>& texts) {
  std::vector<Diagnostic> warnings;
  for (std::size_t i = 0; i + 1 < texts.size(); i += 2)
    warnings.push_back({Severity::warning, texts[i], texts[i + 1]});
  return warnings;
}

}  // namespace

RunOutputs::RunOutputs(const CaseFile& case_file, const BuiltModel& built,
                       const std::filesystem::path& directory, std::string inputs, const Checkpoint* from)
    : case_(case_file),
      built_(built),
      directory_(directory),
      inputs_(std::move(inputs)),
      model_(model_digest(case_file, built)),
      results_(results_writer(case_file, built, directory, from)),
      cad_(case_file, built, directory, from ? from->snapshots : 0),
      next_restart_(Clock::now() + restart_interval),
      names_(snapshot_names(built)),
      checks_(built.model),
      extremes_(from ? from->extremes : std::vector<double>{}),
      contacts_(built) {
  if (from && !built.collectors.empty())
    contacts_.take_over(read_histories(temporary_name(directory / "histories.csv")));
  if (case_file.output.paraview)
    paraview_.emplace(directory_, snapshot_names(built), times_before(directory_, from), "", boxes_of(built));
  if (from) diagnostics_ = warnings_of(from->said_of_files);
  if (!from || from->snapshots == 0) return;
  const StoredFrames stored(directory);
  for (std::size_t i = 0; i < from->snapshots; ++i) look_at(stored.read(i, 1)[0]);
}

void RunOutputs::look_at(const Snapshot& frame) {
  checks_.look_at(frame);
  extremes_.look_at(frame, names_);
}

template <class Work>
void RunOutputs::timed(Work work) {
  const auto start = Clock::now();
  work();
  seconds_ += std::chrono::duration<double>(Clock::now() - start).count();
}

bool RunOutputs::takes_elements_ahead() const {
  std::size_t elements = 0;
  for (const Beam& beam : built_.model.beams) elements += beam.home.size();
  return elements > ResultsWriter::most_open_elements && case_.output.cad_formats.empty() && !paraview_;
}

void RunOutputs::write_ahead(double time, int beam, std::vector<ElementRecord>& local) {
  timed([&] {
    for (ElementRecord& element : local) put_into_world(built_.frame, element);
    checks_.look_at(local, beam, time);
    results_.write_ahead(local);
  });
}

void RunOutputs::write(Snapshot local) {
  timed([&] {
    Snapshot frame = to_world(built_.frame, std::move(local));
    if (paraview_) paraview_->write(frame);
    look_at(frame);
    contacts_.look_at(frame);
    if (shown_to_) shown_to_(frame);
    cad_.write(frame, diagnostics_);
    results_.write(std::move(frame));
  });
}

void RunOutputs::write_between(Snapshot local) {
  timed([&] {
    const Snapshot moment = to_world(built_.frame, std::move(local));
    contacts_.look_at(moment);
    results_.write_between(moment);
  });
}

void RunOutputs::look_between(Snapshot local) {
  timed([&] { extremes_.look_at(to_world(built_.frame, std::move(local)), names_); });
}

void RunOutputs::write_shape(Snapshot local) {
  timed([&] {
    Snapshot frame = to_world(built_.frame, std::move(local));
    if (paraview_) paraview_->write(frame);
    cad_.write(frame, diagnostics_);
    results_.write(std::move(frame));
  });
}

void RunOutputs::write_series(const std::string& name, const std::vector<Snapshot>& local) {
  timed([&] {
    ParaviewSeries series(directory_, snapshot_names(built_), {}, name);
    for (const Snapshot& frame : local) series.write(to_world(built_.frame, frame));
    series.write_index();
  });
}

bool RunOutputs::checkpoint_due() const { return Clock::now() >= next_restart_; }

void RunOutputs::write(Checkpoint point) {
  point.extremes = extremes_.numbers();  // of its moment: others may come before it is written
  if (!checkpoint_due()) {
    last_point_ = std::move(point);
    return;
  }
  timed([&] {
    cad_.flush();  // a run that goes on from here has what came before
    const auto start = Clock::now();
    results_.close_chunk();
    if (paraview_) paraview_->write_index();
    put(std::move(point));
    const auto end = Clock::now();
    next_restart_ = end + std::max<Clock::duration>(restart_interval, least_rest * (end - start));
  });
}

void RunOutputs::put(Checkpoint point) {
  point.inputs = inputs_;
  point.model = model_;
  point.said_of_files = texts_of(diagnostics_);
  write_checkpoint(directory_ / "restart.nc", std::move(point));
  last_point_.reset();
}

void RunOutputs::finish() {
  timed([&] {
    results_.finish();
    if (paraview_) paraview_->write_index();
    cad_.flush();
    if (last_point_) put(std::move(*last_point_));
  });
}

}  // namespace nurbeam
