#include "pipelines/study/rows.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/results/file_hash.h"

namespace nurbeam {

namespace {

using Json = nlohmann::ordered_json;

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// JSON has no number for what is none.
std::vector<double> numbers_of(const Json& list) {
  std::vector<double> numbers;
  for (const Json& each : list)
    numbers.push_back(each.is_null() ? std::numeric_limits<double>::quiet_NaN() : each.get<double>());
  return numbers;
}

// The parts that a study and that of the head of a file do not have in common.
std::string differing(const StudyIdentity& study, const Json& head) {
  std::map<std::string, std::string> former;
  if (head.is_object() && head.contains("parts") && head["parts"].is_object())
    for (const auto& [name, digest] : head["parts"].items()) former[name] = digest.dump();
  if (former.empty()) return "the study, its case, a CAD file or nurbeam";  // of earlier versions
  std::map<std::string, std::string> names;
  for (const auto& [name, digest] : study.parts)
    if (!former.contains(name) || former[name] != Json(digest).dump()) names[name];
  for (const auto& [name, digest] : former)
    if (!study.parts.contains(name)) names[name];
  std::string text;
  for (const auto& [name, none] : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

constexpr char before_checksum = '\t';
constexpr const char* begin_anew =
    "; run without --resume, which begins anew, or into another directory by --out";
constexpr const char* or_begin_anew = ", or run without --resume";

std::string checksum_of(const std::string& text, const std::string& study) {
  return sha256_of_text(study + "\n" + text);
}

// A line of a study's file.
std::string with_checksum(const std::string& text, const std::string& study) {
  return text + before_checksum + checksum_of(text, study) + "\n";
}

// What a line says, where its checksum is right.
std::optional<std::string> without_checksum(const std::string& line, const std::string& study) {
  const std::size_t at = line.rfind(before_checksum);
  if (at == std::string::npos) return {};
  const std::string text = line.substr(0, at);
  if (line.substr(at + 1) != checksum_of(text, study)) return {};
  return text;
}

std::vector<std::vector<double>> rows_of(const Json& list) {
  std::vector<std::vector<double>> rows;
  for (const Json& each : list) rows.push_back(numbers_of(each));
  return rows;
}

}  // namespace

std::string line_of(const Variant& variant) {
  Json json = {{"number", variant.number},          {"values", variant.values},
               {"status", name_of(variant.status)}, {"reason", variant.reason},
               {"quantities", variant.quantities},  {"seconds", variant.seconds}};
  if (!variant.gradient.empty()) json["gradient"] = variant.gradient;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Variant variant_of(const std::string& line) {
  try {
    const Json json = Json::parse(line);
    const auto status = variant_status(json.at("status").get<std::string>());
    if (!status) throw std::runtime_error("has an unknown status");
    return {.number = json.at("number").get<std::size_t>(),
            .values = numbers_of(json.at("values")),
            .status = *status,
            .reason = json.at("reason").get<std::string>(),
            .quantities = numbers_of(json.at("quantities")),
            .gradient = rows_of(json.value("gradient", Json::array())),
            .seconds = json.at("seconds").get<double>()};
  } catch (const Json::exception& problem) {
    throw std::runtime_error(std::string("is no variant: ") + problem.what());
  }
}

StudyIdentity identity_of(const StudyFile& study, const StudyCase* study_case) {
  std::string text = std::string(NURBEAM_VERSION) + "\n" + study.json + "\n";
  StudyIdentity identity{.parts = {{"the version of nurbeam", NURBEAM_VERSION}}};
  const Json keys = Json::parse(study.json);
  for (const auto& [key, value] : keys.items())
    identity.parts[in_quotes(key) + " of the study"] = sha256_of_text(value.dump());
  if (study_case) {
    text += study_case->variant(study.variables, all_values(study, study.nominal()));
    identity.parts[study_case->file().string()] = sha256_of_text(study_case->variant({}, {}));
    for (const auto& input : study_case->inputs()) {
      const std::string digest = sha256_of_file(input);
      text += digest + "\n";
      identity.parts[input.string()] = digest;
    }
  }
  identity.digest = sha256_of_text(text);
  return identity;
}

StudyRows::StudyRows(std::filesystem::path file, const StudyIdentity& study, bool resume)
    : StudyRows(std::move(file), study.digest) {  // which is closed whatever is thrown
  signal(SIGXFSZ, SIG_IGN);                       // a file that may not grow is found by the write's failure
  std::error_code none;
  if (std::filesystem::exists(file_, none) && !std::filesystem::is_regular_file(file_, none))
    fail("is no file; give another directory by --out");
  descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail(std::strerror(errno));
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) fail("another nurbeam study writes to it");
  if (resume) read_back(study);
  cut_to_size();  // not before the lock: until then the rows are another's
  const Json head = {{"nurbeam_study_rows", 2}, {"digest", study.digest}, {"parts", study.parts}};
  if (size_ == 0) write(with_checksum(head.dump(), ""));
}

StudyRows::~StudyRows() {
  if (descriptor_ >= 0) close(descriptor_);
}

void StudyRows::check_head(const std::string& line, const StudyIdentity& study) const {
  const std::optional<std::string> checked = without_checksum(line, "");
  const Json head = Json::parse(checked.value_or(line), nullptr, false);
  const bool readable = head.is_object() && head.contains("digest") && head["digest"].is_string();
  if (!checked && !(readable && head.value("nurbeam_study_rows", Json()) == 1))
    throw UnusableRowsError(file_.string() + ": its first line is damaged" + begin_anew);
  if (head["digest"] != study.digest)
    throw UnusableRowsError(
        file_.string() + ": belongs to another study: changed since: " + differing(study, head) + begin_anew);
  if (!checked)
    throw UnusableRowsError(file_.string() + ": has no checksums: an earlier version has written it" +
                            begin_anew);
}

void StudyRows::read_back(const StudyIdentity& study) {
  std::ifstream in(file_, std::ios::binary);
  std::string line;
  for (std::size_t number = 1; std::getline(in, line) && !in.eof(); ++number) {  // else it is not whole
    if (number == 1) {
      check_head(line, study);
    } else {
      const std::optional<std::string> checked = without_checksum(line, study_);
      if (!checked)
        throw UnusableRowsError(
            file_.string() + ": line " + std::to_string(number) +
            " is damaged or was changed: it has not the checksum that it was written with; "
            "remove the line, and its variant runs again" +
            or_begin_anew);
      try {
        Variant variant = variant_of(*checked);
        if (variant.status == VariantStatus::crashed)
          stored_.erase(variant.number);  // runs again: the machine ended it
        else
          stored_.insert_or_assign(variant.number, std::move(variant));
      } catch (const std::runtime_error& problem) {
        fail(std::string("a line ") + problem.what());
      }
    }
    size_ += static_cast<long long>(line.size()) + 1;
  }
}

void StudyRows::cut_to_size() {
  if (ftruncate(descriptor_, size_) != 0) fail(std::strerror(errno));
}

void StudyRows::append(const Variant& variant) {
  std::string line = line_of(variant);
  line.pop_back();  // its end
  write(with_checksum(line, study_));
  constexpr double longest_unsynchronised = 1;  // [s]
  if (seconds_now() - last_synchronised_ > longest_unsynchronised) synchronise();
}

void StudyRows::synchronise() {
  if (fdatasync(descriptor_) != 0) fail(std::strerror(errno));
  last_synchronised_ = seconds_now();
}

// A line is whole or not there.
void StudyRows::write(const std::string& line) {
  std::size_t written = 0;
  while (written < line.size()) {
    const ssize_t n = ::write(descriptor_, line.data() + written, line.size() - written);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const std::string reason = std::strerror(errno);
      [[maybe_unused]] const int ignored = ftruncate(descriptor_, size_);
      fail(reason + "; what was finished before is kept: go on with --resume");
    }
    written += static_cast<std::size_t>(n);
  }
  size_ += static_cast<long long>(line.size());
}

void StudyRows::fail(const std::string& what) const { throw StudyRowsError(file_.string() + ": " + what); }

}  // namespace nurbeam
