#include "pipelines/verification/accuracy_campaign.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <ostream>
#include <string>
#include <thread>
#include <vector>

#include "nurbs/number_text.h"
#include "pipelines/accuracy/error_bars.h"
#include "pipelines/diagnostics/exit_code.h"
#include "pipelines/verification/noted.h"

namespace nurbeam {

namespace {

using verification::ProblemLevel;

constexpr int coarsest = -4, coarsest_base = -2;
constexpr int least_for_half = 6, least_for_quarter = 8;                        // as at_level has them
constexpr double trivial = 3e-7, most_of_scale = 0.25, most_of_forces = 0.125;  // as AccuracyTable has them

/// A problem at one level.
struct AtLevel {
  std::vector<VerifyRow> rows;
  ProblemLevel with;

  long steps() const {
    long sum = 0;
    for (const ProblemLevel::Kept& run : with.runs) sum += run.numbers.steps;
    return sum;
  }
};

// Nothing where it cannot be computed so coarsely. `leader`: its runs without fixed steps take the steps of
// this one's.
std::optional<AtLevel> at_level(const VerifyProblem& problem, int level, const AtLevel* leader = nullptr) {
  ProblemLevel& with = verification::problem_level();
  with = {.level = level, .keeps_numbers = true};
  if (leader) {
    with.given = &leader->with.steps;
    with.beside = level - leader->with.level;
  }
  std::optional<AtLevel> found;
  try {
    VerifyResult result = problem.run();
    found = {std::move(result.rows), std::move(with)};
  } catch (const std::exception&) {  // of the coarse elements
  }
  with = {};
  return found;
}

std::string unit_of(const VerifyRow& row) {
  const std::size_t open = row.quantity.find('['), close = row.quantity.find(']');
  return open == std::string::npos || close == std::string::npos
             ? "1"
             : row.quantity.substr(open + 1, close - open - 1);
}

bool is_force(const std::string& unit) {
  return unit.find('N') != std::string::npos || unit.find("Pa") != std::string::npos;
}

/// One estimate beside its true error.
struct Estimate {
  double error, bar, scale;
  bool is_claimed;
  bool is_trivial() const { return error <= trivial * scale; }
  bool is_inside() const { return error <= bar; }
};

using ByUnit = std::map<std::string, double>;

// The largest differences of rows, by units.
ByUnit differences(const AtLevel& fine, const AtLevel& coarse) {
  ByUnit largest;
  for (std::size_t i = 0; i < fine.rows.size(); ++i) {
    double& d = largest[unit_of(fine.rows[i])];
    const double here = std::abs(fine.rows[i].computed - coarse.rows[i].computed);
    if (!fine.rows[i].at_least && fine.rows[i].reference != 0 && std::isfinite(here)) d = std::max(d, here);
  }
  return largest;
}

// The difference of two runs up to a moment at which a history has the value of a row; nothing where none
// has.
std::optional<double> difference_of_history(double value, const AtLevel& fine, const AtLevel& coarse) {
  for (std::size_t run = 0; run < std::min(fine.with.runs.size(), coarse.with.runs.size()); ++run) {
    const LevelNumbers &a = fine.with.runs[run].numbers, &b = coarse.with.runs[run].numbers;
    for (std::size_t i = 0; i < std::min(a.rows.size(), b.rows.size()); ++i)
      for (const HistoryQuantity& quantity : fine.with.runs[run].quantities)
        for (const std::size_t k : quantity.columns)
          if (a.rows[i][k] == value && value != 0) return Differences({quantity}, a, b).until(0, a.times[i]);
  }
  return std::nullopt;
}

/// Which levels stand for the finest, the coarse and the coarser run of a level.
std::vector<int> levels_for(int base, const ProblemLevel& with) {
  const int n = with.fewest_elements;
  const bool is_guide = n == 0;
  if (with.moves)
    return is_guide || n >= least_for_half ? std::vector{base, base - 1} : std::vector{base + 1, base};
  if (n >= least_for_quarter) return {base, base - 1, base - 2};
  return n >= least_for_half ? std::vector{base + 1, base, base - 1} : std::vector{base + 2, base + 1, base};
}

/// The levels of a problem, each with its own steps, and those that stand beside the level in front of them
/// with the steps of that.
struct Levels {
  std::map<int, AtLevel> own, beside;

