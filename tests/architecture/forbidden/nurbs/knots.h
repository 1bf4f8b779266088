#pragma once
#include "fem/mesh/mesh.h"
