#pragma once
#include "fem/mesh.h"
