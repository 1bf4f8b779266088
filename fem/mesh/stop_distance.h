#pragma once
#include <Eigen/Core>
#include <vector>

#include "fem/mesh/mesh.h"

namespace nurbeam {

/// Whether all bodies of a stop are on their beams.
inline bool is_in_place(const Mesh& mesh, const Stop& stop) {
  return mesh.riders[stop.rider].place >= 0 && (stop.other < 0 || mesh.riders[stop.other].place >= 0);
}

/// The distance d of a stop whose bodies are on their beams, in one mesh. For one body, and for two at least
/// twice their gap apart, d is measured along the beam. For two bodies nearer together on a beam that
/// deforms, d is the line between them plus the excess of the drawn arc over its chord there. They then press
/// against each other, and not each against the beam. On a rigid guide both measures agree.
///
/// The structure must outlive this object. Coordinates: the two places (-1 for none), then the positions of
/// both bodies where d depends on them.
class StopDistance {
 public:
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 8, 1>;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 8, 8>;

  StopDistance(const Structure& structure, const Mesh& mesh, const Stop& stop);

  const std::vector<int>& dofs() const { return dofs_; }
  /// Distance d [m] and its rate [m/s], for all coordinates and rates of the mesh.
  double value(const Eigen::VectorXd& q) const;
  double rate(const Eigen::VectorXd& q, const Eigen::VectorXd& v) const;
  /// Second time derivative of d [m/s^2].
  double acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a) const;
  /// Gradient and Hessian of d in its own coordinates.
  Vector gradient(const Eigen::VectorXd& q) const;
  Matrix hessian(const Eigen::VectorXd& q) const;
  /// The entries of `x` at the coordinates of d, in their order; 0 where a coordinate is missing.
  Vector own(const Eigen::VectorXd& x) const;
  /// Force on a body along the line, for an opening force N of the stop [N], third component 0 in the plane;
  /// 0 where d depends on places alone.
  Eigen::Vector3d on_body(int body, const Eigen::VectorXd& q, double N) const;

 private:
  double along_beam(const Eigen::VectorXd& q) const;
  // Whether the line between the bodies counts.
  bool near(const Eigen::VectorXd& q) const;
  Eigen::Vector3d line(const Eigen::VectorXd& q) const;
  struct Chord;  // chord of the drawn beam
  Chord chord(const Eigen::VectorXd& q) const;

  const Stop* stop_;
  const ReferenceCurve* curve_;
  int dimension_;
  std::vector<int> dofs_;
  int bodies_[2];
  double gap_ = 0;  // least distance of two bodies [m]
};

}  // namespace nurbeam
