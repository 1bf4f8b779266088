#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "fem/motion/record/snapshot.h"
#include "pipelines/results/frame_layout.h"

namespace nurbeam {

/// Frames in one netCDF-4 file, compressed where it is to stay; every variable carries its unit and a
/// long_name:
///   time(time), step(time), newton_iterations(time), energy_*(time)
///   probe_position, probe_velocity (time, probe, xyz); body_position, body_velocity, body_joint_force (time,
///   body, xyz); body_s (time, body), the fill value after a body has left; beam_length (time, beam)
///   probe_displacement, probe_* of section_parts; body_holding_force, body_* of friction_parts where bodies
///   have friction; beam_* and beam_*_s of beam_extremes (and of own_axes_parts and own_axes_extremes where
///   beams have torsion); connector_force, connector_length (time, connector), connector_from_position,
///   connector_to_position (time, connector, xyz), the fill value where an earlier version began the run,
///   connector_name; measure, measure_s (time, measure), where a model has sags of parts or clearances, with
///   measure_name;
///   reaction_position, reaction_force, reaction_couple (time, reaction, xyz)
///   probe_name, body_name, beam_name, reaction_name
/// and, because the elements of a beam and the steps between two frames change in number, contiguous ragged
/// arrays (CF conventions, 9.3.3): the elements of the first beam at the first time, of the second beam, ...,
/// of the first beam at the second time, ...:
///   element_count, node_count (time, beam): how many of the rows below belong to a beam at a time
///   control_points (element, control_point, homogeneous): (w x, w y, w z, w); drawn_control_points
///   (element, control_point, xyz), with the same weights; element_s_start, element_s_end (element); the
///   sampled_fields (element, sample), velocity (element, sample, xyz), with torsion the own_axes_fields and
///   section_axes (element, sample, xyz); node_position, node_slope (node, xyz); node_s (node)
///   solver_step_count (time); solver_step_time, _size, _newton_iterations, _rejected (solver_step)
class FrameStore {
 public:
  /// Makes the file, without frames; `expected`: about how much is to come. This and the others throw
  /// std::runtime_error (file and reason).
  FrameStore(const std::filesystem::path& file, const SnapshotNames& names, const std::string& title,
             bool packed, const StoredRows& expected);
  /// Appends frames whose vectors fit the names.
  void write(std::span<const Snapshot> frames);
  /// Appends elements of the next frame, in the order of its beams: those that were handed over before it. It
  /// has no others, and is written alone.
  void write_ahead(std::span<const ElementRecord> elements);
  /// Appends what another store of the same names has written, of which there is so much.
  void copy(const std::filesystem::path& file, const StoredRows& rows);
  /// Ends the file, with its checksum.
  void close();

 private:
  void define_of_time(const std::string& name, std::vector<std::string> dimensions, const std::string& unit,
                      const std::string& long_name, NetcdfFile::Type type = NetcdfFile::Type::real);
  void define_scalars();
  void define_turns();
  void define_felt(const std::string& kind, const std::string& whose);
  void define_points(const std::string& kind, const std::vector<std::string>& names);
  void define_beams(const std::vector<std::string>& names);
  void define_reactions(const std::vector<std::string>& names);
  void define_connectors(const std::vector<std::string>& names);
  void define_measures(const std::vector<std::string>& names);
  void define_steps();
  class PerFrame;
  void write_scalars(const PerFrame& each);
  void write_probes(const PerFrame& each);
  void write_bodies(const PerFrame& each);
  void write_beams(const PerFrame& each);
  void write_reactions(const PerFrame& each);
  void write_connectors(const PerFrame& each);
  void write_measures(const PerFrame& each);
  void write_elements(std::span<const Snapshot> frames);
  class ElementBlock;
  void write_nodes(std::span<const Snapshot> frames);
  void write_steps(std::span<const Snapshot> frames);

  std::filesystem::path path_;
  NetcdfFile file_;
  std::size_t probe_count_, body_count_, beam_count_, reaction_count_, connector_count_, measure_count_;
  bool sections_, springs_, turns_, felt_, felt_at_probes_;
  std::span<const BodyPart> body_parts_;
  std::vector<SectionPart> section_parts_;
  std::vector<BeamExtreme> beam_extremes_;
  std::vector<SampledField> sampled_fields_;
  StoredRows expected_, written_;
  std::size_t ahead_ = 0;  // elements of the next frame
};

}  // namespace nurbeam
