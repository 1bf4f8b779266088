#pragma once
#include <Eigen/Core>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "cad_import/report/import_report.h"
#include "pipelines/section/profile_polygon.h"

namespace nurbeam {

/// A closed planar profile: one outline with holes, and its moments about its own axes through the centroid.
///
/// In a plane z = const of the file, x and y are the file's. In any other plane y is the direction in it
/// nearest to the file's z axis. x is perpendicular to y, with its largest component positive.
struct SectionProfile {
  std::vector<Loop> loops;   ///< (x, y, 0) about the centroid: the outline anticlockwise, holes clockwise
  Eigen::Vector3d centroid;  ///< in the file's coordinates [m]
  Eigen::Vector3d x_axis, y_axis;  ///< in the file's coordinates
  double area = 0;                 ///< [m^2]
  double second_x = 0;             ///< I_x: integral of y^2, for bending that moves the section along y [m^4]
  double second_y = 0;             ///< I_y: integral of x^2 [m^4]
  double product = 0;              ///< I_xy: integral of x y [m^4]

  /// Greatest and least second moment about an axis through the centroid [m^4].
  double principal_1() const;
  double principal_2() const;
  /// From the x axis to the axis of principal_1, in (-pi/2, pi/2]; 0 where all axes are alike [rad].
  double principal_angle() const;
};

/// A profile and everything that is wrong with it; `value` is empty when any diagnostic is an error.
struct ProfileReport {
  std::optional<SectionProfile> value;
  std::vector<Diagnostic> diagnostics;
};

/// The profile that all the curves of a file make: closed chains in one plane that do not cross, one of which
/// holds the others. `where` heads the diagnostics. Curves of degree above 3 are approximated to 1e-9 of the
/// profile's size.
ProfileReport section_profile(const std::vector<ImportedCurve>& curves, const std::string& where);

/// Moments, axes and the torsion constant, which is computed for this, as lines of a name and values.
void print_profile(std::ostream& out, const SectionProfile& profile);

}  // namespace nurbeam
