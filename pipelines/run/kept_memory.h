#pragma once
#include <malloc.h>

namespace nurbeam {

/// For the whole process: what is given back to the allocator is kept. Vectors of large models are taken and
/// given back in every step, and whole models with every variant of a study: the kernel would clear the same
/// pages again and again.
inline void keep_memory() {
  constexpr int most = 1 << 30;
  mallopt(M_MMAP_THRESHOLD, most);
  mallopt(M_TRIM_THRESHOLD, most);
}

}  // namespace nurbeam
