#include "pipelines/study/study_keys.h"

#include "pipelines/case/shapes.h"

namespace nurbeam {

namespace {

using namespace shapes;

/// A number, or a text with a unit, whose dimension the target of the variable says.
Shape measured() { return either(any_text(), quantity(Dimension::number)); }

Shape pair_of(Shape item) {
  Shape shape = array(std::move(item), 2);
  shape.most_items = 2;
  return shape;
}

Shape axis_name() { return choice({"x", "y", "z"}); }

Shape distribution() {
  const Shape moments = object(
      {{"mean", measured(),
        "mean; as all numbers of a distribution it may be an expression of earlier variables with a range, "
        "where optimise is subject to a probability",
        required},
       {"sd", measured(), "standard deviation", required}});
  Shape three = array(measured(), 3);
  three.most_items = 3;
  return object({{"uniform", pair_of(measured()), "[minimum, maximum]"},
                 {"normal", moments, "of Gauss"},
                 {"lognormal", moments, "its logarithm is normal; mean and sd are those of the value itself"},
                 {"triangular", three, "[minimum, most likely, maximum]"},
                 {"gumbel", moments, "of maximum values"},
                 {"weibull", moments, "of minimum values, from 0"},
                 {"lower", measured(), "cut off below this"},
                 {"upper", measured(), "cut off above this"}},
                {{{"uniform", "normal", "lognormal", "triangular", "gumbel", "weibull"}, required}});
}

Shape variable() {
  const Shape points = array(integer(not_negative()), 1);
  const Shape turn =
      object({{"axis", shapes::vector(Dimension::number), "direction of the axis", required},
              {"about", shapes::vector(Dimension::length), "a point of it; [0, 0, 0] when omitted"}});
  const Shape scale =
      object({{"about", shapes::vector(Dimension::length), "the point that stays", required}});
  return object(
      {{"name", name(), "heads its column, and stands in expressions", required},
       {"path", either(any_text(), array(any_text(), 1)),
        "number of the case file, as --set has it (beams[0].section.radius); several of them get one value"},
       {"control_point",
        object({{"beam", name(), "the beam", required},
                {"index", integer(not_negative()), "of the control point, counted from 0", required},
                {"axis", axis_name(), "which coordinate", required}}),
        "a coordinate of a control point of the beam's curve [m]"},
       {"weight",
        object({{"beam", name(), "the beam", required},
                {"index", integer(not_negative()), "of the control point, counted from 0", required}}),
        "the weight of a control point"},
       {"transform",
        object(
            {{"beam", name(), "the beam", required},
             {"points", points, "control points that move, counted from 0; all when omitted"},
             {"translate", shapes::vector(Dimension::number), "moved along this direction, the value in m"},
             {"place", axis_name(),
              "moved along this axis until the first of the points has the value as its coordinate, in m"},
             {"rotate", turn, "turned by the value, in degrees"},
             {"scale", scale, "scaled by the value"}},
            {{{"translate", "place", "rotate", "scale"}, required}}),
        "moves control points of the beam's curve together"},
       {"range", pair_of(measured()), "[minimum, maximum]: any value between, with equal chances"},
       {"distribution", distribution(), "how its values are scattered"},
       {"value", any_text(), "an expression of other variables"},
       {"nominal", measured(),
        "where a search begins; the middle of the range, or the mean of the distribution within its \"lower\" and \"upper\", when omitted"}},
      {{{"path", "control_point", "weight", "transform"}, false},
       {{"range", "distribution", "value"}, required}});
}

Shape refinement() {
  return object(
      {{"beam", name(), "whose curve gets more control points; variables move them", required},
       {"knots", array(quantity(Dimension::number), 1), "knots that are inserted, once each"},
       {"parts", integer({.lower = 2, .upper = 1000}), "each span is divided into so many equal ones"}},
      {{{"knots", "parts"}, required}});
}

Shape quantity_of_interest() {
  return object(
      {{"name", name(), "heads its column", required},
       {"value", any_text(),
        "an expression over histories and variables: max(trolley.speed), at(end, cable.length), "
        "time(leaves, trolley)",
        required},
       {"unit", any_text(),
        "heads its column in tables and plots; it converts nothing: the value is made of SI units, so write "
        "1e3 * at(end, tip.x) for \"mm\"; none when omitted"}});
}

Shape counted(const char* what, double least) {
  return object({{"count", integer({.lower = least, .upper = 1e7}), what, required}});
}

Shape plan() {
  const Shape levels = integer({.lower = 1, .upper = 1e6});
  return object(
      {{"list", array(array(measured(), 1), 1), "rows with the values of the variables, in their order"},
       {"gradient", either(choice({"nominal"}), array(array(measured(), 1), 1)),
        "the variant of the nominal values, or rows as of a list: quantities with their derivatives by the "
        "variables"},
       {"grid", either(levels, array(levels, 1)),
        "so many values of each variable from end to end of its range, all combined; one number, or one "
        "for each variable"},
       {"latin_hypercube", counted("number of variants", 1), "stratified in each variable"},
       {"sobol", counted("number of variants", 1), "the low-discrepancy sequence"},
       {"monte_carlo", counted("number of variants", 1), "independent draws"}},
      {{{"list", "gradient", "grid", "latin_hypercube", "sobol", "monte_carlo"}, required}});
}

Shape sensitivity() {
  return object({{"count", integer({.lower = 8, .upper = 1e6}),
                  "size of the base sample; (variables + 2) times as many variants run", required},
                 {"quantities", array(name(), 1), "of which; all when omitted"},
                 {"confidence", quantity(Dimension::number, {.lower = 0.5, .upper = 0.999}),
                  "level of the intervals; 0.95 when omitted"}});
}

Shape derivatives() { return choice({"tangents", "differences"}); }
constexpr const char* about_derivatives =
    "tangents when omitted: variants come with derivatives that go along with their runs; differences: of "
    "variants, two more for each variable. Of what friction, stops and methods other than generalized-alpha "
    "do there are only these";

Shape reliability() {
  return object(
      {{"quantity", name(), "whose limit is looked at", required},
       {"above", measured(), "the variant fails where the quantity is above this"},
       {"below", measured(), "the variant fails where it is below this"},
       {"method", choice({"form", "importance_sampling", "monte_carlo"}), "form when omitted"},
       {"count", integer({.lower = 10, .upper = 1e8}), "most variants of a simulation; 1000 when omitted"},
       {"derivatives", derivatives(), about_derivatives},
       {"coefficient_of_variation", quantity(Dimension::number, {.lower = 0, .upper = 1}),
        "a simulation ends where that of the probability is below this; when omitted at the count"}},
      {{{"above", "below"}, required}});
}

Shape check_of_probabilities() {
  return object({{"method", choice({"importance_sampling", "monte_carlo"}),
                  "importance_sampling, about the design point of FORM, when omitted"},
                 {"count", integer({.lower = 10, .upper = 1e8}),
                  "most variants for each probability; 1000 when omitted"},
                 {"coefficient_of_variation", quantity(Dimension::number, {.lower = 0, .upper = 1}),
                  "it ends where that of the probability is below this; when omitted at the count"}});
}

Shape optimum() {
  return object({{"minimise", either(name(), array(name(), 1)), "a quantity, or several for a Pareto front"},
                 {"maximise", either(name(), array(name(), 1)), "likewise"},
                 {"subject_to", array(any_text(), 1),
                  "expressions over quantities and variables that must hold, such as \"speed <= 10\", and "
                  "\"probability(stress > 2.5e8) <= 1e-3\" or \"reliability_index(stress > 2.5e8) >= 3\": "
                  "then variables with a range are searched, those with a distribution are random"},
                 {"check", check_of_probabilities(),
                  "a simulation of these probabilities at the optimum; none when omitted"},
                 {"method", choice({"cobyla", "nelder_mead", "gradient", "genetic"}),
                  "cobyla when omitted; genetic for several objectives, gradient with a probability"},
                 {"derivatives", derivatives(), about_derivatives},
                 {"evaluations", integer({.lower = 1, .upper = 1e6}),
                  "most variants, of genetic 16 at least; 100 when omitted"},
                 {"tolerance", quantity(Dimension::number, {.lower = 1e-12, .upper = 0.5}),
                  "of the variables, as a part of their ranges; 1e-4 when omitted"}});
}

Shape calibration() {
  const Shape observation =
      object({{"value", any_text(), "an expression whose value is a history: tip.x", required},
              {"measured", table(Dimension::number), "what was measured of it, in SI units", required},
              {"sd", quantity(Dimension::number, {.lower = 1e-30, .upper = 1e30}),
               "standard deviation of its noise; 1 when omitted. With ranges only the ratios count"}});
  return object({{"observations", array(observation, 1), "what was measured", required},
                 {"derivatives", derivatives(),
                  "tangents: variants come with derivatives that go along with their runs; differences: of "
                  "variants, two more for each variable. When omitted tangents where there are such"},
                 {"confidence", quantity(Dimension::number, {.lower = 0.5, .upper = 0.999}),
                  "level of the intervals and of the region; 0.95 when omitted"},
                 {"evaluations", integer({.lower = 1, .upper = 1e6}), "most variants; 200 when omitted"}});
}

Shape surrogate() {
  return object({{"type", choice({"chaos", "kriging"}), "polynomial chaos (when omitted) or Kriging"},
                 {"degree", integer({.lower = 1, .upper = 12}), "of the polynomials; 3 when omitted"},
                 {"held_back", quantity(Dimension::number, {.lower = 0.05, .upper = 0.5}),
                  "part of the variants that validates; 0.2 when omitted"}});
}

}  // namespace

const Shape& study_keys() {
  static const Shape shape = object(
      {{"$schema", any_text(), "for editors; ignored"},
       {"nurbeam_study", integer({.lower = 1, .upper = 1, .reason = "this version reads format 1"}),
        "version of the study-file format", required},
       {"name", any_text(), "title of the study; the file's name when omitted"},
       {"case", any_text(),
        "case file, relative to the study file; without it all quantities are expressions of the variables"},
       {"set", array(any_text()), "changes of the case for all variants, as --set has them", false, "case"},
       {"refine", array(refinement(), 1),
        "curves that get more control points, without a change of their shape", false, "case"},
       {"variables", array(variable(), 1), "what varies", required},
       {"constraints", array(any_text()),
        "expressions of the variables; a variant runs where all of them hold"},
       {"quantities", array(quantity_of_interest(), 1),
        "what is asked of each variant; needed but for \"calibrate\""},
       {"accuracy", boolean(),
        "true: beside each quantity NAME its error of mesh and step, NAME.error, from runs with other elements "
        "and steps; false when omitted",
        false, "case"},
       {"plan", plan(), "which variants run"},
       {"sensitivity", sensitivity(), "Sobol indices of the quantities"},
       {"reliability", reliability(), "the probability that a limit is passed"},
       {"optimise", optimum(), "the best values of the variables"},
       {"calibrate", calibration(),
        "the values of the variables at which histories are as they were measured: by least squares where all "
        "have ranges; where all are normally distributed, their distributions are known before",
        false, "case"},
       {"surrogate", surrogate(), "functions of the variables instead of runs, made of the plan's rows",
        false, "plan"},
       {"seed", integer({.lower = 0, .upper = 2147483647}), "of what is random; 1 when omitted"},
       {"time_limit", quantity(Dimension::time, plausible(1e-3, 1e9)),
        "of one variant, in wall time; a longer one fails; none when omitted"}},
      {{{"plan", "sensitivity", "reliability", "optimise", "calibrate"}, required}});
  return shape;
}

}  // namespace nurbeam
