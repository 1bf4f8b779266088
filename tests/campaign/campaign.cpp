// Random models, run and held to the laws of mechanics.
//
//   random_campaign [--mechanics] [--seed N] [--count N] [--hours H] [--steps N] [--keep DIRECTORY]
//     seeds N, N + 1, ... until count or time is up; each case for so many steps (1000); with --mechanics
//     cases of what resists, holds and connects
//   random_campaign [--steps N] --case FILE...   these cases alone
//
// Exits with 1 where a law is broken; the case is kept as seed_N.json, cut down to what still breaks it (but
// one that hangs is kept as it is: each cut would take a minute).

#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/campaign/random_case.h"
#include "tests/campaign/trial.h"

namespace nurbeam::campaign {

namespace {

struct Options {
  unsigned long seed = 1;
  long count = 100;
  std::optional<double> hours;
  std::filesystem::path keep;
  long steps = 1000;
  std::vector<std::string> cases;
  std::optional<unsigned long> show;
  bool mechanics = false;

  Json made(unsigned long number) const { return mechanics ? random_mechanics(number) : random_case(number); }
};

Options read_options(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto value = [&]() -> std::string {
      if (i + 1 >= argc) throw std::invalid_argument(word + " needs a value");
      return argv[++i];
    };
    if (word == "--seed")
      options.seed = std::stoul(value());
    else if (word == "--count")
      options.count = std::stol(value());
    else if (word == "--hours")
      options.hours = std::stod(value());
    else if (word == "--steps")
      options.steps = std::stol(value());
    else if (word == "--keep")
      options.keep = value();
    else if (word == "--show")
      options.show = std::stoul(value());
    else if (word == "--mechanics")
      options.mechanics = true;
    else if (word == "--case")
      while (i + 1 < argc) options.cases.emplace_back(argv[++i]);
    else
      throw std::invalid_argument(
          word +
          " is not known; known are --seed, --count, --hours, --steps, --keep, --case, "
          "--show, --mechanics");
  }
  return options;
}

/// A case that hangs or crashes is a defect like any other: it runs in a process of its own, for so many
/// seconds of the processor's time.
constexpr long longest_seconds = 60;

template <class Case>
void try_in_child(const Case& c, long steps, int out) {
  const itimerval time{{0, 0}, {longest_seconds, 0}};
  setitimer(ITIMER_PROF, &time, nullptr);
  Verdict verdict;
  try {
    verdict = try_case(c, steps);
  } catch (const std::exception& error) {
    verdict = {.outcome = "thrown", .complaint = std::string("throws: ") + error.what()};
  }
  const std::string text =
      Json{verdict.outcome, verdict.complaint, verdict.drift, verdict.imbalance, verdict.seconds}.dump(
          -1, ' ', false, Json::error_handler_t::replace);
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = write(out, text.data() + done, text.size() - done);
    if (written <= 0) break;
    done += static_cast<std::size_t>(written);
  }
  _exit(0);
}

template <class Case>  // a file or what stands in it
Verdict watched(const Case& c, long steps) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  std::cout.flush();
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) {
    close(ends[0]);
    try_in_child(c, steps, ends[1]);
  }
  close(ends[1]);
  std::string text(1 << 16, '\0');
  std::size_t length = 0;
  for (ssize_t got = 1; got > 0 && length < text.size(); length += static_cast<std::size_t>(got))
    if ((got = read(ends[0], text.data() + length, text.size() - length)) < 0) break;
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFSIGNALED(status))
    return WTERMSIG(status) == SIGPROF
               ? Verdict{.outcome = "hung", .complaint = "takes more than a minute"}
               : Verdict{.outcome = "crashed", .complaint = strsignal(WTERMSIG(status))};
  const Json told = Json::parse(text.substr(0, length));
  const auto number = [](const Json& value) { return value.is_null() ? NAN : value.get<double>(); };
  return {told[0], told[1], number(told[2]), number(told[3]), number(told[4])};
}

// The kind of a complaint: its words up to the first number.
std::string kind_of(const std::string& complaint) {
  return complaint.substr(0, complaint.find_first_of("0123456789"));
}

