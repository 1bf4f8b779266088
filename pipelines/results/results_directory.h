#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace nurbeam {

/// Why a run cannot write its results into a directory, which need not be there: one of these files,
/// absolute, lies there under a name that a run gives to its own; empty where none does.
std::string taken_by_input(const std::filesystem::path& directory,
                           const std::vector<std::filesystem::path>& inputs);

/// A directory that one run at a time writes its results into, from construction to destruction. The lock is
/// the operating system's on the open directory: it leaves no file behind and ends with the process.
class ResultsDirectory {
 public:
  /// Makes the directory and takes it. Throws std::runtime_error (path and reason) when another run writes
  /// there.
  explicit ResultsDirectory(std::filesystem::path path);
  ~ResultsDirectory();
  ResultsDirectory(const ResultsDirectory&) = delete;
  ResultsDirectory& operator=(const ResultsDirectory&) = delete;

  /// Removes what a former run has written there: the files of docs/results.md, also under their temporary
  /// names, but for numbers of levels (accuracy_level_K.json), which tell what they belong to. Throws
  /// std::runtime_error (path and reason) when these names are not free.
  void clear() const;
  /// What a run has written there, relative to it, in order; the files in frames/ count as one.
  std::vector<std::filesystem::path> files() const;

 private:
  void lock();

  std::filesystem::path path_;
  int descriptor_ = -1;
};

}  // namespace nurbeam
