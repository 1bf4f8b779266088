#include <stdexcept>

#include "pipelines/study/openturns_study.h"

namespace nurbeam {

namespace {

/// Of each variable.
struct Estimates {
  OT::Point first_order, total_order;
};

Estimates estimates_of(const OT::Sample& inputs, const OT::Sample& outputs, std::size_t rows) {
  const OT::SaltelliSensitivityAlgorithm algorithm(inputs, outputs, rows);
  return {algorithm.getFirstOrderIndices(), algorithm.getTotalOrderIndices()};
}

/// Blocks of rows, of which each is one of the given ones, drawn by chance, the same in all blocks.
OT::Sample drawn_again(const OT::Sample& outputs, std::size_t rows) {
  const auto from = OT::RandomGenerator::IntegerGenerate(rows, rows);
  OT::Sample drawn(outputs.getSize(), 1);
  for (std::size_t i = 0; i < outputs.getSize(); ++i) drawn(i, 0) = outputs(i - i % rows + from[i % rows], 0);
  return drawn;
}

/// Standard deviations of the estimates, by the bootstrap. (The intervals of OpenTURNS are not about its own
/// estimates where there is one variable, and twice as wide as they should be for the total order.)
Estimates deviations_of(const OT::Sample& inputs, const OT::Sample& outputs, std::size_t rows) {
  constexpr int draws = 200;
  OT::Sample first(0, inputs.getDimension()), total(0, inputs.getDimension());
  for (int i = 0; i < draws; ++i) {
    const OT::Sample drawn = drawn_again(outputs, rows);
    if (drawn.getMin() == drawn.getMax()) continue;  // of few rows it may be one that is the same everywhere
    const Estimates estimates = estimates_of(inputs, drawn, rows);
    first.add(estimates.first_order);
    total.add(estimates.total_order);
  }
  return {first.computeStandardDeviation(), total.computeStandardDeviation()};
}

std::vector<SobolIndices::Index> with_interval(const OT::Point& values, const OT::Point& deviations,
                                               double confidence) {
  const double width = OT::DistFunc::qNormal((1 + confidence) / 2);
  std::vector<SobolIndices::Index> indices;
  for (std::size_t i = 0; i < values.getDimension(); ++i)
    indices.push_back({values[i], values[i] - width * deviations[i], values[i] + width * deviations[i]});
  return indices;
}

/// The base rows all of whose variants are done: the design is blocks of `size` rows.
std::vector<std::size_t> whole_rows(const StudyPoints& quantities, std::size_t size) {
  std::vector<std::size_t> whole;
  for (std::size_t row = 0; row < size; ++row) {
    bool done = true;
    for (std::size_t at = row; at < quantities.size(); at += size) done = done && !quantities[at].empty();
    if (done) whole.push_back(row);
  }
  return whole;
}

}  // namespace

SensitivityResult sobol_indices(const StudyFile& study, const StudySensitivity& sensitivity,
                                const StudyEvaluation& evaluate) {
  OT::RandomGenerator::SetSeed(study.seed);
  const auto size = static_cast<std::size_t>(sensitivity.count);
  const OT::Sample design = OT::SobolIndicesExperiment(joint_distribution(study), size, false).generate();
  const StudyPoints points = from_sample(design);
  const StudyPoints quantities = evaluate(points);
  const std::vector<std::size_t> rows = whole_rows(quantities, size);
  if (2 * rows.size() < size)
    throw std::runtime_error("Sobol indices need their whole sample, but only " +
                             std::to_string(rows.size()) + " of " + std::to_string(size) +
                             " rows have all their variants done");
  SensitivityResult result{.rows_left_out = static_cast<int>(size - rows.size())};
  for (const std::string& name : sensitivity.quantities) {
    const std::size_t k = quantity_index(study, name);
    StudyPoints inputs, outputs;
    for (std::size_t block = 0; block < points.size(); block += size)
      for (const std::size_t row : rows) {
        inputs.push_back(points[block + row]);
        outputs.push_back({quantities[block + row][k]});
      }
    if (hardly_varies(outputs, 0)) {
      const std::vector<SobolIndices::Index> none(study.free_variables().size());
      result.indices.push_back({.quantity = name, .first_order = none, .total_order = none});
      continue;
    }
    const OT::Sample x = to_sample(inputs), y = to_sample(outputs);
    const Estimates values = estimates_of(x, y, rows.size()), sd = deviations_of(x, y, rows.size());
    const double level = sensitivity.confidence;
    result.indices.push_back({.quantity = name,
                              .first_order = with_interval(values.first_order, sd.first_order, level),
                              .total_order = with_interval(values.total_order, sd.total_order, level)});
  }
  return result;
}

}  // namespace nurbeam
