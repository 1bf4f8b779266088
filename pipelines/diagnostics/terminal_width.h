#pragma once
#include <optional>

namespace nurbeam {

/// Columns of the terminal that a file descriptor writes to; empty where it is none, or does not tell.
std::optional<int> terminal_width(int file);

}  // namespace nurbeam
