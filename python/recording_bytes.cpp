#include "python/recording_bytes.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "pipelines/results/frame_layout.h"
#include "pipelines/results/frame_reader.h"
#include "pipelines/results/frame_store.h"

namespace nurbeam::python {

namespace {

/// A file of its own among the temporary ones, for as long as this lives.
class PassingFile {
 public:
  PassingFile() {
    std::string directory = (std::filesystem::temp_directory_path() / "nurbeam_XXXXXX").string();
    if (!mkdtemp(directory.data()))
      throw std::runtime_error(directory + ": no temporary directory can be made there");
    directory_ = directory;
  }
  PassingFile(const PassingFile&) = delete;
  PassingFile& operator=(const PassingFile&) = delete;
  ~PassingFile() {
    std::error_code left_there;
    std::filesystem::remove_all(directory_, left_there);
  }
  std::filesystem::path path() const { return directory_ / "results.nc"; }

 private:
  std::filesystem::path directory_;
};

}  // namespace

std::string bytes_of(const std::string& title, const SnapshotNames& names,
                     const std::vector<Snapshot>& frames) {
  StoredRows rows;
  for (const Snapshot& frame : frames) rows += rows_of(frame);
  const PassingFile file;
  FrameStore store(file.path(), names, title, true, rows);
  store.write(frames);
  store.close();
  std::ifstream in(file.path(), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Recording recording_from(const std::string& bytes) {
  const PassingFile file;
  std::ofstream out(file.path(), std::ios::binary);
  out << bytes;
  out.close();
  if (!out) throw std::runtime_error(file.path().string() + ": cannot be written");
  const FrameReader reader(file.path());
  std::vector<Snapshot> frames = reader.read(0, reader.times().size());
  return {.title = reader.title(),
          .names = reader.names(),
          .frames = {std::move_iterator(frames.begin()), std::move_iterator(frames.end())},
          .modes = {},
          .row_times = {},
          .row_values = {}};
}

}  // namespace nurbeam::python
