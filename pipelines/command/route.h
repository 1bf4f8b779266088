#pragma once
#include "pipelines/command/commands.h"

namespace nurbeam {

/// `nurbeam route`: finds the cables of a file, prints what they have come to, and writes their curves.
int route_command(const Arguments& arguments, Streams streams);

}  // namespace nurbeam
