#include <algorithm>
#include <cmath>

#include "fem/element/subdivision.h"
#include "nurbs/arc_length.h"
#include "pipelines/papers/papers.h"
#include "pipelines/papers/papers_run.h"
#include "pipelines/papers/pendulum_motion.h"

// What the graded division of [S] is for: fewer elements for one error. With the metric.
namespace nurbeam::papers {

namespace {

const std::vector<double> shares{-0.6, -0.45, -0.3, -0.15, 0,
                                 0.15, 0.3,   0.45, 0.6};  // of the bound of Eq. 18
constexpr std::size_t equal = 4;

struct Case {
  std::string name;
  PendulumArc arc;
  int elements;
};

double error_of(const Case& one, double share, const PendulumMotion& fine) {
  const double k = share * grading_limit(length(pendulum_axis(one.arc)), one.elements);
  const PendulumMotion motion = pendulum_motion({.arc = one.arc, .elements = one.elements, .grading = k},
                                                GeneralizedAlpha{.rho_infinity = 0.9}, 5e-4);
  return motion.t.size() < fine.t.size() ? NAN : largest_difference(motion, fine).AB;
}

}  // namespace

void write_grading(Page& page, const PendulumMotion& fine) {
  std::vector<Case> cases;
  for (const int n : {2, 3, 4, 8})
    for (const auto& [name, arc] :
         {std::pair{"r1", PendulumArc::uniform}, {"r2", PendulumArc::paper}, {"r3", PendulumArc::extreme}})
      cases.push_back({name, arc, n});
  std::vector<std::vector<double>> errors(cases.size(), std::vector<double>(shares.size()));
  for_each_of(cases.size() * shares.size(), [&](std::size_t i) {
    errors[i / shares.size()][i % shares.size()] =
        error_of(cases[i / shares.size()], shares[i % shares.size()], fine);
  });
  std::vector<std::vector<std::string>> rows;
  double most[2] = {0, 0};  // the largest gain up to 3 elements, and with more
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto best = std::min_element(errors[i].begin(), errors[i].end());
    const double gain = errors[i][equal] / *best;
    double& largest = most[cases[i].elements > 3];
    largest = std::max(largest, gain);
    rows.push_back({cases[i].name, std::to_string(cases[i].elements), number(errors[i][equal], 2),
                    number(*best, 2), number(shares[static_cast<std::size_t>(best - errors[i].begin())]),
                    number(gain, 2)});
  }
  page.heading("Where graded division pays", 3);
  page.table(
      "With the metric; generalized-α, step 0.5 ms; largest difference in |AB| over 1 s from the fine run; "
      "k from -0.6 to 0.6 times the bound of Eq. 18, in nine steps",
      {"element", "parts", "equal parts [m]", "best k [m]", "its k, over the bound", "gain"}, rows);
  page.paragraph("With two or three parts the best k is up to " + number(most[0], 2) +
                 " times better than equal parts, with four or eight up to " + number(most[1], 2) +
                 " times. No rule of [S] tells k beforehand.");
}

}  // namespace nurbeam::papers
