#pragma once
#include <kinsol/kinsol.h>

#include <boost/version.hpp>

#include "fem/motion/run/simulation.h"
#include "fem/no_such_header.h"
#include "tests/support/dual.h"
