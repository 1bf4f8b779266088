#include "pipelines/model/largest_tension.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nurbeam {

namespace {

double largest_factor(const TimeTable& time) {
  double largest = time.empty() ? 1 : 0;
  for (const auto& [t, factor] : time) largest = std::max(largest, std::abs(factor));
  return largest;
}

// Forces and moments of a model, by their sizes.
struct Sums {
  double force = 0, moment = 0;

  void add(const PointLoad& load) { force += load.value.norm() * largest_factor(load.time); }
  void add(const Moment& load) { moment += load.value.norm() * largest_factor(load.time); }
};

double weight_of(const BeamModel& model) {
  double mass = 0;
  for (const Beam& beam : model.beams) mass += beam.properties.mass_per_length * beam.curve.length();
  for (const Body& body : model.bodies) mass += body.mass;
  for (const Force& force : model.forces)
    if (const auto* lump = std::get_if<PlaceMass>(&force)) mass += lump->mass;
  return mass * model.gravity.norm();
}

double free_strain(const FreeStrain& strain) {
  double thermal = 0;
  for (const auto& [time, value] : strain.thermal) thermal = std::max(thermal, std::abs(value));
  return std::abs(strain.of_tension) + std::abs(strain.constant) + thermal;
}

Sums sums_of(const BeamModel& model) {
  Sums sums{.force = weight_of(model)};
  for (const Force& force : model.forces) {
    if (const auto* load = std::get_if<PointLoad>(&force)) sums.add(*load);
    if (const auto* load = std::get_if<Moment>(&force)) sums.add(*load);
    if (const auto* load = std::get_if<LineLoad>(&force))
      sums.force += load->value.norm() * largest_factor(load->time) * model.beams[load->beam].curve.length();
  }
  for (const Beam& beam : model.beams)
    if (!beam.rigid) sums.force += beam.properties.axial_stiffness * free_strain(beam.properties.free_strain);
  for (const Connector& connector : model.connectors) sums.force += std::abs(connector.force);
  return sums;
}

}  // namespace

double largest_tension(const BeamModel& model, int b) {
  for (const Constraint& constraint : model.constraints)
    if (const auto* support = std::get_if<Support>(&constraint);
        support && (support->motion || support->turn))
      return std::numeric_limits<double>::infinity();
  const Beam& beam = model.beams[b];
  const Sums sums = sums_of(model);
  const double EI = beam.properties.least_bending_stiffness(), L = beam.curve.length(),
               turn = (sums.force * L * L / 2 + sums.moment * L) / EI,
               strain = std::min(1.0, turn * turn / 2);
  return sums.force + beam.properties.axial_stiffness * (EI > 0 ? strain : 1);
}

}  // namespace nurbeam
