#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "fem/system/beam_system.h"

namespace nurbeam {

/// Finds the moments between two snapshots at which a quantity of a run is larger than at any snapshot
/// before.
///
/// Each step gives a few indicators, by vectors of the nodes alone: of each beam displacement, tension,
/// compression, bending and both together, of bodies speed and force, of supports and joints force and
/// couple, of connectors force, and the energies. Where an indicator has passed a maximum in time that is
/// larger than all before, the state of this moment deserves a snapshot, which then has the values
/// themselves.
class PeakWatch {
 public:
  /// Looks at the end of a step; returns whether its start deserves a snapshot. `afresh`: the step is the
  /// first one on its mesh or after an event, and its start does not count.
  bool passes_peak(const BeamSystem& system, const State& after, bool afresh);
  /// Takes it that the last state that was looked at has a snapshot.
  void record();

  /// All that a checkpoint needs of it, and back.
  std::vector<double> numbers() const;
  void go_on_from(const std::vector<double>& numbers);

 private:
  /// A span of the mesh: its nodes' coordinates and its values as drawn.
  struct Span {
    int r[2], slope[2];  ///< first coordinates
    double length, strain, curvature[2];
  };
  struct BeamSpans {
    std::vector<Span> spans;
    std::vector<std::pair<int, Eigen::Vector3d>> nodes;  ///< first coordinate and drawn position
    const BeamProperties* properties;
    double radius;  ///< of a disk as stiff [m]
  };
  void prepare(const BeamSystem& system, const State& state);
  void measure(const BeamSystem& system, const State& state);
  template <int D>
  void measure_beam(const BeamSpans& beam, const State& state, double* energies);
  void measure_constraints(const BeamSystem& system, const State& state);

  const BeamSystem* system_ = nullptr;
  std::vector<BeamSpans> beams_;
  std::vector<double> earlier_, last_, now_, best_;
  long steps_ = 0, found_ = 0;
};

}  // namespace nurbeam
