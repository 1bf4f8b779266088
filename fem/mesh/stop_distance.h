#pragma once
#include <Eigen/Core>
#include <vector>

#include "fem/mesh/mesh.h"

namespace nurbeam {

/// Whether all bodies of a stop are on their beams.
inline bool is_in_place(const Mesh& mesh, const Stop& stop) {
  return mesh.riders[stop.rider].place >= 0 && (stop.other < 0 || mesh.riders[stop.other].place >= 0);
}

/// The distance d of a stop that is in place, in one mesh: of one body along its beam; of two that too as
/// long as they are twice their gap apart. Nearer together on a beam that deforms it is the line between
/// them, longer by as much as the drawn beam is than its chord there: they press against each other, and not
/// each against the beam. On a rigid guide both are the same.
///
/// The structure must outlive it. Coordinates: the two places (-1 for none), and then positions of both
/// bodies where it knows of them.
class StopDistance {
 public:
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 8, 1>;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 8, 8>;

  StopDistance(const Structure& structure, const Mesh& mesh, const Stop& stop);

  const std::vector<int>& dofs() const { return dofs_; }
  /// d [m], and of rates of the coordinates its own [m/s]: n coordinates each.
  double value(const Eigen::VectorXd& q) const;
  double rate(const Eigen::VectorXd& q, const Eigen::VectorXd& v) const;
  /// d''.
  double acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a) const;
  /// In its own coordinates.
  Vector gradient(const Eigen::VectorXd& q) const;
  Matrix hessian(const Eigen::VectorXd& q) const;
  /// What of `x`, n coordinates, is its own; 0 where it has none.
  Vector own(const Eigen::VectorXd& x) const;
  /// What a force N that opens it gives to a body along its line [N], dimension D; 0 of places alone.
  Eigen::Vector3d on_body(int body, const Eigen::VectorXd& q, double N) const;

 private:
  double along_beam(const Eigen::VectorXd& q) const;
  // Whether the line between the bodies counts.
  bool near(const Eigen::VectorXd& q) const;
  Eigen::Vector3d line(const Eigen::VectorXd& q) const;
  struct Chord;  // of the drawing
  Chord chord(const Eigen::VectorXd& q) const;

  const Stop* stop_;
  const ReferenceCurve* curve_;
  int dimension_;
  std::vector<int> dofs_;
  int bodies_[2];
  double gap_ = 0;  // of two bodies [m]
};

}  // namespace nurbeam
