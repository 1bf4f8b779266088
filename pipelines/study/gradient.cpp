#include "pipelines/study/gradient.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/run/simulation_plan.h"
#include "pipelines/study/variant.h"
#include "solver/algebra/side_by_side.h"

namespace nurbeam {

namespace {

std::vector<double> free_values(const StudyFile& study, const std::vector<double>& values) {
  std::vector<double> free;
  for (const std::size_t i : study.free_variables()) free.push_back(values[i]);
  return free;
}

/// The values of all variables where free variable k is changed.
std::vector<double> changed(const StudyFile& study, const std::vector<double>& values, std::size_t k,
                            double by) {
  std::vector<double> free = free_values(study, values);
  free[k] += by;
  return all_values(study, free);
}

/// The stored times at which histories have a part in the quantities.
std::vector<std::size_t> times_that_count(const StudyFile& study, const std::vector<double>& values,
                                          const Histories& histories, const BeamModel& model,
                                          const std::vector<RunEvent>& events) {
  const auto quantities = [&](const Histories& of) {
    std::vector<double> all;
    for (const StudyQuantity& quantity : study.quantities)
      all.push_back(quantity.value.number(scope_of_run(study, values, of, model, events)));
    return all;
  };
  constexpr double little = 1e-6;
  const std::vector<double> present = quantities(histories);
  std::vector<std::size_t> times;
  Histories nudged = histories;
  const auto counts = [&](std::size_t time, double part) {
    nudged.nudge(time, part);
    const bool changes = quantities(nudged) != present;
    nudged.replace(time, histories);
    return changes;
  };
  for (std::size_t i = 0; i < histories.times().size(); ++i)
    if (counts(i, little) || counts(i, -little)) times.push_back(i);
  return times;
}

/// Half of what numbers change by from a move back to the same move on, f(-1) and f(1), where they are `here`
/// without; linear, from as small a part of it as it takes for both to change them alike: of a long one the
/// extreme of a history may come to lie at another time.
Eigen::VectorXd slopes(const Eigen::VectorXd& here, const std::function<Eigen::VectorXd(double part)>& f) {
  constexpr double least = 1e-4, alike = 1e-3, round_off = 1e-13;
  Eigen::VectorXd slope(here.size());
  std::vector<bool> found(static_cast<std::size_t>(here.size()), false);
  for (double part = 1; std::find(found.begin(), found.end(), false) != found.end(); part /= 10) {
    const Eigen::VectorXd on = f(part) - here, back = here - f(-part);
    for (Eigen::Index i = 0; i < here.size(); ++i) {
      if (found[static_cast<std::size_t>(i)]) continue;
      const bool one_sided = !std::isfinite(on[i]) || !std::isfinite(back[i]);
      const double mean = !one_sided ? (on[i] + back[i]) / 2 : std::isfinite(on[i]) ? on[i] : back[i];
      slope[i] = mean / part;
      found[static_cast<std::size_t>(i)] =
          one_sided || part <= least ||
          std::abs(on[i] - back[i]) <= alike * std::abs(mean) + round_off * std::abs(here[i]);
    }
  }
  return slope;
}

// Throws std::invalid_argument where a neighbouring model is in space, or has been put into a plane that it
// is out of by little: what a parameter does out of it is left out.
void check_planar_alike(const BuiltModel& own, const BuiltModel& other) {
  constexpr double round_off = 1e-14;
  const bool leaves_out = std::abs(other.frame.off_plane - own.frame.off_plane) > round_off;
  if (other.model.dimension != own.model.dimension || leaves_out)
    throw std::invalid_argument(
        "the model is plane, and one in space with another value; take a nominal value that is out of the "
        "plane, or differences of runs");
}

/// Throws std::invalid_argument where beams of a neighbouring model are drawn in another way.
void check_drawn_alike(const BeamModel& own, const BeamModel& other) {
  for (std::size_t b = 0; b < own.beams.size(); ++b) {
    const int parts = own.beams[b].curve.segment_count(), others = other.beams[b].curve.segment_count();
    if (parts != others)
      throw std::invalid_argument(
          "beam " + in_quotes(own.beams[b].name) + " is divided into " + std::to_string(parts) +
          " rational cubics, and into " + std::to_string(others) +
          " with another value, as a curve may be where its weights are all equal and where they differ; take "
          "a value a little off (1.001 for a weight of 1), or differences of runs");
  }
}

/// What is asked of a method, beside the times.
std::vector<double> settings_of(const IntegratorSettings& integrator) {
  return std::visit(
      [&](const auto& method) {
        std::vector<double> settings{static_cast<double>(integrator.index()), method.tolerance};
        if constexpr (
            requires { method.rho_infinity; })
          settings.push_back(method.rho_infinity);
        if constexpr (
            requires { method.newton_tolerance; })
          settings.push_back(method.newton_tolerance);
        return settings;
      },
      integrator);
}

/// Whether neighbours run alike, and so can go along.
bool same_run(const SimulationOptions& a, const SimulationOptions& b) {
  return a.end_time == b.end_time && a.step == b.step && a.output_times == b.output_times &&
         a.length_control.min == b.length_control.min && a.length_control.max == b.length_control.max &&
         settings_of(a.integrator) == settings_of(b.integrator);
}

bool asks_for_von_mises(const StudyFile& study) {
  return std::any_of(
      study.quantities.begin(), study.quantities.end(),
      [](const StudyQuantity& quantity) {
        const std::vector<std::string> names = quantity.value.names();
        return std::any_of(
            names.begin(), names.end(),
            [](const std::string& name) { return name.find(".von_mises") != std::string::npos; });
      });
}

// Throws std::invalid_argument where the shear stress of a section does not change smoothly with a parameter.
void check_stresses(const BeamModel& less, const BeamModel& model, const BeamModel& more) {
  for (std::size_t b = 0; b < model.beams.size(); ++b) {
    const auto of_torque = [&](const BeamModel& each) {
      return each.beams[b].stresses ? each.beams[b].stresses->largest({.torque = 1}).von_mises : 0;
    };
    const double here = of_torque(model), slope = of_torque(more) - of_torque(less);
    constexpr double round_off = 1e-9, bent = 0.01;
    if (std::abs(slope) <= round_off * here) continue;
    if (std::abs(of_torque(more) + of_torque(less) - 2 * here) > bent * std::abs(slope))
      throw std::invalid_argument(
          "the shear stress of the section of beam " + in_quotes(model.beams[b].name) +
          " is found on a mesh that changes with it, so that its error is more than the "
          "difference; leave \"von_mises\" out, or search without derivatives");
  }
}

template <class Target>
bool targets(const StudyVariable& variable) {
  return variable.target && std::holds_alternative<Target>(*variable.target);
}

// Of the beam of which a variable moves control points or corners, one by one: its name, or its number in the
// case where a path has that; empty: none.
std::string beam_of_points(const StudyVariable& variable) {
  if (!variable.target) return {};
  if (const auto* point = std::get_if<ControlPointCoordinate>(&*variable.target)) return point->beam;
  const auto* numbers = std::get_if<CasePaths>(&*variable.target);
  if (!numbers || numbers->paths.empty()) return {};
  const std::string &path = numbers->paths.front(), begin = "beams[";
  const std::size_t end = path.find("].axis.");
  const bool moves =
      path.find(".control_points[") != std::string::npos || path.find(".polyline[") != std::string::npos;
  if (!moves || !path.starts_with(begin) || end == std::string::npos) return {};
  return path.substr(begin.size(), end - begin.size());
}

}  // namespace

double derivative_step(const StudyVariable& variable, double value, bool settles) {
  using Kind = StudyDistribution::Kind;
  const Kind kind = variable.distribution.kind;
  const std::vector<double>& p = variable.distribution.parameters;
  const double width = kind == Kind::uniform || kind == Kind::triangular ? p.back() - p.front() : p[1];
  const double greater = std::max(width, std::abs(value)), lesser = std::min(width, std::abs(value));
  const auto step = [&] {
    // Not too small beside the value: that is lost in round-off. What moves the axis by no more than that:
    // slender beams are stiff against what is of second order in it. Neighbours that settle answer as their
    // loads are, with an error of the square of the step.
    constexpr double settled = 4e-4;
    if (!beam_of_points(variable).empty() || targets<CurveTransform>(variable))
      return std::max(settles ? settled * width : 0, 1e-6 * greater);
    const double part = !targets<ControlPointWeight>(variable) ? 1e-4 : settles ? settled : 1e-5;
    return part * std::max(lesser, 0.1 * greater);
  };
  return std::min(step(), 0.1 * width);  // as far as the range allows
}

std::vector<double> differences(const StudyFile& study, const std::vector<double>& values,
                                const std::function<double(const std::vector<double>&)>& f) {
  std::vector<double> result;
  const std::vector<std::size_t> free = study.free_variables();
  for (std::size_t k = 0; k < free.size(); ++k) {
    const double step = derivative_step(study.variables[free[k]], values[free[k]]);
    result.push_back((f(changed(study, values, k, step)) - f(changed(study, values, k, -step))) / (2 * step));
  }
  return result;
}

namespace {

// The beam of which a variable moves a control point; null: none.
const Beam* beam_of_point(const StudyVariable& variable, const BeamModel& model) {
  const std::string of = beam_of_points(variable);
  for (std::size_t b = 0; !of.empty() && b < model.beams.size(); ++b)
    if (model.beams[b].name == of || std::to_string(b) == of) return &model.beams[b];
  return nullptr;
}

double element_length(const Beam& beam) {
  return beam.curve.length() / static_cast<double>(beam.home.size() - 1);
}

// Of a control point, where its range is narrow: no less than a part of an element, in whose numbers less is
// lost in round-off.
double step_of_residuals(const StudyVariable& variable, const BeamModel& model, double by_value) {
  constexpr double part = 1e-6;
  const Beam* beam = beam_of_point(variable, model);
  return beam && !beam->rigid ? std::max(part * element_length(*beam), by_value) : by_value;
}

// Adjoints of motions are linear in the numbers of elements: of a control point they take a part of the
// length of an element, between round-off in these and what is of third order in it.
double step_of_elements(const StudyVariable& variable, const BeamModel& model, double by_value) {
  constexpr double part = 5e-6, far = 100, near = 0.1;
  const Beam* beam = beam_of_point(variable, model);
  if (!beam || beam->has_torsion() || !model.riders.empty()) return by_value;
  return std::clamp(part * element_length(*beam), near * by_value, far * by_value);
}

// Of a control point whose neighbours settle: where its range is wide no more than a part of what it bends,
// and where it is narrow no less, as round-off of forces does not get smaller with the range.
double step_of_spans(const StudyVariable& variable, const BeamModel& model, double by_value) {
  constexpr double least = 5e-5, most = 2e-4;
  const Beam* beam = beam_of_point(variable, model);
  if (!beam) return by_value;
  const double span = beam->curve.length() / beam->curve.segment_count();
  return std::clamp(by_value, least * span, most * span);
}

}  // namespace

struct VariantGradient::NeighbouringRun {
  std::vector<double> values;
  std::unique_ptr<const BuiltModel> built;
  Histories histories;

