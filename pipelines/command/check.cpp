#include "pipelines/command/check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include "fem/motion/record/snapshot.h"
#include "fem/system/initial_state.h"
#include "nurbs/number_text.h"
#include "pipelines/diagnostics/exit_code.h"
#include "pipelines/diagnostics/print_diagnostics.h"
#include "pipelines/model/build_model.h"
#include "pipelines/results/run_summary.h"

namespace nurbeam {

namespace {

constexpr int place_digits = 9, size_digits = 6;

std::string place(double s) { return "s = " + text_of(s, place_digits) + " m"; }

std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

void print_beam(std::ostream& out, const Beam& beam, double drawn_bending) {
  const double L = beam.curve.length();
  if (beam.rigid) {
    out << "guide     " << beam.name << ": " << (beam.is_ring() ? "a ring, " : "") << "length "
        << text_of(L, place_digits) << " m, rigid, " << counted(beam.curve.segment_count(), "CAD segment")
        << '\n';
    return;
  }
  double shortest = L, longest = 0;
  for (std::size_t i = 1; i < beam.home.size(); ++i) {
    const double length = beam.home[i].s - beam.home[i - 1].s;
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  }
  const BeamProperties& p = beam.properties;
  const double stretch =
      std::sqrt(1 + 2 * p.free_strain.constant);  // of the unstressed over the drawn length
  const auto size = [](double value) { return text_of(value, size_digits); };
  out << "beam      " << beam.name << ": " << (beam.is_ring() ? "a ring, " : "") << "length "
      << text_of(L, place_digits) << " m, mass " << size(L * p.mass_per_length) << " kg, "
      << counted(beam.curve.segment_count(), "CAD segment") << ", "
      << counted(beam.home.size() - 1, "element") << " of " << size(shortest)
      << (size(shortest) == size(longest) ? "" : " to " + size(longest)) << " m, EA "
      << size(p.free_axial_stiffness()) << " N, ";
  if (p.sections)
    out << "EI1 " << size(p.sections->bending_1 * stretch) << ", EI2 "
        << size(p.sections->bending_2 * stretch) << ", EI12 " << size(p.sections->bending_product * stretch)
        << ", GJ " << size(p.sections->torsion * stretch);
  else
    out << "EI " << size(p.bending_stiffness * stretch);
  out << " N m^2, stress-free " << (beam.curve.straight() ? "straight" : "as drawn");
  if (stretch != 1) out << ", unstressed length " << text_of(L * stretch, place_digits) << " m";
  if (p.free_strain.of_tension != 0) out << ", tension " << size(p.drawn_tension()) << " N as drawn";
  if (std::holds_alternative<HookeLaw>(p.law)) out << ", Hooke's law of force over stretch";
  if (std::holds_alternative<ForceOverStretch>(p.law)) out << ", force over stretch by rows";
  if (!p.free_strain.thermal.empty()) out << ", with a temperature";
  if (drawn_bending > 0) out << ", " << size(drawn_bending) << " J of bending as drawn";
  out << '\n';
}

// Of a beam in space: its element, and why; the angle that sections come back turned by on a ring.
void print_torsion(std::ostream& out, const Beam& beam, const std::string& torsion) {
  if (torsion.empty()) return;
  out << "torsion   of " << beam.name << ": " << torsion << '\n';
  if (beam.has_torsion() && beam.is_ring())
    out << "holonomy  of " << beam.name
        << ": sections carried around the ring without twist come back turned by "
        << text_of(beam.curve.holonomy() * 180 / std::numbers::pi, size_digits) << " degrees\n";
}

void print_corners(std::ostream& out, const Beam& beam) {
  for (const HomeNode& node : beam.home)
    if (node.kind == NodeKind::rigid || node.kind == NodeKind::hinge)
      out << "corner    of " << beam.name << " at " << place(node.s) << ", "
          << (node.kind == NodeKind::rigid ? "rigid" : "a hinge") << '\n';
}

// Of each beam: what was decided of places with the same reason, the first of them by name.
void print_slopes(std::ostream& out, const BuiltModel& built) {
  std::map<std::tuple<int, bool, std::string>, std::vector<const SlopeDecision*>> alike;
  for (const SlopeDecision& slope : built.slopes)
    alike[{slope.beam, slope.discontinuous, slope.why}].push_back(&slope);
  for (const auto& [key, places] : alike) {
    const auto& [b, is_kink, why] = key;
    out << "slope     of " << built.model.beams[b].name << " at " << place(places.front()->s) << ", "
        << places.front()->path;
    if (places.size() > 1) out << ", and " << places.size() - 1 << " more";
    out << ": " << (is_kink ? "may jump" : "is continuous") << "; " << why << '\n';
  }
}

void print_materials(std::ostream& out, const CaseFile& case_file) {
  for (const CaseBeam& beam : case_file.beams) {
    const CaseMaterial& material = beam.material;
    if (material.name.empty()) continue;
    const auto size = [](double value) { return text_of(value, size_digits); };
    out << "material  of " << beam.name << ": " << material.name << ", density " << size(material.density)
        << " kg/m^3, Young's modulus " << size(material.youngs_modulus) << " Pa";
    if (material.poissons_ratio) out << ", Poisson's ratio " << size(*material.poissons_ratio);
    if (material.thermal_expansion)
      out << ", thermal expansion " << size(*material.thermal_expansion) << " /K";
    out << '\n';
  }
}

void print_sections(std::ostream& out, const BuiltModel& built) {
  for (std::size_t b = 0; b < built.sources.size(); ++b)
    if (const auto& drawn = built.sources[b].profile) {
      out << "section   of " << built.model.beams[b].name << ": " << drawn->file.string() << '\n';
      print_profile(out, drawn->profile);
    }
}

void print_joints(std::ostream& out, const BeamModel& model) {
  for (const Rider& rider : model.riders) {
    const Body& body = model.bodies[rider.body];
    const bool is_ring = body.mass == 0;  // of an eyelet or a reel
    out << (rider.reel ? "reel      "
            : is_ring  ? "eyelet    "
                       : "joint     ")
        << body.name << (is_ring ? "" : " (" + text_of(body.mass, size_digits) + " kg)") << " on "
        << model.beams[rider.beam].name << " at " << place(rider.s);
    if (rider.reel) out << ", " << text_of(model.stored_length(rider, rider.s), size_digits) << " m stored";
    out << '\n';
  }
  for (const Constraint& constraint : model.constraints)
    if (const auto* joint = std::get_if<BeamJoint>(&constraint))
      out << "joint     " << model.beams[joint->beam_a].name << " at " << place(joint->s_a) << " and "
          << model.beams[joint->beam_b].name << " at " << place(joint->s_b) << ", "
          << (joint->rigid ? "rigid" : "hinged") << '\n';
}

void print_connectors(std::ostream& out, const BeamModel& model) {
  const auto end_text = [&](const Grip& end) -> std::string {
    if (end.beam >= 0) return model.beams[end.beam].name + " at " + place(end.s);
    return end.body >= 0 ? model.bodies[end.body].name : "a point";
  };
  for (const Connector& connector : model.connectors) {
    out << "connector " << connector.name << ": " << end_text(connector.ends[0]) << " to "
        << end_text(connector.ends[1]);
    if (connector.type != ConnectorType::rod)
      out << ", " << text_of(connector.stiffness, size_digits) << " N/m"
          << (connector.rows ? " where it is not stretched, by rows" : "");
    if (connector.length_rule == ConnectorLength::given)
      out << ", length " << text_of(connector.length, place_digits) << " m";
    out << '\n';
  }
  for (const RotationalConnector& connector : model.rotational_connectors)
    out << "connector " << connector.name << ": " << end_text(connector.ends[0]) << " to "
        << end_text(connector.ends[1]) << ", " << text_of(connector.stiffness, size_digits) << " N m/rad"
        << (connector.counts(model.dimension) ? "" : " against any turn") << '\n';
}

// Where elements cannot even have the drawn shape without stretching.
void print_mismatch(std::ostream& out, const BeamSystem& system) {
  Mismatch mismatch;
  record_beams(system, drawn_state(system), [&](int beam, const std::vector<ElementRecord>& elements) {
    mismatch.look_at(elements, system.model().beams[beam].name, 0);
  });
  constexpr double round_off = 1e-12;
  if (mismatch.value > round_off)
    out << "mesh      axial mismatch of the drawn shape up to " << text_of(mismatch.value, 3) << ", in "
        << mismatch.beam << " at " << place(mismatch.s) << ": more elements there lessen it\n";
}

template <class Alternative, class List>
std::ptrdiff_t count(const List& list) {
  return std::count_if(
      list.begin(), list.end(), [](const auto& item) { return std::holds_alternative<Alternative>(item); });
}

}  // namespace

int check_case(const CaseFile& case_file, std::ostream& out, std::ostream& err) {
  const BuildReport report = build_model(case_file);
  print_diagnostics(err, report.diagnostics);
  if (!report.value) return exit_bad_input;
  const BeamModel& model = report.value->model;
  out << "case      " << case_file.name << '\n';
  const BeamSystem system(model);
  out << "model     " << (model.dimension == 2 ? "planar" : "spatial") << ", " << system.coordinate_count()
      << " coordinates\n";
  const Eigen::Vector3d& g = case_file.gravity;
  const auto size = [](double value) { return text_of(value, size_digits); };
  out << "gravity   [" << size(g.x()) << ", " << size(g.y()) << ", " << size(g.z()) << "] m/s^2\n";
  for (std::size_t b = 0; b < model.beams.size(); ++b)
    print_beam(out, model.beams[b], report.value->sources[b].drawn_bending);
  for (std::size_t b = 0; b < model.beams.size(); ++b)
    print_torsion(out, model.beams[b], report.value->sources[b].torsion);
  for (const Beam& beam : model.beams) print_corners(out, beam);
  print_slopes(out, *report.value);
  print_mismatch(out, system);
  if (const auto& adapted = report.value->adapted)
    out << "mesh      positions off by about " << text_of(adapted->error, 2) << " of a beam's length, by the "
        << (adapted->from_equilibrium ? "static state" : "drawing") << '\n';
  print_materials(out, case_file);
  print_sections(out, *report.value);
  print_joints(out, model);
  print_connectors(out, model);
  out << "supports  " << count<Support>(model.constraints) << ", point loads "
      << count<PointLoad>(model.forces) << ", moments " << count<Moment>(model.forces)
      << ", distributed loads " << count<LineLoad>(model.forces) + count<LineTorque>(model.forces) << '\n';
  return exit_done;
}

}  // namespace nurbeam
