#pragma once
#include <array>

#include "fem/element/quadrature.h"
#include "fem/material/numbers.h"

namespace nurbeam {

/// Numbers of a point of an element with fixed ends: first and second derivatives of the shape functions,
/// weight [m], curvature of the stress-free shape [1/m] and strain of its label; weights of the axial strain
/// there in its Legendre coefficients e_1..e_4 (strain_weights).
template <class P>
struct PointNumbers {
  std::array<P, 4> S1, S2;
  P weight, kappa0, eps0;
  std::array<P, 4> in_strain;
};

/// One number at each Gauss point of a part of an element, side by side; a last lane makes the count even,
/// as suits the processor.
using Lanes = SideBySide<GaussRule::size + GaussRule::size % 2>;

/// The Gauss points of a part of an element by itself. Lanes beyond the points repeat the last one without
/// weight.
using PointPack = PointNumbers<Lanes>;

}  // namespace nurbeam