  NeighbouringRun(const Histories& run, std::vector<double> of, std::unique_ptr<const BuiltModel> model)
      : values(std::move(of)), built(std::move(model)), histories(run.of_neighbour(*built)) {}

  Neighbour neighbour() const {
    return {std::make_shared<const BeamModel>(built->model), probe_places(*built)};
  }
};

struct VariantGradient::Pair {
  NeighbouringRun more, less;
  double step;
};

VariantGradient::VariantGradient(const StudyFile& study, const StudyCase& study_case,
                                 const std::vector<double>& values, const CaseFile& case_file,
                                 const BuiltModel& model)
    : study_(study), model_(model), values_(values) {
  const SimulationOptions options = simulation_options(case_file);
  const Histories own_histories(study, model);
  const auto case_of = [&](const std::vector<double>& of, std::string& why) {
    if (std::optional<CaseFile> reshaped = study_case.reshaped(case_file, values, study.variables, of))
      return reshaped;
    CaseFileReport read = study_case.read(study.variables, of);
    if (!read.value) {
      why = first_error(read.diagnostics);
      return std::optional<CaseFile>();
    }
    if (!same_run(options, simulation_options(*read.value)))
      throw std::invalid_argument(
          "variables that change the times of a run, its integrator or when its mesh changes have no "
          "derivative; take differences of runs");
    return std::optional<CaseFile>(std::move(*read.value));
  };
  const auto run_of = [&](std::vector<double> of, std::string& why) -> std::optional<NeighbouringRun> {
    const std::optional<CaseFile> neighbour = case_of(of, why);
    BuildReport report = neighbour ? build_model(*neighbour, {}, &model) : BuildReport{};
    if (neighbour && !report.value) why = first_error(report.diagnostics);
    if (!report.value) return std::nullopt;
    check_planar_alike(model, *report.value);
    check_drawn_alike(model.model, report.value->model);
    return NeighbouringRun(own_histories, std::move(of),
                           std::make_unique<const BuiltModel>(std::move(*report.value)));
  };
  // On one side where there is nothing on the other, as below a damping of zero: closer, as that is of first
  // order.
  const auto pair_of = [&](std::size_t k, double step) -> Pair {
    std::string why;
    std::optional<NeighbouringRun> more = run_of(changed(study, values, k, step), why),
                                   less = run_of(changed(study, values, k, -step), why);
    if (more && less) {
      if (asks_for_von_mises(study)) check_stresses(less->built->model, model.model, more->built->model);
      return {std::move(*more), std::move(*less), step};
    }
    const double little = step / 10;
    std::optional<NeighbouringRun> own = run_of(values, why),
                                   beside = run_of(changed(study, values, k, more ? little : -little), why);
    if (!own || !beside)
      throw std::invalid_argument("with a little more and with a little less of it there is no model: " +
                                  why + "; take another \"nominal\" value, or a method without derivatives");
    if (more) return {std::move(*beside), std::move(*own), little / 2};
    return {std::move(*own), std::move(*beside), little / 2};
  };
  const std::vector<std::size_t> free = study.free_variables();
  is_by_adjoint_ = pays_by_adjoint(free.size(), own_histories, options.statics);
  const bool settles = options.statics && !is_by_adjoint_;
  std::vector<std::optional<Pair>> pairs(free.size());
  std::vector<std::string> problems(free.size());
  side_by_side(static_cast<int>(free.size()), [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    const StudyVariable& variable = study.variables[free[k]];
    const double by_value = derivative_step(variable, values[free[k]], settles);
    const double of_residuals = step_of_residuals(variable, model.model, by_value);
    const double step = settles ? step_of_spans(variable, model.model, by_value)
                        : is_by_adjoint_ && !options.statics
                            ? step_of_elements(variable, model.model, of_residuals)
                            : of_residuals;
    try {
      pairs[k].emplace(pair_of(k, step));
    } catch (const std::invalid_argument& problem) {
      problems[k] = problem.what();
    }
  });
  std::vector<NeighbourPair> neighbours;
  for (std::size_t k = 0; k < free.size(); ++k) {
    if (!problems[k].empty())
      throw std::invalid_argument("no derivative by " + in_quotes(study.variables[free[k]].name) + ": " +
                                  problems[k]);
    const Pair& pair = pairs_.emplace_back(std::move(*pairs[k]));
    neighbours.push_back({pair.more.neighbour(), pair.less.neighbour(), pair.step});
  }
  sensitivities_ =
      std::make_unique<Sensitivities>(options, probe_places(model), std::move(neighbours), is_by_adjoint_);
}

VariantGradient::~VariantGradient() = default;

// Not where single unknowns of a state change what is asked for by much more than all together: energies and
// forces of a rest.
bool VariantGradient::pays_by_adjoint(std::size_t variables, const Histories& histories,
                                      bool is_static) const {
  const SnapshotContents contents = histories.contents();
  return variables > study_.quantities.size() &&
         !(is_static && (contents.beams || contents.sections || contents.energy));
}

Eigen::VectorXd VariantGradient::quantities(const std::vector<double>& values, const Histories& histories,
                                            const std::vector<RunEvent>& events) const {
  const ExpressionScope scope = scope_of_run(study_, values, histories, model_.model, events);
  Eigen::VectorXd all(static_cast<Eigen::Index>(study_.quantities.size()));
  for (std::size_t i = 0; i < study_.quantities.size(); ++i)
    all[static_cast<Eigen::Index>(i)] = study_.quantities[i].value.number(scope);
  return all;
}

// (quantities x parameters) What states at the times that count, which change with the parameters, do to the
// quantities, where adjoints say so.
Eigen::MatrixXd VariantGradient::through_states(const Histories& histories,
                                                const std::vector<RunEvent>& events) {
  const Eigen::VectorXd here = quantities(values_, histories, events);
  Histories changed = histories, moved = histories;
  const auto linear = [&](std::size_t time, const Snapshot& snapshot) {
    changed.replace(time, snapshot);
    const Eigen::VectorXd change = slopes(here, [&](double part) {
      moved.shift(time, histories, changed, part);
      const Eigen::VectorXd there = quantities(values_, moved, events);
      moved.replace(time, histories);
      return there;
    });
    return Eigen::VectorXd(here + change);
  };
  return sensitivities_->through_states(linear);
}

StudyGradient VariantGradient::of_quantities(const Histories& histories,
                                             const std::vector<RunEvent>& events) {
  const std::vector<std::size_t> times = times_that_count(study_, values_, histories, model_.model, events);
  sensitivities_->ask({.records = times,
                       .quantities = study_.quantities.size(),
                       .contents = histories.contents(),
                       .of_beams = histories.parts_of_beams()});
  for (Pair& pair : pairs_)
    for (NeighbouringRun* run : {&pair.more, &pair.less}) run->histories.begin_as(histories);
  for (const std::size_t time : times) {
    const std::vector<Sensitivities::Neighbours> neighbours = sensitivities_->neighbours(time);
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      pairs_[k].more.histories.replace(time, neighbours[k].more);
      pairs_[k].less.histories.replace(time, neighbours[k].less);
    }
  }
  const Eigen::VectorXd here = quantities(values_, histories, events);
  Eigen::MatrixXd gradient(here.size(), static_cast<Eigen::Index>(pairs_.size()));
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const Pair& pair = pairs_[k];
    const auto beside = [&](double part) {
      std::vector<double> values = values_;
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] += part * (pair.more.values[i] - pair.less.values[i]) / 2;
      Histories moved = histories;
      for (const std::size_t time : times)
        moved.shift(time, pair.less.histories, pair.more.histories, part / 2);
      std::vector<RunEvent> later = events;
      for (std::size_t i = 0; i < events.size(); ++i)
        later[i].time += part * pair.step * sensitivities_->event_times()[i][k];
      return quantities(values, moved, later);
    };
    gradient.col(static_cast<Eigen::Index>(k)) = slopes(here, beside) / pair.step;
  }
  if (is_by_adjoint_) gradient += through_states(histories, events);
  StudyGradient rows;
  for (std::size_t i = 0; i < study_.quantities.size(); ++i) {
    const Eigen::VectorXd row = gradient.row(static_cast<Eigen::Index>(i));
    if (!row.allFinite())
      throw std::invalid_argument("the quantity " + in_quotes(study_.quantities[i].name) +
                                  " has no derivative");
    rows.emplace_back(row.begin(), row.end());
  }
  return rows;
}

}  // namespace nurbeam
