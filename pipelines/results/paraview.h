#pragma once
#include <filesystem>
#include <vector>

#include "fem/motion/record/snapshot.h"

namespace nurbeam {

/// Writes frames for ParaView: frames.pvd, which names the time of each file, and frames/beams_000000.vtu,
/// frames/bodies_000000.vtu, frames/reactions_000000.vtu, frames/connectors_000000.vtu, ...
///
/// Each element is one cell VTK_BEZIER_CURVE of degree 3 with its own four points and the point data
/// `RationalWeights`: the exact curve. Strain, curvature, axial force, bending moment and velocity are point
/// data too, interpolated by the same rational functions through their samples. Cell data: beam, element and
/// the reference arc lengths of the element's ends. Bodies are vertices with velocity, joint force and s (NaN
/// after a body has left its beam), connectors lines with force and length. Rigid bodies are boxes besides,
/// frames/boxes_000000.vtu, ...
class ParaviewSeries {
 public:
  /// `directory` exists. The first frames of an earlier run, with these times, are kept. A series of another
  /// name has NAME.pvd and frames/NAME_beams_000000.vtu, ... `boxes`: per body InertiaBox::half_edges(), as
  /// drawn, in the world's axes; zero for none; empty: of none.
  ParaviewSeries(std::filesystem::path directory, SnapshotNames names, std::vector<double> times = {},
                 const std::string& name = {}, std::vector<Eigen::Matrix3d> boxes = {});
  /// Writes one frame. This and the other throw std::runtime_error (file and reason).
  void write(const Snapshot& frame);
  /// Writes the .pvd for the frames so far.
  void write_index() const;

 private:
  /// "frames/beams_000042.vtu"
  std::string frame_file(const char* kind, std::size_t frame) const;

  std::filesystem::path directory_;
  std::string index_, prefix_;  // frames.pvd; NAME_
  SnapshotNames names_;
  std::vector<double> times_;
  std::vector<Eigen::Matrix3d> boxes_;
};

/// The coefficients c (Bernstein, rational with `weights`) of the function that takes the values `samples` at
/// u = 0, 1/3, 2/3, 1: f(u) = sum B_i w_i c_i / sum B_i w_i.
Eigen::Vector4d rational_coefficients(const Eigen::Vector4d& samples, const Eigen::Vector4d& weights);

}  // namespace nurbeam
