#include "pipelines/verification/rope_cases.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "nurbs/number_text.h"
#include "pipelines/model/model_snapshot.h"
#include "pipelines/run/simulation_plan.h"
#include "pipelines/verification/noted.h"

namespace nurbeam::verification {

namespace {

std::string point(double x, double y, double z) {
  return "[" + text_of(x) + ", " + text_of(y) + ", " + text_of(z) + "]";
}

/// The section of a rope without bending stiffness to speak of.
constexpr double area = 1e-4;
std::string rope(const std::string& name, const std::string& from, const std::string& to, double stiffness,
                 double mass, int elements, const std::string& more) {
  return R"({ "name": ")" + name + R"(", "axis": { "polyline": [)" + from + ", " + to +
         R"(] }, "stress_free": "straight", "torsion": false, "section": { "area": )" + text_of(area) +
         R"(, "second_moment": 1e-14 }, "elements": { "count": )" + std::to_string(elements) +
         R"( }, "material": { "density": )" + text_of(mass / area) + R"(, "youngs_modulus": )" +
         text_of(stiffness / area) + more + "}";
}

std::string pinned(const std::string& beam, const std::string& at) {
  return R"({ "beam": ")" + beam + R"(", "at": ")" + at + R"(", "type": "pinned" })";
}

std::string only_probe(const std::string& beam, const std::string& at) {
  return R"("probes": [{ "name": "p", "beam": ")" + beam + R"(", "at": )" + at + " }]";
}

std::string first_errors(const std::vector<Diagnostic>& diagnostics) {
  for (const Diagnostic& found : diagnostics)
    if (found.severity == Severity::error) return found.where + ": " + found.message;
  return "no error";
}

}  // namespace

RunRecord run_text(const std::string& text) {
  const CaseFileReport read = read_case_text(text, "case");
  if (!read.value) throw std::runtime_error(first_errors(read.diagnostics));
  const BuildReport built = build_model(*read.value);
  if (!built.value) throw std::runtime_error(first_errors(built.diagnostics));
  RunRecord record;
  SimulationObserver observer;
  observer.snapshot = [&](const Snapshot& frame) {
    record.frames.push_back(to_world(built.value->frame, frame));
  };
  record.report =
      simulate(noted(built.value->model, simulation_options(*read.value)), probe_places(*built.value),
               at_problem_level(simulation_options(*read.value)), observer);
  if (record.report.status != SimulationStatus::done)
    throw std::runtime_error(outcome_in_world(record.report, *built.value));
  keep_numbers(record.frames, record.report);
  return record;
}

double largest_z_error(const RunRecord& run, const std::vector<double>& heights) {
  double largest = run.frames.size() == heights.size() ? 0 : NAN;
  for (std::size_t i = 0; i < heights.size(); ++i)
    largest = std::max(largest, std::abs(run.probe(i).z() - heights[i]));
  return largest;
}

std::string net_case(int elements, const std::string& more) {
  std::string beams, supports, joints;
  const auto list = [](std::string& all, const std::string& next) {
    all += (all.empty() ? "" : ", ") + next;
  };
  const std::string tension = R"( }, "tension": )" + text_of(net_tension);
  for (int i = 0; i < 2; ++i) {
    const double at = net_crossings[i];
    const std::string x = "x" + std::to_string(i), y = "y" + std::to_string(i);
    list(beams, rope(x, point(0, at, 0), point(net_span, at, 0), net_stiffness, net_mass, elements, tension));
    list(beams, rope(y, point(at, 0, 0), point(at, net_span, 0), net_stiffness, net_mass, elements, tension));
    for (const std::string& beam : {x, y})
      for (const char* end : {"start", "end"}) list(supports, pinned(beam, end));
    for (int j = 0; j < 2; ++j)
      list(joints, R"({ "beams": [")" + x + R"(", "y)" + std::to_string(j) +
                       R"("], "type": "hinged", "at": { "near": )" + point(net_crossings[j], at, 0) + " } }");
  }
  return R"({ "nurbeam": 1, "gravity": [0, 0, -9.81], "beams": [)" + beams + R"(], "supports": [)" +
         supports + R"(], "joints": [)" + joints + R"(], "output": { "report": false, "every": 0.05, )" +
         only_probe("y1", R"({ "length": 8 })") + " }, " + more + "}";
}

std::string slackline_case(int elements, const std::string& law, double mass, double fraction,
                           const std::string& more) {
  const std::string place = R"({ "fraction": )" + text_of(fraction) + " }";
  return R"({ "nurbeam": 1, "gravity": [0, 0, -9.81], "beams": [)" +
         rope("line", point(0, 0, 0), point(slackline_span, 0, 0), slackline_stiffness, mass, elements,
              R"(, "law": ")" + law + R"(" }, "unstressed_length": )" + text_of(slackline_length)) +
         R"(], "supports": [)" + pinned("line", "start") + ", " + pinned("line", "end") +
         R"(], "output": { "report": false, "every": 0.1, )" + only_probe("line", place) + " }, " + more +
         "}";
}

