#include "cad_import/import_curves.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "cad_import/files/ask_program.h"
#include "cad_import/files/cad_file_name.h"
#include "cad_import/report/report_bytes.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

namespace fs = std::filesystem;

ImportReport error_report(const fs::path& file, const std::string& message) {
  ImportReport report;
  report.file = file.string();
  report.diagnostics.push_back({Severity::error, report.file, message});
  return report;
}

std::string megabytes(std::uintmax_t bytes) { return std::to_string(bytes >> 20) + " MiB"; }

// The CAD files beside one that is not there, of which one was meant.
std::string files_beside(const fs::path& file) {
  constexpr std::size_t most = 10;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  std::error_code error;
  if (!fs::is_directory(folder, error)) return "; there is no folder " + folder.string();
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (is_named_as_cad_file(entry.path())) names.push_back(entry.path().filename().string());
  if (names.empty()) return "; no CAD file is in its folder";
  std::sort(names.begin(), names.end());
  std::string list;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i) list += (i == 0 ? "" : ", ") + names[i];
  return "; in its folder there are: " + list + (names.size() > most ? ", ..." : "");
}

// Why the path cannot hold a CAD file at all; nothing if it may.
std::optional<std::string> unusable(const fs::path& file, std::size_t size_limit) {
  const std::string expected = std::string("; expected a ") + cad_formats + " file";
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found)
    return "there is no such file" + expected + files_beside(file);
  if (error) return error.message() + expected;
  if (fs::is_directory(status)) return "it is a directory" + expected;
  if (!fs::is_regular_file(status)) return "it is not a regular file" + expected;
  const std::uintmax_t size = fs::file_size(file, error);
  if (size == 0) return "the file is empty" + expected;
  if (size > size_limit)
    return "the file has " + megabytes(size) + ", more than the limit of " + megabytes(size_limit) +
           "; export only the curves that are needed";
  return std::nullopt;
}

/// How much text a file may hold: a packed one several times its size, which is told inside.
std::uintmax_t size_of_text(const fs::path& file, std::size_t size_limit) {
  constexpr std::uintmax_t packed = 10;
  std::array<char, 2> begin{};
  std::ifstream(file, std::ios::binary).read(begin.data(), begin.size());
  const std::string_view mark(begin.data(), begin.size());
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) return 0;
  return mark == "PK" || mark == "\x1F\x8B" ? std::min<std::uintmax_t>(packed * size, size_limit) : size;
}

ChildLimits limits_for(const fs::path& file, const ImportOptions& options) {
  constexpr std::uintmax_t seconds = 5, bytes = 24;  // for each MiB, and for each byte, of the text
  const std::uintmax_t size = size_of_text(file, options.size_limit_bytes);
  ChildLimits limits{options.time_limit, options.memory_limit_bytes, options.interrupted, options.watch};
  limits.time += std::chrono::seconds(seconds * (size >> 20));
  if (limits.memory_bytes > 0) limits.memory_bytes += bytes * size;
  return limits;
}

ImportReport report_of(const ChildResult& result, const fs::path& file, const ChildLimits& limits) {
  switch (result.status) {
    case ChildResult::Status::finished:
      return report_from_bytes(result.output);
    case ChildResult::Status::failed:
      return error_report(file, "the reader failed: " + result.complaint);
    case ChildResult::Status::out_of_memory:
      return error_report(file, "reading it needs more than the memory limit of " +
                                    megabytes(limits.memory_bytes) +
                                    ", which is that of its size; the file is damaged, or export the curves "
                                    "alone");
    case ChildResult::Status::timed_out:
      return error_report(file, "reading it takes longer than the time limit of " +
                                    std::to_string(limits.time.count()) +
                                    " s, which is that of its size; the file is damaged, or export the "
                                    "curves alone");
    case ChildResult::Status::interrupted:
      return error_report(file, "reading it was interrupted");
    case ChildResult::Status::crashed:
      return error_report(file, "the reader crashed on it (" + result.complaint +
                                    "); the file is damaged or too deeply nested; export it again");
    case ChildResult::Status::not_started:
      return error_report(file, "no process to read it in: " + result.complaint);
  }
  throw std::logic_error("unknown status of a child process");
}

}  // namespace

ImportReport import_curves(const fs::path& file, const ImportOptions& options) {
  if (!(options.tolerance > 0))
    throw std::invalid_argument("tolerance is " + text_of(options.tolerance) + " m; it must be positive");
  if (const auto reason = unusable(file, options.size_limit_bytes)) return error_report(file, *reason);
  try {
    const ChildLimits limits = limits_for(file, options);
    const ChildResult result = asked(ReadRequest{file, options.tolerance}, limits);
    ImportReport report = report_of(result, file, limits);
    report.peak_memory = result.peak_memory;
    return report;
  } catch (const std::exception& e) {
    return error_report(file,
                        std::string("the reader was damaged by it and sent no valid report: ") + e.what());
  }
}

}  // namespace nurbeam
