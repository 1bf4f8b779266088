#include <algorithm>
#include <stdexcept>

#include "pipelines/study/openturns_study.h"

namespace nurbeam {

namespace {

std::vector<SobolIndices::Index> with_interval(const OT::Point& values, const OT::Interval& interval) {
  std::vector<SobolIndices::Index> indices;
  for (std::size_t i = 0; i < values.getDimension(); ++i)
    indices.push_back({values[i], interval.getLowerBound()[i], interval.getUpperBound()[i]});
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
    if (std::all_of(outputs.begin(), outputs.end(),
                    [&](const auto& row) { return row == outputs.front(); })) {
      const std::vector<SobolIndices::Index> none(study.free_variables().size());
      result.indices.push_back({.quantity = name, .first_order = none, .total_order = none});
      continue;
    }
    OT::SaltelliSensitivityAlgorithm algorithm(to_sample(inputs), to_sample(outputs), rows.size());
    algorithm.setConfidenceLevel(sensitivity.confidence);
    result.indices.push_back({.quantity = name,
                              .first_order = with_interval(algorithm.getFirstOrderIndices(),
                                                           algorithm.getFirstOrderIndicesInterval()),
                              .total_order = with_interval(algorithm.getTotalOrderIndices(),
                                                           algorithm.getTotalOrderIndicesInterval())});
  }
  return result;
}

}  // namespace nurbeam
