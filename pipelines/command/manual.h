#pragma once
#include <string>
#include <vector>

#include "pipelines/command/commands.h"

namespace nurbeam {

/// "nurbeam run CASE.json [--out DIR] ...".
std::string usage_of(const Command& command);
/// The same with the options alone that must be given: "nurbeam run CASE.json [options]".
std::string brief_usage_of(const Command& command);

/// The manual page nurbeam(1), in roff.
std::string manual_page(const std::vector<Command>& commands);

/// A script for bash that completes commands, options and file names.
std::string bash_completion(const std::vector<Command>& commands);

/// What "nurbeam --help" prints.
std::string help_text(const std::vector<Command>& commands);

}  // namespace nurbeam
