// Reads mutated files of tests/corpus and tests/fuzz/seeds in child processes forked from this one with
// OpenCASCADE warm, and checks that every one of them ends in curves or in a diagnostic that names the file.
// Now and then a good file is read by import_curves().
//
//   fuzz_reader step|iges|dxf|binary|ifc|brep|json|packed [--seconds N] [--cases N] [--seed N] [--from
//   DIRECTORY]
//               [--counts FILE] [--keep DIRECTORY] [--keep-fewer DIRECTORY]
//
// Without --seed it is the date, 20240521. --from names drawings to mutate besides; --counts adds up the
// outcomes of many runs in a file; --keep keeps each input that crashed the reader or ran out of time,
// --keep-fewer each that gave fewer curves than its source and no more diagnostics. Exit code 1 when a case
// was not survived.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <new>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>

#include "cad_import/import_curves.h"
#include "cad_import/program/read_file.h"
#include "tests/fuzz/corpus_text.h"
#include "tests/fuzz/mutation.h"
#include "tests/fuzz/shared_outcomes.h"
#include "tests/fuzz/warm_reader.h"
#include "tests/support/places.h"

namespace nurbeam {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds time_limit{2};
constexpr std::size_t memory_limit = std::size_t{2} << 30;
constexpr std::uint64_t cases_of_a_child = 50, text_cases_of_a_child = 1000;
constexpr std::uint64_t cases_between_canaries = 2000;

struct Options {
  std::string format;
  double seconds = 1e9;
  std::uint64_t cases = ~std::uint64_t{0};
  std::uint64_t seed = 0;
  std::string from, counts, keep, keep_fewer;
};

using Counts = std::map<std::string, std::uint64_t>;

std::uint64_t today() {
  const std::time_t now = std::time(nullptr);
  std::tm date{};
  gmtime_r(&now, &date);
  return static_cast<std::uint64_t>((date.tm_year + 1900) * 10000 + (date.tm_mon + 1) * 100 + date.tm_mday);
}

Options read_arguments(int count, char** arguments) {
  Options options;
  options.seed = today();
  const std::set<std::string> formats{"step", "iges", "dxf", "binary", "ifc", "brep", "json", "packed"};
  options.format = count < 2 ? "" : arguments[1];
  if (!formats.contains(options.format))
    throw std::invalid_argument("expected step, iges, dxf, binary, ifc, brep, json or packed");
  for (int i = 2; i + 1 < count; i += 2) {
    const std::string key = arguments[i], value = arguments[i + 1];
    if (key == "--seconds")
      options.seconds = std::stod(value);
    else if (key == "--cases")
      options.cases = std::stoull(value);
    else if (key == "--seed")
      options.seed = std::stoull(value);
    else if (key == "--from")
      options.from = value;
    else if (key == "--counts")
      options.counts = value;
    else if (key == "--keep")
      options.keep = value;
    else if (key == "--keep-fewer")
      options.keep_fewer = value;
    else
      throw std::invalid_argument("unknown option '" + key + "'");
  }
  return options;
}

// Loads what OpenCASCADE sets up once into this process, so that the children need not.
void warm_up(const CorpusText& text) {
  read_file(text.name, 1e-7);
  for (int number : {SIGSEGV, SIGFPE, SIGBUS, SIGILL}) std::signal(number, SIG_DFL);
}

std::string outcome_of(const ImportReport& report) {
  if (report.ok()) return "imported";
  const auto error = std::find_if(report.diagnostics.begin(), report.diagnostics.end(),
                                  [](const Diagnostic& d) { return d.severity == Severity::error; });
  for (const auto& [words, outcome] : {std::pair{"the reader crashed", "crashed_and_contained"},
                                       {"the reader was damaged", "crashed_and_contained"},
                                       {"time limit of", "timed_out"},
                                       {"memory limit of", "out_of_memory"},
                                       {"no process to read", "not_started"}})
    if (error->message.find(words) != std::string::npos) return outcome;
  return "diagnosed";
}

// What must hold of every report; "" if it does.
std::string violation(const ImportReport& report, const fs::path& file) {
  if (report.ok() && report.curves.empty()) return "neither a curve nor an error";
  for (const Diagnostic& d : report.diagnostics) {
    if (d.where.find(file.filename().string()) == std::string::npos)
      return "a diagnostic does not name the file: " + d.where;
    if (d.message.empty()) return "a diagnostic says nothing";
  }
  for (const ImportedCurve& curve : report.curves) {
    if (!curve.curve.control_points().allFinite()) return "a control point is not finite";
    if (!(curve.curve.control_points().row(3).minCoeff() > 0)) return "a weight is not positive";
  }
  return "";
}

std::ptrdiff_t open_descriptors() { return std::distance(fs::directory_iterator("/proc/self/fd"), {}); }

long resident_kilobytes() {
  std::ifstream statm("/proc/self/statm");
  long size = 0, resident = 0;
  statm >> size >> resident;
  return resident * (sysconf(_SC_PAGESIZE) / 1024);
}

void add_to_file(const std::string& path, const Counts& counts) {
  if (path.empty()) return;
  Counts sums = counts;
  std::ifstream in(path);
  std::string name;
  for (std::uint64_t count = 0; in >> name >> count;) sums[name] += count;
  std::ofstream out(path + ".new");
  for (const auto& [outcome, count] : sums) out << outcome << ' ' << count << '\n';
  out.close();
  fs::rename(path + ".new", path);
}

/// A directory of its own, removed at the end.
class Scratch {
 public:
  Scratch() {
    std::string name = (fs::temp_directory_path() / "nurbeam_fuzz_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make " + name);
    path_ = name;
  }
  ~Scratch() { fs::remove_all(path_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const fs::path& path() const { return path_; }
  fs::path file(const std::string& name, const std::string& content) const {
    const fs::path file = path_ / name;
    std::ofstream(file, std::ios::binary) << content;
    return file;
  }

 private:
  fs::path path_;
};

class Fuzzer {
 public:
  explicit Fuzzer(const Options& options)
      : options_(options), random_(options.seed), corpus_(corpus_of(options.format, options.from)) {
    for (const CorpusText& text : corpus_) contents_.push_back(text.content);
    // Assemblies find their parts beside them.
    for (const auto& seed : fs::directory_iterator(test::source_directory() / "tests/fuzz/seeds"))
      fs::copy_file(seed.path(), scratch_.path() / seed.path().filename());
    warm_up(corpus_.front());
  }

  // The number of cases that were not survived.
  int run() {
    const Clock::time_point begin = Clock::now();
    const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
    check_canary();
    const std::ptrdiff_t descriptors = open_descriptors();
    const long resident = resident_kilobytes();
    std::uint64_t done = 0;
    while (done < options_.cases && elapsed() < options_.seconds) {
      const std::uint64_t count =
          std::min(options_.cases - done, is_own_text() ? text_cases_of_a_child : cases_of_a_child);
      if (is_own_text())
        run_text_cases(count);
      else
        run_cases(count);
      done += count;
      if (done % cases_between_canaries == 0) {
        check_canary();
        hand_over();
      }
    }
    check_canary();
    if (open_descriptors() != descriptors) fail("file descriptors are left open");
    if (waitpid(-1, nullptr, WNOHANG) != -1) fail("child processes are left");
    constexpr long most_growth = 100'000;  // [kB]
    if (resident_kilobytes() > resident + most_growth) fail("the parent's memory grows");
    hand_over();
    print(done, elapsed());
    return failures_;
  }

 private:
  struct Case {
    const CorpusText* source;
    std::string content, file;
    std::uint64_t seed;
  };

  /// Whether readers of our own read the format, without OpenCASCADE.
  bool is_own_text() const {
    return options_.format == "dxf" || options_.format == "binary" || options_.format == "ifc" ||
           options_.format == "json";
  }

  Case case_of(std::uint64_t seed) const {
    std::mt19937_64 random(seed);
    const CorpusText& source = random_text(corpus_, random);
    return {&source, mutated(source.content, contents_, random), "case.cad", seed};
  }

  Case next_case(std::size_t number) {
    Case next = case_of(random_());
    next.file = scratch_.file("case_" + std::to_string(number) + ".cad", next.content);
    return next;
  }

  /// All in one child, without files, as long as none ends it. What they come to stands in shared memory.
  void run_text_cases(std::size_t count) {
    std::vector<std::uint64_t> seeds;
    for (std::size_t i = 0; i < count; ++i) seeds.push_back(random_());
    const SharedOutcomes shared;
    while (shared->done < count) {
      const Clock::time_point begin = Clock::now();
      const std::string ended = end_of_child([&] { read_text_cases(seeds, *shared); });
      slowest_ = std::max(slowest_, std::chrono::duration<double>(Clock::now() - begin).count());
      if (shared->done == count) break;
      const Case guilty = case_of(seeds[shared->done++]);
      ++counts_[ended];
      if (!options_.keep.empty()) keep(options_.keep, guilty.content, ended, guilty.seed);
      fail(guilty.source->name + ", case " + std::to_string(guilty.seed) + ": " + ended);
    }
    for (std::size_t i = 0; i < outcomes.size(); ++i)
      if (shared->counts[i] > 0) counts_[outcomes[i]] += shared->counts[i];
    failures_ += static_cast<int>(shared->violations);
  }

  void read_text_cases(const std::vector<std::uint64_t>& seeds, Outcomes& shared) {
    const rlimit memory{memory_limit, memory_limit}, none{0, 0};
    setrlimit(RLIMIT_AS, &memory);
    setrlimit(RLIMIT_CORE, &none);
    for (; shared.done < seeds.size(); ++shared.done) {
      limit_processor_time(time_limit);
      const Case next = case_of(seeds[shared.done]);
      try {
        const ImportReport report = read_content(next.file, next.content, 1e-7);
        judge_text(report, next, shared);
      } catch (const std::bad_alloc&) {
        ++shared.counts[2];
        if (!options_.keep.empty()) keep(options_.keep, next.content, outcomes[2], next.seed);
      }
    }
  }

  void judge_text(const ImportReport& report, const Case& of, Outcomes& shared) const {
    ++shared.counts[report.ok() ? 0 : 1];
    if (is_fewer_unsaid(report, *of.source)) {
      ++shared.counts[3];
      if (!options_.keep_fewer.empty()) keep(options_.keep_fewer, of.content, "fewer", of.seed);
    }
    const std::string wrong = violation(report, of.file);
    if (wrong.empty()) return;
    ++shared.violations;
    std::cout << "NOT SURVIVED: " << of.source->name << ", case " << of.seed << ": " << wrong << std::endl;
    if (!options_.keep.empty()) keep(options_.keep, of.content, "wrong", of.seed);
  }

  // Several in one child; one that ends it, or harms what is read after it, is read again in one of its own.
  void run_cases(std::size_t count) {
    std::vector<Case> cases;
    for (std::size_t i = 0; i < count; ++i) cases.push_back(next_case(i));
    for (std::size_t first = 0; first < count;) {
      std::vector<std::string> files;
      for (std::size_t i = first; i < count; ++i) files.push_back(cases[i].file);
      const Clock::time_point begin = Clock::now();
      const std::vector<ImportReport> reports = warm_reports(files, time_limit, memory_limit);
      slowest_ = std::max(slowest_, std::chrono::duration<double>(Clock::now() - begin).count());
      for (std::size_t i = 0; i < reports.size(); ++i) {
        const bool alone = i == 0 || !is_remarkable(reports[i], cases[first + i]);
        judge(alone ? reports[i] : warm_reports({files[i]}, time_limit, memory_limit)[0], cases[first + i]);
      }
      first += reports.size();
    }
  }

  static bool is_remarkable(const ImportReport& report, const Case& of) {
    const std::string outcome = outcome_of(report);
    return !violation(report, of.file).empty() || (outcome != "imported" && outcome != "diagnosed");
  }

  void judge(const ImportReport& report, const Case& of) {
    const std::string outcome = outcome_of(report);
    ++counts_[outcome];
    if (is_fewer_unsaid(report, *of.source)) {
      ++counts_["of_these_fewer_unsaid"];
      if (!options_.keep_fewer.empty()) keep(options_.keep_fewer, of.content, "fewer", of.seed);
    }
    const std::string wrong = violation(report, of.file);
    if (!wrong.empty()) fail(of.source->name + ", case " + std::to_string(of.seed) + ": " + wrong);
    if (is_remarkable(report, of) && !options_.keep.empty())
      keep(options_.keep, of.content, outcome, of.seed);
  }

  // Curves are missing and nothing is said: a whole entity may have been cut out, or something is lost.
  static bool is_fewer_unsaid(const ImportReport& report, const CorpusText& source) {
    return report.ok() && report.curves.size() < source.curves &&
           report.diagnostics.size() <= source.diagnostics;
  }

  static void keep(const std::string& directory, const std::string& content, const std::string& outcome,
                   std::uint64_t seed) {
    fs::create_directories(directory);
    std::ofstream(fs::path(directory) / (outcome + "_" + std::to_string(seed) + ".cad"), std::ios::binary)
        << content;
  }

  // A good file is still read as it was before any bad one.
  void check_canary() {
    const CorpusText& good = corpus_[canary_++ % corpus_.size()];
    const std::size_t curves = import_curves(good.name, {.time_limit = patience}).curves.size();
    if (curves != good.curves) fail(good.name + " now gives " + std::to_string(curves) + " curves");
  }

  void fail(const std::string& what) {
    ++failures_;
    std::cout << "NOT SURVIVED: " << what << std::endl;
  }

  void hand_over() {
    add_to_file(options_.counts, counts_);
    for (const auto& [outcome, count] : counts_) totals_[outcome] += count;
    counts_.clear();
  }

  void print(std::uint64_t done, double seconds) const {
    rusage children{};
    getrusage(RUSAGE_CHILDREN, &children);
    std::cout << done << " cases, seed " << options_.seed << ", " << seconds << " s:";
    for (const auto& [outcome, count] : totals_) std::cout << ' ' << outcome << ' ' << count << ',';
    std::cout << " longest child " << slowest_ << " s, largest child " << children.ru_maxrss / 1024
              << " MiB\n";
  }

  const Options options_;
  std::mt19937_64 random_;
  const std::vector<CorpusText> corpus_;
  std::vector<std::string> contents_;
  const Scratch scratch_;
  Counts counts_, totals_;
  double slowest_ = 0;
  std::size_t canary_ = 0;
  int failures_ = 0;
};

}  // namespace
}  // namespace nurbeam

int main(int count, char** arguments) {
  try {
    return nurbeam::Fuzzer(nurbeam::read_arguments(count, arguments)).run() == 0 ? 0 : 1;
  } catch (const std::exception& e) {
    std::cerr << "fuzz_reader: " << e.what() << '\n';
    return 2;
  }
}
