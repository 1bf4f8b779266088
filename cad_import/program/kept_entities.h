#pragma once
#include <limits>
#include <set>

namespace nurbeam {

/// Said of an entity that is not kept because of that.
inline constexpr const char* crashed_on =
    "left out: OpenCASCADE crashes on it; it is damaged, or uses what OpenCASCADE cannot read: export it again";

/// Which entities of a file are read, by their numbers from 0: the reader may have crashed on others.
struct KeptEntities {
  int before = std::numeric_limits<int>::max();  ///< all below
  std::set<int> without = {};                    ///< but these, which are named
  int* count = nullptr;                          ///< told how many there are, where it is wanted

  bool contain(int number) const { return number < before && !without.contains(number); }
  void tell(int entities) const {
    if (count != nullptr) *count = entities;
  }
};

}  // namespace nurbeam
