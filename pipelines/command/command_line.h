#pragma once
#include <iosfwd>
#include <string>
#include <vector>

#include "pipelines/command/commands.h"

namespace nurbeam {

/// Runs the command `nurbeam ARGUMENTS...` (without the program's name), one of `table`. Data goes to `out`,
/// messages to `err`. Returns the exit code: 0 done, 1 a comparison failed, 2 bad input, 3 the solver did not
/// converge, 4 results could not be written, 130 interrupted.
int run_command_line(const std::vector<Command>& table, const std::vector<std::string>& arguments,
                     std::ostream& out, std::ostream& err);
/// A command of nurbeam itself.
int run_command_line(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);

}  // namespace nurbeam
