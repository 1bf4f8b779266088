#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cad_import/report/import_report.h"
#include "nurbs/curve_chain.h"
#include "pipelines/case/case_file.h"

namespace nurbeam {

/// A gap between two ends of curves.
struct Gap {
  int curve_a, curve_b;   ///< indices into the report's curves
  Eigen::Vector3d point;  ///< midway [m]
  double width;           ///< [m]
};

/// What a case asks of a file, or why it cannot have it.
struct AxisSelection {
  std::vector<Chain> chains;  ///< of indices into the report's curves; one unless all are asked for
  std::vector<Gap> gaps;      ///< inside the chains
  std::string key;            ///< the key of "axis" that the error is about; "" for the axis itself
  std::string error;          ///< empty when there are chains
};

/// The distance up to which ends of curves meet [m]: the one asked for; else the file's own resolution, from
/// 1e-9 to 1e-3 of the size of the curves together; where the file declares none 1e-6 of that size.
double gap_tolerance(const ImportReport& report, const std::optional<double>& asked);

/// The chains that `axis` chooses: among the curves of a part, of a layer and of a colour the named one
/// (alone, or with the tangent-continuous ones connected to it), the chain nearest to a point, the longest,
/// all, or the only one. Where no curve is named, those that are not hidden count, and of them the curves
/// that no face uses count; if there are none the centre lines of pipes; if there are none either the edges
/// of faces.
AxisSelection select_axis(const AxisFile& axis, const ImportReport& report);

/// A place where three or more ends of curves meet.
struct Junction {
  Eigen::Vector3d point;    ///< [m]
  std::vector<int> curves;  ///< indices into the report's curves, ascending
};

/// The junctions, within the tolerance [m], of those curves that count (see select_axis); none of edges of
/// faces, where every vertex is one.
std::vector<Junction> junctions(const ImportReport& report, double tolerance);

/// Chains of the curves that count, as select_axis would offer them.
std::vector<Chain> chains_of(const ImportReport& report, double tolerance);

/// `1-4, 7 "rim"`: numbers from 1 and names of curves, the first 20.
std::string list_of_curves(const ImportReport& report, std::vector<int> indices);

/// Angle above which a joint of two curves is a corner unless the case says otherwise [rad].
constexpr double default_corner_angle = 1e-4;

}  // namespace nurbeam
