#include "pipelines/results/results.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "cad_import/files/atomic_file.h"
#include "pipelines/results/checksum.h"
#include "pipelines/results/file_error.h"
#include "pipelines/results/frame_reader.h"
#include "pipelines/results/frame_store.h"
#include "pipelines/results/history_table.h"

namespace nurbeam {

namespace {

namespace fs = std::filesystem;

void check_count(const char* what, std::size_t found, std::size_t expected) {
  if (found != expected) {
    throw std::invalid_argument(std::string("a frame with ") + std::to_string(found) + " " + what +
                                "; expected " + std::to_string(expected));
  }
}

fs::path created(const fs::path& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error || !fs::is_directory(directory))
    fail(directory, "cannot be made a directory" + (error ? ": " + error.message() : std::string()));
  return directory;
}

fs::path store_file(const fs::path& directory) { return directory / "results.nc"; }
fs::path history_file(const fs::path& directory) { return directory / "histories.csv"; }

fs::path chunk_file(const fs::path& directory, std::size_t number) {
  std::string digits = std::to_string(number);
  digits.insert(0, digits.size() < 4 ? 4 - digits.size() : 0, '0');
  return directory / ("results.chunk" + digits + ".nc");
}

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

std::vector<fs::path> chunks_in(const fs::path& directory) {
  std::vector<fs::path> chunks;
  while (is_there(chunk_file(directory, chunks.size() + 1)))
    chunks.push_back(chunk_file(directory, chunks.size() + 1));
  return chunks;
}

/// Those of a run that has finished, or of one that has not.
std::vector<fs::path> frame_files(const fs::path& directory) {
  if (is_there(store_file(directory))) return {store_file(directory)};
  return chunks_in(directory);
}

/// What is read again soon is not compressed.
enum class Use { passing, lasting };

/// The temporary name of a file, which is removed unless the file has been published.
class TemporaryFile {
 public:
  explicit TemporaryFile(fs::path file) : file_(std::move(file)) {}
  ~TemporaryFile() {
    if (is_published_) return;
    std::error_code ignored;
    fs::remove(temporary_name(file_), ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  fs::path name() const { return temporary_name(file_); }
  void publish() {
    nurbeam::publish(file_);
    is_published_ = true;
  }

 private:
  fs::path file_;
  bool is_published_ = false;
};

/// A file of frames that is being written.
struct OpenFile {
  TemporaryFile file;
  FrameStore store;

  OpenFile(fs::path named, Use use, const SnapshotNames& names, const std::string& title,
           const StoredRows& expected)
      : file(std::move(named)), store(file.name(), names, title, use == Use::lasting, expected) {}

  void publish() {
    store.close();
    file.publish();
  }
};

template <class Write>
void write_file(const fs::path& file, Use use, const SnapshotNames& names, const std::string& title,
                const StoredRows& expected, Write write) {
  OpenFile open(file, use, names, title, expected);
  write(open.store);
  open.publish();
}

/// Frames that are in memory together: few of large ones.
std::size_t batch_of(const StoredRows& rows) {
  constexpr std::size_t most_frames = 64;
  const std::size_t elements_of_a_frame = rows.elements / std::max<std::size_t>(rows.frames, 1) + 1;
  return std::clamp<std::size_t>(ResultsWriter::most_open_elements / elements_of_a_frame, 1, most_frames);
}

/// Calls visit(frames) for the frames [0, count) of a reader, a batch at a time.
template <class Visit>
void for_each_batch(const FrameReader& reader, std::size_t count, Visit visit) {
  const std::size_t batch = batch_of(reader.rows());
  for (std::size_t first = 0; first < count; first += batch)
    visit(reader.read(first, std::min(batch, count - first)));
}

}  // namespace

// --- Writing
// -----------------------------------------------------------------------------------------------------

struct ResultsWriter::Implementation {
  fs::path directory;
  SnapshotNames names;
  std::string title;
  fs::path former;  // the rows of the run that this goes on from, where they are more than the frames
  HistoryTable histories;
  std::vector<StoredRows> chunk_rows;
  std::vector<Snapshot> open;
  StoredRows open_rows;
  std::optional<OpenFile> ahead;  // with elements of the next frame

  Implementation(fs::path where, SnapshotNames of, std::string name, std::optional<RowsBefore> rows = {})
      : directory(created(where)),
        names(std::move(of)),
        title(std::move(name)),
        former(rows ? set_aside() : fs::path()),
        histories(temporary_name(history_file(directory)), names) {
    if (!rows) return;
    histories.take_over(former, *rows);
    fs::remove(former);
  }

