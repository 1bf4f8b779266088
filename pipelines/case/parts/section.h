#pragma once
#include <filesystem>

#include "pipelines/case/fields.h"
#include "pipelines/case/parts/axis.h"

namespace nurbeam {

/// A section drawn in a CAD file.
struct CaseProfile {
  std::filesystem::path path;  ///< absolute; of an outline what it is called
  bool x_in_plane = false;     ///< a planar model bends along the profile's x axis; else along y
  /// Given by numbers instead of a file: corners, anticlockwise [m].
  std::vector<Eigen::Vector2d> outline = {};
  CurveChoice curves = {};  ///< of the file
};

struct CaseSection {
  double area = 0;                           ///< [m^2]
  double second_moment = 0;                  ///< [m^4]
  std::optional<double> radius = {};         ///< of a disk or a pipe [m]
  std::optional<double> bore = {};           ///< inner radius of a pipe [m]
  std::optional<double> extreme_fibre = {};  ///< greatest distance from the axis of bending [m]
  std::optional<std::array<double, 2>> second_moments = {};  ///< I_x, I_y, where they may differ [m^4]
  double product = 0;                                        ///< I_xy [m^4]
  std::optional<double> torsion_constant = {};               ///< [m^4]
  std::optional<CaseProfile> profile = {};                   ///< what gives area and second moment
  bool flexible_bends = false;  ///< bends of the pipe are softer, as its section becomes oval there
  bool from_cad = false;        ///< all are those of the pipe whose centre line the axis is
};

/// The shape of the "section" of a beam; case_beam.cpp reads it.
Shape section_shape();

}  // namespace nurbeam
