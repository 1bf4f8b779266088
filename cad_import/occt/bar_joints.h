#pragma once
#include <string>
#include <vector>

#include "cad_import/occt/hollow_bars.h"

namespace nurbeam {

/// The centre line of a hollow bar, or a part of it [mm].
struct BarLine {
  Eigen::Vector3d start, end;
  BarSection section;
  int face;
};

struct JoinedBars {
  std::vector<BarLine> lines;
  std::vector<std::string> remarks = {};  ///< on ends that stand anywhere on their cut
};

/// Bars from where their centre lines begin to where they end: where the plane of a cut meets the centre
/// line, or, of one that ends on another bar, where the two centre lines meet, and that one is divided there.
JoinedBars joined_bars(const std::vector<HollowBar>& bars);

}  // namespace nurbeam
