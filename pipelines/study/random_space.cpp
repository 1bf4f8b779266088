#include "pipelines/study/random_space.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

namespace {

std::vector<std::size_t> free_ones(const StudyFile& study, bool random) {
  std::vector<std::size_t> found;
  for (const std::size_t i : study.free_variables())
    if (study.variables[i].is_random == random) found.push_back(i);
  return found;
}

// "a = 1, b = 2"
std::string design_text(const StudyFile& study, const std::vector<double>& design) {
  std::string text;
  const std::vector<std::size_t> at = design_variables(study);
  for (std::size_t i = 0; i < at.size(); ++i)
    text += (i > 0 ? ", " : "") + study.variables[at[i]].name + " = " + text_of(design[i], 6);
  return text;
}

}  // namespace

std::vector<std::size_t> design_variables(const StudyFile& study) { return free_ones(study, false); }
std::vector<std::size_t> random_variables(const StudyFile& study) { return free_ones(study, true); }

ExpressionScope scope_of_design(const StudyFile& study, const std::vector<double>& design) {
  return {
      .value = [&study, &design, at = design_variables(study)](const std::string& name) -> ExpressionValue {
        for (std::size_t i = 0; i < at.size(); ++i)
          if (study.variables[at[i]].name == name) return design[i];
        throw std::invalid_argument("there is no design variable " + in_quotes(name));
      }};
}

RandomSpace::RandomSpace(const StudyFile& study, const std::vector<double>& design) {
  for (const std::size_t i : random_variables(study)) try {
      laws_.push_back(law_of(study.variables[i].distribution.at(scope_of_design(study, design))));
    } catch (const OT::Exception&) {  // which speaks of its own names of parameters
      throw std::runtime_error("the distribution of " + in_quotes(study.variables[i].name) +
                               " is none with " + design_text(study, design));
    }
}

// By the nearer tail: far out in it Phi is 1 to its last digit.
std::vector<double> RandomSpace::values(const Eigen::VectorXd& u) const {
  std::vector<double> values;
  for (std::size_t i = 0; i < laws_.size(); ++i) {
    const double at = u[static_cast<Eigen::Index>(i)];
    values.push_back(laws_[i].computeScalarQuantile(OT::DistFunc::pNormal(-std::abs(at)), at > 0));
  }
  return values;
}

std::vector<double> RandomSpace::slopes(const Eigen::VectorXd& u) const {
  const std::vector<double> x = values(u);
  std::vector<double> slopes;
  for (std::size_t i = 0; i < x.size(); ++i)
    slopes.push_back(OT::DistFunc::dNormal(u[static_cast<Eigen::Index>(i)]) / laws_[i].computePDF(x[i]));
  return slopes;
}

Eigen::VectorXd RandomSpace::standard(const std::vector<double>& values) const {
  Eigen::VectorXd u(static_cast<Eigen::Index>(laws_.size()));
  for (std::size_t i = 0; i < laws_.size(); ++i) {
    const double below = laws_[i].computeCDF(values[i]);
    u[static_cast<Eigen::Index>(i)] =
        below <= 0.5 ? OT::DistFunc::qNormal(below)
                     : -OT::DistFunc::qNormal(laws_[i].computeComplementaryCDF(values[i]));
  }
  return u;
}

std::vector<double> RandomSpace::deviations() const {
  std::vector<double> deviations;
  for (const OT::Distribution& law : laws_) deviations.push_back(law.getStandardDeviation()[0]);
  return deviations;
}

std::vector<double> joined(const StudyFile& study, const std::vector<double>& design,
                           const std::vector<double>& random) {
  std::vector<double> values;
  std::size_t of_design = 0, of_random = 0;
  for (const std::size_t i : study.free_variables())
    values.push_back(study.variables[i].is_random ? random[of_random++] : design[of_design++]);
  return values;
}

}  // namespace nurbeam
