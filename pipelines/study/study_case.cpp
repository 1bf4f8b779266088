#include "pipelines/study/study_case.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "nurbs/knot_insertion.h"
#include "nurbs/number_text.h"
#include "nurbs/primitives.h"
#include "pipelines/case/case_json.h"
#include "pipelines/case/case_overrides.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/model/beam_axis.h"
#include "pipelines/model/cad_files.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

namespace {

// ---- The curves that are drawn ----

NurbsCurve curve_of_file(const CaseBeam& beam, const AxisFile& axis, const Chain& chain, CadFiles& files,
                         Findings& findings) {
  const ImportReport& report = files.read(axis.path, findings);
  if (chain.curves.size() == 1) {
    const NurbsCurve& curve = report.curves[chain.curves[0]].curve;
    return chain.reversed[0] ? curve.reversed() : curve;
  }
  std::vector<NurbsCurve> curves;
  for (const ImportedCurve& curve : report.curves) curves.push_back(curve.curve);
  return join(curves, chain, approximation_tolerance(beam, curves, chain)).to_nurbs();
}

NurbsCurve curve_of_cubics(std::vector<RationalCubic> cubics) {
  BezierPath path{.segments = std::move(cubics), .breaks = {}};
  path.breaks.resize(path.segments.size() + 1);
  std::iota(path.breaks.begin(), path.breaks.end(), 0.0);
  return path.to_nurbs();
}

NurbsCurve curve_through(const CaseAxis::Polyline& points) {
  std::vector<double> knots{0};
  for (std::size_t i = 0; i < points.size(); ++i) knots.push_back(static_cast<double>(i));
  knots.push_back(knots.back());
  Eigen::Matrix3Xd columns(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) columns.col(static_cast<Eigen::Index>(i)) = points[i];
  return make_nurbs_curve(KnotVector(1, knots), columns, Eigen::VectorXd::Ones(columns.cols()));
}

NurbsCurve drawn_curve(const CaseBeam& beam, const Chain& chain, CadFiles& files, Findings& findings) {
  return std::visit(
      [&](const auto& source) -> NurbsCurve {
        using Source = std::decay_t<decltype(source)>;
        if constexpr (std::is_same_v<Source, AxisFile>)
          return curve_of_file(beam, source, chain, files, findings);
        if constexpr (std::is_same_v<Source, NurbsCurve>) return source;
        if constexpr (std::is_same_v<Source, CaseAxis::Polyline>) return curve_through(source);
        if constexpr (std::is_same_v<Source, BentLines>) return curve_of_cubics(bent_line_cubics(source));
        if constexpr (std::is_same_v<Source, CaseAxis::Arc>)
          return curve_of_cubics(arc_cubics(source.center, source.start, source.end, source.normal));
      },
      beam.axis.source);
}

NurbsCurve refined(NurbsCurve curve, const StudyRefinement& refinement) {
  std::vector<double> knots = refinement.knots;
  const std::vector<double> breaks = curve.knots().breaks();
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
    for (int part = 1; part < refinement.parts; ++part)
      knots.push_back(breaks[i] + (breaks[i + 1] - breaks[i]) * part / refinement.parts);
  for (const double u : knots) curve = with_knot(curve, u);
  return curve;
}

// ---- What variables name ----

const std::string* beam_of(const StudyTarget& target) {
  return std::visit(
      [](const auto& t) -> const std::string* {
        if constexpr (
            requires { t.beam; })
          return &t.beam;
        else
          return nullptr;
      },
      target);
}

std::vector<std::string> keys_of(const std::map<std::string, StudyCurve>& curves) {
  std::vector<std::string> keys;
  for (const auto& [key, unused] : curves) keys.push_back(key);
  return keys;
}

std::vector<int> indices_of(const StudyTarget& target) {
  if (const auto* point = std::get_if<ControlPointCoordinate>(&target)) return {point->index};
  if (const auto* weight = std::get_if<ControlPointWeight>(&target)) return {weight->index};
  if (const auto* transform = std::get_if<CurveTransform>(&target)) return transform->points;
  return {};
}

// Whether it could be done.
bool refine(NurbsCurve& curve, const StudyRefinement& refinement, Findings& findings) {
  try {
    curve = refined(curve, refinement);
    return true;
  } catch (const std::invalid_argument& problem) {
    findings.error(refinement.path, problem.what());
    return false;
  }
}

// The curves that the variables name, by the names of their beams.
std::map<std::string, StudyCurve> curves_to_move(const StudyFile& study, const CaseFile& case_file,
                                                 CadFiles& files, Findings& findings) {
  std::map<std::string, StudyCurve> curves;
  std::set<std::string> miscounted;  // whose control points are others than the study means
  std::optional<ResolvedCase> resolved;
  for (const StudyVariable& variable : study.variables) {
    const std::string* name = variable.target ? beam_of(*variable.target) : nullptr;
    if (!name) continue;
    const auto beam = std::find_if(case_file.beams.begin(), case_file.beams.end(),
                                   [&](const CaseBeam& each) { return each.name == *name; });
    if (beam == case_file.beams.end()) {
      findings.error(variable.path, "the case has no beam " + in_quotes(*name) +
                                        known_names(*name, names_of(case_file.beams)));
      continue;
    }
    if (!curves.contains(*name)) {
      if (beam->section.from_cad) {
        findings.error(variable.path,
                       "the section of beam " + in_quotes(*name) +
                           " comes \"from\" its CAD file, which a moved curve has left; give its radius");
        continue;
      }
      if (!resolved) {
        Findings of_case(case_file.path.string());
        resolved = resolve_case(case_file, files, of_case);
        const bool wrong = of_case.has_errors();
        findings.append(of_case.take());
        if (wrong) return curves;
      }
      const auto found = std::find_if(resolved->beams.begin(), resolved->beams.end(),
                                      [&](const CaseBeam& each) { return each.name == *name; });
      if (found == resolved->beams.end()) {
        findings.error(variable.path,
                       "beam " + in_quotes(*name) +
                           " is several curves (\"chains\": \"all\"); name one of them by \"curve\"");
        continue;
      }
      const Chain& chain = resolved->chains[static_cast<std::size_t>(found - resolved->beams.begin())];
      NurbsCurve drawn = drawn_curve(*found, chain, files, findings);
      for (const StudyRefinement& refinement : study.refinements)
        if (refinement.beam == *name && !refine(drawn, refinement, findings)) miscounted.insert(*name);
      curves.emplace(*name,
                     StudyCurve{static_cast<std::size_t>(beam - case_file.beams.begin()), std::move(drawn)});
    }
    if (miscounted.contains(*name)) continue;
    const auto count = static_cast<int>(curves.at(*name).drawn.control_points().cols());
    for (const int index : indices_of(*variable.target))
      if (index >= count)
        findings.error(variable.path,
                       "the curve of beam " + in_quotes(*name) + " has " + std::to_string(count) +
                           " control points, counted from 0; there is no " + std::to_string(index));
  }
  for (const StudyRefinement& refinement : study.refinements)
    if (!curves.contains(refinement.beam))
      findings.error(refinement.path, "no variable moves the curve of beam " + in_quotes(refinement.beam) +
                                          known_names(refinement.beam, keys_of(curves)));
  return curves;
}

// ---- A variant ----

/// The control points of a curve, plain, and its weights, while variables move them.
struct MovedCurve {
  Eigen::Matrix3Xd points;
  Eigen::VectorXd weights;

