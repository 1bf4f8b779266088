#include "pipelines/study/study_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "nurbs/number_text.h"
#include "pipelines/case/case_check.h"
#include "pipelines/case/case_overrides.h"
#include "pipelines/case/case_schema.h"
#include "pipelines/case/case_values.h"
#include "pipelines/case/table_files.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/study/analysis.h"
#include "pipelines/study/study_keys.h"
#include "pipelines/study/study_parts.h"

namespace nurbeam {

namespace {

/// Reads what has been checked against the shape; what is wrong besides goes to the findings.
class StudyReader : StudyPartReader {
 public:
  using StudyPartReader::StudyPartReader;

  void read() {
    study_.name = text(json_, "name", study_.path.stem().string());
    const std::filesystem::path directory = std::filesystem::absolute(study_.path).parent_path();
    if (has(json_, "case")) study_.case_file = (directory / text(json_, "case")).lexically_normal();
    for_each_item(json_, "set", "", [&](const Json& change, const std::string& path) {
      study_.changes.push_back({change.get<std::string>(), path});
    });
    for_each_item(
        json_, "refine", "",
        [&](const Json& item, const std::string& path) {
          if (!has(item, "beam")) return;
          study_.refinements.push_back({.beam = text(item, "beam"),
                                        .path = path,
                                        .knots = numbers(item, "knots"),
                                        .parts = static_cast<int>(number(item, "parts", 1))});
        });
    for_each_item(json_, "variables", "",
                  [&](const Json& item, const std::string& path) { read_variable(item, path); });
    check_variable_names();
    for_each_item(
        json_, "constraints", "",
        [&](const Json& item, const std::string& path) {
          if (auto expression = parsed(item.get<std::string>(), path)) {
            check_formula(*expression, path);
            study_.constraints.push_back(std::move(*expression));
          }
        });
    for_each_item(json_, "quantities", "",
                  [&](const Json& item, const std::string& path) { read_quantity(item, path); });
    if (flag(json_, "accuracy")) add_errors();
    check_derived();
    read_study_task(json_, study_, findings_);
    check_formulas(study_, findings_);
    check_effects();
    study_.seed = static_cast<unsigned>(number(json_, "seed", 1));
    study_.time_limit = optional_number(json_, "time_limit");
  }

 private:
  // Beside each quantity its error.
  void add_errors() {
    const std::vector<StudyQuantity> quantities = study_.quantities;
    for (const StudyQuantity& quantity : quantities) {
      if (quantity.value.asks_for_errors()) continue;
      std::string name = quantity.name;
      study_.quantities.push_back({name + ".error", quantity.unit, quantity.path,
                                   Expression::parse("error(" + quantity.value.text() + ")")});
    }
  }
  void read_variable(const Json& json, const std::string& path) {
    StudyVariable variable{.name = text(json, "name"), .path = path};
    variable.target = read_target(json, path);
    if (variable.target && !json_.contains("case"))
      findings_.error(path, "changes a case, but the study has no \"case\"; name one");
    const Dimension dimension = variable.target ? dimension_of(variable, path) : dimension_of_use(variable);
    variable.unit = default_unit(dimension);
    if (has(json, "value")) variable.derived = parsed_or_zero(text(json, "value"), child(path, "value"));
    if (has(json, "range")) {
      variable.distribution.parameters = all_measured(json["range"], dimension, child(path, "range"));
      check_increasing(variable.distribution.parameters, child(path, "range"));
    }
    if (has(json, "distribution"))
      read_study_distribution(json_, json["distribution"], dimension, variable, study_, findings_);
    if (has(json, "nominal"))
      variable.nominal = measured(json["nominal"], dimension, child(path, "nominal")).value_or(0);
    else if (!variable.derived && !findings_.has_errors())
      variable.nominal = middle_of(variable.distribution);
    if (!variable.derived && !findings_.has_errors()) check_ends(variable, findings_);
    study_.variables.push_back(std::move(variable));
  }

  // Of a design variable that stands as a parameter of a distribution: that of what is so distributed.
  Dimension dimension_of_use(const StudyVariable& design) {
    for (const Json& item : part(json_, "variables")) {
      if (!item.is_object() || !has(item, "distribution")) continue;
      StudyVariable random;
      random.target = read_target(item, "");
      if (random.target && stands_alone_in(item["distribution"], design.name))
        return dimension_of(random, design.path);
    }
    return Dimension::number;
  }

  std::optional<StudyTarget> read_target(const Json& json, const std::string& path) {
    if (has(json, "path")) {
      CasePaths paths;
      if (json["path"].is_string())
        paths.paths.push_back(text(json, "path"));
      else
        for (const Json& each : json["path"])
          if (each.is_string()) paths.paths.push_back(each.get<std::string>());
      return paths;
    }
    if (has(json, "control_point")) {
      const Json& at = json["control_point"];
      return ControlPointCoordinate{text(at, "beam"), static_cast<int>(number(at, "index", 0)),
                                    static_cast<int>(std::string("xyz").find(text(at, "axis", "x")))};
    }
    if (has(json, "weight"))
      return ControlPointWeight{text(json["weight"], "beam"),
                                static_cast<int>(number(json["weight"], "index", 0))};
    if (has(json, "transform")) return read_transform(json["transform"], child(path, "transform"));
    return {};
  }

