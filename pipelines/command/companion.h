#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "cad_import/files/companion_program.h"

namespace nurbeam {

/// This process goes on as another program with these arguments. Throws std::runtime_error where it cannot be
/// started.
[[noreturn]] void become_program(const std::filesystem::path& program, std::vector<std::string> words);

}  // namespace nurbeam
