#pragma once
#include <optional>
#include <vector>

#include "fem/mesh/mesh_elements.h"
#include "fem/structure/connector.h"

namespace nurbeam {

/// The line between the ends of a connector in one mesh.
template <int D>
class ConnectorAxis {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Matrix = Eigen::Matrix<double, D, D>;

  ConnectorAxis(const Connector& connector, const Structure& structure, const Mesh& mesh);

  /// (2 D) Coordinates of both ends; -1 for an end at a point.
  const std::vector<int>& dofs() const { return dofs_; }
  int body(int end) const { return bodies_[end]; }

  /// The line of the connector at one state: its length |d|, or n . d; the gradient n of the length in d, and
  /// the rate of the length; its Hessian in d, (1 - n n')/|d|, or 0 along a fixed direction.
  struct Line {
    double length, rate;
    Vector n;
    Matrix curvature;
    Vector rate_gradient;  ///< gradient of the rate in d
  };
  Line line(const State& state) const;

  /// Adds a pull N, which draws the ends together, to inertia less forces.
  void add_pull(const Vector& pull, Eigen::Ref<Eigen::VectorXd> dynamics) const;
  /// The 2 D x 2 D matrix in both ends, from a D x D matrix in d.
  Eigen::Matrix<double, 2 * D, 2 * D> in_ends(const Matrix& in_d) const;

 private:
  Vector difference(const Eigen::VectorXd& x, bool of_places) const;

  std::vector<int> dofs_;
  std::array<int, 2> bodies_;
  std::array<Vector, 2> points_;
  std::optional<Vector> direction_;
};

extern template class ConnectorAxis<2>;
extern template class ConnectorAxis<3>;

}  // namespace nurbeam