  CurveTransform read_transform(const Json& json, const std::string& path) {
    CurveTransform transform{.beam = text(json, "beam")};
    for_each_item(json, "points", path, [&](const Json& item, const std::string& where) {
      const int index = item.get<int>();
      if (std::find(transform.points.begin(), transform.points.end(), index) != transform.points.end())
        findings_.error(where, "is " + std::to_string(index) + " again; each control point moves once");
      transform.points.push_back(index);
    });
    std::string where;
    if (has(json, "translate")) {
      transform.direction = vector(json, "translate");
      where = child(path, "translate");
    } else if (has(json, "rotate")) {
      transform.kind = CurveTransform::Kind::rotate;
      transform.direction = vector(json["rotate"], "axis");
      transform.about = vector(json["rotate"], "about", Eigen::Vector3d::Zero());
      where = child(path, "rotate.axis");
    } else if (has(json, "place")) {
      transform.kind = CurveTransform::Kind::place;
      const std::size_t axis = std::string("xyz").find(text(json, "place", "x"));
      transform.direction = Eigen::Vector3d::Unit(static_cast<Eigen::Index>(std::min<std::size_t>(axis, 2)));
      return transform;
    } else {
      transform.kind = CurveTransform::Kind::scale;
      transform.about = vector(part(json, "scale"), "about", Eigen::Vector3d::Zero());
      return transform;
    }
    if (transform.direction.norm() > 0)
      transform.direction.normalize();
    else
      findings_.error(where, "is [0, 0, 0]; give a direction");
    return transform;
  }

  void check_variable_names() {
    std::set<std::string> seen;
    for (const StudyVariable& variable : study_.variables)
      if (!variable.name.empty() && !seen.insert(variable.name).second)
        findings_.error(child(variable.path, "name"),
                        in_quotes(variable.name) + " is the name of two variables; names must differ");
    for (const StudyVariable& variable : study_.variables) {
      if (variable.name == "pi")
        findings_.error(child(variable.path, "name"), "is that of 3.14159...; give another");
      if (variable.name.find('\'') != std::string::npos)
        findings_.error(child(variable.path, "name"),
                        "has a single quote, which cannot stand in an expression; leave it out");
    }
    for (const StudyVariable& variable : study_.variables) check_column(variable.name, variable.path);
    check_targets();
  }

  // What study.nc can have as the name of a variable, and study.csv as that of one more column.
  void check_column(const std::string& name, const std::string& path) {
    for (const std::string_view own : study_table_columns)
      if (name == own)
        findings_.error(child(path, "name"),
                        in_quotes(name) + " is a column that study.csv has already; give another");
    std::string fitting = name;
    std::replace(fitting.begin(), fitting.end(), '/', '-');
    while (!fitting.empty() && fitting.back() == ' ') fitting.pop_back();
    if (fitting != name)
      findings_.error(child(path, "name"),
                      in_quotes(name) +
                          " cannot head a column of study.nc: it must have no \"/\" and not "
                          "end with a space; " +
                          in_quotes(fitting) + " can");
  }

  // What two variables set has the value of one alone.
  void check_targets() {
    std::map<std::string, std::string> owners;
    for (const StudyVariable& variable : study_.variables) {
      std::vector<std::string> places;
      if (const auto* target = variable.target ? &*variable.target : nullptr) {
        if (const auto* numbers = std::get_if<CasePaths>(target))
          for (const std::string& path : numbers->paths) places.push_back(in_quotes(path));
        if (const auto* point = std::get_if<ControlPointCoordinate>(target))
          places.push_back(std::string(1, "xyz"[point->axis]) + " of control point " +
                           std::to_string(point->index) + " of " + in_quotes(point->beam));
        if (const auto* weight = std::get_if<ControlPointWeight>(target))
          places.push_back("the weight of control point " + std::to_string(weight->index) + " of " +
                           in_quotes(weight->beam));
      }
      for (const std::string& place : places)
        if (const auto [owner, is_first] = owners.emplace(place, variable.name); !is_first)
          findings_.error(variable.path,
                          "sets " + place + ", as " + in_quotes(owner->second) +
                              " does; one variable can set it, with a \"value\" made of others");
    }
  }

