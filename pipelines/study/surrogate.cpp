#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "nurbs/number_text.h"
#include "pipelines/study/openturns_study.h"

namespace nurbeam {

namespace {

std::size_t held_back(const StudySurrogate& surrogate, std::size_t variants) {
  return static_cast<std::size_t>(std::round(surrogate.held_back * static_cast<double>(variants)));
}

struct Fitted {
  std::function<double(const OT::Point&)> value;
  std::vector<double> first_order = {}, total_order = {};
};

std::function<double(const OT::Point&)> value_of(const OT::Function& function) {
  return [function](const OT::Point& x) { return function(x)[0]; };
}

Fitted chaos_of(const StudyFile& study, int degree, const OT::Sample& x, const OT::Sample& y) {
  const OT::Distribution joint = joint_distribution(study);
  const std::size_t inputs = joint.getDimension();
  OT::OrthogonalProductPolynomialFactory::PolynomialFamilyCollection families;
  for (std::size_t i = 0; i < inputs; ++i)
    families.add(OT::OrthogonalUniVariatePolynomialFamily(
        OT::StandardDistributionPolynomialFactory(joint.getMarginal(i))));
  const OT::LinearEnumerateFunction enumerate(inputs);
  const OT::OrthogonalBasis basis = OT::OrthogonalProductPolynomialFactory(families, enumerate);
  const std::size_t terms = enumerate.getBasisSizeFromTotalDegree(static_cast<std::size_t>(degree));
  OT::FunctionalChaosAlgorithm algorithm(x, y, joint, OT::FixedStrategy(basis, terms),
                                         OT::LeastSquaresStrategy());
  algorithm.run();
  const OT::FunctionalChaosResult result = algorithm.getResult();
  Fitted fitted{value_of(result.getMetaModel())};
  const OT::FunctionalChaosSobolIndices indices(result);
  for (std::size_t i = 0; i < inputs; ++i) {
    fitted.first_order.push_back(indices.getSobolIndex(i));
    fitted.total_order.push_back(indices.getSobolTotalIndex(i));
  }
  return fitted;
}

/// Of parts of the extents: the lengths of correlation are looked for from one start, the same for all
/// variables.
Fitted kriging_of(const OT::Sample& x, const OT::Sample& y) {
  const std::size_t inputs = x.getDimension();
  OT::Point extent = x.getMax() - x.getMin();
  OT::SquareMatrix scale(inputs);
  for (std::size_t i = 0; i < inputs; ++i) scale(i, i) = 1 / std::max(extent[i], 1e-300);
  const OT::LinearFunction parts(x.getMin(), OT::Point(inputs), scale);
  OT::MaternModel covariance(inputs);
  covariance.setNu(2.5);
  covariance.setScale(OT::Point(inputs, 0.5));
  OT::KrigingAlgorithm algorithm(parts(x), y, covariance, OT::ConstantBasisFactory(inputs).build());
  algorithm.setOptimizationBounds(OT::Interval(OT::Point(inputs, 0.02), OT::Point(inputs, 20)));
  algorithm.setOptimizationAlgorithm(
      OT::NLopt("LN_COBYLA"));  // the default's search along lines fails at times
  algorithm.run();
  return {value_of(OT::ComposedFunction(algorithm.getResult().getMetaModel(), parts))};
}

// What does not vary: no part of it is any variable's.
Fitted constant_of(const StudyFile& study, double value, bool with_indices) {
  const std::vector<double> none(with_indices ? study.free_variables().size() : 0, 0.0);
  return {[value](const OT::Point&) { return value; }, none, none};
}

}  // namespace

std::string too_few_for(const StudySurrogate& surrogate, std::size_t variables, std::size_t variants) {
  const std::size_t held = held_back(surrogate, variants);
  const std::string all = std::to_string(variants);
  if (held < 2 || variants < held + 3)
    return "a surrogate needs more than " + all + " variants that are done";
  double terms = 1;  // of a polynomial: (variables + degree) over degree
  for (int k = 1; k <= surrogate.degree; ++k) terms *= (static_cast<double>(variables) + k) / k;
  if (surrogate.kind != StudySurrogate::Kind::chaos ||
      std::round(terms) <= static_cast<double>(variants - held))
    return {};
  return "polynomials of degree " + std::to_string(surrogate.degree) + " have " + text_of(std::round(terms)) +
         " terms, more than the " + std::to_string(variants - held) + " of " + all +
         " variants that are not held back; take a lower \"degree\" or more variants";
}

std::vector<SurrogateResult> make_surrogates(const StudyFile& study, const StudySurrogate& surrogate,
                                             const StudyPoints& inputs, const StudyPoints& outputs) {
  OT::RandomGenerator::SetSeed(study.seed);
  if (const std::string problem = too_few_for(surrogate, study.free_variables().size(), inputs.size());
      !problem.empty())
    throw std::runtime_error(problem);
  const std::size_t held = held_back(surrogate, inputs.size());
  // Plans are in order of space or time: what is held back is spread over them.
  StudyPoints fit_x, fit_y, test_x, test_y;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const bool back = (i + 1) * held / inputs.size() > i * held / inputs.size();
    (back ? test_x : fit_x).push_back(inputs[i]);
    (back ? test_y : fit_y).push_back(outputs[i]);
  }
  std::vector<SurrogateResult> results;
  for (std::size_t k = 0; k < study.quantities.size(); ++k) {
    const OT::Sample x = to_sample(fit_x), y = to_sample(fit_y).getMarginal(k);
    const bool is_chaos = surrogate.kind == StudySurrogate::Kind::chaos;
    const Fitted fitted = hardly_varies(fit_y, k) ? constant_of(study, y[0][0], is_chaos)
                          : is_chaos              ? chaos_of(study, surrogate.degree, x, y)
                                                  : kriging_of(x, y);
    SurrogateResult result{.quantity = study.quantities[k].name,
                           .first_order = fitted.first_order,
                           .total_order = fitted.total_order};
    double mean = 0, squares = 0, errors = 0, largest = 0;
    for (const auto& row : test_y) mean += row[k] / static_cast<double>(test_y.size());
    for (std::size_t i = 0; i < test_y.size(); ++i) {
      const double error = fitted.value(to_point(test_x[i])) - test_y[i][k];
      errors += error * error;
      squares += (test_y[i][k] - mean) * (test_y[i][k] - mean);
      result.largest_error = std::max(result.largest_error, std::abs(error));
      largest = std::max(largest, std::abs(test_y[i][k]));
    }
    // Where these are all equal there is no variance to explain, and either it meets them or it does not.
    const bool meets = result.largest_error <= 1e-12 * largest;
    result.q2 = hardly_varies(test_y, k) ? (meets ? 1 : 0) : 1 - errors / squares;
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace nurbeam
