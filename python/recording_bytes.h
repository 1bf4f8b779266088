#pragma once
#include <string>
#include <vector>

#include "python/recording.h"

namespace nurbeam::python {

/// Snapshots of a recording as the bytes of a file of results (results.nc), to the last bit. Throws
/// std::runtime_error (file and reason) where no file can be written in the directory for temporary ones.
std::string bytes_of(const std::string& title, const SnapshotNames& names,
                     const std::vector<Snapshot>& frames);

/// The recording of such bytes, without modes.
Recording recording_from(const std::string& bytes);

}  // namespace nurbeam::python
