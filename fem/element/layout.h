#pragma once
#include <Eigen/Core>
#include <optional>

namespace nurbeam {

/// Positions of the generalised coordinates of an element: q = (r_A, r_sA, r_B, r_sB, s_A, s_B), Eq. 11 of
/// Ding & Ouyang with arc-length gradients and positions instead of r_x and x. Ends are 0 (A) and 1 (B).
template <int D>
struct ElementLayout {
  static constexpr int nodal = 4 * D;                              ///< number of positions and slopes
  static constexpr int size = nodal + 2;                           ///< number of all coordinates
  static constexpr int r(int end) { return 2 * D * end; }          ///< first of D
  static constexpr int slope(int end) { return 2 * D * end + D; }  ///< first of D
  static constexpr int place(int end) { return nodal + end; }

  using Nodes = Eigen::Matrix<double, D, 4>;  ///< columns r_A, r_sA, r_B, r_sB
  using Coordinates = Eigen::Matrix<double, size, 1>;
  using Matrix = Eigen::Matrix<double, size, size>;

  static Nodes nodes(const Coordinates& q) { return Eigen::Map<const Nodes>(q.data()); }
};

/// Positions of the coordinates of an element with torsion: first those of ElementLayout<3>, then the angles
/// of the sections at both ends in their charts, then the bubble of twist.
struct TwistLayout : ElementLayout<3> {
  static constexpr int first = ElementLayout<3>::size;
  static constexpr int angle(int end) { return first + end; }
  static constexpr int bubble = first + 2;
  static constexpr int size = first + 3;

  using Coordinates = Eigen::Matrix<double, size, 1>;
  using Matrix = Eigen::Matrix<double, size, size>;
};

template <int D>
inline constexpr int element_size = ElementLayout<D>::size;
template <int D>
using ElementVector = typename ElementLayout<D>::Coordinates;
template <int D>
using ElementMatrix = typename ElementLayout<D>::Matrix;
template <int D>
using ElementNodes = typename ElementLayout<D>::Nodes;

/// Coordinates and their rates of one element.
template <int D>
struct ElementState {
  ElementVector<D> q, v, a;
  double free_strain = 0;         ///< free strain at the present time (FreeStrain)
  std::optional<bool> taut = {};  ///< the side on which TautViscosity is held; none: by the strain
  double stabilisation = 1;       ///< of the state: factor on FoldResistance

  ElementNodes<D> nodes() const { return ElementLayout<D>::nodes(q); }
  ElementNodes<D> node_rates() const { return ElementLayout<D>::nodes(v); }
};

}  // namespace nurbeam