// Without what can go while the complaint stays.
Json cut_down(Json c, const std::string& complaint, long steps) {
  const auto still = [&](const Json& smaller) {
    return kind_of(watched(smaller, steps).complaint) == kind_of(complaint);
  };
  const auto try_change = [&](const Json& smaller) {
    const bool holds = still(smaller);
    if (holds) c = smaller;
    return holds;
  };
  for (const char* list : {"loads", "supports", "stops", "connectors"})
    for (std::size_t i = c.contains(list) ? c[list].size() : 0; i-- > 0;) {
      Json smaller = c;
      smaller[list].erase(i);
      try_change(smaller);
    }
  for (std::size_t i = c.contains("bodies") ? c["bodies"].size() : 0; i-- > 0;) {
    Json smaller = c;
    smaller["bodies"].erase(i);
    if (i < smaller["sliding_joints"].size()) smaller["sliding_joints"].erase(i);
    try_change(smaller);
  }
  for (const char* path :
       {"/beams/0/material/damping", "/analysis/initial", "/analysis/integrator", "/beams/0/orientation",
        "/gravity", "/air", "/beams/0/material/mass_damping", "/beams/0/material/stiffness_damping",
        "/sliding_joints/0/friction", "/sliding_joints/0/speed"}) {
    Json smaller = c;
    const Json::json_pointer pointer(path);
    if (!smaller.contains(pointer)) continue;
    smaller[pointer.parent_pointer()].erase(pointer.back());
    try_change(smaller);
  }
  for (int count : {3, 4, 6, 8}) {
    Json smaller = c;
    for (Json& beam : smaller["beams"]) beam["elements"]["count"] = count;
    if (try_change(smaller)) break;
  }
  return c;
}

struct Tally {
  std::map<std::string, long> outcomes;
  long runs = 0, complaints = 0;
  double drift = 0, imbalance = 0, seconds = 0;

  void add(const Verdict& verdict) {
    ++runs;
    ++outcomes[verdict.outcome];
    if (!verdict.complaint.empty()) ++complaints;
    if (verdict.outcome == "done" && verdict.complaint.empty()) {
      drift = std::max(drift, verdict.drift);
      imbalance = std::max(imbalance, verdict.imbalance);
    }
    seconds = std::max(seconds, verdict.seconds);
  }
  void print() const {
    std::cout << runs << " cases, " << complaints << " break a law; largest imbalance of forces " << imbalance
              << ", longest case " << seconds << " s\n";
    for (const auto& [outcome, count] : outcomes) std::cout << "  " << count << "  " << outcome << '\n';
    std::cout.flush();
  }
};

void report(const std::string& name, const Verdict& verdict) {
  if (!verdict.complaint.empty())
    std::cout << name << ": " << verdict.complaint << " (" << verdict.outcome << ")" << std::endl;
}

int run(const Options& options) {
  if (options.show) {
    std::cout << options.made(*options.show).dump(1) << '\n';
    return 0;
  }
  Tally tally;
  for (const std::string& file : options.cases) {
    const Verdict verdict = watched(std::filesystem::path(file), options.steps);
    std::cout << file << ": " << verdict.outcome << ", drift " << verdict.drift << ", imbalance "
              << verdict.imbalance << ", " << verdict.seconds << " s\n";
    report(file, verdict);
    tally.add(verdict);
  }
  const auto start = std::chrono::steady_clock::now();
  const auto goes_on = [&](long i) {
    if (!options.cases.empty()) return false;
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    return options.hours ? passed.count() < *options.hours * 3600 : i < options.count;
  };
  for (long i = 0; goes_on(i); ++i) {
    const unsigned long seed = options.seed + static_cast<unsigned long>(i);
    const std::string name = "seed " + std::to_string(seed);
    const Json c = options.made(seed);
    const Verdict verdict = watched(c, options.steps);
    tally.add(verdict);
    report(name, verdict);
    if (tally.runs % 100 == 0) tally.print();
    if (verdict.complaint.empty() || options.keep.empty()) continue;
    std::filesystem::create_directories(options.keep);
    std::ofstream(options.keep / ("seed_" + std::to_string(seed) + ".json"))
        << (verdict.outcome == "hung" ? c : cut_down(c, verdict.complaint, options.steps)).dump(1) << '\n';
  }
  tally.print();
  return tally.complaints > 0 ? 1 : 0;
}

}  // namespace

}  // namespace nurbeam::campaign

int main(int argc, char** argv) {
  try {
    return nurbeam::campaign::run(nurbeam::campaign::read_options(argc, argv));
  } catch (const std::exception& error) {
    std::cerr << "random_campaign: " << error.what() << '\n';
    return 2;
  }
}