  explicit MovedCurve(const NurbsCurve& curve)
      : points(curve.control_points().topRows<3>()), weights(curve.control_points().row(3)) {
    for (Eigen::Index i = 0; i < points.cols(); ++i) points.col(i) /= weights[i];
  }

  void apply(const ControlPointCoordinate& at, double value) { points(at.axis, at.index) = value; }
  void apply(const ControlPointWeight& at, double value) {
    if (!(value > 0))
      throw std::invalid_argument("a weight of " + text_of(value) + "; weights must be greater than 0");
    weights[at.index] = value;
  }
  void apply(const CurveTransform& transform, double value) {
    std::vector<int> indices = transform.points;
    if (indices.empty()) {
      indices.resize(static_cast<std::size_t>(points.cols()));
      std::iota(indices.begin(), indices.end(), 0);
    }
    if (transform.kind == CurveTransform::Kind::place) {
      const Eigen::Vector3d by =
          (value - transform.direction.dot(points.col(indices.front()))) * transform.direction;
      for (const int i : indices) points.col(i) += by;
      return;
    }
    for (const int i : indices) points.col(i) = moved(transform, value, points.col(i));
  }

 private:
  static Eigen::Vector3d moved(const CurveTransform& transform, double value, const Eigen::Vector3d& p) {
    switch (transform.kind) {
      case CurveTransform::Kind::translate:
        return p + value * transform.direction;
      case CurveTransform::Kind::rotate:
        return transform.about +
               Eigen::AngleAxisd(value * std::numbers::pi / 180, transform.direction) * (p - transform.about);
      case CurveTransform::Kind::scale:
        return transform.about + value * (p - transform.about);
      case CurveTransform::Kind::place:
        break;  // which depends on the first point
    }
    return p;
  }
};

NurbsCurve curve_of(const NurbsCurve& drawn, const MovedCurve& moved) {
  return make_nurbs_curve(drawn.knots(), moved.points, moved.weights);
}

Json inline_axis(const NurbsCurve& curve) {
  Json nurbs = {{"degree", curve.degree()}, {"knots", curve.knots().knots()}};
  const auto& [points, weights] = MovedCurve(curve);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    nurbs["control_points"].push_back({points(0, i), points(1, i), points(2, i)});
    nurbs["weights"].push_back(weights[i]);
  }
  return {{"nurbs", nurbs}};
}

