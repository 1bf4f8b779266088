// The own header comes late on purpose.
// clang-format off
#include <vector>

#include "solver/event.h"
