#pragma once
#include <Eigen/Core>
#include <array>

#include "fem/element/layout.h"

namespace nurbeam {

/// A matrix in the coordinates of an element, without the parts that differ between components of the nodes.
template <int D>
struct PlaceSums {
  using Nodes = ElementNodes<D>;
  Eigen::Matrix4d isotropic = Eigen::Matrix4d::Zero();
  /// Derivatives of forces on nodes by the places.
  std::array<Nodes, 2> by_place{Nodes::Zero(), Nodes::Zero()};
  /// Derivatives of forces on places by the nodes.
  std::array<Nodes, 2> of_place{Nodes::Zero(), Nodes::Zero()};
  /// Derivatives of forces on places by the places.
  Eigen::Matrix2d places = Eigen::Matrix2d::Zero();

  ElementMatrix<D> matrix() const {
    using Layout = ElementLayout<D>;
    using Column = Eigen::Matrix<double, Layout::nodal, 1>;
    ElementMatrix<D> K = ElementMatrix<D>::Zero();
    for (int k = 0; k < 4; ++k)
      for (int l = 0; l < 4; ++l)
        for (int c = 0; c < D; ++c) K(l * D + c, k * D + c) = isotropic(l, k);
    for (const int i : {0, 1}) {
      K.col(Layout::place(i)).template head<Layout::nodal>() = Eigen::Map<const Column>(by_place[i].data());
      K.row(Layout::place(i)).template head<Layout::nodal>() =
          Eigen::Map<const Column>(of_place[i].data()).transpose();
    }
    K.template bottomRightCorner<2, 2>() = places;
    return K;
  }
};

/// A covector in the coordinates of an element.
template <int D>
struct Gradient {
  ElementNodes<D> nodes = ElementNodes<D>::Zero();
  std::array<double, 2> places{};

  ElementVector<D> vector() const {
    ElementVector<D> f;
    f << Eigen::Map<const Eigen::Matrix<double, 4 * D, 1>>(nodes.data()), places[0], places[1];
    return f;
  }
};

}  // namespace nurbeam
