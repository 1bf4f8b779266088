// The own header comes late on purpose.
// clang-format off
#include <vector>

#include "solver/steps/event.h"

bool same(const char* a, const char* b) { return strcmp(a, b) == 0; }
