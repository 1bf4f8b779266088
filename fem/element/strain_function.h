#pragma once
#include <array>
#include <cstddef>

#include "fem/material/numbers.h"

namespace nurbeam {

template <int D, class E>
using NodeNumbers = std::array<std::array<E, D>, 4>;  ///< r_A, r_sA, r_B, r_sB by node and direction

/// A function of the nodes e that is an integral or a value of the axial strain: tr(e G e')/2 less a
/// constant, with its gradient e G and its second derivatives G times the unit matrix.
template <int D, class E>
struct StrainFunction {
  E value;
  NodeNumbers<D, E> by_e;
  std::array<std::array<E, 4>, 4> by_ee;
};

/// Weighted stresses on n functions of the strain, and their weighted derivatives by the functions (`by_x`)
/// and once more by the functions of the rates of the nodes (`by_rate`).
template <std::size_t n, class E>
struct StrainStresses {
  std::array<E, n> on;
  std::array<std::array<E, n>, n> by_x, by_rate;
};

/// Adds the tangent of stresses on functions of the strain, by column and row; `e_rate`: the rates of the
/// nodes, null without damping. Only the blocks above the diagonal, unless `full`.
template <int D, class E, std::size_t n, class Tangents>
NURBEAM_WITHIN void add_stress_tangents(const std::array<StrainFunction<D, E>, n>& x,
                                        const NodeNumbers<D, E>* e_rate, const StrainStresses<n, E>& stresses,
                                        bool full, Tangents& K) {
  std::array<NodeNumbers<D, E>, n> x_rate;  // gradients of the rates of x in the nodes
  for (std::size_t i = 0; e_rate && i < n; ++i)
    for (int k = 0; k < 4; ++k)
      for (int d = 0; d < D; ++d) {
        x_rate[i][k][d] = (*e_rate)[0][d] * x[i].by_ee[0][k];
        for (int m = 1; m < 4; ++m) x_rate[i][k][d] += (*e_rate)[m][d] * x[i].by_ee[m][k];
      }
  for (int k = 0; k < 4; ++k)
    for (int b = 0; b < D; ++b) {
      std::array<E, n> by;
      for (std::size_t i = 0; i < n; ++i) {
        by[i] = stresses.by_x[i][0] * x[0].by_e[k][b];
        for (std::size_t j = 1; j < n; ++j) by[i] += stresses.by_x[i][j] * x[j].by_e[k][b];
        for (std::size_t j = 0; e_rate && j < n; ++j) by[i] += stresses.by_rate[i][j] * x_rate[j][k][b];
      }
      for (int m = 0; m <= (full ? 3 : k); ++m) {
        for (int a = 0; a < D; ++a)
          for (std::size_t i = 0; i < n; ++i) K[k * D + b][m * D + a] += x[i].by_e[m][a] * by[i];
        for (std::size_t i = 0; i < n; ++i) K[k * D + b][m * D + b] += stresses.on[i] * x[i].by_ee[k][m];
      }
    }
}

}  // namespace nurbeam
