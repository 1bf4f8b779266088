#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace nurbeam {

/// One stored element of one beam: everything needed to rebuild its exact curve, and what it carries at the
/// parameters u = 0, 1/3, 2/3, 1 of that cubic (`sample`).
struct ElementRecord {
  Eigen::Matrix4d control_points;        ///< homogeneous, deformed, world [m]
  double s_start = 0, s_end = 0;         ///< reference arc length [m]
  Eigen::Vector4d strain;                ///< Green's axial strain [-]
  Eigen::Vector4d curvature;             ///< [1/m], by the model's measure; signed in a planar model
  Eigen::Vector4d axial_force;           ///< elastic, tension positive [N]
  Eigen::Vector4d bending_moment;        ///< elastic [N m]; signed in a planar model
  Eigen::Matrix<double, 3, 4> velocity;  ///< of the material, world [m/s]
};

struct BeamRecord {
  std::vector<ElementRecord> elements;
  std::vector<Eigen::Vector3d> node_positions, node_slopes;  ///< [m], [-] (left slope at a kink)
  std::vector<double> node_s;                                ///< [m]
  double length = 0;                                         ///< deformed [m]
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

/// One accepted step of the integrator.
struct StepRecord {
  double time = 0;            ///< at its end [s]
  double size = 0;            ///< [s]
  int newton_iterations = 0;  ///< over all attempts
  int rejected = 0;           ///< attempts thrown away
};

/// Everything that is stored at one output time.
struct Frame {
  double time = 0;
  std::vector<PointRecord> probes;
  std::vector<BodyRecord> bodies;
  std::vector<BeamRecord> beams;
  EnergyRecord energy;
  std::vector<StepRecord> steps;  ///< since the previous frame
  double step = 0;                ///< last step size [s]
  int newton_iterations = 0;      ///< since the previous frame
};

/// Names in the order of the vectors of a Frame.
struct FrameNames {
  std::vector<std::string> probes, bodies, beams;
};

}  // namespace nurbeam
