#pragma once
#include <vector>

namespace nurbeam {

struct Structure;

/// Where the parts of a structure that remember have their numbers in State::memory: three of each rider with
/// friction, one of each stop and one of each connector that jumps; -1 of those that remember nothing.
struct MemoryPlaces {
  std::vector<int> riders, stops, connectors;
  int size = 0;

  MemoryPlaces() = default;
  explicit MemoryPlaces(const Structure& structure);
};

}  // namespace nurbeam