  const AtLevel* find(int level, int base) const {
    const bool follows = level != base && own.at(base).with.moves && !own.at(base).with.steps.empty();
    const std::map<int, AtLevel>& of = follows ? beside : own;
    const auto found = of.find(follows ? base : level);
    return found == of.end() ? nullptr : &found->second;
  }
};

// As AccuracyTable has it.
bool is_claimed(double bar, double scale, const std::vector<const AtLevel*>& runs, std::size_t row) {
  const AtLevel &fine = *runs[0], &coarse = *runs[1];
  constexpr double least_ratio = 1.5, falls = 0.71, matters = 0.01;
  const auto value = [&](std::size_t i) { return runs[i]->rows[row].computed; };
  if (fine.with.moves) {
    const double most = is_force(unit_of(fine.rows[row])) ? most_of_forces : most_of_scale;
    return static_cast<double>(fine.steps()) >= least_ratio * static_cast<double>(coarse.steps()) &&
           bar <= most * scale;
  }
  const bool shrinks =
      runs.size() < 3 || std::abs(value(0) - value(1)) <= falls * std::abs(value(1) - value(2));
  return bar <= (shrinks ? most_of_scale : matters) * scale;
}

std::optional<Estimate> estimate(std::size_t row, int base, const Levels& levels) {
  const AtLevel& own = levels.own.at(base);
  std::vector<const AtLevel*> runs;
  for (const int level : levels_for(base, own.with)) {
    const AtLevel* found = levels.find(level, base);
    if (!found || found->rows.size() != own.rows.size()) break;
    runs.push_back(found);
  }
  const VerifyRow& of = own.rows[row];
  if (runs.size() < 2 || of.at_least || of.reference == 0 || !std::isfinite(of.computed)) return std::nullopt;
  double largest = 0;
  for (const VerifyRow& other : own.rows)
    if (!other.at_least && unit_of(other) == unit_of(of))
      largest = std::max(largest, std::abs(other.reference));
  const std::string unit = unit_of(of);
  const double d = std::abs(runs[0]->rows[row].computed - runs[1]->rows[row].computed);
  double bar = 1e-7 * largest;
  if (own.with.moves) {
    const double before = difference_of_history(runs[0]->rows[row].computed, *runs[0], *runs[1])
                              .value_or(differences(*runs[0], *runs[1])[unit]);
    bar += (runs[0] == &own ? 1.25 : 1.5) * std::max(d, before);
  } else {
    const auto second =
        runs.size() > 2 ? std::optional(std::abs(runs[1]->rows[row].computed - runs[2]->rows[row].computed))
                        : std::nullopt;
    bar += std::max(bounded_order_error(d, second, own.with.has_jumps),
                    0.1 * differences(*runs[0], *runs[1])[unit]);
    if (runs[0] != &own) bar += std::abs(runs[0]->rows[row].computed - of.computed);
  }
  const double scale = std::max(std::abs(of.reference), 0.01 * largest);
  return Estimate{std::abs(of.computed - of.reference), bar, scale, is_claimed(bar, scale, runs, row)};
}

// Whether a known answer is one of another model, such as a rope without mass: half the elements and steps
// twice as long move the number by less than a fifth of its error, where they would double an error of
// theirs.
bool is_of_another_model(std::size_t row, const Levels& levels) {
  constexpr double small = 0.2;
  const auto coarser = levels.own.find(-1);
  if (coarser == levels.own.end() || coarser->second.rows.size() <= row) return false;
  const VerifyRow& of = levels.own.at(0).rows[row];
  const double moved = std::abs(coarser->second.rows[row].computed - of.computed);
  return moved < small * std::abs(of.computed - of.reference);
}

/// Estimates of some problems, and what is made of them.
struct Tally {
  int all = 0, nontrivial = 0, unclaimed = 0, all_inside = 0, inside = 0;
  std::vector<double> ratios;

