#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "pipelines/accuracy/accuracy_table.h"

namespace nurbeam {

/// Writes errors.csv, with the header and the rows of histories.csv and the error of each number there.
/// Throws std::runtime_error (file and reason).
void write_errors_table(const std::filesystem::path& directory, const AccuracyTable& table);

/// Writes errors.nc, with the error of each number of histories that results.nc has, in arrays of the same
/// shape: error_probe_position, ... Throws std::runtime_error (file and reason).
void write_errors_netcdf(const std::filesystem::path& directory, const AccuracyTable& table,
                         const std::vector<HistoryColumn>& columns, const std::vector<double>& times);

/// What errors.csv of a directory has at the given times, by heading; empty where there is none.
std::map<std::string, std::vector<double>> errors_of_frames(const std::filesystem::path& directory,
                                                            const std::vector<double>& times);

}  // namespace nurbeam
