#include "pipelines/results/evidence.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include "nurbs/number_text.h"

namespace nurbeam {

namespace {

std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

VerifiedProblem problem_of(const std::string& line) {
  constexpr std::size_t columns = 5;
  const std::vector<std::string> cells = parts_of(line, '\t');
  if (cells.size() != columns)
    throw std::invalid_argument("the line \"" + line + "\" of verified problems has " +
                                std::to_string(cells.size()) + " columns, not " + std::to_string(columns));
  const std::vector<std::string> features = parts_of(cells[4], ';');
  return {cells[0],
          std::stoi(cells[1]),
          std::stod(cells[2]),
          std::stod(cells[3]),
          {features.begin(), features.end()}};
}

/// Features that both have, over those that either has.
double likeness(const std::set<std::string>& a, const std::set<std::string>& b) {
  const auto common =
      static_cast<double>(std::ranges::count_if(a, [&](const std::string& one) { return b.contains(one); }));
  return common / (static_cast<double>(a.size() + b.size()) - common);
}

}  // namespace

std::string text_of(const std::vector<VerifiedProblem>& problems) {
  constexpr int digits = 2;
  std::string text;
  for (const VerifiedProblem& problem : problems) {
    text += problem.name + "\t" + std::to_string(problem.rows) + "\t" + text_of(problem.least, digits) +
            "\t" + text_of(problem.greatest, digits) + "\t";
    const char* before = "";
    for (const std::string& feature : problem.features) {
      text += before + feature;
      before = ";";
    }
    text += "\n";
  }
  return text;
}

std::vector<VerifiedProblem> read_verified(std::string_view table) {
  std::vector<VerifiedProblem> problems;
  for (const std::string& line : parts_of(std::string(table), '\n')) problems.push_back(problem_of(line));
  return problems;
}

std::vector<FeatureEvidence> evidence_for(const std::set<std::string>& features,
                                          const std::vector<VerifiedProblem>& verified) {
  constexpr std::size_t most = 3;
  std::vector<FeatureEvidence> all;
  for (const std::string& feature : features) {
    FeatureEvidence& evidence = all.emplace_back();
    evidence.feature = feature;
    for (const VerifiedProblem& problem : verified)
      if (problem.features.contains(feature)) evidence.problems.push_back(problem);
    const auto rank = [&](const VerifiedProblem& problem) {
      return std::tuple(problem.least > close_error, -likeness(features, problem.features), problem.least);
    };
    std::ranges::stable_sort(evidence.problems, {}, rank);
    if (evidence.problems.size() > most) evidence.problems.resize(most);
  }
  return all;
}

}  // namespace nurbeam
