#pragma once
#include <array>

#include "solver/algebra/banded_lu.h"
#include "solver/algebra/every_processor.h"

/// Parts shared by the factorisation of BandedLu and the solutions with it, for their own source files.
namespace nurbeam {

/// Four numbers that follow one another, and squares of them.
namespace fours {

constexpr int block = BandedLu::block;

using Four = BandedLu::Four;
NURBEAM_WITHIN Four& four(double* at) { return *reinterpret_cast<Four*>(at); }
NURBEAM_WITHIN const Four& four(const double* at) { return *reinterpret_cast<const Four*>(at); }
using Square = std::array<std::array<double, block>, block>;
NURBEAM_WITHIN Four product(const Square& columns, const Four& x) {
  return (four(columns[0].data()) * x[0] + four(columns[1].data()) * x[1]) +
         (four(columns[2].data()) * x[2] + four(columns[3].data()) * x[3]);
}

// The product with the upper triangle of the square alone, its diagonal included.
using Choice = long long __attribute__((vector_size(4 * sizeof(long long))));
NURBEAM_WITHIN Four upper_product(const Square& columns, const Four& x) {
  const auto above = [&](int c, const Choice& chosen) { return chosen ? four(columns[c].data()) : Four{}; };
  return (above(0, Choice{-1, 0, 0, 0}) * x[0] + above(1, Choice{-1, -1, 0, 0}) * x[1]) +
         (above(2, Choice{-1, -1, -1, 0}) * x[2] + four(columns[3].data()) * x[3]);
}

// The product with the lower triangle of the square, with ones on its diagonal.
NURBEAM_WITHIN Four lower_product(const Square& columns, const Four& x) {
  const auto below = [&](int c, const Choice& chosen, const Four& unit) {
    return chosen ? four(columns[c].data()) : unit;
  };
  return (below(0, Choice{0, -1, -1, -1}, Four{1, 0, 0, 0}) * x[0] +
          below(1, Choice{0, 0, -1, -1}, Four{0, 1, 0, 0}) * x[1]) +
         (below(2, Choice{0, 0, 0, -1}, Four{0, 0, 1, 0}) * x[2] + Four{0, 0, 0, 1} * x[3]);
}

}  // namespace fours

// The rows of U of a block, from beyond the next block on.
NURBEAM_WITHIN std::array<const double*, BandedLu::block> BandedLu::upper_beyond(int k) const {
  const Block& own = blocks_[k / block];
  std::array<const double*, block> u;
  for (int r = 0; r < block; ++r) u[r] = upper_.data() + own.upper_begin + r * own.upper_length;
  return u;
}

// The multipliers of a block, column by column, in the rows beyond the next block.
NURBEAM_WITHIN std::array<const double*, BandedLu::block> BandedLu::multipliers_beyond(int k) const {
  const Block& own = blocks_[k / block];
  std::array<const double*, block> m;
  for (int c = 0; c < block; ++c) m[c] = lower_.data() + own.lower_begin + c * own.lower_length;
  return m;
}

}  // namespace nurbeam
