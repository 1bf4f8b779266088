#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace nurbeam {

/// One stored element of one beam: everything needed to rebuild its exact curve.
struct ElementRecord {
  Eigen::Matrix4d control_points;  ///< homogeneous, deformed, world [m]
  double s_start, s_end;           ///< reference arc length [m]
};

struct BeamRecord {
  std::vector<ElementRecord> elements;
  std::vector<Eigen::Vector3d> node_positions, node_slopes;  ///< [m], [-] (left slope at a kink)
  std::vector<double> node_s;                                ///< [m]
  double length;                                             ///< deformed [m]
};

struct PointRecord {
  Eigen::Vector3d position, velocity;  ///< [m], [m/s]
};

struct BodyRecord {
  PointRecord point;
  std::optional<double> s;      ///< empty after it has left its beam [m]
  Eigen::Vector3d joint_force;  ///< of the beam on the body [N]
};

struct EnergyRecord {
  double kinetic = 0, gravity = 0, axial = 0, bending = 0, dissipated = 0, total = 0;  ///< [J]
};

/// Everything that is stored at one output time.
struct Frame {
  double time;
  std::vector<PointRecord> probes;
  std::vector<BodyRecord> bodies;
  std::vector<BeamRecord> beams;
  EnergyRecord energy;
  double step;            ///< last step size [s]
  int newton_iterations;  ///< since the previous frame
};

/// Names in the order of the vectors of a Frame.
struct FrameNames {
  std::vector<std::string> probes, bodies, beams;
};

/// Writes histories.csv and results.nc into a directory, frame by frame, each to a temporary name (".part"
/// behind it) that is renamed by finish(). Every frame reaches the disk before write() returns, so a run that
/// is killed leaves no half file under a final name and all its frames under the temporary one.
///
/// results.nc (netCDF-4, compressed; every variable carries its unit and a long_name):
///   time(time), step(time), newton_iterations(time), energy_*(time)
///   probe_position, probe_velocity (time, probe, xyz); body_position, body_velocity, body_joint_force (time,
///   body, xyz); body_s (time, body), the fill value after a body has left; beam_length (time, beam)
///   probe_name, body_name, beam_name
/// and, because the elements of a beam change in number, contiguous ragged arrays (CF conventions, 9.3.3):
/// the elements of the first beam at the first time, of the second beam, ..., of the first beam at the second
/// time, ...:
///   element_count, node_count (time, beam): how many of the rows below belong to a beam at a time
///   control_points (element, control_point, homogeneous): (w x, w y, w z, w); element_s_start, element_s_end
///   (element) node_position, node_slope (node, xyz); node_s (node)
class ResultsWriter {
 public:
  /// Throws std::runtime_error (file and reason) when the directory or a file cannot be written.
  ResultsWriter(std::filesystem::path directory, FrameNames names, std::string title);
  ~ResultsWriter();
  /// Throws std::invalid_argument unless the frame has as many probes, bodies and beams as there are names,
  /// and std::runtime_error (file and reason) when it cannot be written.
  void write(const Frame& frame);
  /// Closes the files and gives them their names; nothing may be written after it. Throws std::runtime_error.
  void finish();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// One beam of a stored frame, as read back.
struct StoredBeam {
  std::string name;
  std::vector<ElementRecord> elements;
};

/// The frame stored nearest to `time` in results.nc. Throws std::runtime_error (file, reason, and for a time
/// outside the stored range the range).
std::pair<double, std::vector<StoredBeam>> read_stored_beams(const std::filesystem::path& directory,
                                                             double time);

}  // namespace nurbeam
