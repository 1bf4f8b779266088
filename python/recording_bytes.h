#pragma once
#include <cstddef>
#include <string>

#include "python/recording.h"

namespace nurbeam::python {

/// Snapshots first, first + 1, ..., first + count - 1 of a recording as the bytes of a file of results
/// (results.nc), to the last bit. Throws std::runtime_error (file and reason) where no file can be written in
/// the directory for temporary ones.
std::string bytes_of(const Recording& recording, std::size_t first, std::size_t count);

/// The recording of such bytes, without modes.
Recording recording_from(const std::string& bytes);

}  // namespace nurbeam::python