  /// The table of a run that was killed, or has ended, under another name: this run begins one of its own.
  /// What has that name already was set aside by a run that was killed before it had taken it over.
  fs::path set_aside() const {
    const fs::path table = history_file(directory), aside = table.string() + ".former";
    for (const fs::path& file : {temporary_name(table), table})
      if (!is_there(aside) && is_there(file)) fs::rename(file, aside);
    if (!is_there(aside)) fail(table, "does not exist; run without --resume");
    return aside;
  }

  void close_chunk() {
    if (open.empty()) return;
    write_file(chunk_file(directory, chunk_rows.size() + 1), Use::passing, names, title, open_rows,
               [&](FrameStore& store) { store.write(open); });
    chunk_rows.push_back(std::exchange(open_rows, {}));
    open.clear();
  }

  void write_ahead(std::span<const ElementRecord> elements) {
    if (!ahead) {
      close_chunk();
      ahead.emplace(chunk_file(directory, chunk_rows.size() + 1), Use::passing, names, title,
                    StoredRows{.frames = 1, .elements = most_open_elements, .nodes = most_open_elements});
    }
    ahead->store.write_ahead(elements);
  }

  // The frame whose elements have been written before.
  void close_with(const Snapshot& frame) {
    ahead->store.write({&frame, 1});
    ahead->publish();
    ahead.reset();
    chunk_rows.push_back(rows_of(frame));
  }

  StoredRows all_rows() const {
    StoredRows rows = open_rows;
    for (const StoredRows& chunk : chunk_rows) rows += chunk;
    return rows;
  }

  void merge() {
    write_file(store_file(directory), Use::lasting, names, title, all_rows(), [&](FrameStore& store) {
      const std::vector<fs::path> files = chunks();
      for (std::size_t i = 0; i < files.size(); ++i) store.copy(files[i], chunk_rows[i]);
      store.write(open);
    });
    for (const fs::path& file : chunks()) fs::remove(file);
  }

  std::vector<fs::path> chunks() const {
    std::vector<fs::path> files;
    for (std::size_t i = 1; i <= chunk_rows.size(); ++i) files.push_back(chunk_file(directory, i));
    return files;
  }

  /// Makes the first frames of what is stored the chunks of this run.
  void take_over(std::size_t frames) {
    if (is_there(store_file(directory))) {
      for (const fs::path& file : chunks_in(directory)) fs::remove(file);
      keep_frames(store_file(directory), frames, chunk_file(directory, 1));
      fs::remove(store_file(directory));
    }
    std::size_t left = frames;
    for (const fs::path& file : chunks_in(directory)) {
      if (left == 0) {
        fs::remove(file);
        continue;
      }
      left -= keep_frames(file, left, file);
      chunk_rows.push_back(FrameReader(file).rows());
    }
    if (left > 0)
      fail(directory, "holds " + std::to_string(frames - left) +
                          " frames of the run; its restart point needs " + std::to_string(frames));
    if (!former.empty()) return;
    for (const fs::path& file : chunks()) {
      const FrameReader chunk(file);
      for_each_batch(chunk, chunk.times().size(), [&](const auto& stored) {
        for (const Snapshot& frame : stored) histories.write(frame);
      });
    }
  }

