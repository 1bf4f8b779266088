#include "pipelines/run/model_notes.h"

#include <algorithm>
#include <cmath>

#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/run/moment_text.h"

namespace nurbeam {

void BeamsInRun::look_at(std::span<const ElementRecord> elements, int beam, double time) {
  beams_.resize(std::max(beams_.size(), static_cast<std::size_t>(beam) + 1));
  OfBeam& of = beams_[static_cast<std::size_t>(beam)];
  if (!elements.empty()) of.start = std::min(of.start, time);
  for (const ElementRecord& e : elements)
    for (int i = 0; i < 4; ++i) {
      if (time == of.start) of.least_force = std::min(of.least_force, e.axial_force[i]);
      const double stretch = std::sqrt(std::max(0.0, 1 + 2 * e.strain[i])) - 1;
      if (std::abs(stretch) <= std::abs(of.stretch)) continue;
      of.stretch = stretch;
      of.s = e.s_start + (e.s_end - e.s_start) * i / 3;
      of.time = time;
    }
}

std::vector<Diagnostic> law_notes(const CaseFile& case_file, const BeamModel& model,
                                  const BeamsInRun& beams) {
  constexpr double small = 0.02;
  std::vector<Diagnostic> notes;
  for (int b = 0; b < static_cast<int>(model.beams.size()); ++b) {
    const Beam& beam = model.beams[b];
    const BeamsInRun::OfBeam of = beams.of(b);
    const auto from = std::find_if(case_file.beams.begin(), case_file.beams.end(),
                                   [&](const CaseBeam& each) { return each.name == beam.name; });
    if (std::abs(of.stretch) < small || from == case_file.beams.end() || from->material.law) continue;
    const double EA = beam.properties.free_axial_stiffness(), e = of.stretch, L = 1 + e;
    const std::string moment = moment_text(case_file.analysis, of.time, 4);
    notes.push_back(
        {Severity::note, case_file.path.string(),
         "beam " + in_quotes(beam.name) + " is " + (e > 0 ? "stretched" : "shortened") + " by " +
             text_of(100 * std::abs(e), 3) + " % at s = " + text_of(of.s, 4) + " m" +
             (moment.empty() ? "" : ", " + moment) + ". Its axial force there is " +
             text_of(EA * L * (L * L - 1) / 2, 4) + " N by Green's law, which is the default, and " +
             text_of(EA * e, 4) +
             " N by Hooke's; choose one, or rows of force over stretch, as \"law\" in its \"material\""});
  }
  return notes;
}

std::vector<Diagnostic> undamped_notes(const CaseFile& case_file, const BeamModel& model,
                                       const BeamsInRun& beams) {
  constexpr double short_reach = 0.05;  // of the beam: bending resists a string no farther than there
  std::vector<Diagnostic> notes;
  if (case_file.analysis.type != CaseAnalysis::Type::dynamic) return notes;
  for (int b = 0; b < static_cast<int>(model.beams.size()); ++b) {
    const Beam& beam = model.beams[b];
    const double tension = beams.of(b).least_force;
    if (beam.rigid || beam.properties.is_damped() || !std::isfinite(tension) || !(tension > 0) ||
        !beam.properties.bends_within(short_reach * beam.curve.length(), tension))
      continue;
    notes.push_back(
        {Severity::note, case_file.path.string(),
         "beam " + in_quotes(beam.name) + " is taut at the start, with " + text_of(tension, 4) +
             " N or more, and has no damping: vibrations never end, and peaks of its force may be theirs; give its "
             "\"material\" a \"stiffness_damping\" or a \"mass_damping\""});
  }
  return notes;
}

std::vector<Diagnostic> loose_body_notes(const CaseFile& case_file, const BeamModel& model,
                                         const SimulationReport& run) {
  std::vector<Diagnostic> notes;
  for (const LooseBody& body : run.loose_bodies)
    if (const Rider& rider = model.riders[body.rider];
        rider.rest == StaticPlace::free_or_held && body.bound == 0)
      notes.push_back(
          {Severity::note, case_file.path.string(),
           "there is no rest near the drawing with beam " + in_quotes(model.beam_of(rider).name) +
               " free to run through " + in_quotes(model.body_of(rider).name) +
               ": the start holds it there, with " + text_of(std::abs(body.needed), 4) +
               " N along the beam, and lets it go as the motion starts, so that tensions jump; \"equilibrium\": "
               "\"held\" says so, and \"release\" lets it go later"});
    else
      notes.push_back(
          {Severity::note, case_file.path.string(),
           "the start equilibrium holds body " + in_quotes(model.body_of(model.riders[body.rider]).name) +
               " where it is drawn, with " + text_of(body.needed, 4) +
               " N along the beam, but its friction can hold " + text_of(body.bound, 4) +
               " N: it slides as the motion starts; \"equilibrium\": \"free\" starts it where friction can hold "
               "it"});
  return notes;
}

}  // namespace nurbeam
