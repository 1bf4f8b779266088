#include "pipelines/model/measures.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <variant>

#include "pipelines/model/axis_selection.h"
#include "pipelines/model/beam_axis.h"
#include "pipelines/model/is_straight.h"

namespace nurbeam {

namespace {

template <class Holder>
bool is_held_by(const BeamModel& model, const Rider& rider) {
  return std::ranges::any_of(
      model.constraints,
      [&](const Constraint& each) {
        const auto* holder = std::get_if<Holder>(&each);
        return holder && holder->body == rider.body;
      });
}
bool is_ring_in_space(const BeamModel& model, const Rider& rider) {
  return is_held_by<HeldBody>(model, rider);
}

// Where supports and eyelets hold a beam, in order.
std::vector<PartEnd> held_places(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams, int b,
                                 const BeamModel& model, Findings& findings) {
  std::vector<PartEnd> places;
  for (const CaseSupport& support : resolved.supports)
    if (resolved.beam_index(support.beam) == b)
      places.push_back(
          {beams[b].material_coordinate(place_on(beams[b], support.at, support.path, findings))});
  for (int j = 0; j < static_cast<int>(model.riders.size()); ++j)
    if (model.riders[j].beam == b && is_ring_in_space(model, model.riders[j]))
      places.push_back({model.riders[j].s, j});
  std::sort(places.begin(), places.end(), [](const PartEnd& x, const PartEnd& y) { return x.s < y.s; });
  return places;
}

void add_sags(const Beam& beam, int b, const std::vector<PartEnd>& places, BeamModel& model) {
  if (places.size() < 3) return;  // of one span the beam's sag tells
  for (std::size_t i = 0; i + 1 < places.size(); ++i)
    model.measures.push_back(
        PartSag{beam.name + ".sag_" + std::to_string(i + 1), b, places[i], places[i + 1]});
}

std::vector<RationalCubic> profile_curve(const CaseClearance& clearance, CadFiles& files,
                                         Findings& findings) {
  const std::string where = clearance.path + ".profile";
  CaseBeam as_beam{};
  as_beam.name = clearance.name;
  as_beam.path = clearance.path;
  as_beam.axis = clearance.profile;
  Chain chain;
  if (const auto* file = std::get_if<AxisFile>(&clearance.profile.source)) {
    const ImportReport& report = files.read(file->path, findings);
    if (!report.ok()) return {};
    AxisSelection selection = select_axis(*file, report);
    if (selection.error.empty() && selection.chains.size() != 1) {
      selection.key = "chains";
      selection.error = "takes " + std::to_string(selection.chains.size()) +
                        " curves; a profile is one: choose it with \"curve\"";
    }
    if (!selection.error.empty()) {
      findings.error(selection.key.empty() ? where : where + "." + selection.key, selection.error);
      return {};
    }
    chain = selection.chains.front();
  }
  try {
    return drawn_axis(as_beam, chain, files, findings).segments;
  } catch (const std::invalid_argument& problem) {
    findings.error(where, problem.what());
    return {};
  }
}

// Points of a curve, straight between which it is as well as itself for a profile of the ground.
std::vector<Eigen::Vector3d> points_of(const std::vector<RationalCubic>& curve, const ModelFrame& frame) {
  constexpr int parts = 64;
  std::vector<Eigen::Vector3d> points;
  for (const RationalCubic& cubic : curve) {
    if (points.empty()) points.push_back(frame.to_local(cubic.point(0)));
    const int n = is_straight(cubic) ? 1 : parts;
    for (int i = 1; i <= n; ++i) points.push_back(frame.to_local(cubic.point(static_cast<double>(i) / n)));
  }
  return points;
}

void add_clearance(const ResolvedCase& resolved, const CaseClearance& clearance, const ModelFrame& frame,
                   CadFiles& files, BeamModel& model, Findings& findings) {
  const int b = resolved.beam_index(clearance.beam);
  if (model.beams[b].rigid) {
    findings.error(
        clearance.path + ".beam",
        "is " + in_quotes(clearance.beam) + ", a rigid guide, which stays as drawn; name an elastic beam");
    return;
  }
  if (model.gravity.norm() == 0) {
    findings.error(clearance.path,
                   "a clearance is measured along gravity, of which there is none; give \"gravity\"");
    return;
  }
  const std::vector<RationalCubic> curve = profile_curve(clearance, files, findings);
  if (curve.empty()) return;
  model.measures.push_back(Clearance{clearance.name + ".clearance", b, points_of(curve, frame)});
}

// What each eyelet or reel tells of the beam in it.
void add_rings(BeamModel& model) {
  for (int j = 0; j < static_cast<int>(model.riders.size()); ++j) {
    const Rider& rider = model.riders[j];
    const bool is_ring = is_ring_in_space(model, rider) || is_held_by<CarriedBody>(model, rider);
    if (!is_ring || model.body_of(rider).mass != 0) continue;
    for (const RingQuantity& of : ring_quantities)
      if (rider.reel.has_value() == of_reel(of.quantity))
        model.measures.push_back(AtRing{model.body_of(rider).name + "." + of.name, j, of.quantity});
  }
}

// What supports that turn and rotational connectors do.
void add_turns(BeamModel& model) {
  const auto add = [&](const std::string& name, bool of_support, int part,
                       std::initializer_list<OfTurn::Quantity> quantities) {
    for (const TurnQuantity& of : turn_quantities)
      if (std::ranges::find(quantities, of.quantity) != quantities.end())
        model.measures.push_back(OfTurn{name + "." + of.name, of_support, part, of.quantity});
  };
  using enum OfTurn::Quantity;
  for (int i = 0; i < static_cast<int>(model.constraints.size()); ++i)
    if (turn_of(model.constraints[i]))
      add(std::visit([&](const auto& c) { return c.reaction_name(model); }, model.constraints[i]), true, i,
          {angle, spin, drive_moment});
  for (int i = 0; i < static_cast<int>(model.rotational_connectors.size()); ++i)
    add(model.rotational_connectors[i].name, false, i, {angle, moment});
}

}  // namespace

void add_measures(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams, const ModelFrame& frame,
                  CadFiles& files, BeamModel& model, Findings& findings) {
  for (int b = 0; b < static_cast<int>(beams.size()); ++b)
    if (!model.beams[b].rigid)
      add_sags(model.beams[b], b, held_places(resolved, beams, b, model, findings), model);
  add_rings(model);
  add_turns(model);
  for (const CaseClearance& clearance : resolved.clearances)
    add_clearance(resolved, clearance, frame, files, model, findings);
}

}  // namespace nurbeam
