#pragma once
#include <Eigen/Core>
#include <vector>

#include "solver/system/second_order_system.h"

namespace nurbeam {

/// Rows of a tangent with a symmetric pattern, found near these rows alone.
class TangentRows {
 public:
  /// `rows`: numbers of coordinates and then multipliers, in order.
  TangentRows(const SecondOrderSystem& system, const State& state, const TangentWeights& weights,
              std::vector<int> rows);

  const std::vector<int>& rows() const { return rows_; }
  /// (rows, columns) Entries of the rows in some columns.
  Eigen::MatrixXd entries(const std::vector<int>& columns) const;
  /// (rows, columns of x) Product of the rows with x, which has a row for each coordinate.
  template <class Columns>
  Eigen::MatrixXd product(const Columns& x) const {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(entries_.rows(), x.cols());
    for (std::size_t k = 0; k < columns_.size() && columns_[k] < x.rows(); ++k)
      sum.noalias() += entries_.col(static_cast<Eigen::Index>(k)) * x.row(columns_[k]);
    return sum;
  }

 private:
  std::vector<int> rows_, columns_;  // columns in order, coupled with the rows
  Eigen::MatrixXd entries_;
};

}  // namespace nurbeam
