#include "pipelines/verification/verify.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <limits>
#include <mutex>
#include <ostream>
#include <sstream>
#include <thread>

#include "pipelines/verification/noted.h"

namespace nurbeam {

namespace {

std::string number(double x, int digits) {
  if (std::isnan(x)) return "-";
  std::ostringstream text;
  text << std::setprecision(digits) << x;
  return text.str();
}

using Line = std::vector<std::string>;

// Columns as wide as what stands in them, two spaces between.
void print_columns(std::ostream& out, const std::vector<Line>& lines, const std::string& indent) {
  std::vector<std::size_t> widths(lines[0].size());
  for (const Line& line : lines)
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  for (const Line& line : lines) {
    out << indent;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      out << std::left << std::setw(static_cast<int>(widths[i])) << line[i] << "  ";
    out << line.back() << '\n';
  }
}

void print_rows(std::ostream& out, const std::vector<VerifyProblem>& problems,
                const std::vector<VerifyResult>& results) {
  std::vector<Line> lines{{"problem", "quantity", "reference", "computed", "error", "tolerance", "pass",
                           "curvature, strain, stress-free", "source"}};
  for (std::size_t p = 0; p < problems.size(); ++p)
    for (const VerifyRow& row : results[p].rows)
      lines.push_back({problems[p].name, row.quantity,
                       (row.at_least ? "at least " : "") + number(row.reference, 10),
                       number(row.computed, 10), number(row.error(), 2), number(row.tolerance, 2),
                       row.passes() ? "yes" : "NO", problems[p].measures, row.source});
  print_columns(out, lines, "");
}

void print_convergence(std::ostream& out, const std::string& problem, const ConvergenceTable& table) {
  out << '\n' << problem << ": " << table.quantity << '\n';
  std::vector<Line> lines{{table.refined, "error", "order"}};
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    lines.push_back({number(table.rows[i].first, 6), number(table.rows[i].second, 3),
                     i == 0 ? "" : number(table.order(i - 1), 3)});
  print_columns(out, lines, "  ");
}

VerifyResult run_problem(const VerifyProblem& problem) {
  try {
    (void)verification::take_noted();
    VerifyResult result = problem.run();
    result.features = verification::take_noted();
    return result;
  } catch (const std::exception& error) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {{{"the run itself", none, error.what(), none, 0}}, {}};
  }
}

void append(std::vector<VerifyProblem>& all, std::vector<VerifyProblem> more) {
  std::move(more.begin(), more.end(), std::back_inserter(all));
}

}  // namespace

double VerifyRow::error() const {
  return at_least && computed > reference ? 0 : std::abs(computed - reference);
}

bool VerifyRow::passes() const { return error() <= tolerance; }

double ConvergenceTable::order(std::size_t i) const {
  const auto& [n, error] = rows.at(i);
  const auto& [finer_n, finer_error] = rows.at(i + 1);
  return std::log(error / finer_error) / std::abs(std::log(finer_n / n));
}

double ConvergenceTable::least_order() const {
  double least = order(0);
  for (std::size_t i = 1; i + 1 < rows.size(); ++i)
    if (std::isnan(order(i)) || order(i) < least) least = order(i);
  return least;
}

void VerifyResult::add(std::string quantity, double reference, std::string source, double computed,
                       double tolerance) {
  rows.push_back({std::move(quantity), reference, std::move(source), computed, tolerance});
}

void VerifyResult::add(ConvergenceTable table, double expected, double tolerance, std::string source) {
  rows.push_back(
      {"order of " + table.quantity, expected, std::move(source), table.least_order(), tolerance, true});
  tables.push_back(std::move(table));
}

std::vector<VerifyProblem> verification_problems() {
  std::vector<VerifyProblem> all = statics_problems();
  append(all, limit_problems());
  append(all, experiment_problems());
  append(all, axial_strain_problems());
  append(all, dynamics_problems());
  append(all, invariance_problems());
  append(all, torsion_problems());
  append(all, torsion_stability_problems());
  append(all, torsion_flight_problems());
  append(all, modes_problems());
  append(all, resistance_problems());
  append(all, torsion_sliding_problems());
  append(all, mechanics_problems());
  append(all, train_problems());
  append(all, energy_problems());
  append(all, rope_problems());
  append(all, eyelet_problems());
  append(all, reel_problems());
  append(all, body_problems());
  append(all, drive_problems());
  append(all, felt_problems());
  append(all, collector_problems());
  append(all, rope_motion_problems());
  append(all, turning_problems());
  append(all, sliding_problems());
  return all;
}

std::vector<VerifyResult> run_all(const std::vector<VerifyProblem>& problems, std::ostream& progress) {
  std::vector<VerifyResult> results(problems.size());
  std::atomic<std::size_t> left = problems.size();
  std::mutex printing;
  // The last problems, which take longest, are begun first.
  const auto work = [&] {
    for (std::size_t rank = left--; rank > 0 && rank <= problems.size(); rank = left--) {
      const auto start = std::chrono::steady_clock::now();
      results[rank - 1] = run_problem(problems[rank - 1]);
      const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
      const std::lock_guard lock(printing);
      progress << problems[rank - 1].name << ": " << number(time.count(), 2) << " s\n" << std::flush;
    }
  };
  {
    std::vector<std::jthread> helpers;
    const std::size_t threads = std::min<std::size_t>(std::thread::hardware_concurrency(), problems.size());
    for (std::size_t i = 1; i < threads; ++i) helpers.emplace_back(work);
    work();
  }
  return results;
}

int print_results(const std::vector<VerifyProblem>& problems, const std::vector<VerifyResult>& results,
                  std::ostream& out) {
  print_rows(out, problems, results);
  int passed = 0, failed = 0;
  for (std::size_t p = 0; p < problems.size(); ++p) {
    for (const ConvergenceTable& table : results[p].tables) print_convergence(out, problems[p].name, table);
    for (const VerifyRow& row : results[p].rows) ++(row.passes() ? passed : failed);
  }
  out << '\n' << passed << " passed, " << failed << " failed\n";
  return failed == 0 ? 0 : 1;
}

std::vector<VerifiedProblem> verified(const std::vector<VerifyProblem>& problems,
                                      const std::vector<VerifyResult>& results) {
  std::vector<VerifiedProblem> all;
  for (std::size_t p = 0; p < problems.size(); ++p) {
    VerifiedProblem& problem = all.emplace_back();
    problem.name = problems[p].name;
    problem.features = results[p].features;
    problem.least = std::numeric_limits<double>::infinity();
    for (const VerifyRow& row : results[p].rows) {
      if (row.at_least || (row.reference == 0 && row.computed == 0)) continue;
      constexpr double as_good_as_0 = 1e-12;
      const double size = std::abs(row.reference), error = row.error() / (size > as_good_as_0 ? size : 1);
      ++problem.rows;
      problem.least = std::min(problem.least, error);
      problem.greatest = std::max(problem.greatest, error);
    }
    if (problem.rows == 0) problem.least = problem.greatest = 0;
  }
  return all;
}

}  // namespace nurbeam
