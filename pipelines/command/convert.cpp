#include "pipelines/command/convert.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <ostream>
#include <set>
#include <stdexcept>
#include <utility>

#include "cad_import/export_curves.h"
#include "nurbs/curve_chain.h"
#include "nurbs/joined_curve.h"
#include "nurbs/number_text.h"
#include "nurbs/smooth/smooth_nurbs.h"
#include "nurbs/split_curve.h"
#include "pipelines/diagnostics/exit_code.h"
#include "pipelines/diagnostics/print_diagnostics.h"
#include "pipelines/diagnostics/reading_progress.h"
#include "pipelines/model/axis_selection.h"

namespace nurbeam {

namespace {

/// The curves under way, and what is said about them.
struct CurvesUnderWay {
  std::vector<NamedCurve> curves;
  std::vector<Diagnostic> diagnostics = {};

  void say(Severity severity, const std::string& where, const std::string& message) {
    diagnostics.push_back({severity, where, message});
  }
};

// ---------------------------------------------------------------------------------------------------------
// choice

std::optional<int> number_of(const std::string& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// The curves of that name, else the one of that number.
std::vector<int> curves_named(const std::string& text, const ImportReport& report) {
  std::vector<int> found;
  const int count = static_cast<int>(report.curves.size());
  for (int i = 0; i < count; ++i)
    if (report.curves[i].name == text) found.push_back(i);
  if (!found.empty()) return found;
  if (const auto number = number_of(text); number && *number >= 1 && *number <= count) return {*number - 1};
  std::vector<int> all;
  for (int i = 0; i < count; ++i) all.push_back(i);
  throw std::invalid_argument("--curve: there is no curve \"" + text + "\" in " + report.file +
                              "; its curves (number and name): " + list_of_curves(report, all));
}

std::vector<int> chosen(const Conversion& conversion, const ImportReport& report, CurvesUnderWay& way) {
  std::set<int> indices;
  for (const std::string& text : conversion.curves)
    for (const int i : curves_named(text, report)) indices.insert(i);
  if (!conversion.curves.empty()) return {indices.begin(), indices.end()};
  std::vector<int> shown;
  for (int i = 0; i < static_cast<int>(report.curves.size()); ++i)
    if (!report.curves[i].hidden) shown.push_back(i);
  if (const std::size_t left = report.curves.size() - shown.size(); left > 0 && !shown.empty())
    way.say(Severity::note, report.file,
            std::to_string(left) + (left == 1 ? " hidden curve is" : " hidden curves are") +
                " left out; name " + (left == 1 ? "it" : "them") + " with --curve");
  if (shown.empty())
    throw std::invalid_argument(report.file + ": all its curves are hidden; name them with --curve");
  return shown;
}

/// A curve without a name goes by its layer, which is all that entities of DXF have.
std::string name_of(const ImportedCurve& curve) { return curve.name.empty() ? curve.layer : curve.name; }

// ---------------------------------------------------------------------------------------------------------
// what is done to them

std::vector<NurbsCurve> plain(const std::vector<NamedCurve>& named) {
  std::vector<NurbsCurve> curves;
  for (const NamedCurve& curve : named) curves.push_back(curve.curve);
  return curves;
}

double size_of(const NurbsCurve& curve) {
  const Eigen::Matrix3Xd points = curve.control_points().colwise().hnormalized();
  return (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
}

/// One curve, smooth where the chain is; exactly as it is where that is asked for, or its degree is above 3.
JoinedCurve joined(const std::vector<NurbsCurve>& curves, const Chain& chain, bool exact) {
  JoinedCurve whole = joined_curve(curves, chain);
  if (exact || whole.curve.degree() > 3) return whole;
  return {smooth_nurbs(join(curves, chain, 0), CurveParameter::free, 1e-12 * size_of(whole.curve)).curve,
          whole.gap};
}

void join_chains(const ImportReport& report, bool exact, CurvesUnderWay& way) {
  const std::vector<NurbsCurve> curves = plain(way.curves);
  std::vector<NamedCurve> chains;
  for (const Chain& chain : find_chains(curves, gap_tolerance(report, {}))) {
    const auto named = std::find_if(chain.curves.begin(), chain.curves.end(),
                                    [&](int i) { return !way.curves[i].name.empty(); });
    const NamedCurve& first = way.curves[named == chain.curves.end() ? chain.curves[0] : *named];
    if (chain.curves.size() == 1) {
      chains.push_back(way.curves[chain.curves[0]]);
      continue;
    }
    JoinedCurve whole = joined(curves, chain, exact);
    if (whole.gap > 1e-12 * size_of(whole.curve))
      way.say(exact ? Severity::error : Severity::note, report.file,
              "the widest gap between curves that are joined is " + text_of(whole.gap) + " m" +
                  (exact ? "; --exact does not close it" : "; both ends were moved midway"));
    chains.push_back({first.name, std::move(whole.curve), first.part, first.layer, first.colour});
  }
  way.curves = std::move(chains);
}

void split(const std::vector<double>& parameters, CurvesUnderWay& way) {
  std::vector<NamedCurve> pieces;
  for (const NamedCurve& named : way.curves) {
    const std::vector<NurbsCurve> parts = split_at(named.curve, parameters);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const std::string number = parts.size() > 1 ? std::to_string(i + 1) : "";
      const std::string space = named.name.empty() || number.empty() ? "" : " ";
      pieces.push_back({named.name + space + number, parts[i], named.part, named.layer, named.colour});
    }
  }
  if (pieces.size() == way.curves.size()) {
    const KnotVector& knots = way.curves[0].curve.knots();
    throw std::invalid_argument(
        "--split-at: no curve has one of these parameters inside; the first runs from " +
        text_of(knots.start(), 17) + " to " + text_of(knots.end(), 17));
  }
  way.curves = std::move(pieces);
}

// ---------------------------------------------------------------------------------------------------------
// what is lost

void check_exactness(const ImportReport& report, const std::vector<int>& indices, CurvesUnderWay& way) {
  for (const int i : indices)
    if (const ImportedCurve& curve = report.curves[i]; !curve.exact)
      way.say(Severity::error, report.file,
              "curve " + std::to_string(i + 1) + " (" + curve.entity + ") is no NURBS: it is read within " +
                  text_of(curve.deviation) + " m; --exact does not write it");
}

void check_format(CadFormat format, bool exact, const std::filesystem::path& to, CurvesUnderWay& way) {
  if (format != CadFormat::svg) return;
  const auto bent = std::count_if(way.curves.begin(), way.curves.end(), [](const NamedCurve& named) {
    return named.curve.is_rational() || named.curve.degree() > 3;
  });
  if (bent > 0)
    way.say(exact ? Severity::error : Severity::note, to.string(),
            std::to_string(bent) + " curve(s) with weights, or of a degree above 3, " +
                (exact ? "cannot be written to SVG exactly"
                       : "become cubics within 1e-6 of the size of the drawing"));
}

/// What a curve has that its format does not hold, as far as its name does not say the same.
struct Lost {
  bool name = false, layer = false, part = false, colour = false;
};

Lost lost_of(const NamedCurve& curve, CadFormat format) {
  const bool is_brep = format == CadFormat::brep, is_dxf = format == CadFormat::dxf;
  const bool has_layers = is_dxf || format == CadFormat::step || format == CadFormat::json ||
                          (format == CadFormat::iges && level_number(curve.layer) > 0);
  const bool has_parts = format == CadFormat::step || format == CadFormat::json;
  const bool other_layer = !curve.layer.empty() && curve.layer != curve.name;
  const bool other_part = !curve.part.empty() && curve.part.substr(curve.part.rfind('/') + 1) != curve.name;
  return {!curve.name.empty() && (is_brep || (is_dxf && other_layer)), other_layer && !has_layers,
          other_part && !has_parts, !curve.colour.empty() && is_brep};
}

/// In one line, how many names, layers, parts and colours are not written.
void tell_what_is_lost(CadFormat format, const std::filesystem::path& to, CurvesUnderWay& way) {
  std::string all;
  bool several = false;  // the last number
  for (const auto& [what, member] : {std::pair("names", &Lost::name), std::pair("layers", &Lost::layer),
                                     std::pair("parts", &Lost::part), std::pair("colours", &Lost::colour)}) {
    const auto number =
        std::count_if(way.curves.begin(), way.curves.end(),
                      [&, of = member](const NamedCurve& curve) { return lost_of(curve, format).*of; });
    if (number > 0) {
      all += (all.empty() ? "" : ", ") + std::string(what) + " of " + std::to_string(number);
      several = number > 1;
    }
  }
  if (!all.empty())
    way.say(Severity::note, to.string(),
            "is written without the " + all + (several ? " curves" : " curve") +
                ", which its format has no place for");
}

LengthUnit unit_of(const ImportReport& report, CadFormat format) {
  for (const LengthUnit unit : {LengthUnit::metre, LengthUnit::inch})
    if (format != CadFormat::brep && is_same_unit(report.unit_in_metres, metres_of(unit))) return unit;
  return LengthUnit::millimetre;
}

CurvesUnderWay converted(const ImportReport& report, CadFormat format, const std::filesystem::path& to,
                         const Conversion& conversion) {
  CurvesUnderWay way;
  const std::vector<int> indices = chosen(conversion, report, way);
  for (const int i : indices)
    way.curves.push_back({name_of(report.curves[i]), moved_curve(report.curves[i].curve, conversion.map),
                          report.curves[i].part, report.curves[i].layer, report.curves[i].colour});
  if (conversion.exact) check_exactness(report, indices, way);
  if (conversion.join) join_chains(report, conversion.exact, way);
  if (!conversion.split_at.empty()) split(conversion.split_at, way);
  check_format(format, conversion.exact, to, way);
  tell_what_is_lost(format, to, way);
  return way;
}

}  // namespace

int convert_file(const std::filesystem::path& in, const std::filesystem::path& to,
                 const Conversion& conversion, std::ostream& out, std::ostream& err) {
  const CadFormat format = written_format(to);
  const ImportReport report = read_with_progress(in, err);
  print_diagnostics(err, report.diagnostics);
  if (!report.ok()) return exit_bad_input;
  const CurvesUnderWay way = converted(report, format, to, conversion);
  print_diagnostics(err, way.diagnostics);
  if (has_errors(way.diagnostics)) return exit_bad_input;
  const LengthUnit unit = conversion.unit.value_or(unit_of(report, format));
  const std::vector<Diagnostic> problems = export_curves(to, way.curves, unit);
  print_diagnostics(err, problems);
  if (has_errors(problems)) return exit_not_written;
  out << to.string() << ": " << way.curves.size() << (way.curves.size() == 1 ? " curve" : " curves")
      << ", unit " << name_of(unit) << '\n';
  return exit_done;
}

}  // namespace nurbeam