  // Warns of variables that change nothing.
  void check_effects() {
    std::set<std::string> named;
    const auto collect = [&](const Expression& expression) {
      for (std::string& name : expression.names()) named.insert(std::move(name));
    };
    for (const StudyVariable& variable : study_.variables) {
      if (variable.derived) collect(*variable.derived);
      for (const auto& formula : variable.distribution.formulas) collect(formula.value);
    }
    for (const Expression& constraint : study_.constraints) collect(constraint);
    for (const StudyQuantity& quantity : study_.quantities) collect(quantity.value);
    const auto collect_sides = [&](const StudyOptimum::Constraint& constraint) {
      collect(constraint.greater);
      collect(constraint.lesser);
    };
    if (const auto* optimum = std::get_if<StudyOptimum>(&study_.task)) {
      for (const StudyOptimum::Constraint& constraint : optimum->constraints) collect_sides(constraint);
      for (const auto& probability : optimum->probabilities) collect_sides(probability.fails);
    }
    for (const StudyVariable& variable : study_.variables)
      if (!variable.target && !variable.derived && !variable.name.empty() && !named.contains(variable.name))
        findings_.warn(variable.path,
                       in_quotes(variable.name) +
                           " changes nothing: it has no place in the case (\"path\", "
                           "\"control_point\", \"weight\", \"transform\"), and no expression names it");
  }

  // Of variables alone.
  void check_formula(const Expression& expression, const std::string& path) {
    if (check_names(expression, path, "variable", names_of(study_.variables))) check_number(expression, path);
  }

  // A derived variable is made of those that stand before it.
  void check_derived() {
    std::vector<std::string> before;
    for (const StudyVariable& variable : study_.variables) {
      const std::string path = child(variable.path, "value");
      if (variable.derived && check_names(*variable.derived, path, "earlier variable", before))
        check_number(*variable.derived, path);
      before.push_back(variable.name);
    }
    if (!study_.variables.empty() && study_.free_variables().empty())
      findings_.error("variables",
                      "all have a \"value\"; one at least needs a \"range\" or a \"distribution\"");
  }

  // A unit converts nothing, and columns have SI units: a number that is taken from one as it is has no
  // other.
  void check_unit(const Expression& value, const std::string& unit, const std::string& path) {
    const std::optional<double> size = in_si_units(unit);
    const bool is_scaled = value.text().find_first_of("*/") != std::string::npos;
    const bool has_columns = std::ranges::any_of(
        value.names(), [](const std::string& name) { return name.find('.') != std::string::npos; });
    if (!size || *size == 1 || is_scaled || !has_columns || unit == "deg") return;
    findings_.warn(child(path, "unit"),
                   "is " + in_quotes(unit) +
                       ", which is written beside the number and converts nothing; columns have "
                       "SI units: let \"value\" be \"" +
                       value.text() + " / " + text_of(*size) + "\", or leave the unit out");
  }

  void read_quantity(const Json& json, const std::string& path) {
    const std::string name = text(json, "name");
    for (const StudyVariable& variable : study_.variables)
      if (variable.name == name && !name.empty())
        findings_.error(child(path, "name"),
                        in_quotes(name) + " is the name of a variable; names must differ");
    check_column(name, path);
    for (const StudyQuantity& other : study_.quantities)
      if (other.name == name && !name.empty())
        findings_.error(child(path, "name"),
                        in_quotes(name) + " is the name of two quantities; names must differ");
    Expression value = has(json, "value") ? parsed_or_zero(text(json, "value"), child(path, "value"))
                                          : Expression::parse("0");
    if (!json_.contains("case")) check_formula(value, child(path, "value"));
    check_unit(value, text(json, "unit"), path);
    study_.quantities.push_back({name, text(json, "unit"), path, std::move(value)});
  }
};

}  // namespace

std::vector<std::size_t> StudyFile::free_variables() const {
  std::vector<std::size_t> free;
  for (std::size_t i = 0; i < variables.size(); ++i)
    if (!variables[i].derived) free.push_back(i);
  return free;
}

std::vector<double> StudyFile::nominal() const {
  std::vector<double> values;
  for (const std::size_t i : free_variables()) values.push_back(variables[i].nominal);
  return values;
}

bool StudyFile::has_random_design() const {
  const auto* optimum = std::get_if<StudyOptimum>(&task);
  return optimum && !optimum->probabilities.empty();
}

StudyFileReport read_study_file(const std::filesystem::path& file) {
  Findings findings(file.string());
  auto json = read_json(file, study_file_kind, findings);
  if (!json) return {{}, findings.take()};
  StudyFile study;
  study.path = file;
  put_in_tables(study_keys(), *json, "", std::filesystem::absolute(file).parent_path(), findings);
  if (check_shape(study_keys(), *json, findings)) {
    study.json = json->dump(-1, ' ', false, Json::error_handler_t::replace);
    StudyReader(*json, study, findings).read();
  }
  StudyFileReport report;
  (findings.has_errors() ? report.with_errors : report.value) = std::move(study);
  report.diagnostics = findings.take();
  return report;
}

std::string study_file_schema() { return schema_text(study_keys(), "nurbeam study file"); }

}  // namespace nurbeam
