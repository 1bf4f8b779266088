#include "pipelines/results/results_directory.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <regex>
#include <stdexcept>
#include <vector>

#include "cad_import/files/atomic_file.h"
#include "pipelines/results/file_error.h"

namespace nurbeam {

namespace {

namespace fs = std::filesystem;

/// The name that a file has once it is complete.
std::string complete_name(const fs::path& name) {
  const fs::path complete = name.stem();
  return (temporary_name(complete) == name ? complete : name).string();
}

/// The names that a run gives to its files, complete or not.
bool is_of_a_run(const fs::path& name) {
  static const std::regex ours(
      R"(histories\.csv(\.former)?|results(\.chunk[0-9]+)?\.nc|restart\.nc|run\.json|run\.log|frames\.pvd|)"
      R"(errors\.csv|errors\.nc|accuracy_level_-?[0-9]+\.json|modes\.csv|mode_[0-9]+\.pvd|report\.html|)"
      R"(deformed(_t[-+.e0-9]+|_[0-9]+)?(_solid|_section_lines|_source)?\.(step|igs|dxf|brep))");
  return std::regex_match(complete_name(name), ours);
}

bool is_of_a_level(const fs::path& name) { return complete_name(name).starts_with("accuracy_level_"); }

constexpr const char* frames_directory = "frames";

/// The names that a run gives to the files in frames/, complete or not.
bool is_a_frame(const fs::path& name) {
  static const std::regex ours(R"((mode_[0-9]+_)?(beams|bodies|reactions|connectors)_[0-9]+\.vtu)");
  return std::regex_match(complete_name(name), ours);
}

void remove_file(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) fail(file, "of a former run cannot be removed: " + error.message());
}

}  // namespace

std::string taken_by_input(const fs::path& directory, const std::vector<fs::path>& inputs) {
  const fs::path place = fs::weakly_canonical(directory / "results.nc").parent_path();
  for (const fs::path& input : inputs) {
    std::error_code ignored;
    const fs::path file = fs::weakly_canonical(input, ignored), name = file.filename();
    const bool is_result = (file.parent_path() == place && is_of_a_run(name)) ||
                           (file.parent_path() == place / frames_directory && is_a_frame(name));
    if (is_result)
      return input.string() +
             ": is an input of this run, and a name of its results, which would take its place; give another "
             "--out, or the file another name";
  }
  return {};
}

ResultsDirectory::ResultsDirectory(fs::path path) : path_(std::move(path)) {
  std::error_code error;
  fs::create_directories(path_, error);
  if (!fs::is_directory(path_)) {
    fail(path_, fs::exists(path_) ? "is a file; expected a directory for the results"
                                  : "cannot be made a directory: " + error.message());
  }
  lock();
}

ResultsDirectory::~ResultsDirectory() { close(descriptor_); }

void ResultsDirectory::lock() {
  descriptor_ = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ < 0) fail(path_, std::string("cannot be read: ") + std::strerror(errno));
  // Where the file system has no locks there is nothing to be held by.
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    close(descriptor_);
    fail(path_, "another run writes its results there; wait for its end or give another directory");
  }
}

void ResultsDirectory::clear() const {
  std::vector<fs::path> former;
  for (const auto& entry : fs::directory_iterator(path_)) {
    if (!is_of_a_run(entry.path().filename()) || is_of_a_level(entry.path().filename())) continue;
    if (entry.is_directory()) fail(entry.path(), "is a directory; a run needs this name for a file");
    former.push_back(entry.path());
  }
  const fs::path frames = path_ / frames_directory;
  if (fs::is_directory(frames)) {
    for (const auto& entry : fs::directory_iterator(frames))
      if (is_a_frame(entry.path().filename())) former.push_back(entry.path());
  } else if (fs::exists(frames)) {
    fail(frames, "is a file; a run needs this name for a directory");
  }
  for (const fs::path& file : former) remove_file(file);
  if (fs::is_directory(frames) && fs::is_empty(frames)) remove_file(frames);
}

std::vector<fs::path> ResultsDirectory::files() const {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(path_)) {
    const fs::path name = entry.path().filename();
    if (name == frames_directory || is_of_a_run(name)) files.push_back(name);
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace nurbeam
