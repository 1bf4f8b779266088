#include "pipelines/run/run_outputs.h"

namespace nurbeam {

namespace {

/// Between two restart points, at least.
constexpr std::chrono::seconds restart_interval{2};

void to_world(const ModelFrame& f, PointRecord& p) {
  p.position = f.to_world(p.position);
  p.velocity = f.direction_to_world(p.velocity);
}

Frame to_world(const ModelFrame& f, Frame frame) {
  for (PointRecord& p : frame.probes) to_world(f, p);
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
      }
    for (Eigen::Vector3d& p : beam.node_positions) p = f.to_world(p);
    for (Eigen::Vector3d& p : beam.node_slopes) p = f.direction_to_world(p);
  }
  frame.energy.gravity += f.gravity_energy;
  frame.energy.total += f.gravity_energy;
  return frame;
}

ResultsWriter results_writer(const std::string& title, const BuiltModel& built,
                             const std::filesystem::path& directory, const RestartPoint* from) {
  if (from) return ResultsWriter::resume(directory, frame_names(built), title, from->frames);
  return ResultsWriter(directory, frame_names(built), title);
}

std::vector<double> times_before(const std::filesystem::path& directory, const RestartPoint* from) {
  return from && from->frames > 0 ? StoredFrames(directory).times() : std::vector<double>{};
}

}  // namespace

FrameNames frame_names(const BuiltModel& built) {
  FrameNames names;
  for (const Probe& probe : built.probes) names.probes.push_back(probe.name);
  for (const Body& body : built.model.bodies) names.bodies.push_back(body.name);
  for (const Beam& beam : built.model.beams) names.beams.push_back(beam.name);
  return names;
}

RunOutputs::RunOutputs(const CaseFile& case_file, const BuiltModel& built,
                       const std::filesystem::path& directory, std::string inputs, const RestartPoint* from)
    : built_(built),
      directory_(directory),
      inputs_(std::move(inputs)),
      results_(results_writer(case_file.name, built, directory, from)),
      cad_(case_file, built, directory, from ? from->frames : 0) {
  if (case_file.output.paraview)
    paraview_.emplace(directory_, frame_names(built), times_before(directory_, from));
}

template <class Work>
void RunOutputs::timed(Work work) {
  const auto start = Clock::now();
  work();
  seconds_ += std::chrono::duration<double>(Clock::now() - start).count();
}

void RunOutputs::write(const Frame& local) {
  timed([&] {
    const Frame frame = to_world(built_.frame, local);
    results_.write(frame);
    if (paraview_) paraview_->write(frame);
    cad_.write(frame, diagnostics_);
  });
}

bool RunOutputs::restart_point_due() const { return Clock::now() - last_restart_ >= restart_interval; }

void RunOutputs::write(const RestartPoint& point) {
  timed([&] {
    results_.close_chunk();
    if (paraview_) paraview_->write_index();
    RestartPoint mine = point;
    mine.inputs = inputs_;
    write_restart_point(directory_ / "restart.nc", mine);
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
