#include <vector>

#include "solver/event.h"
