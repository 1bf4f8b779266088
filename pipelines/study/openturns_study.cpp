#include "pipelines/study/openturns_study.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace nurbeam {

namespace {

using Family = StudyDistribution::Kind;

OT::Distribution whole_distribution(const StudyDistribution& d) {
  const std::vector<double>& p = d.parameters;
  switch (d.kind) {
    case Family::uniform:
      return OT::Uniform(p[0], p[1]);
    case Family::normal:
      return OT::Normal(p[0], p[1]);
    case Family::lognormal:
      return OT::ParametrizedDistribution(OT::LogNormalMuSigma(p[0], p[1], 0));
    case Family::triangular:
      return OT::Triangular(p[0], p[1], p[2]);
    case Family::gumbel:
      return OT::ParametrizedDistribution(OT::GumbelMuSigma(p[0], p[1]));
    case Family::weibull:
      return OT::ParametrizedDistribution(OT::WeibullMinMuSigma(p[0], p[1], 0));
  }
  return {};
}

class VariantsFunction : public OT::EvaluationImplementation {
 public:
  using Transform =
      std::function<std::vector<double>(const std::vector<double>&, const std::vector<double>&)>;

  VariantsFunction(std::size_t inputs, std::size_t outputs, StudyEvaluation evaluate, Transform f)
      : inputs_(inputs), outputs_(outputs), evaluate_(std::move(evaluate)), f_(std::move(f)) {
    setInputDescription(OT::Description::BuildDefault(inputs, "x"));
    setOutputDescription(OT::Description::BuildDefault(outputs, "y"));
  }

  VariantsFunction* clone() const override { return new VariantsFunction(*this); }
  OT::UnsignedInteger getInputDimension() const override { return inputs_; }
  OT::UnsignedInteger getOutputDimension() const override { return outputs_; }

  OT::Point operator()(const OT::Point& x) const override { return operator()(OT::Sample(1, x))[0]; }
  OT::Sample operator()(const OT::Sample& x) const override {
    const StudyPoints points = from_sample(x);
    const StudyPoints quantities = evaluate_(points);
    OT::Sample result(x.getSize(), outputs_);
    for (std::size_t i = 0; i < points.size(); ++i) result[i] = to_point(f_(quantities[i], points[i]));
    callsNumber_.fetchAndAdd(static_cast<int>(x.getSize()));
    return result;
  }

 private:
  std::size_t inputs_, outputs_;
  StudyEvaluation evaluate_;
  Transform f_;
};

class VariantsGradient : public OT::GradientImplementation {
 public:
  VariantsGradient(std::size_t inputs, std::size_t outputs, StudyDerivatives gradient)
      : inputs_(inputs), outputs_(outputs), gradient_(std::move(gradient)) {}

  VariantsGradient* clone() const override { return new VariantsGradient(*this); }
  OT::UnsignedInteger getInputDimension() const override { return inputs_; }
  OT::UnsignedInteger getOutputDimension() const override { return outputs_; }

  OT::Matrix gradient(const OT::Point& x) const override {
    const StudyGradient rows = gradient_(from_point(x));
    OT::Matrix result(inputs_, outputs_);
    for (std::size_t k = 0; k < rows.size(); ++k)
      for (std::size_t i = 0; i < inputs_; ++i) result(i, k) = rows[k][i];
    return result;
  }

 private:
  std::size_t inputs_, outputs_;
  StudyDerivatives gradient_;
};

}  // namespace

void silence_openturns() { OT::Log::Show(OT::Log::NONE); }

OT::Distribution law_of(const StudyDistribution& d) {
  const OT::Distribution whole = whole_distribution(d);
  if (d.lower && d.upper) return OT::TruncatedDistribution(whole, *d.lower, *d.upper);
  if (d.lower) return OT::TruncatedDistribution(whole, *d.lower, OT::TruncatedDistribution::LOWER);
  if (d.upper) return OT::TruncatedDistribution(whole, *d.upper, OT::TruncatedDistribution::UPPER);
  return whole;
}

OT::Distribution joint_distribution(const StudyFile& study) {
  OT::ComposedDistribution::DistributionCollection marginals;
  for (const std::size_t i : study.free_variables()) {
    OT::Distribution marginal = law_of(study.variables[i].distribution);
    marginal.setDescription({study.variables[i].name});
    marginals.add(marginal);
  }
  return OT::ComposedDistribution(marginals);
}

double index_of(double probability) { return -OT::DistFunc::qNormal(probability); }

std::optional<double> mean_of(const StudyDistribution& distribution) {
  try {
    const double mean = law_of(distribution).getMean()[0];
    return std::isfinite(mean) ? std::optional(mean) : std::nullopt;
  } catch (const OT::Exception&) {
    return std::nullopt;
  }
}

OT::Point to_point(const std::vector<double>& values) { return OT::Point(values.begin(), values.end()); }

OT::Sample to_sample(const StudyPoints& points) {
  OT::Sample sample(points.size(), points.empty() ? 0 : points.front().size());
  for (std::size_t i = 0; i < points.size(); ++i) sample[i] = to_point(points[i]);
  return sample;
}

std::vector<double> from_point(const OT::Point& point) { return {point.begin(), point.end()}; }

StudyPoints from_sample(const OT::Sample& sample) {
  StudyPoints points;
  for (std::size_t i = 0; i < sample.getSize(); ++i) points.push_back(from_point(sample[i]));
  return points;
}

OT::Function study_function(const StudyFile& study, const StudyEvaluation& evaluate, std::size_t outputs,
                            VariantsFunction::Transform f, const StudyDerivatives& gradient) {
  const std::size_t inputs = study.free_variables().size();
  OT::Function function(VariantsFunction(inputs, outputs, evaluate, std::move(f)));
  if (gradient) function.setGradient(VariantsGradient(inputs, outputs, gradient));
  return function;
}

bool hardly_varies(const StudyPoints& rows, std::size_t quantity) {
  constexpr double round_off = 1e-13;
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (const auto& row : rows) {
    least = std::min(least, row[quantity]);
    greatest = std::max(greatest, row[quantity]);
  }
  return greatest - least <= round_off * std::max(std::abs(least), std::abs(greatest));
}

std::size_t quantity_index(const StudyFile& study, const std::string& name) {
  const auto found = std::find_if(study.quantities.begin(), study.quantities.end(),
                                  [&](const StudyQuantity& quantity) { return quantity.name == name; });
  return static_cast<std::size_t>(found - study.quantities.begin());
}

}  // namespace nurbeam
