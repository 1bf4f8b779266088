#include "pipelines/model/resolved_case.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/model/axis_selection.h"

namespace nurbeam {

namespace {

// Radii nearer to each other than this part of them are the same radius.
constexpr double same_radius = 1e-6;

// The beams that a name of the case stands for.
using BeamNames = std::map<std::string, std::vector<std::string>>;

// Where other curves meet the chosen ones.
void note_junctions(const std::string& where, const std::vector<Chain>& chains, const ImportReport& report,
                    double tolerance, Findings& findings) {
  std::set<int> chosen;
  for (const Chain& chain : chains) chosen.insert(chain.curves.begin(), chain.curves.end());
  for (const Junction& junction : junctions(report, tolerance)) {
    if (std::none_of(junction.curves.begin(), junction.curves.end(),
                     [&](int curve) { return chosen.contains(curve); }))
      continue;
    findings.add(Severity::note, where,
                 "curves " + list_of_curves(report, junction.curves) + " of " + report.file + " meet at " +
                     text_of(junction.point));
  }
}

// The chains of curves that the case chooses; one empty chain, with a diagnostic, where it cannot.
std::vector<Chain> chosen_chains(const CaseBeam& beam, const AxisFile& axis, CadFiles& files,
                                 Findings& findings) {
  const ImportReport& report = files.read(axis.path, findings);
  if (!report.ok()) return {{}};
  const AxisSelection selection = select_axis(axis, report);
  const std::string where = beam.path + ".axis";
  if (!selection.error.empty()) {
    findings.error(selection.key.empty() ? where : where + "." + selection.key, selection.error);
    return {{}};
  }
  constexpr double digits_of_a_file = 1e-10;  // of a length
  for (const Gap& gap : selection.gaps) {
    if (gap.width <= digits_of_a_file * length(report.curves[gap.curve_a].curve)) continue;
    findings.warn(where, "the gap of " + text_of(gap.width) + " m between curves " +
                             std::to_string(gap.curve_a + 1) + " and " + std::to_string(gap.curve_b + 1) +
                             " of " + report.file + " at " + text_of(gap.point) + " was closed");
  }
  note_junctions(where, selection.chains, report, gap_tolerance(report, axis.gap), findings);
  return selection.chains;
}

bool is_same_section(const ImportedCurve& a, const ImportedCurve& b) {
  const auto same = [](double x, double y) { return std::abs(x - y) <= same_radius * std::max(x, y); };
  return same(a.pipe_radius, b.pipe_radius) &&
         std::abs(a.bore_radius - b.bore_radius) <= same_radius * a.pipe_radius &&
         same(a.bar.area, b.bar.area) && same(a.bar.second_moments.x(), b.bar.second_moments.x());
}

std::string section_words(const ImportedCurve& curve) {
  if (const BarSection& bar = curve.bar; bar.area > 0)
    return "the width " + text_of(bar.width) + " m (height " + text_of(bar.height) + " m)";
  return "the radius " + text_of(curve.pipe_radius) + " m (bore " + text_of(curve.bore_radius) + " m)";
}

// Why the curve gives a beam no section; "" if it does.
std::string section_refusal(const ImportedCurve& curve) {
  if (!curve.is_centre_line())
    return " is a " + curve.entity + " and no centre line of a pipe; give \"radius\"";
  const BarSection& bar = curve.bar;
  if (std::abs(bar.second_moments.x() - bar.second_moments.y()) <= same_radius * bar.second_moments.x())
    return "";
  return " is the centre line of a hollow bar, " + text_of(bar.width) + " by " + text_of(bar.height) +
         " m, which bends otherwise about its width than about its height; give \"area\", which is " +
         text_of(bar.area) + " m^2, and \"second_moment\", which is " + text_of(bar.second_moments.x()) +
         " m^4 about the width and " + text_of(bar.second_moments.y()) +
         " about the height, or a \"profile\"";
}

// That of a square tube, which bends in all directions alike, or of a pipe.
CaseSection section_of(const ImportedCurve& curve, const std::optional<double>& torsion_constant) {
  if (curve.bar.area > 0)
    return {.area = curve.bar.area,
            .second_moment = curve.bar.second_moments.x(),
            .torsion_constant = torsion_constant};
  const double outer = curve.pipe_radius, inner = curve.bore_radius;
  return {.area = std::numbers::pi * (outer * outer - inner * inner),
          .second_moment = std::numbers::pi / 4 * (std::pow(outer, 4) - std::pow(inner, 4)),
          .radius = outer,
          .bore = inner,
          .torsion_constant = torsion_constant};
}

// The section of the pipe or hollow bar whose centre line the chain is.
CaseSection cad_section(const CaseBeam& beam, const Chain& chain, CadFiles& files, Findings& findings) {
  const auto* file = std::get_if<AxisFile>(&beam.axis.source);
  const std::string where = beam.path + ".section.from";
  if (!file) {
    findings.error(where, "\"cad\" needs an axis from a file; give \"radius\"");
    return {};
  }
  if (chain.curves.empty()) return {};
  const std::vector<ImportedCurve>& curves = files.read(file->path, findings).curves;
  const ImportedCurve& first = curves[chain.curves.front()];
  for (int i : chain.curves) {
    const ImportedCurve& curve = curves[i];
    if (const std::string refusal = section_refusal(curve); !refusal.empty())
      findings.error(
          where, "is \"cad\", but curve " + std::to_string(i + 1) + " of " + file->path.string() + refusal);
    else if (!is_same_section(first, curve))
      findings.error(where, std::string("the ") + (first.bar.area > 0 ? "bar" : "pipe") + " has " +
                                section_words(first) + " at curve " +
                                std::to_string(chain.curves.front() + 1) + " and " + section_words(curve) +
                                " at curve " + std::to_string(i + 1) +
                                "; a beam has one section: give \"radius\", or choose a part with \"curve\"");
  }
  return section_of(first, beam.section.torsion_constant);
}

// What is said of a beam made of a chain must not be said of another one, nor may a connector head a column
// of its name. `whole`: by the names of the beams made of chains that of the beam of the case.
void check_names_of_chains(const std::map<std::string, std::string>& whole, const CaseFile& case_file,
                           Findings& findings) {
  const auto check = [&](const std::string& name, const std::string& path) {
    const auto chain = whole.find(name);
    if (chain == whole.end()) return;
    findings.error(path + ".name",
                   "is " + in_quotes(name) + ", the name of a beam that " + in_quotes(chain->second) +
                       " becomes by \"chains\": \"all\"; names must differ: give another one");
  };
  for (const CaseBeam& beam : case_file.beams) check(beam.name, beam.path);
  for (const CaseConnector& connector : case_file.connectors) check(connector.name, connector.path);
}

// Whether the name stands for beams; else an error.
bool check_name(const std::string& name, const std::string& path, const BeamNames& names,
                const std::vector<CaseBeam>& beams, Findings& findings) {
  if (names.contains(name)) return true;
  std::vector<std::string> known;
  for (const CaseBeam& beam : beams) known.push_back(beam.name);
  findings.error(path + ".beam", "there is no beam " + in_quotes(name) + known_names(name, known));
  return false;
}

// What was said of a name is said of every beam that it stands for.
template <class Item>
void name_each_beam(std::vector<Item>& items, const BeamNames& names, const std::vector<CaseBeam>& beams,
                    Findings& findings) {
  std::vector<Item> each;
  for (const Item& item : items) {
    if (!check_name(item.beam, item.path, names, beams, findings)) continue;
    for (const std::string& name : names.at(item.beam)) {
      each.push_back(item);
      each.back().beam = name;
    }
  }
  items = std::move(each);
}

// Loads and supports of a name are those of every beam that it stands for; the rest needs one beam.
void name_beams(ResolvedCase& resolved, const BeamNames& names, Findings& findings) {
  name_each_beam(resolved.loads, names, resolved.beams, findings);
  name_each_beam(resolved.supports, names, resolved.beams, findings);
  // Of an item that is about one beam: what its `key` says of it, and which there are to choose of.
  const auto needs_one = [&](const std::string& name, const std::string& path, const char* key = ".beam",
                             const char* says = "is ", const char* choose = "choose one: ") {
    if (check_name(name, path, names, resolved.beams, findings) && names.at(name).size() > 1)
      findings.error(path + key, says + in_quotes(name) + ", which is several beams; " + choose +
                                     quoted_list(names.at(name)));
  };
  const auto each_needs_one = [&](const auto& items) {
    for (const auto& item : items) needs_one(item.beam, item.path);
  };
  each_needs_one(resolved.sliding_joints);
  each_needs_one(resolved.eyelets);
  each_needs_one(resolved.reels);
  each_needs_one(resolved.collectors);
  each_needs_one(resolved.stops);
  for (const CaseBeamJoint& joint : resolved.joints)
    for (const std::string& name : joint.beams)
      needs_one(name, joint.path, ".beams", "names ", "choose of: ");
  for (const auto& connectors : {resolved.connectors, resolved.rotational_connectors})
    for (const CaseConnector& connector : connectors)
      for (const CaseConnectorEnd& end : connector.ends)
        if (!end.beam.empty()) needs_one(end.beam, end.path);
  for (const CaseBodyJoint& joint : resolved.body_joints)
    if (!joint.between[1].beam.empty()) needs_one(joint.between[1].beam, joint.between[1].path);
  each_needs_one(resolved.probes);
  each_needs_one(resolved.clearances);
}

}  // namespace

ResolvedCase resolve_case(const CaseFile& case_file, CadFiles& files, Findings& findings) {
  ResolvedCase resolved{.gravity = case_file.gravity,
                        .air = case_file.air,
                        .field = case_file.field,
                        .bodies = case_file.bodies,
                        .loads = case_file.loads,
                        .supports = case_file.supports,
                        .sliding_joints = case_file.sliding_joints,
                        .eyelets = case_file.eyelets,
                        .reels = case_file.reels,
                        .stops = case_file.stops,
                        .joints = case_file.joints,
                        .body_joints = case_file.body_joints,
                        .body_loads = case_file.body_loads,
                        .connectors = {},
                        .collectors = case_file.collectors,
                        .probes = case_file.output.probes,
                        .clearances = case_file.output.clearances,
                        .laws = case_file.laws,
                        .accelerations = case_file.output.accelerations,
                        .analysis = case_file.analysis};
  for (const CaseConnector& connector : case_file.connectors)
    (connector.rotational ? resolved.rotational_connectors : resolved.connectors).push_back(connector);
  BeamNames names;
  std::map<std::string, std::string> whole;
  for (const CaseBeam& beam : case_file.beams) {
    const auto* file = std::get_if<AxisFile>(&beam.axis.source);
    const std::vector<Chain> chains =
        file ? chosen_chains(beam, *file, files, findings) : std::vector<Chain>{{}};
    for (std::size_t i = 0; i < chains.size(); ++i) {
      CaseBeam one = beam;
      if (file && file->all_chains) {
        one.name += " " + std::to_string(i + 1);
        names[beam.name].push_back(one.name);
        whole[one.name] = beam.name;
      }
      names[one.name] = {one.name};
      if (one.section.from_cad) {
        const bool flexible = one.section.flexible_bends;
        one.section = cad_section(one, chains[i], files, findings);
        one.section.flexible_bends = flexible;
      }
      resolved.beams.push_back(std::move(one));
      resolved.chains.push_back(chains[i]);
    }
  }
  if (!findings.has_errors()) check_names_of_chains(whole, case_file, findings);
  if (!findings.has_errors()) name_beams(resolved, names, findings);
  return resolved;
}

int ResolvedCase::beam_index(const std::string& name) const {
  const auto found =
      std::find_if(beams.begin(), beams.end(), [&](const CaseBeam& beam) { return beam.name == name; });
  return static_cast<int>(found - beams.begin());
}

int ResolvedCase::body_index(const std::string& name) const {
  const auto found =
      std::find_if(bodies.begin(), bodies.end(), [&](const CaseBody& body) { return body.name == name; });
  return static_cast<int>(found - bodies.begin());
}

int ResolvedCase::sliding_bodies(const std::string& name) const {
  const auto on_it = [&](const auto& rider) { return rider.beam == name; };
  return static_cast<int>(std::ranges::count_if(sliding_joints, on_it) +
                          std::ranges::count_if(eyelets, on_it));
}

}  // namespace nurbeam