/// Calls apply(target) for the target of a variable, if it has one; what is wrong then names the variable.
template <class Apply>
void with_target(const StudyVariable& variable, Apply apply) {
  if (!variable.target) return;
  try {
    std::visit(apply, *variable.target);
  } catch (const std::invalid_argument& problem) {
    throw std::invalid_argument("variable " + in_quotes(variable.name) + ": " + problem.what());
  }
}

// Adds the files that stand anywhere in a case: CAD files, tables.
void add_files_of(const Json& json, const std::filesystem::path& folder,
                  std::vector<std::filesystem::path>& files) {
  for (const auto& [key, value] : json.items()) {
    if (value.is_structured()) add_files_of(value, folder, files);
    if (key != "file" || !value.is_string()) continue;
    std::error_code none;
    if (const auto file = folder / value.get<std::string>(); std::filesystem::is_regular_file(file, none))
      files.push_back(file);
  }
}

/// A change of a study that has been made, and the path in the case whose value it has set.
struct MadeChange {
  StudyChange change;
  std::string path;
};

// Makes the changes that can be made; what is wrong with others goes to the findings.
std::vector<MadeChange> make_changes(const StudyFile& study, Json& json, Findings& findings) {
  std::vector<MadeChange> made;
  for (const StudyChange& change : study.changes)
    if (const AppliedOverride applied = apply_override(json, change.text); applied.problem.empty())
      made.push_back({change, applied.path});
    else
      findings.error(change.path, in_quotes(change.text) + ": " + applied.problem);
  return made;
}

// What is said of a value of the case is said of the change that has set it.
void name_changes(const StudyFile& study, const std::vector<MadeChange>& made,
                  std::vector<Diagnostic>& diagnostics) {
  const std::string of_case = study.case_file->string() + ": ";
  const auto is_of = [&](const Diagnostic& d, const MadeChange& change) {
    const std::string place = of_case + change.path;
    return d.where == place || d.where.starts_with(place + ".") || d.where.starts_with(place + "[");
  };
  for (Diagnostic& d : diagnostics) {
    const auto last =
        std::find_if(made.rbegin(), made.rend(), [&](const MadeChange& m) { return is_of(d, m); });
    if (last == made.rend()) continue;
    d.message = in_quotes(last->change.text) + ": " + d.where.substr(of_case.size()) + ": " + d.message;
    d.where = study.path.string() + ": " + last->change.path;
  }
}

// Changes that have set what is wrong cannot be made either.
std::vector<StudyChange> without_errors(const StudyFile& study, const std::vector<MadeChange>& made,
                                        const std::vector<Diagnostic>& diagnostics) {
  std::vector<StudyChange> sound;
  for (const auto& [change, path] : made) {
    const std::string place = study.path.string() + ": " + change.path;
    const bool wrong = std::any_of(diagnostics.begin(), diagnostics.end(), [&](const Diagnostic& d) {
      return d.severity == Severity::error && d.where == place;
    });
    if (!wrong) sound.push_back(change);
  }
  return sound;
}

std::vector<std::string> texts_of(const std::vector<MadeChange>& made) {
  std::vector<std::string> texts;
  for (const auto& [change, path] : made) texts.push_back(change.text);
  return texts;
}

// Whether a path leads into the axis of a beam, by its name or its index.
bool is_in_axis(const std::string& path, const std::string& beam, std::size_t index) {
  return path.starts_with("beams[" + beam + "].axis") ||
         path.starts_with("beams[" + std::to_string(index) + "].axis");
}

// Whether the numbers that variables set are there in this case (that no case has one is said elsewhere), and
// are not those of a curve that others move.
void check_paths(const StudyFile& study, const Json& case_json,
                 const std::map<std::string, StudyCurve>& curves, Findings& findings) {
  std::map<std::string, std::pair<std::string, std::string>>
      owners;  // by place: variable, and as it writes it
  for (const StudyVariable& variable : study.variables) {
    const auto* numbers = variable.target ? std::get_if<CasePaths>(&*variable.target) : nullptr;
    if (!numbers) continue;
    for (const std::string& path : numbers->paths) {
      Json json = case_json;
      const AppliedOverride applied = apply_override(json, path + "=1");
      if (!applied.problem.empty() && dimension_at(path).dimension)
        findings.error(variable.path + ".path", applied.problem);
      const std::string& place = applied.problem.empty() ? applied.path : path;
      const auto& [owner, written] = owners.try_emplace(place, variable.name, path).first->second;
      if (written != path)  // what is written alike has been found
        findings.error(variable.path + ".path",
                       in_quotes(path) + " is " + in_quotes(written) + ", which " + in_quotes(owner) +
                           " sets; one variable can set it, with a \"value\" made of others");
      for (const auto& [beam, curve] : curves)
        if (is_in_axis(place, beam, curve.beam))
          findings.error(variable.path + ".path",
                         "is of a curve that other variables move: move it with \"control_point\", "
                         "\"weight\" or \"transform\"");
    }
  }
}

}  // namespace

