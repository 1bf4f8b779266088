#pragma once
#include <Eigen/SparseCore>

#include "solver/system/second_order_system.h"

namespace nurbeam {

/// [M + (h/2) D + (h^2/4) K, G'; G 0] at one state, the first block divided by its scale.
class ScaledKkt {
 private:
  Eigen::VectorXd values_;

 public:
  Eigen::Map<Eigen::SparseMatrix<double>> matrix;  ///< with the pattern of the system, which must outlive it
  double scale = 1;

  explicit ScaledKkt(const SecondOrderSystem& system, const State& state, double h = 0);
  ScaledKkt(const ScaledKkt&) = delete;
  ScaledKkt& operator=(const ScaledKkt&) = delete;

 private:
  void scale_coordinates(int n);
};

}  // namespace nurbeam
