#pragma once
#include "fem/motion/run/simulation.h"
