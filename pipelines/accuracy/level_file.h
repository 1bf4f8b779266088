#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "pipelines/accuracy/level_numbers.h"

namespace nurbeam {

/// The name of the file that keeps the numbers of a level while a case is refined.
std::string level_file_name(int level);

/// Writes the numbers of a finished run, to a temporary name that is renamed. `inputs`: a digest of what they
/// belong to. Throws std::runtime_error (file and reason).
void write_level(const std::filesystem::path& directory, const LevelNumbers& numbers,
                 const std::string& inputs);

/// The numbers of a level that are there for these inputs; nothing where there are none, or what is there
/// cannot be read.
std::optional<LevelNumbers> read_level(const std::filesystem::path& directory, int level,
                                       const std::string& inputs);

/// Removes the numbers of levels that belong to other inputs.
void remove_other_levels(const std::filesystem::path& directory, const std::string& inputs);

}  // namespace nurbeam