  /// Writes the first frames of a file, at most `most`, to another, or the same; returns how many.
  std::size_t keep_frames(const fs::path& from, std::size_t most, const fs::path& to) {
    const FrameReader reader(from);
    const std::size_t count = std::min(most, reader.times().size());
    if (from != to || count < reader.times().size())
      write_file(to, Use::passing, names, title, reader.rows(), [&](FrameStore& store) {
        for_each_batch(reader, count, [&](const auto& frames) { store.write(frames); });
      });
    return count;
  }
};

ResultsWriter::ResultsWriter(fs::path directory, SnapshotNames names, std::string title)
    : implementation_(
          std::make_unique<Implementation>(std::move(directory), std::move(names), std::move(title))) {}

ResultsWriter::ResultsWriter(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}
ResultsWriter::ResultsWriter(ResultsWriter&&) noexcept = default;
ResultsWriter::~ResultsWriter() = default;

ResultsWriter ResultsWriter::resume(fs::path directory, SnapshotNames names, std::string title,
                                    std::size_t frames, std::optional<RowsBefore> rows) {
  auto files =
      std::make_unique<Implementation>(std::move(directory), std::move(names), std::move(title), rows);
  files->take_over(frames);
  return ResultsWriter(std::move(files));
}

void ResultsWriter::write(Snapshot frame) {
  Implementation& files = *implementation_;
  check_count("probes", frame.probes.size(), files.names.probes.size());
  check_count("bodies", frame.bodies.size(), files.names.bodies.size());
  check_count("beams", frame.beams.size(), files.names.beams.size());
  files.histories.write(frame);
  if (files.ahead) return files.close_with(frame);
  files.open_rows += rows_of(frame);
  files.open.push_back(std::move(frame));
  if (files.open_rows.elements >= most_open_elements) files.close_chunk();
}

void ResultsWriter::write_between(const Snapshot& moment) {
  HistoryTable& histories = implementation_->histories;
  if (moment.time != histories.last_time()) histories.write_between(moment);
}

void ResultsWriter::write_ahead(std::span<const ElementRecord> elements) {
  implementation_->write_ahead(elements);
}

void ResultsWriter::close_chunk() {
  implementation_->close_chunk();
  implementation_->histories.put_on_disk();
}

std::size_t ResultsWriter::frame_count() const { return implementation_->all_rows().frames; }

std::optional<StoredResults> ResultsWriter::all_frames() {
  Implementation& files = *implementation_;
  if (!files.chunk_rows.empty()) return {};
  return StoredResults{files.title, files.names, std::exchange(files.open, {})};
}

void ResultsWriter::finish() {
  Implementation& files = *implementation_;
  files.merge();
  files.histories.close();
  publish(history_file(files.directory));
}

// --- Reading
// -----------------------------------------------------------------------------------------------------

struct StoredFrames::Implementation {
  fs::path file;  ///< for messages
  std::vector<FrameReader> files;
};

StoredFrames::StoredFrames(const fs::path& directory) : implementation_(std::make_unique<Implementation>()) {
  implementation_->file = store_file(directory);
  for (const fs::path& file : frame_files(directory)) implementation_->files.emplace_back(file);
  if (implementation_->files.empty())
    fail(store_file(directory), is_there(directory)
                                    ? "does not exist; expected a directory that `nurbeam run` has written"
                                    : "does not exist, nor does its directory");
  for (const FrameReader& reader : implementation_->files)
    times_.insert(times_.end(), reader.times().begin(), reader.times().end());
}

StoredFrames::StoredFrames(StoredFrames&&) noexcept = default;
StoredFrames::~StoredFrames() = default;

const std::string& StoredFrames::title() const { return implementation_->files.front().title(); }
const SnapshotNames& StoredFrames::names() const { return implementation_->files.front().names(); }

std::vector<Snapshot> StoredFrames::read(std::size_t first, std::size_t count) const {
  std::vector<Snapshot> frames;
  for (const FrameReader& reader : implementation_->files) {
    const std::size_t there = reader.times().size();
    if (first < there && count > 0) {
      std::vector<Snapshot> part = reader.read(first, std::min(count, there - first));
      count -= part.size();
      std::move(part.begin(), part.end(), std::back_inserter(frames));
      first = 0;
    } else {
      first -= std::min(first, there);
    }
  }
  return frames;
}

std::size_t StoredFrames::nearest(double time) const {
  if (times_.empty()) fail(implementation_->file, "holds no frame");
  const double slack = 1e-9 * std::max(std::abs(times_.front()), std::abs(times_.back()));
  if (!(time >= times_.front() - slack && time <= times_.back() + slack)) {
    std::ostringstream reason;
    reason << "time " << time << " s is not stored; expected one from " << times_.front() << " s to "
           << times_.back() << " s";
    fail(implementation_->file, reason.str());
  }
  const auto nearest = std::min_element(times_.begin(), times_.end(), [&](double a, double b) {
    return std::abs(a - time) < std::abs(b - time);
  });
  return static_cast<std::size_t>(nearest - times_.begin());
}

StoredResults read_results(const fs::path& directory) {
  const StoredFrames stored(directory);
  return {stored.title(), stored.names(), stored.read(0, stored.times().size())};
}

std::optional<Diagnostic> missing_checksum(const fs::path& directory) {
  const std::vector<fs::path> files = frame_files(directory);
  if (std::all_of(files.begin(), files.end(), &has_checksum)) return {};
  return Diagnostic{Severity::warning, store_file(directory).string(),
                    "has no checksum, as results of earlier versions: damage to it would go unseen; run the "
                    "case again for one"};
}

std::pair<double, std::vector<StoredBeam>> read_stored_beams(const fs::path& directory, double time) {
  const StoredFrames stored(directory);
  const Snapshot frame = stored.read(stored.nearest(time), 1).front();
  std::vector<StoredBeam> beams;
  for (std::size_t b = 0; b < frame.beams.size(); ++b)
    beams.push_back({stored.names().beams[b], frame.beams[b].elements});
  return {frame.time, beams};
}

}  // namespace nurbeam
