#include "pipelines/run/run_outputs.h"

#include <algorithm>

#include "nurbs/number_text.h"

namespace nurbeam {

namespace {

/// Between two restart points, at least.
constexpr std::chrono::seconds restart_interval{2};

void to_world(const ModelFrame& f, PointRecord& p) {
  p.position = f.to_world(p.position);
  p.velocity = f.direction_to_world(p.velocity);
}

Snapshot to_world(const ModelFrame& f, Snapshot frame) {
  for (ProbeRecord& p : frame.probes) {
    to_world(f, p);
    p.displacement = f.direction_to_world(p.displacement);
  }
  for (ReactionRecord& reaction : frame.reactions) {
    reaction.position = f.to_world(reaction.position);
    reaction.force = f.direction_to_world(reaction.force);
    reaction.couple = f.direction_to_world(reaction.couple);
  }
  for (BodyRecord& body : frame.bodies) {
    to_world(f, body.point);
    body.joint_force = f.direction_to_world(body.joint_force);
  }
  for (BeamRecord& beam : frame.beams) {
    for (ElementRecord& e : beam.elements)
      for (int i = 0; i < 4; ++i) {
        const double w = e.control_points(3, i);
        const Eigen::Vector3d p = f.to_world(e.control_points.col(i).head<3>() / w);
        e.control_points.col(i).head<3>() = w * p;
        e.velocity.col(i) = f.direction_to_world(e.velocity.col(i));
        e.d1.col(i) = f.direction_to_world(e.d1.col(i));
        e.d2.col(i) = f.direction_to_world(e.d2.col(i));
      }
    for (Eigen::Vector3d& p : beam.node_positions) p = f.to_world(p);
    for (Eigen::Vector3d& p : beam.node_slopes) p = f.direction_to_world(p);
  }
  frame.energy.gravity += f.gravity_energy;
  frame.energy.total += f.gravity_energy;
  return frame;
}

// "reaction.cable.start", where the support has no name of its own.
std::string reaction_name(const BeamModel& model, const Support& support) {
  if (!support.name.empty()) return support.name;
  const Beam& beam = model.beams[support.beam];
  const bool open = !beam.is_ring();
  const std::string place = open && support.s == 0                     ? ".start"
                            : open && support.s == beam.curve.length() ? ".end"
                                                                       : "@" + text_of(support.s);
  return "reaction." + beam.name + place;
}
std::string reaction_name(const BeamModel& model, const BeamJoint& joint) {
  if (!joint.name.empty()) return joint.name;
  return "joint." + model.beams[joint.beam_a].name + "." + model.beams[joint.beam_b].name;
}

// With a number behind it where others have the name.
std::string distinct(const std::string& name, const std::vector<std::string>& others) {
  std::string free = name;
  for (int i = 2; std::find(others.begin(), others.end(), free) != others.end(); ++i)
    free = name + " " + std::to_string(i);
  return free;
}

ResultsWriter results_writer(const std::string& title, const BuiltModel& built,
                             const std::filesystem::path& directory, const Checkpoint* from) {
  if (from) return ResultsWriter::resume(directory, snapshot_names(built), title, from->snapshots);
  return ResultsWriter(directory, snapshot_names(built), title);
}

std::vector<double> times_before(const std::filesystem::path& directory, const Checkpoint* from) {
  return from && from->snapshots > 0 ? StoredFrames(directory).times() : std::vector<double>{};
}

}  // namespace

SnapshotNames snapshot_names(const BuiltModel& built) {
  SnapshotNames names;
  for (const Probe& probe : built.probes) names.probes.push_back(probe.name);
  for (const Body& body : built.model.bodies) names.bodies.push_back(body.name);
  for (const Beam& beam : built.model.beams) {
    names.beams.push_back(beam.name);
    names.sections = names.sections || beam.has_torsion();
  }
  for (const Constraint& constraint : built.model.constraints)
    names.reactions.push_back(
        std::visit([&](const auto& of) { return distinct(reaction_name(built.model, of), names.reactions); },
                   constraint));
  return names;
}

RunOutputs::RunOutputs(const CaseFile& case_file, const BuiltModel& built,
                       const std::filesystem::path& directory, std::string inputs, const Checkpoint* from)
    : built_(built),
      directory_(directory),
      inputs_(std::move(inputs)),
      results_(results_writer(case_file.name, built, directory, from)),
      cad_(case_file, built, directory, from ? from->snapshots : 0) {
  if (case_file.output.paraview)
    paraview_.emplace(directory_, snapshot_names(built), times_before(directory_, from));
  if (!from || from->snapshots == 0) return;
  const StoredFrames stored(directory);
  for (std::size_t i = 0; i < from->snapshots; ++i) look_at(stored.read(i, 1)[0]);
}

void RunOutputs::look_at(const Snapshot& frame) {
  const SnapshotNames names = snapshot_names(built_);
  mismatch_.look_at(frame, names.beams);
  extremes_.look_at(frame, names);
}

template <class Work>
void RunOutputs::timed(Work work) {
  const auto start = Clock::now();
  work();
  seconds_ += std::chrono::duration<double>(Clock::now() - start).count();
}

void RunOutputs::write(const Snapshot& local) {
  timed([&] {
    const Snapshot frame = to_world(built_.frame, local);
    results_.write(frame);
    if (paraview_) paraview_->write(frame);
    look_at(frame);
    cad_.write(frame, diagnostics_);
  });
}

void RunOutputs::write_shape(const Snapshot& local) {
  timed([&] {
    const Snapshot frame = to_world(built_.frame, local);
    results_.write(frame);
    if (paraview_) paraview_->write(frame);
    cad_.write(frame, diagnostics_);
  });
}

void RunOutputs::write_series(const std::string& name, const std::vector<Snapshot>& local) {
  timed([&] {
    ParaviewSeries series(directory_, snapshot_names(built_), {}, name);
    for (const Snapshot& frame : local) series.write(to_world(built_.frame, frame));
    series.write_index();
  });
}

bool RunOutputs::checkpoint_due() const { return Clock::now() - last_restart_ >= restart_interval; }

void RunOutputs::write(const Checkpoint& point) {
  timed([&] {
    results_.close_chunk();
    if (paraview_) paraview_->write_index();
    Checkpoint mine = point;
    mine.inputs = inputs_;
    write_checkpoint(directory_ / "restart.nc", mine);
    last_restart_ = Clock::now();
  });
}

void RunOutputs::finish() {
  timed([&] {
    results_.finish();
    if (paraview_) paraview_->write_index();
  });
}

}  // namespace nurbeam
