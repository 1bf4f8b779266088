#pragma once
#include <optional>
#include <string>
#include <vector>

#include "fem/motion/record/snapshot.h"

namespace nurbeam {

/// The largest magnitude (of the least axial force: the least value) that a quantity has in all frames.
struct RunExtreme {
  std::string quantity, unit;  ///< "cable.axial_force.max", "N"
  double value;
  std::optional<double> s;  ///< reference arc length, where it is of a beam [m]
  double time;              ///< [s]
};

/// What stands out in a run: of beams the extremes along them, of bodies speed and joint force, of supports
/// and joints force and couple.
class RunExtremes {
 public:
  void look_at(const Snapshot& frame, const SnapshotNames& names);
  const std::vector<RunExtreme>& list() const { return list_; }

 private:
  void keep(const RunExtreme& candidate, bool least);

  std::vector<RunExtreme> list_;
  std::size_t next_ = 0;  // of list_, while a frame is looked at
};

}  // namespace nurbeam
