#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

namespace nurbeam {

/// Loads on a section about its own axes: axial force [N], moments about d1 and d2 and torque [N m].
struct SectionLoads {
  double axial_force = 0, moment_1 = 0, moment_2 = 0, torque = 0;
};

/// A place of a section, and its shear stress per torque.
struct StressPlace {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< from the centroid along d1 and d2 [m]
  double shear_per_torque = 0;                      ///< [1/m^3]
};

/// The stresses of beams with torsion: sigma from the axial force and both moments, tau from the torque.
/// Stresses of shear forces and of warping are left out.
class SectionStresses {
 public:
  /// The stresses at the places where they are largest.
  struct Largest {
    double normal;     ///< normal stress of the largest magnitude, with its sign [Pa]
    double von_mises;  ///< sqrt(sigma^2 + 3 tau^2) [Pa]; NaN where the shear of a place is not known
  };

  /// A disk or a pipe: all places are on a circle, tau = T r/J. `second_moment` is I [m^4],
  /// `torsion_constant` J [m^4].
  static SectionStresses round(double area, double second_moment, double torsion_constant, double radius);
  /// A section given by places. `second_moments` and `product` are I_x = int y^2 dA, I_y = int x^2 dA and
  /// I_xy = int x y dA [m^4]. Throws std::invalid_argument without places.
  SectionStresses(double area, const Eigen::Vector2d& second_moments, double product,
                  std::vector<StressPlace> places);

  Largest largest(const SectionLoads& loads) const;

 private:
  SectionStresses(double area, double second_moment, StressPlace on_circle);

  double area_;
  Eigen::Matrix2d moments_inverse_;  // inverse of [I_x, -I_xy; -I_xy, I_y] [1/m^4]
  bool round_ = false;               // the single place then turns to where the stress is largest
  std::vector<StressPlace> places_;
};

}  // namespace nurbeam
