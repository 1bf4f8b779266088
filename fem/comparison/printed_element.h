#pragma once
#include <Eigen/Core>
#include <vector>

#include "fem/element/subdivision.h"
#include "fem/material/section.h"

namespace nurbeam {

enum class PrintedCurvature {
  second_derivative,  ///< |r_xx|: Eq. 23 of [S], the subdivision paper; without sign
  spatial             ///< (r_x x r_xx)/|r_x|^3, signed: the curvature of Ding & Ouyang
};

enum class PrintedStart {
  as_drawn,  ///< strain and curvature count from those of the drawing: Eqs. 22-23 of [S]
  straight   ///< |r_x| = 1 and no curvature are free of stress: Eq. 19 of Ding & Ouyang
};

/// The planar element of the papers with fixed ends as they print it: Eqs. 20-24 of [S]. All integrals are
/// over the label x, without the stretch of the drawing. For comparison: a drawing that is not in even steps
/// then gets mass and stiffness in wrong places.
class PrintedElement {
 public:
  using Nodes = Eigen::Matrix<double, 2, 4>;  ///< r_A, r_xA, r_B, r_xB

  /// The five-point Gauss rule is taken in `panels` equal parts of the label. The axial strain must be
  /// pointwise.
  PrintedElement(const RancfElement& drawn, const BeamProperties& beam, PrintedCurvature curvature,
                 PrintedStart start = PrintedStart::as_drawn, int panels = 1);

  /// Eq. 21: integrals of rho A s_i s_j dx, for slopes times lengths [kg].
  const Eigen::Matrix4d& mass() const { return mass_; }
  /// Integrals of rho A s_i dx, for slopes times a length [kg]: the load under a unit of gravity.
  const Eigen::Vector4d& load_factors() const { return load_factors_; }
  /// Eq. 22 [N], for slopes [N m]: the gradient of the energy; 0 for the curvature where |r_xx| = 0.
  Nodes elastic_force(const Nodes& e) const;

  struct Energy {
    double axial, bending;  ///< [J]
    double total() const { return axial + bending; }
  };
  Energy elastic_energy(const Nodes& e) const;

 private:
  struct Point {
    Eigen::Vector4d d1, d2;  // of the shape functions by x
    double weight;           // in x [m]
    double strain0 = 0, curvature0 = 0;
  };

  BeamProperties beam_;
  PrintedCurvature curvature_;
  std::vector<Point> points_;
  Eigen::Matrix4d mass_ = Eigen::Matrix4d::Zero();
  Eigen::Vector4d load_factors_ = Eigen::Vector4d::Zero();
};

}  // namespace nurbeam
