#include "pipelines/case/case_references.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "nurbs/number_text.h"
#include "pipelines/case/case_collector.h"
#include "pipelines/case/case_connector.h"
#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

namespace {

using Kind = Shape::Kind;

/// Reports names that occur twice. An empty name has been reported.
void check_unique(const std::vector<std::pair<std::string, std::string>>& names_and_paths,
                  Findings& findings) {
  std::map<std::string, std::string> first;
  for (const auto& [name, path] : names_and_paths) {
    const auto [other, is_new] = first.emplace(name, path);
    if (!is_new && !name.empty()) {
      findings.error(path,
                     in_quotes(name) + " is already the name of " + other->second + "; names must differ");
    }
  }
}

void check_names(const Json& json, Findings& findings) {
  const auto collect = [](const Json& holder, const char* key, const std::string& path) {
    std::vector<std::pair<std::string, std::string>> names;
    for_each_item(holder, key, path, [&](const Json& item, const std::string& item_path) {
      names.emplace_back(text(item, "name"), child(item_path, "name"));
    });
    return names;
  };
  const auto beams = collect(json, "beams", "");
  check_unique(beams, findings);
  auto columns = collect(json, "bodies", "");  // these head columns of the same table
  const auto probes = collect(part(json, "output"), "probes", "output"),
             clearances = collect(part(json, "output"), "clearances", "output");
  const auto supports = collect(json, "supports", ""), joints = collect(json, "joints", "");
  const auto connectors = collect(json, "connectors", ""), eyelets = collect(json, "eyelets", ""),
             reels = collect(json, "reels", ""), collectors = collect(json, "collectors", "");
  for (const auto& more : {probes, clearances, supports, joints, connectors, eyelets, reels, collectors})
    columns.insert(columns.end(), more.begin(), more.end());
  check_unique(columns, findings);
  // The columns of a vector belong to the body: "B.joint_force.x".
  for (const auto& [body, body_path] : collect(json, "bodies", ""))
    for (const auto& [name, path] : columns)
      if (name == body + ".joint_force")
        findings.error(path, in_quotes(name) + " heads the columns of the joint's force on the body " +
                                 in_quotes(body) + ", of " + body_path + "; give another name");
  // Both have a length in that table.
  for (const auto& [name, path] : connectors)
    for (const auto& [of_beam, beam_path] : beams)
      if (!name.empty() && name == of_beam) check_unique({{of_beam, beam_path}, {name, path}}, findings);
}

/// The names of the items under the key; nothing when one of them is unusable.
std::optional<std::vector<std::string>> names_under(const Json& json, const char* key) {
  std::vector<std::string> names;
  if (json.contains(key) && json[key].is_null()) return {};
  for (const Json& item : part(json, key)) {
    names.push_back(item.is_null() ? "" : text(item, "name"));
    if (names.back().empty()) return {};
  }
  return names;
}

/// The names of the bodies and, as "body.point", of the points of rigid ones.
std::optional<std::vector<std::string>> bodies_and_points(const Json& json) {
  std::optional<std::vector<std::string>> names = names_under(json, "bodies");
  if (!names) return names;
  for (const Json& body : part(json, "bodies"))
    for (const auto& [point, place] : part(body, "points").items())
      names->push_back(text(body, "name") + "." + point);
  return names;
}

bool is_one_of(const std::string& name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Whether it is "net 3", where the beam "net" takes every chain of its file: how many there are, the file
/// will tell.
bool is_beam_of_chain(const std::string& name, const Json& json) {
  const std::size_t space = name.rfind(' ');
  if (space == std::string::npos || name.find_first_not_of("0123456789", space + 1) != std::string::npos)
    return false;
  bool found = false;
  for_each_item(json, "beams", "", [&](const Json& beam, const std::string&) {
    found = found || (text(beam, "name") == name.substr(0, space) && has(part(beam, "axis"), "chains"));
  });
  return found;
}

/// Reports, for every item under the key, a name under `reference` that is not among the known ones.
void check_references(const Json& json, const Json& holder, const char* key, const std::string& path,
                      const char* reference, const std::vector<std::string>& known, Findings& findings) {
  for_each_item(
      holder, key, path,
      [&](const Json& item, const std::string& item_path) {
        const std::string name = text(item, reference);
        if (!name.empty() && !is_one_of(name, known) && !is_beam_of_chain(name, json))
          findings.error(child(item_path, reference), "there is no " + std::string(reference) + " " +
                                                          in_quotes(name) + known_names(name, known));
      });
}

/// The same of both ends of every connector, and of what joints join to bodies.
void check_ends(const Json& json, const char* reference, const std::vector<std::string>& known,
                Findings& findings) {
  const auto check = [&](const Json& end, const std::string& path) {
    const std::string name = text(end, reference);
    if (!name.empty() && !is_one_of(name, known) && !is_beam_of_chain(name, json))
      findings.error(child(path, reference), "there is no " + std::string(reference) + " " + in_quotes(name) +
                                                 known_names(name, known));
  };
  for_each_item(
      json, "connectors", "",
      [&](const Json& connector, const std::string& path) {
        for (const char* end : {"from", "to"}) check(part(connector, end), child(path, end));
      });
  for_each_item(json, "joints", "", [&](const Json& joint, const std::string& path) {
    for_each_item(joint, "between", path, check);
  });
}

void check_references(const Json& json, Findings& findings) {
  if (const auto beams = names_under(json, "beams")) {
    check_references(json, json, "loads", "", "beam", *beams, findings);
    check_references(json, json, "supports", "", "beam", *beams, findings);
    check_references(json, json, "sliding_joints", "", "beam", *beams, findings);
    for (const char* key : {"eyelets", "reels", "collectors"})
      check_references(json, json, key, "", "beam", *beams, findings);
    for_each_item(json, "bodies", "", [&](const Json& body, const std::string& path) {
      for (const char* key : {"fastened", "fixed_to"}) {
        const std::string name = text(part(body, key), "beam");
        if (!name.empty() && !is_one_of(name, *beams) && !is_beam_of_chain(name, json))
          findings.error(child(child(path, key), "beam"),
                         "there is no beam " + in_quotes(name) + known_names(name, *beams));
      }
    });
    check_references(json, json, "stops", "", "beam", *beams, findings);
    for (const char* key : {"probes", "clearances"})
      check_references(json, part(json, "output"), key, "output", "beam", *beams, findings);
    check_ends(json, "beam", *beams, findings);
    for_each_item(json, "joints", "", [&](const Json& joint, const std::string& path) {
      for_each_item(joint, "beams", path, [&](const Json& name, const std::string& name_path) {
        if (!is_one_of(name, *beams) && !is_beam_of_chain(name, json))
          findings.error(name_path, "there is no beam " + in_quotes(name.get<std::string>()) +
                                        known_names(name.get<std::string>(), *beams));
      });
    });
  }
  if (const auto bodies = bodies_and_points(json)) {
    check_references(json, json, "sliding_joints", "", "body", *bodies, findings);
    for (const char* key : {"eyelets", "reels"})
      for_each_item(json, key, "", [&](const Json& carried, const std::string& path) {
        const std::string name = text(carried, "on");
        if (!name.empty() && !is_one_of(name, *bodies))
          findings.error(child(path, "on"),
                         "there is no body " + in_quotes(name) + known_names(name, *bodies));
      });
    check_ends(json, "body", *bodies, findings);
    for (const char* key : {"loads", "supports"})
      check_references(json, json, key, "", "body", *bodies, findings);
    check_references(json, part(json, "output"), "probes", "output", "body", *bodies, findings);
    for_each_item(json, "stops", "", [&](const Json& stop, const std::string& path) {
      for_each_item(stop, "bodies", path, [&](const Json& name, const std::string& name_path) {
        if (!is_one_of(name, *bodies))
          findings.error(name_path, "there is no body " + in_quotes(name.get<std::string>()) +
                                        known_names(name.get<std::string>(), *bodies));
      });
    });
  }
}

/// Reports a division of the end time into more parts than `most`.
void check_division(const char* path, const char* parts, const std::optional<double>& part,
                    const CaseAnalysis& analysis, double most, Findings& findings) {
  if (part && analysis.end_time / *part > most * (1 + 1e-9)) {
    findings.error(path, "is " + text_of(*part, all_digits) +
                             " s: " + text_of(std::ceil(analysis.end_time / *part), all_digits) + " " +
                             parts + " until analysis.end_time, " + text_of(analysis.end_time, all_digits) +
                             " s, and the limit is " + text_of(most, all_digits) + "; give at least " +
                             text_of(analysis.end_time / most, all_digits) + " s");
  }
}

void check_times(const Json& json, const CaseFile& c, Findings& findings) {
  const bool dynamic = c.analysis.type == CaseAnalysis::Type::dynamic;
  if (dynamic && has(json, "analysis") && !json["analysis"].contains("end_time")) {
    findings.error("analysis",
                   "\"end_time\" is missing; a dynamic analysis needs it (or \"type\": \"static\")");
    return;
  }
  check_division("output.every", "stored frames", c.output.every, c.analysis, most_frames, findings);
  check_division("output.histories_every", "rows of histories", c.output.histories_every, c.analysis,
                 most_steps, findings);
  check_division("analysis.step", "steps", c.analysis.step, c.analysis, most_steps, findings);
  const bool has_end = c.analysis.end_time > 0;  // else it is said what is wrong with it
  if (dynamic && has_end && c.analysis.step && *c.analysis.step > c.analysis.end_time)
    findings.warn("analysis.step", "is " + text_of(*c.analysis.step, all_digits) +
                                       " s, longer than the motion, which ends at analysis.end_time, " +
                                       text_of(c.analysis.end_time, all_digits) +
                                       " s: one step would be all of it; a hundredth of the motion, " +
                                       text_of(c.analysis.end_time / 100, all_digits) + " s, shows more");
  for (std::size_t i = 0; dynamic && has_end && i < c.output.cad_times.size(); ++i) {
    if (c.output.cad_times[i] > c.analysis.end_time) {
      findings.error(child("output.cad.times", i), "is " + text_of(c.output.cad_times[i], all_digits) +
                                                       " s; must not be after analysis.end_time, " +
                                                       text_of(c.analysis.end_time, all_digits) + " s");
    }
  }
}

std::string list_of(const std::vector<double>& numbers) {
  std::string list;
  for (const double number : numbers) list += (list.empty() ? "" : ", ") + text_of(number, all_digits);
  return list;
}

/// Reports CAD files of load steps that there are not. Without load steps there is one state, of any time.
void check_cad_factors(const CaseFile& c, Findings& findings) {
  const std::vector<double>& factors = c.analysis.load_factors;
  if (factors.empty()) return;
  constexpr std::size_t most_named = 12;
  const auto alternatives = [&](double t) {
    if (factors.size() <= most_named) return "one of these: " + list_of(factors);
    const double nearest =
        *std::ranges::min_element(factors, {}, [t](double factor) { return std::abs(factor - t); });
    return "one of these, of which the nearest is " + text_of(nearest, all_digits);
  };
  for (std::size_t i = 0; i < c.output.cad_times.size(); ++i) {
    const double t = c.output.cad_times[i];
    if (std::ranges::none_of(factors, [&](double factor) { return c.analysis.is_same_time(factor, t); }))
      findings.error(child("output.cad.times", i), "is " + text_of(t, all_digits) +
                                                       ", which is no factor of analysis.load_steps; give " +
                                                       alternatives(t));
  }
}

/// Buckling takes the stiffness of strains for constant.
void check_laws_of_buckling(const CaseFile& c, Findings& findings) {
  const auto refuse = [&](const std::string& path) {
    findings.error(
        path,
        "is a law whose stiffness changes with the strain, and \"buckling\" takes it for constant; "
        "use \"green\" or a number, or a \"static\" analysis with \"load_steps\"");
  };
  for (const CaseBeam& beam : c.beams)
    if (beam.material.law && !std::holds_alternative<GreenLaw>(*beam.material.law))
      refuse(beam.path + ".material.law");
  for (const CaseConnector& connector : c.connectors)
    if (connector.rows) refuse(connector.path + ".stiffness");
}

/// Speeds are of something that turns.
void check_speeds(const CaseFile& c, Findings& findings) {
  const std::vector<double>& speeds = c.analysis.modes.speeds;
  if (speeds.empty()) return;
  const char* key = "analysis.modes.speeds";
  constexpr int digits = 7;
  for (std::size_t i = 0; i + 1 < speeds.size(); ++i)
    if (!(speeds[i] < speeds[i + 1]))
      findings.error(child(key, i + 1), "is " + text_of(speeds[i + 1], digits) + " after " +
                                            text_of(speeds[i], digits) + "; speeds must increase");
  if (c.analysis.type == CaseAnalysis::Type::buckling)
    findings.error(key, "is of natural frequencies; leave it out, or give the type \"modes\"");
  std::vector<const CaseBody*> rotors;
  for (const CaseBody& body : c.bodies)
    if (body.rotor.inertia > 0) rotors.push_back(&body);
  if (rotors.size() > 1 && rotors.front()->rotor.speed == 0)
    findings.error(child(rotors.front()->path, "rotor.speed"),
                   "is 0, and the other rotors turn at their ratio to it under \"modes\": \"speeds\"; give "
                   "speeds in that ratio");
  if (rotors.empty() && !(c.field && !c.field->rate.isZero(0)))
    findings.error(key,
                   "has nothing that turns; give a rigid body a \"rotor\", or the case a \"frame\" "
                   "with a \"rate\"");
}

/// Small vibrations and buckling want loads with an energy; buckling wants loads.
void check_modes(const CaseFile& c, Findings& findings) {
  if (!c.analysis.has_modes()) return;
  check_speeds(c, findings);
  const bool buckling = c.analysis.type == CaseAnalysis::Type::buckling;
  if (buckling && c.loads.empty())
    findings.error(
        "analysis.type",
        "is \"buckling\", but there are no \"loads\", whose factors it computes; gravity is none of "
        "them");
  if (buckling) check_laws_of_buckling(c, findings);
  if (!buckling && !c.analysis.modes.about_equilibrium) return;
  for (const CaseLoad& load : c.loads)
    if (load.follower)
      findings.error(
          child(load.path, "follower"),
          "is true: a load that follows the section has no energy, and without one there are neither "
          "natural frequencies nor buckling factors; use a load that is fixed in space");
}

void check_solids(const CaseFile& c, Findings& findings) {
  const std::vector<std::string>& formats = c.output.cad_formats;
  const auto solid = std::find(formats.begin(), formats.end(), "step-solid");
  if (solid == formats.end()) return;
  for (const CaseBeam& beam : c.beams)
    if (!beam.rigid && !beam.section.radius && !beam.section.from_cad &&
        !(beam.section.profile && (beam.torsion || beam.torsion_by_drawing)))
      findings.error(child("output.cad.formats", solid - formats.begin()),
                     "is \"step-solid\", but the section of the beam " + in_quotes(beam.name) +
                         " has no radius, nor a profile and torsion that orients it; give it one, or use "
                         "\"step\" for the curve");
}

/// Warns of what is said of a motion where there is none. Elements change their lengths in statics too.
void check_keys_of_motions(const Json& json, const CaseAnalysis& analysis, Findings& findings) {
  if (analysis.type == CaseAnalysis::Type::dynamic) return;
  if (has(part(json, "output"), "histories_every"))
    findings.warn("output.histories_every", "is of a motion, which this is not: it has no effect");
  const std::string here = analysis.has_modes() ? "on modes and buckling" : "in a static analysis";
  for (const char* key : {"end_time", "step", "tolerance", "initial", "integrator"})
    if (has(part(json, "analysis"), key)) findings.warn(child("analysis", key), "has no effect " + here);
  for_each_item(json, "beams", "", [&](const Json& beam, const std::string& path) {
    if (has(part(beam, "initial"), "velocity"))
      findings.warn(child(path, "initial.velocity"), "is of the start of a motion: nothing moves " + here);
    if (text(part(beam, "elements"), "over") == "motion")
      findings.warn(child(path, "elements.over"),
                    "is of a motion: the tolerance is that of the state " + here);
  });
}

/// Warns of what is said and changes nothing.
void check_effects(const Json& json, const CaseFile& c, Findings& findings) {
  check_keys_of_motions(json, c.analysis, findings);
  if (has(json, "air") &&
      std::none_of(c.bodies.begin(), c.bodies.end(), [](const CaseBody& body) { return body.drag_area > 0; }))
    findings.warn("air", "has no effect: it drags bodies by their \"drag_area\" alone, and none has one");
  const Json& cad = part(part(json, "output"), "cad");
  if (cad.is_object() && part(cad, "times").is_array() && cad["times"].empty())
    findings.warn("output.cad.times",
                  "is empty: no CAD file is written; leave it out for one of the last state, or say \"all\"");
  const auto is_step = [](const std::string& format) {
    return format.starts_with("step") && format != "step-source";
  };
  if (cad.is_object() && cad.contains("schema") && std::ranges::none_of(c.output.cad_formats, is_step))
    findings.warn("output.cad.schema",
                  "has no effect: it is of new STEP files, and \"formats\" has none of these");
  for (const CaseSupport& support : c.supports) {
    const auto is_along = [&](const DisplacementTable::Row& row) {
      constexpr double round_off = 1e-12;
      const Eigen::Vector3d& moved = row.second;
      return moved.cross(support.direction->stableNormalized()).norm() <= round_off * moved.norm();
    };
    if (support.direction && !support.motion.empty() &&
        std::all_of(support.motion.begin(), support.motion.end(), is_along))
      findings.warn(
          child(support.path, "motion"),
          "has no effect: it is along \"direction\", where the support is free; to push there, give "
          "a \"force\", or pin it");
  }
}

void check_brep(const CaseFile& c, Findings& findings) {
  const std::vector<std::string>& formats = c.output.cad_formats;
  if (std::find(formats.begin(), formats.end(), "brep") != formats.end() && c.output.cad_unit != "mm")
    findings.error("output.cad.unit", "is " + in_quotes(c.output.cad_unit) +
                                          ", but \"brep\" declares no length unit and is read in "
                                          "millimetres; use \"mm\", or another format");
}

}  // namespace

void check_across(const Json& json, const CaseFile& case_file, Findings& findings) {
  const bool none = !json.contains("beams") || (json["beams"].is_array() && json["beams"].empty());
  if (none &&
      std::ranges::none_of(case_file.bodies, [](const CaseBody& body) { return body.inertia.has_value(); }))
    findings.error("",
                   "\"beams\" is missing (the beams), and there are no rigid bodies, which move without one");
  check_names(json, findings);
  check_references(json, findings);
  check_connectors(case_file, findings);
  check_collectors(case_file, findings);
  check_times(json, case_file, findings);
  check_cad_factors(case_file, findings);
  check_modes(case_file, findings);
  if (!findings.has_errors()) check_solids(case_file, findings);
  check_effects(json, case_file, findings);
  check_brep(case_file, findings);
}

}  // namespace nurbeam
