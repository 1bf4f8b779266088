#pragma once
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "pipelines/command/command_line.h"
#include "tests/pipelines/case_text.h"
#include "tests/support/places.h"

namespace nurbeam::test {

/// What one `nurbeam run` did and left behind.
struct CaseRun {
  int code;
  std::string messages;
  std::vector<std::string> files;  ///< in the results directory
  std::vector<std::string> header;
  std::vector<std::vector<double>> rows;  ///< of histories.csv; an empty field is NaN

  bool says(const std::string& part) const { return messages.find(part) != std::string::npos; }
  bool left_half_files() const {
    return std::any_of(
        files.begin(), files.end(),
        [](const std::string& name) { return name.find(".part") != std::string::npos; });
  }
  double value(std::size_t row, const std::string& column) const {
    const auto at = std::find(header.begin(), header.end(), column);
    if (at == header.end()) throw std::out_of_range("no column " + column);
    return rows.at(row).at(at - header.begin());
  }
  double last(const std::string& column) const { return value(rows.size() - 1, column); }
};

/// Sends std::cerr to a text for its lifetime.
class CapturedErrors {
 public:
  CapturedErrors() : before_(std::cerr.rdbuf(text_.rdbuf())) {}
  ~CapturedErrors() { std::cerr.rdbuf(before_); }
  CapturedErrors(const CapturedErrors&) = delete;
  CapturedErrors& operator=(const CapturedErrors&) = delete;
  std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
  std::streambuf* before_;
};

inline void read_histories(const std::filesystem::path& file, CaseRun& run) {
  std::ifstream stream(file);
  std::string line, field;
  for (bool first = true; std::getline(stream, line); first = false) {
    std::istringstream fields(line + ",");
    if (!first) run.rows.emplace_back();
    while (std::getline(fields, field, ',')) {
      if (first)
        run.header.push_back(field);
      else
        run.rows.back().push_back(field.empty() ? std::numeric_limits<double>::quiet_NaN()
                                                : std::stod(field));
    }
  }
}

/// Runs a case file with overrides ("path=value") into a fresh results directory.
inline CaseRun run_file(const std::filesystem::path& file, const std::vector<std::string>& overrides = {}) {
  const TemporaryDirectory directory;
  const std::filesystem::path results = directory.path() / "results";
  std::vector<std::string> words = {"run", file.string(), "--quiet", "--out", results.string()};
  for (const std::string& override : overrides) words.insert(words.end(), {"--set", override});
  std::ostringstream out, err;
  const CapturedErrors errors;
  CaseRun run{run_command_line(words, out, err), {}, {}, {}, {}};
  run.messages = err.str() + errors.text();
  read_histories(results / "histories.csv", run);
  if (std::filesystem::exists(results))
    for (const auto& entry : std::filesystem::recursive_directory_iterator(results))
      run.files.push_back(entry.path().filename().string());
  return run;
}

inline std::filesystem::path sample(const std::string& name) {
  return test::source_directory() / "samples" / name;
}

/// Runs a case of which the text is given.
inline CaseRun run_text(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const TemporaryDirectory directory;
  return run_file(directory.write("case.json", text), overrides);
}

}  // namespace nurbeam::test
