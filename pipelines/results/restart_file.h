#pragma once
#include <filesystem>

#include "fem/motion/record/checkpoint.h"

namespace nurbeam {

/// Writes a restart point as netCDF, to a temporary name that is renamed. Throws std::runtime_error (file and
/// reason).
void write_checkpoint(const std::filesystem::path& file, Checkpoint point);
/// Throws std::runtime_error (file and reason).
Checkpoint read_checkpoint(const std::filesystem::path& file);

}  // namespace nurbeam
