#pragma once
#include <array>

#include "solver/banded_lu.h"
#include "solver/every_processor.h"

/// What the factors of BandedLu and the solutions with them share, for their own source files.
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

}  // namespace fours

NURBEAM_WITHIN double BandedLu::inverse_pivot(int k) const {
  return blocks_[k / block].upper[k % block][k % block];
}

// From column 0 on, if it were so long.
NURBEAM_WITHIN const double* BandedLu::upper_row(int k) const {
  const Block& own = blocks_[k / block];
  const int row = k % block;
  return upper_.data() + own.upper_begin + row * own.upper_length - (k - row);
}

// Within a block.
NURBEAM_WITHIN double BandedLu::multiplier(int row, int column) const { return upper_row(row)[column]; }

// Of the rows below a block, of each of its columns.
NURBEAM_WITHIN std::array<const double*, BandedLu::block> BandedLu::multipliers_below(int k) const {
  const Block& own = blocks_[k / block];
  std::array<const double*, block> m;
  for (int c = 0; c < block; ++c) m[c] = lower_.data() + own.lower_begin + c * own.lower_length;
  return m;
}

}  // namespace nurbeam
