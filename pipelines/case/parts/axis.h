#pragma once
#include <filesystem>
#include <variant>

#include "nurbs/bent_lines.h"
#include "nurbs/nurbs_curve.h"
#include "pipelines/case/fields.h"

namespace nurbeam {

/// What narrows a choice among the curves of a CAD file.
struct CurveChoice {
  std::optional<std::string> part = {}, layer = {}, colour = {};
};

/// Which curves of a CAD file.
struct AxisFile {
  std::filesystem::path path;  ///< absolute
  std::optional<std::string> curve_name = {};
  std::optional<int> curve_index = {};  ///< from 1
  bool chain = false;
  std::optional<std::string> part = {}, layer = {}, colour = {};
  std::optional<Eigen::Vector3d> near = {};  ///< [m]
  bool longest = false;
  bool all_chains = false;
  std::optional<double> gap = {};  ///< largest gap to close [m]

  CurveChoice choice() const { return {part, layer, colour}; }
};

struct CaseAxis {
  using File = AxisFile;
  using Polyline = std::vector<Eigen::Vector3d>;
  struct Arc {
    Eigen::Vector3d center, start, end, normal;
  };
  std::variant<File, NurbsCurve, Polyline, BentLines, Arc> source;
};

/// What the keys of a CurveChoice mean.
inline constexpr const char* only_part =
    "only curves of this part (STEP), group (IGES) or block (DXF): its name, or the end of its path";
inline constexpr const char* only_layer = "only curves of this layer (STEP, DXF) or level (IGES)";
inline constexpr const char* only_colour = "only curves of this colour, \"#rrggbb\"";

/// The shape of the "axis" of a beam; case_axis.h reads it.
Shape axis_shape();

}  // namespace nurbeam
