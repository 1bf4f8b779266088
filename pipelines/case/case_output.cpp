#include "pipelines/case/case_output.h"

#include <algorithm>

namespace nurbeam {

Shape output_shape() {
  using namespace shapes;
  const Shape cad = object(
      {{"formats",
        array(choice({"step", "iges", "dxf", "brep", "step-solid", "step-section-lines", "step-source"}), 1),
        "file formats; step when omitted"},
       {"times", either(choice({"all"}), array(quantity(Dimension::time, not_negative()))),
        "times to write (of a static analysis its load factors), or all stored frames as a numbered sequence; the end time when omitted"},
       {"unit", choice({"mm", "m", "inch", "in"}), "length unit of the files; mm when omitted"},
       {"schema", choice({"ap214", "ap242"}), "application protocol of STEP files; ap214 when omitted"},
       {"parameter", choice({"free", "material"}),
        "parameter of the curves: free for the fewest control points, or reference arc length; free "
        "when omitted"}});
  return object(
      {{"every", quantity(Dimension::time, plausible(1e-12, 1e9)),
        "time between stored frames; a hundredth of `end_time` when omitted, but no less than `step`"},
       {"histories_every", either(choice({"step"}), quantity(Dimension::time, plausible(1e-12, 1e9))),
        "time between rows of histories, or a row at every step; those of stored frames alone when omitted, and "
        "every step with `collectors`"},
       {"cad", cad, "deformed axes as CAD files"},
       {"probes", short_array(probe_fields().shape()), "points whose motion is stored"},
       {"clearances", short_array(clearance_fields().shape()), "heights of beams over the ground"},
       {"accelerations", boolean(),
        "accelerations and load factors of point masses and probes too, as rigid bodies have them; false when "
        "omitted"},
       {"paraview", boolean(), "a series of ParaView files, frames.pvd; false when omitted"},
       {"report", boolean(), "report.html; true when omitted"}});
}

CaseOutput read_output(const Json& json, const CaseAnalysis& analysis, const std::filesystem::path& directory,
                       Findings& findings) {
  CaseOutput output;
  constexpr int default_frames = 100;
  if (analysis.type == CaseAnalysis::Type::dynamic)
    output.every =
        number(json, "every", std::max(analysis.end_time / default_frames, analysis.step.value_or(0)));
  if (has(json, "histories_every")) {
    const Json& every = json["histories_every"];
    output.histories_at_steps = every.is_string();
    if (every.is_number()) output.histories_every = every.get<double>();
  }
  if (has(json, "cad")) {
    const Json& cad = json["cad"];
    output.cad_formats = {"step"};
    output.cad_times = {analysis.end_time};
    output.cad_unit = text(cad, "unit", output.cad_unit);
    output.cad_schema =
        chosen<StepSchema>(cad, "schema", {{"ap214", StepSchema::ap214}, {"ap242", StepSchema::ap242}});
    output.cad_parameter = chosen<CurveParameter>(
        cad, "parameter", {{"free", CurveParameter::free}, {"material", CurveParameter::material}});
    if (has(cad, "formats")) {
      output.cad_formats.clear();
      for_each_item(cad, "formats", "", [&](const Json& format, const std::string&) {
        output.cad_formats.push_back(format.get<std::string>());
      });
    }
    if (has(cad, "times") && cad["times"].is_string()) {
      output.cad_at_all_times = true;
      output.cad_times.clear();
    } else if (has(cad, "times")) {
      output.cad_times = numbers(cad, "times");
    }
  }
  for_each_item(json, "probes", "output", [&](const Json& probe, const std::string& path) {
    CaseProbe& added = output.probes.emplace_back();
    added.path = path;
    if (has(probe, "beam") && !probe.contains("at")) findings.error(path, "\"at\" is missing (where)");
    probe_fields().read(probe, path, added, findings);
  });
  for_each_item(json, "clearances", "output", [&](const Json& clearance, const std::string& path) {
    CaseClearance& added = output.clearances.emplace_back();
    added.path = path;
    clearance_fields(directory).read(clearance, path, added, findings);
  });
  output.accelerations = flag(json, "accelerations");
  output.paraview = flag(json, "paraview");
  output.report = !has(json, "report") || flag(json, "report");
  return output;
}

}  // namespace nurbeam