std::string bungee_case(int elements, const std::string& law, double mass, double every,
                        const std::string& more) {
  return R"({ "nurbeam": 1, "gravity": [0, 0, -9.81], "beams": [)" +
         rope("rope", point(0, 0, 0), point(0, 0, -bungee_length), bungee_stiffness, mass, elements,
              R"(, "law": ")" + law + R"(" })") +
         R"(], "supports": [)" + pinned("rope", "start") + R"(], "output": { "report": false, "every": )" +
         text_of(every) + ", " + only_probe("rope", R"("end")") + " }, " + more + "}";
}

std::string hanging_case(int elements, double length, double span, double stiffness, double mass,
                         const std::string& more) {
  return R"({ "nurbeam": 1, "gravity": [0, 0, -9.81], "beams": [)" +
         rope("rope", point(0, 0, 0), point(span, 0, 0), stiffness, mass, elements,
              R"( }, "unstressed_length": )" + text_of(length)) +
         R"(], "supports": [)" + pinned("rope", "start") + ", " + pinned("rope", "end") +
         R"(], "output": { "report": false, )" + only_probe("rope", R"({ "fraction": 0.4 })") + " }, " +
         more + "}";
}

std::string whirling_case(int elements, const Eigen::Vector3d& tip, double stiffness, double mass,
                          double spin, const std::string& more) {
  return R"({ "nurbeam": 1, "gravity": [0, 0, -9.81], "beams": [)" +
         rope("rope", point(0, 0, 0), point(tip.x(), tip.y(), tip.z()), stiffness, mass, elements,
              R"( }, "initial": { "velocity": { "rotation": )" + point(0, 0, spin) + " } }") +
         R"(], "supports": [)" + pinned("rope", "start") +
         R"(], "output": { "report": false, "every": 0.05, )" + only_probe("rope", R"("end")") + " }, " +
         more + "}";
}

std::string arresting_case(int elements, double stiffness, double half, double tail,
                           const std::string& loads) {
  return R"({ "nurbeam": 1, "gravity": [0, 0, 0], "beams": [)" +
         rope("rope", point(0, 0, 0), point(0, half + tail, 0), stiffness, 4, elements, " }") +
         R"(], "supports": [{ "beam": "rope", "at": "start", "type": "guided", "direction": [1, 0, 0] }],
    "eyelets": [{ "name": "sheave", "beam": "rope", "at": { "length": )" +
         text_of(half) + R"( } }], "loads": [)" + loads +
         R"(], "analysis": { "type": "static" }, "output": { "report": false, "probes": [
      { "name": "hook", "beam": "rope", "at": "start" }, { "name": "tail", "beam": "rope", "at": "end" }] } })";
}

std::string arrested_aircraft(double longest_element) {
  return R"({ "nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{ "name": "cable", "axis": { "polyline": [[0, 0, 0], [0, 77, 0]] }, "stress_free": "straight",
      "section": { "area": 1e-4, "second_moment": 5e-12 },
      "material": { "density": 4e4, "youngs_modulus": 2e11, "damping": 1e-4 },
      "elements": { "max_length": )" +
         text_of(longest_element) + R"( } }],
    "bodies": [{ "name": "sheave", "mass": 5 },
               { "name": "aircraft", "mass": 7500, "position": [-1, 0, 0], "velocity": [66, 0, 0] }],
    "sliding_joints": [{ "body": "sheave", "beam": "cable", "at": { "length": 17 }, "slope": "discontinuous",
      "friction": { "force": 350e3, "stick_stiffness": 1e8 } }],
    "connectors": [
      { "name": "one rod", "type": "rod", "from": { "body": "sheave" }, "to": { "point": [1, 17, 0] } },
      { "name": "another", "type": "rod", "from": { "body": "sheave" }, "to": { "point": [0, 18, 0] } },
      { "name": "hook", "type": "compression-only", "direction": [1, 0, 0], "from": { "body": "aircraft" },
        "to": { "beam": "cable", "at": "start" }, "stiffness": 5e7, "length": 1 }],
    "supports": [{ "beam": "cable", "at": "start", "type": "guided", "direction": [1, 0, 0], "mass": 2.5 }],
    "loads": [{ "beam": "cable", "at": "end", "force": [0, 20e3, 0] }],
    "analysis": { "end_time": 0.8, "tolerance": 1e-4 }, "output": { "report": false, "every": 0.002 } })";
}

}  // namespace nurbeam::verification
