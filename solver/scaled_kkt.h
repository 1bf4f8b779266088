#pragma once
#include <Eigen/SparseCore>

#include "solver/second_order_system.h"

namespace nurbeam {

/// [M + (h/2) D + (h^2/4) K, G'; G 0] at one state, the first block divided by its scale.
struct ScaledKkt {
  Eigen::SparseMatrix<double> matrix;
  double scale = 1;

  explicit ScaledKkt(const SecondOrderSystem& system, const State& state, double h = 0);

 private:
  void scale_coordinates(int n);
};

}  // namespace nurbeam