  void add(const Estimate& of) {
    if (!of.is_claimed) {
      ++unclaimed;
      return;
    }
    ++all;
    all_inside += of.is_inside();
    if (of.is_trivial()) return;
    ++nontrivial;
    inside += of.is_inside();
    ratios.push_back(of.bar / of.error);
  }
  double part_inside() const { return nontrivial > 0 ? static_cast<double>(inside) / nontrivial : 1; }
  double middle_ratio() {
    if (ratios.empty()) return 0;
    std::ranges::sort(ratios);
    return ratios[ratios.size() / 2];
  }
};

std::string percent(int part, int whole) {
  return whole == 0 ? "-" : text_of(100.0 * part / whole, 3) + " %";
}

std::string row_of(const std::string& name, Tally tally) {
  return "| " + name + " | " + std::to_string(tally.all) + " | " + percent(tally.all_inside, tally.all) +
         " | " + std::to_string(tally.nontrivial) + " | " + percent(tally.inside, tally.nontrivial) + " | " +
         text_of(tally.middle_ratio(), 2) + " | " + std::to_string(tally.unclaimed) + " |";
}

Levels levels_of(const VerifyProblem& problem) {
  Levels levels;
  for (int level = 0; level >= coarsest; --level) {
    std::optional<AtLevel> found = at_level(problem, level);
    if (!found) break;
    levels.own.emplace(level, std::move(*found));
    const AtLevel& own = levels.own.at(level);
    if (own.with.by_hand || (own.with.moves && level < coarsest_base)) break;
    if (!own.with.moves || own.with.steps.empty()) continue;
    const int companion = levels_for(level, own.with)[0] == level ? level - 1 : level + 1;
    if (std::optional<AtLevel> beside = at_level(problem, companion, &own))
      levels.beside.emplace(level, std::move(*beside));
  }
  return levels;
}

/// The estimates of all problems.
class Campaign {
 public:
  Campaign(const std::vector<VerifyProblem>& problems, std::ostream& progress)
      : problems_(problems), left_(problems.size()), progress_(progress) {}

  // Takes problem after problem, the last first, which take longest.
  void work() {
    for (std::size_t rank = left_--; rank > 0 && rank <= problems_.size(); rank = left_--) {
      const Levels levels = levels_of(problems_[rank - 1]);
      const std::lock_guard lock(mutex_);
      progress_ << problems_[rank - 1].name << ": " << levels.own.size() << " meshes" << std::endl;
      if (levels.own.empty() || levels.own.at(0).with.by_hand) {
        ++left_out;
        continue;
      }
      for (int base = 0; base >= coarsest_base && levels.own.contains(base); --base)
        add(problems_[rank - 1].name, base, levels);
    }
  }

  int left_out = 0;         // problems that make their own steps or matrices
  int of_other_models = 0;  // estimates beside known answers of other models
  int inside_of_others = 0;
  Tally statics, motion, whole;
  Tally by_mesh[1 - coarsest_base];  // as they are, half, a quarter

 private:
  void add(const std::string& name, int base, const Levels& levels) {
    const AtLevel& own = levels.own.at(base);
    for (std::size_t row = 0; row < own.rows.size(); ++row) {
      const auto found = estimate(row, base, levels);
      if (!found) continue;
      if (!found->is_trivial() && is_of_another_model(row, levels)) {
        ++of_other_models;
        inside_of_others += found->is_claimed && found->is_inside();
        continue;
      }
      for (Tally* tally : {&by_mesh[-base], own.with.moves ? &motion : &statics, &whole}) tally->add(*found);
      if (found->is_claimed && !found->is_trivial() && !found->is_inside())
        progress_ << name << ", 2^" << base << " times the elements: " << own.rows[row].quantity
                  << " is off by " << text_of(found->error, 3) << ", estimated " << text_of(found->bar, 3)
                  << std::endl;
    }
  }

  const std::vector<VerifyProblem>& problems_;
  std::atomic<std::size_t> left_;
  std::ostream& progress_;
  std::mutex mutex_;
};

}  // namespace

int print_accuracy(const std::vector<VerifyProblem>& problems, std::ostream& progress, std::ostream& out) {
  Campaign campaign(problems, progress);
  {
    std::vector<std::jthread> helpers;
    const std::size_t threads = std::min<std::size_t>(std::thread::hardware_concurrency(), problems.size());
    for (std::size_t i = 1; i < threads; ++i) helpers.emplace_back([&] { campaign.work(); });
    campaign.work();
  }
  out << "| Rows | all | inside | error above 3e-7 of the scale | inside | estimate over error, middle | "
         "said to be not converged |\n|---|---|---|---|---|---|---|\n"
      << row_of("as they are", campaign.by_mesh[0]) << '\n'
      << row_of("half the elements, steps twice as long", campaign.by_mesh[1]) << '\n'
      << row_of("a quarter, four times as long", campaign.by_mesh[2]) << '\n'
      << row_of("statics, modes, buckling", campaign.statics) << '\n'
      << row_of("motion", campaign.motion) << '\n'
      << row_of("**all**", campaign.whole) << '\n'
      << "Left out: " << campaign.left_out << " of " << problems.size()
      << " problems, which make their own steps or matrices; " << campaign.of_other_models
      << " numbers beside known answers of another model, " << campaign.inside_of_others
      << " of them inside.\n";
  constexpr double least_inside = 0.95, most_ratio = 12;
  return campaign.whole.part_inside() >= least_inside && campaign.whole.middle_ratio() <= most_ratio
             ? exit_done
             : exit_failed;
}

}  // namespace nurbeam
