#pragma once
#include <array>

namespace nurbeam {

/// The five-point Gauss rule on [0,1], exact for polynomials of degree 9.
struct GaussRule {
  static constexpr int size = 5;
  static constexpr std::array<double, size> points{0.046910077030668003601, 0.23076534494715845448, 0.5,
                                                   0.76923465505284154552, 0.95308992296933199640};
  static constexpr std::array<double, size> weights{0.11846344252809454376, 0.23931433524968323402,
                                                    0.28444444444444444444, 0.23931433524968323402,
                                                    0.11846344252809454376};
};

}  // namespace nurbeam
