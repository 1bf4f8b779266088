#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fem/motion/record/snapshot.h"

namespace nurbeam {

/// The largest magnitude (of the least axial force: the least value) that a quantity has in a run.
struct RunExtreme {
  std::string quantity, unit;  ///< "cable.axial_force.max", "N"
  double value;
  std::optional<double> s;           ///< reference arc length, where it is of a beam [m]
  double time;                       ///< [s]
  std::optional<double> layer = {};  ///< of one in a layer of bending: how far this reaches [m]
};

/// What stands out in a run: of beams the extremes along them, of bodies speed and joint force, of supports
/// and joints force and couple, of connectors the force, and the energies. Bodies count on their beam alone,
/// in the kinetic energy too: one that has left it falls, and so does what hangs on it.
class RunExtremes {
 public:
  /// Goes on from the numbers() of an earlier part of the run; empty: from its start.
  explicit RunExtremes(std::vector<double> before = {}) : before_(std::move(before)) {}

  /// Looks at a moment of the run: a frame, or one between frames.
  void look_at(const Snapshot& frame, const SnapshotNames& names);
  const std::vector<RunExtreme>& list() const { return list_; }
  /// Value, place, time and layer of each, for a restart point.
  std::vector<double> numbers() const;

 private:
  void keep(const RunExtreme& candidate, bool least);

  std::vector<RunExtreme> list_;
  std::vector<double> before_;
  std::size_t next_ = 0;  // of list_, while a frame is looked at
};

}  // namespace nurbeam
