#pragma once
#include <vector>

namespace nurbeam {

struct Structure;

/// First index in State::memory of each part that remembers: three numbers for a rider with friction, one for
/// a stop, one for a connector that jumps, one for a rotational connector that counts its angle; -1 for parts
/// without memory.
struct MemoryPlaces {
  std::vector<int> riders, stops, connectors, angles;
  int size = 0;

  MemoryPlaces() = default;
  explicit MemoryPlaces(const Structure& structure);
};

}  // namespace nurbeam
