#pragma once
#include <filesystem>
#include <variant>

#include "nurbs/nurbs_curve.h"
#include "pipelines/case/fields.h"

namespace nurbeam {

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
};

struct CaseAxis {
  using File = AxisFile;
  using Polyline = std::vector<Eigen::Vector3d>;
  struct Arc {
    Eigen::Vector3d center, start, end, normal;
  };
  std::variant<File, NurbsCurve, Polyline, Arc> source;
};

/// The shape of the "axis" of a beam; case_axis.h reads it.
Shape axis_shape();

}  // namespace nurbeam
