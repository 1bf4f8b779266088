#pragma once
#include <Eigen/Core>

namespace nurbeam {

/// Whether all numbers of a vector or matrix are finite: their sum times zero is zero, or not a number.
template <class Numbers>
bool all_finite(const Numbers& numbers) {
  return (numbers.array() * 0.0).sum() == 0;
}

}  // namespace nurbeam
