#include "pipelines/run/kept_memory.h"

#include <malloc.h>

namespace nurbeam {

void keep_memory() {
  constexpr int most = 1 << 30;
  mallopt(M_MMAP_THRESHOLD, most);
  mallopt(M_TRIM_THRESHOLD, most);
}

void give_back_memory() { malloc_trim(0); }

}  // namespace nurbeam
