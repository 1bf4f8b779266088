#pragma once
#include <Eigen/Core>

namespace nurbeam {

/// Whether all numbers of a vector or matrix are finite: a sum of zeros is zero, and not a number else.
template <class Numbers>
bool all_finite(const Numbers& numbers) {
  return (numbers.array() * 0.0).sum() == 0;
}

}  // namespace nurbeam
