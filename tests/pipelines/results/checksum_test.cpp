#include "pipelines/results/checksum.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "fem/motion/run/simulation.h"
#include "pipelines/results/checked_json.h"
#include "pipelines/results/restart_file.h"
#include "pipelines/results/results.h"
#include "tests/pipelines/case_text.h"
#include "tests/support/models.h"

namespace nurbeam {
namespace {

using test::TemporaryDirectory;
using Path = std::filesystem::path;

std::string content_of(const Path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void write(const Path& file, const std::string& content) { std::ofstream(file, std::ios::binary) << content; }

/// Calls `read` with the file damaged in one bit, at every `every`-th byte.
template <class Read>
void for_each_flip(const Path& file, std::size_t every, Read read) {
  const std::string whole = content_of(file);
  std::mt19937 random(7);
  for (std::size_t at = 0; at < whole.size(); at += every) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << random() % 8));
    write(file, damaged);
    read(at);
  }
  write(file, whole);
}

/// Calls `read` with the file cut short.
template <class Read>
void for_each_cut(const Path& file, Read read) {
  const std::string whole = content_of(file);
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 4) {
    write(file, whole.substr(0, size));
    read(size);
    write(file, whole.substr(0, whole.size() - 1 - size));
    read(whole.size() - 1 - size);
  }
  write(file, whole);
}

BeamModel bar() {
  return testing::one_beam({testing::line_cubic({0, 0, 0}, {1, 0, 0})}, 2,
                           testing::round_bar(0.02, 7200, 2e6), 4, {{0, true}});
}

/// A run of the bar, whose files stay in a directory.
struct Written {
  Written() {
    SimulationObserver observer;
    ResultsWriter results(directory.path(), {.probes = {"p"}, .beams = {"b"}, .reactions = {"r"}}, "bar");
    observer.snapshot = [&](const Snapshot& frame) { results.write(frame); };
    observer.checkpoint_due = [] { return true; };
    observer.checkpoint = [&](Checkpoint point) {
      point.inputs = "of the test";
      write_checkpoint(restart(), std::move(point));
    };
    SimulationOptions options;
    options.end_time = 0.02;
    options.step = 1e-3;
    options.output_times = {0, 0.01, 0.02};
    simulate(bar(), {{0, 1}}, options, observer);
    results.finish();
  }
  Path restart() const { return directory.path() / "restart.nc"; }
  Path results() const { return directory.path() / "results.nc"; }

  TemporaryDirectory directory;
};

TEST(Checksum, OfAFileIsWrongWhereverABitIsFlipped) {
  const TemporaryDirectory directory;
  const Path file = directory.path() / "file";
  std::string text(checksum_attribute);
  for (int i = 0; i < 1000; ++i) text += static_cast<char>(i * i);
  write(file, text);
  append_checksum(file);
  EXPECT_EQ(check_file(file), Checksum::right);
  for_each_flip(
      file, 1, [&](std::size_t at) { EXPECT_THROW(check_file(file), DamagedError) << at; });
  for_each_cut(file, [&](std::size_t size) {
    if (size > checksum_attribute.size()) EXPECT_THROW(check_file(file), DamagedError) << size;
  });
  EXPECT_EQ(check_file(file), Checksum::right);
}

TEST(Checksum, IsMissingWithoutAWordInFilesThatNeverHadOne) {
  const TemporaryDirectory directory;
  const Path file = directory.path() / "file";
  for (const std::size_t size : {0, 1, 82, 100'000}) {
    write(file, std::string(size, 'x'));
    EXPECT_EQ(check_file(file), Checksum::none) << size;
  }
  EXPECT_THROW(check_file(directory.path() / "none"), std::runtime_error);
}

TEST(Checksum, IsFoundMissingWhereverTheFileSaysThatItHasOne) {
  const TemporaryDirectory directory;
  const Path file = directory.path() / "file";
  for (std::size_t before = (1 << 16) - 80; before < (1 << 16) + 80; before += 7) {
    write(file, std::string(before, 'n') + std::string(checksum_attribute) + std::string(200, 'n'));
    EXPECT_THROW(check_file(file), DamagedError) << before;
  }
}

TEST(Checksum, OfATextIsAsked) {
  std::string text = "what is said";
  EXPECT_THROW(check_text(text, "the text"), DamagedError);
  append_checksum(text);
  check_text(text, "the text");
  text[3] = 'T';
  EXPECT_THROW(check_text(text, "the text"), DamagedError);
}

TEST(Checksum, ADamagedRestartPointIsRefused) {
  const Written written;
  const auto expect_refused = [&](std::size_t at) {
    EXPECT_THROW(read_checkpoint(written.restart()), std::runtime_error) << at;
  };
  for_each_flip(written.restart(), 3, expect_refused);
  for_each_cut(written.restart(), expect_refused);
  EXPECT_GT(read_checkpoint(written.restart()).state.t, 0);
}

TEST(Checksum, DamagedResultsAreRefused) {
  const Written written;
  const auto expect_refused = [&](std::size_t at) {
    EXPECT_THROW(read_results(written.directory.path()), std::runtime_error) << at;
  };
  for_each_flip(written.results(), 61, expect_refused);
  for_each_cut(written.results(), expect_refused);
  EXPECT_EQ(read_results(written.directory.path()).frames.size(), 3U);
}

TEST(Checksum, EqualRunsWriteEqualBytes) {
  const Written first, second;
  EXPECT_EQ(content_of(first.restart()), content_of(second.restart()));
  EXPECT_EQ(content_of(first.results()), content_of(second.results()));
}

TEST(Checksum, OfAJsonFileIsOfItsValuesHoweverTheyAreLaidOut) {
  const TemporaryDirectory directory;
  const Path file = directory.path() / "run.json";
  const std::string text = with_checksum(R"({"a": [1, 2.5, null], "b": {"c": "d\nUml\u00e4ut"}})");
  write(file, text);
  const std::string plain = checked_json(file);
  EXPECT_NE(plain.find("2.5"), std::string::npos);
  EXPECT_EQ(plain.find("checksum"), std::string::npos);
  std::string one_line = text;
  std::erase(one_line, '\n');
  write(file, one_line);
  EXPECT_EQ(checked_json(file), plain);
  std::string changed = text;
  changed.replace(changed.find("2.5"), 3, "2.6");
  write(file, changed);
  EXPECT_THROW(checked_json(file), DamagedError);
  write(file, "{}");
  EXPECT_EQ(checked_json(file), "{}\n") << "of an earlier version";
  for (const char* none : {"", "[1]", "{"}) {
    write(file, none);
    EXPECT_THROW(checked_json(file), std::invalid_argument) << none;
  }
}

}  // namespace
}  // namespace nurbeam
