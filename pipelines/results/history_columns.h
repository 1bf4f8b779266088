#pragma once
#include <functional>
#include <string>
#include <vector>

#include "fem/motion/record/snapshot.h"

namespace nurbeam {

/// One history of a run: what histories.csv, the report and the static values show, in their order.
struct HistoryColumn {
  std::string of;     ///< what it belongs to: probe, body, beam, reaction, collector or energy
  std::size_t index;  ///< number within it
  std::string name;   ///< of that object; "energy"
  std::string quantity, unit;
  std::function<double(const Snapshot&)> value;  ///< NaN where there is none
  SnapshotContents contents;                     ///< that it is read from
  Extreme BeamRecord::*extreme = nullptr;        ///< of a beam, where it is one

  /// "trolley.x [m]".
  std::string heading() const { return name + "." + quantity + " [" + unit + "]"; }
};

/// What a row of histories between two frames is read from: all but what needs all elements.
inline constexpr SnapshotContents contents_between_frames{.beams = false, .measures = false};
inline bool is_known_between_frames(const HistoryColumn& column) {
  return !column.contents.beams && !column.contents.measures;
}

/// All but the time. New ones are added at the end.
std::vector<HistoryColumn> history_columns(const SnapshotNames& names);

}  // namespace nurbeam