std::map<std::string, NurbsCurve> StudyCase::moved(const std::vector<StudyVariable>& variables,
                                                   const std::vector<double>& values) const {
  std::map<std::string, MovedCurve> moved;
  for (std::size_t i = 0; i < variables.size(); ++i)
    with_target(variables[i], [&](const auto& target) {
      if constexpr (requires { target.beam; })
        moved.try_emplace(target.beam, curves_.at(target.beam).drawn).first->second.apply(target, values[i]);
    });
  std::map<std::string, NurbsCurve> curves;
  for (const auto& [name, curve] : moved) curves.emplace(name, curve_of(curves_.at(name).drawn, curve));
  return curves;
}

StudyCase::StudyCase(const std::string& json, std::filesystem::path file,
                     std::map<std::string, StudyCurve> curves, std::vector<std::filesystem::path> inputs)
    : json_(std::make_shared<const Json>(Json::parse(json))),
      file_(std::move(file)),
      curves_(std::move(curves)),
      inputs_(std::move(inputs)) {}

std::string StudyCase::variant(const std::vector<StudyVariable>& variables,
                               const std::vector<double>& values) const {
  return json_of(variables, values).dump();
}

CaseFileReport StudyCase::read(const std::vector<StudyVariable>& variables,
                               const std::vector<double>& values) const {
  return read_case_json(json_of(variables, values), file_);
}

std::optional<CaseFile> StudyCase::reshaped(const CaseFile& read, const std::vector<double>& read_values,
                                            const std::vector<StudyVariable>& variables,
                                            const std::vector<double>& values) const {
  for (std::size_t i = 0; i < variables.size(); ++i)
    if (values[i] != read_values[i] && variables[i].target && !beam_of(*variables[i].target)) return {};
  CaseFile reshaped = read;
  for (const auto& [name, curve] : moved(variables, values))
    reshaped.beams[curves_.at(name).beam].axis.source = curve_of(curve, MovedCurve(curve));  // as it is read
  return reshaped;
}

Json StudyCase::json_of(const std::vector<StudyVariable>& variables,
                        const std::vector<double>& values) const {
  Json json = *json_;
  for (std::size_t i = 0; i < variables.size(); ++i)
    with_target(variables[i], [&](const auto& target) {
      if (!std::isfinite(values[i]))
        throw std::invalid_argument(text_of(values[i]) + " cannot stand in a case");
      if constexpr (requires { target.paths; }) {
        for (const std::string& path : target.paths)
          if (const std::string problem = apply_override(json, path + "=" + Json(values[i]).dump()).problem;
              !problem.empty())
            throw std::invalid_argument(problem);
      }
    });
  for (const auto& [name, curve] : moved(variables, values))
    json["beams"][curves_.at(name).beam]["axis"] = inline_axis(curve);
  return json;
}

StudyCaseReport read_study_case(const StudyFile& study) {
  StudyCaseReport report;
  const CaseTextReport text = case_text(*study.case_file);
  if (text.json.empty()) return {{}, text.diagnostics};
  Findings findings(study.path.string());
  Json json = Json::parse(text.json);
  const std::vector<MadeChange> made = make_changes(study, json, findings);
  const CaseFileReport read = read_case_file(*study.case_file, texts_of(made));
  report.diagnostics = read.diagnostics;
  name_changes(study, made, report.diagnostics);
  report.changes = without_errors(study, made, report.diagnostics);
  if (read.value && read.value->analysis.has_modes())
    findings.error("case",
                   "finds modes, of which there are no quantities; give one with \"analysis.type\": "
                   "\"dynamic\" or \"static\", or change it by \"set\"");
  std::map<std::string, StudyCurve> curves;
  CadFiles files;
  try {
    if (read.value) curves = curves_to_move(study, *read.value, files, findings);
  } catch (const std::invalid_argument& problem) {
    findings.error("variables", problem.what());
  }
  check_paths(study, json, curves, findings);
  const bool usable = read.value && !findings.has_errors();
  const std::vector<Diagnostic> found = findings.take();
  report.diagnostics.insert(report.diagnostics.end(), found.begin(), found.end());
  if (!usable) return report;
  std::vector<std::filesystem::path> inputs;
  add_files_of(json, std::filesystem::absolute(*study.case_file).parent_path(), inputs);
  report.value.emplace(json.dump(), *study.case_file, std::move(curves), std::move(inputs));
  return report;
}

}  // namespace nurbeam
