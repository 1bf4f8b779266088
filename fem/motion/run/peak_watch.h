#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "fem/motion/run/energy_account.h"
#include "fem/motion/run/span_shapes.h"
#include "fem/system/beam_system.h"

namespace nurbeam {

/// The start of a step that may have an extreme of the run.
struct PeakMoment {
  State state;
  double step = 0;  ///< length of the step before it [s]
  EnergyAccount account;
  std::vector<double> indicators = {};  ///< of PeakWatch
};

/// Keeps the moments between snapshots at which a quantity of a run is larger than ever before.
///
/// Each step gives a few indicators, by vectors of the nodes alone: of each beam displacement, tension,
/// compression, bending and both together, of bodies speed and force, of supports and joints
/// multipliers, of connectors force, and the energies. Where an indicator has passed a maximum in time that
/// is larger than all before, the state of this moment is kept until a larger one comes. What is kept in the
/// end deserves a snapshot, which has the values themselves: it takes longer than a step.
class PeakWatch {
 public:
  /// Looks at the end of a step; returns whether its start is to be kept. `afresh`: the step is the first one
  /// on its mesh or after an event, and its start does not count.
  bool passes_peak(const std::shared_ptr<const BeamSystem>& system, const State& after, bool afresh);
  /// Keeps the start of the step that was looked at last.
  void keep(PeakMoment moment);
  /// Whether no more moments are worth their memory.
  bool is_full() const;
  /// Takes it that the last state that was looked at has a snapshot.
  void record();

  /// The system of the steps that were looked at last; null before the first.
  const std::shared_ptr<const BeamSystem>& system() const { return system_; }
  const std::vector<PeakMoment>& kept() const { return kept_; }
  /// Forgets all moments, and returns those that deserve a snapshot in spite of what it takes: their
  /// indicators are much larger than in snapshots so far.
  std::vector<PeakMoment> take_notable();

  /// All that a checkpoint needs of it, and back. `system`: that of the checkpoint, of which all moments are;
  /// `state`: likewise.
  std::vector<double> numbers() const;
  void go_on_from(const std::vector<double>& numbers, const std::shared_ptr<const BeamSystem>& system,
                  const State& state);

 private:
  struct Node {
    const MeshNode* node;
    Eigen::Vector3d drawn;
    Eigen::Vector3d tangent = {};  ///< of the drawing at s, where the node moves
    double s = -1;                 ///< of `drawn`, where the node moves [m]
    double length = 0;             ///< half the lengths of its spans [m]
  };
  struct WatchedBeam {
    const Beam* beam;
    SpanShapes spans;
    std::vector<Node> nodes;
    double radius;  ///< of a disk as stiff [m]
  };
  static Eigen::Vector3d drawn_near(const Beam& beam, double s, Node& node);
  void prepare(const BeamSystem& system, const State& state);
  void measure(const BeamSystem& system, const State& state);
  template <int D>
  void measure_beam(WatchedBeam& watched, const State& state, double* energies);
  void drop_surpassed();

  std::shared_ptr<const BeamSystem> system_;
  std::vector<WatchedBeam> beams_;
  std::vector<bool> adrift_;               ///< bodies that have left their beams do not count
  std::vector<std::pair<int, int>> rows_;  ///< of constraints: first and number of their multipliers
  std::vector<double> earlier_, last_, now_;
  std::vector<double> best_, top_;  ///< the largest in snapshots, and with what is kept
  std::vector<PeakMoment> kept_;    ///< in order of time
  long steps_ = 0, found_ = 0;
};

}  // namespace nurbeam
