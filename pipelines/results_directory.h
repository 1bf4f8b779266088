#pragma once
#include <filesystem>

namespace nurbeam {

/// A directory that one run at a time writes its results into, from construction to destruction. The lock is
/// the operating system's on the open directory: it leaves no file behind and ends with the process.
class ResultsDirectory {
 public:
  /// Makes the directory, takes it, and removes what a former run has written there: histories.csv,
  /// results.nc, run.json, report.html and deformed*.step and .igs, also under their temporary names. Throws
  /// std::runtime_error (path and reason) when another run writes there or these names are not free.
  explicit ResultsDirectory(std::filesystem::path path);
  ~ResultsDirectory();
  ResultsDirectory(const ResultsDirectory&) = delete;
  ResultsDirectory& operator=(const ResultsDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  void lock();
  void clear() const;

  std::filesystem::path path_;
  int descriptor_ = -1;
};

}  // namespace nurbeam
