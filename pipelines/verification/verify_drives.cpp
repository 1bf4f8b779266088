// Hinges of rigid bodies that are driven, and rotational connectors between them.

#include <array>
#include <cmath>
#include <numbers>

#include "fem/structure/turn.h"
#include "nurbs/number_text.h"
#include "pipelines/verification/body_cases.h"

namespace nurbeam {

namespace {

using namespace verification;
using Vector = Eigen::Vector3d;
using std::numbers::pi;

// A measure of a run by its place among those of its drive: angle, spin, moment.
double drive(const RunRecord& run, std::size_t frame, std::size_t i) {
  return run.frames.at(frame).measures.at(i).value;
}

// ---- A crank with a rod of 0.35 m that moves a slider along x ----

constexpr double crank_start = 40 * pi / 180;

RunRecord crank(const std::string& crank_more, const std::string& support, double end, double every) {
  const Vector pin(0.1 * std::cos(crank_start), 0, 0.1 * std::sin(crank_start)),
      end_of_rod(pin.x() + std::sqrt(0.35 * 0.35 - pin.z() * pin.z()), 0, 0);
  return run_bodies(body_text("crank", 1, {0, 0, 0}, {0.02, 0.02, 0.02}, crank_more) + ", " +
                        body_text("rod", 1.5, (pin + end_of_rod) / 2, {0.02, 0.02, 0.02}) + ", " +
                        body_text("slider", 2, end_of_rod, {0.01, 0.01, 0.01}),
                    R"(, "supports": [)" + support + R"(], "joints": [
           { "between": [{ "body": "rod", "at": )" +
                        vector_text(pin) + R"( }, { "body": "crank", "at": )" + vector_text(pin) +
                        R"( }], "type": "cylinder", "axis": [0, 1, 0] },
           { "between": [{ "body": "rod", "at": )" +
                        vector_text(end_of_rod) +
                        R"( }, { "body": "slider" }], "type": "hinged" },
           { "between": [{ "body": "slider" }, { "point": )" +
                        vector_text(end_of_rod) + R"( }], "type": "slide", "axis": [1, 0, 0] }])",
                    end, every);
}

/// Driven at 20 rad/s.
VerifyResult driven_crank() {
  constexpr double speed = 20;
  const RunRecord run = crank("", R"({ "name": "motor", "body": "crank", "type": "clamped", "rotation": {
         "axis": [0, -1, 0], "speed": 20 } })",
                              7 * pi / 6 / speed, pi / 6 / speed);
  VerifyResult result;
  const std::string source = "Lagrange's equations";
  for (const auto& [frame, degrees, x, acceleration, moment] :
       {std::tuple{0, 40, 0.420651303, -32.898814858, 8.084067076},
        {3, 130, 0.277235161, 27.501879169, -5.598583520},
        {7, 250, 0.302947474, 22.661483875, 5.300696206}}) {
    const BodyRecord& slider = body_at(run, static_cast<std::size_t>(frame), 2);
    const std::string when = " at " + std::to_string(degrees) + " degrees";
    result.add("slider" + when + " [m]", x, source, slider.point.position.x(), 1e-6);
    result.add("acceleration of the slider" + when + " [m/s^2]", acceleration, source,
               slider.felt->acceleration.x(), 1e-5);
    result.add("moment of the drive" + when + " [N m]", moment, source,
               drive(run, static_cast<std::size_t>(frame), 2), 1e-5);
  }
  result.add("energy that departs [J]", 0, "work of the drive", run.report.energy_drift, 3e-4);
  return result;
}

/// Free from 20 rad/s on.
VerifyResult free_crank() {
  const RunRecord run = crank(R"(, "angular_velocity": [0, -20, 0])",
                              R"({ "body": "crank", "type": "pinned", "axis": [0, 1, 0] })", 0.5, 0.1);
  VerifyResult result;
  for (const auto& [frame, angle, spin] :
       {std::tuple{1, 2.596006608, 24.079139253}, {5, 11.310071119, 18.567140878}}) {
    const BodyRecord& crank = body_at(run, static_cast<std::size_t>(frame));
    const Vector along = attitude_of(crank) * Vector(std::cos(crank_start), 0, std::sin(crank_start));
    const double found = std::atan2(along.z(), along.x());
    const std::string when = " after " + text_of(0.1 * frame) + " s";
    result.add("angle of the crank" + when + " [rad]", angle, "Lagrange's equations",
               angle + std::remainder(found - angle, 2 * pi), 1e-6);
    result.add("spin of the crank" + when + " [rad/s]", spin, "Lagrange's equations", -crank.turn->spin.y(),
               1e-5);
  }
  return result;
}

// ---- Shafts ----

/// A universal joint bent by 30 degrees turns a disc of 2 kg m^2; its input at 10 rad/s.
VerifyResult universal_joint() {
  const double bend = pi / 6;
  const Vector out(std::cos(bend), std::sin(bend), 0);
  const RunRecord run = run_bodies(
      body_text("input", 1, {0, 0, 0}, {1, 1, 1}) + ", " + body_text("output", 1, {0, 0, 0}, {2, 2, 2}),
      R"(, "supports": [
           { "body": "input", "type": "clamped", "rotation": { "axis": [1, 0, 0], "speed": 10 } },
           { "body": "output", "at": )" +
          vector_text(out) + R"(, "type": "guided", "direction": )" + vector_text(out) + R"( }],
         "joints": [{ "between": [{ "body": "output" }, { "body": "input" }], "type": "universal",
           "axes": [[0, 0, 1], [0, 1, 0]] }])",
      0.2, 0.1, "[0, 0, 0]");
  VerifyResult result;
  const std::string source = "tan out = tan in/cos bend";
  for (const auto& [frame, angle, speed, moment] : {std::tuple{1, 1.063305928, 9.342052393, -45.817346337},
                                                    {2, 1.948146207, 9.052163153, 35.803599713}}) {
    const auto i = static_cast<std::size_t>(frame);
    const BodyRecord& output = body_at(run, i, 1);
    const Eigen::Quaterniond q = attitude_of(output);
    const std::string when = " after " + text_of(0.1 * frame) + " s";
    result.add("angle of the output" + when + " [rad]", angle, source,
               2 * std::atan2(q.vec().dot(out), q.w()), 1e-6);
    result.add("its spin" + when + " [rad/s]", speed, source, output.turn->spin.dot(out), 1e-5);
    result.add("moment on it" + when + " [N m]", moment, source,
               run.frames.at(i).reactions.at(2).couple.dot(out), 1e-4);
  }
  return result;
}

/// A body is carried round by an arm of 2 m, brought to 3 rad/s within 2 s.
VerifyResult carried_round() {
  constexpr double mass = 5, inertia = 0.7, arm = 2, speed = 3, ramp = 2;
  const RunRecord run =
      run_bodies(body_text("load", mass, {arm, 0, 0}, {inertia, inertia, inertia}),
                 R"(, "supports": [{ "name": "arm", "body": "load", "type": "clamped", "rotation": {
           "axis": [0, 0, 1], "about": [0, 0, 0], "speed": 3, "ramp": 2 } }])",
                 3, 0.25, "[0, 0, 0]");
  const AngleMotion law = AngleMotion::at_speed(speed, ramp);
  VerifyResult result;
  for (const std::size_t frame : {2, 5, 12}) {
    const double t = run.frames.at(frame).time;
    const AngleMotion::Moment now = law.at(t);
    const std::string when = " at " + text_of(t) + " s";
    add_vector(result, "load" + when + " [m]", {arm * std::cos(now.angle), arm * std::sin(now.angle), 0},
               "closed form", body_at(run, frame).point.position, 1e-8);
    result.add("moment of the drive" + when + " [N m]", (mass * arm * arm + inertia) * now.acceleration,
               "closed form", drive(run, frame, 2), 1e-5);
    const ReactionRecord& reaction = run.frames.at(frame).reactions.at(0);
    result.add("pull of the arm" + when + " [N]", mass * arm * now.rate * now.rate, "closed form",
               -reaction.force.dot(reaction.position.normalized()), 1e-4);
  }
  result.add("energy that departs [J]", 0, "work of the drive", run.report.energy_drift, 1e-3);
  return result;
}

/// Two bodies that fly turn each other about a hinge: by a prescribed angle, then by a moment of 0.5 N m.
VerifyResult bodies_that_turn_each_other() {
  constexpr double a = 1, b = 3;
  const auto turned = [&](const std::string& motor) {
    return run_bodies(
        body_text("a", 1, {0, 0, 0}, {a, a, a}) + ", " + body_text("b", 1, {0, 0, 0}, {b, b, b}),
        R"(, "joints": [{ "name": "motor", "between": [{ "body": "a" }, { "body": "b" }], "type": "hinged",
             "axis": [0, 0, 1], "drive": )" +
            motor + " }]",
        2, 1, "[0, 0, 0]");
  };
  const auto angle = [](const RunRecord& run, std::size_t body) {
    const Eigen::Quaterniond q = attitude_of(body_at(run, 2, body));
    return 2 * std::atan2(q.z(), q.w());
  };
  VerifyResult result;
  const std::string source = "angular momentum";
  const RunRecord led = turned(R"({ "motion": { "table": [[0, 0], [2, 90]] } })");
  result.add("angle of the first, led by 90 degrees [rad]", pi / 2 * b / (a + b), source, angle(led, 0),
             1e-7);
  result.add("of the second [rad]", -pi / 2 * a / (a + b), source, angle(led, 1), 1e-7);
  result.add("energy that departs [J]", 0, "work of the drive", led.report.energy_drift, 1e-6);
  const RunRecord pushed = turned(R"({ "moment": 0.5 })");
  result.add("angle of the first, after 2 s of a moment [rad]", 0.5 / a * 2, source, angle(pushed, 0), 1e-7);
  result.add("of the second [rad]", -0.5 / b * 2, source, angle(pushed, 1), 1e-7);
  result.add("energy that departs [J]", 0, "work of the moment", pushed.report.energy_drift, 1e-6);
  return result;
}

/// A body on a pin with a spring of 50 N m/rad and a dashpot of 1.5 N m s, pushed by 4 N m; and two bodies of
/// twice the inertia, which fly and are pushed both.
VerifyResult spring_on_a_pin() {
  VerifyResult result;
  const auto check = [&](const std::string& what, const RunRecord& run) {
    const std::string source = "the linear oscillator";
    result.add("angle after 0.5 s" + what + " [rad]", 0.119690779, source, drive(run, 1, 0), 1e-6);
    result.add("angle after 2 s" + what + " [rad]", 0.092256061, source, drive(run, 4, 0), 1e-6);
    result.add("energy that departs" + what + " [J]", 0, "work of the moment", run.report.energy_drift, 3e-5);
  };
  const auto spring = [](const std::string& from, const std::string& axis) {
    return R"(, "connectors": [{ "name": "spring", "type": "rotational", "stiffness": 50, "damping": 1.5, )" +
           axis + R"("from": )" + from + R"(, "to": { "body": "b" } }])";
  };
  const std::string about_z = R"("axis": [0, 0, 1], )";
  check("", run_bodies(body_text("b", 1, {0, 0, 0}, {0.8, 0.8, 0.8}),
                       R"(, "supports": [{ "body": "b", "type": "pinned", "axis": [0, 0, 1] }],
                            "loads": [{ "body": "b", "moment": [0, 0, 4] }])" +
                           spring(R"({ "point": [0, 0, 0] })", about_z),
                       2, 0.5, "[0, 0, 0]"));
  for (const std::string& axis : {about_z, std::string()})
    check(axis.empty() ? ", of two bodies, without an axis" : ", of two bodies",
          run_bodies(
              body_text("a", 1, {0, 0, 0}, {1.6, 1.6, 1.6}) + ", " +
                  body_text("b", 1, {0, 0, 0}, {1.6, 1.6, 1.6}),
              R"(, "loads": [{ "body": "a", "moment": [0, 0, -4] }, { "body": "b", "moment": [0, 0, 4] }])" +
                  spring(R"({ "body": "a" })", axis),
              2, 0.5, "[0, 0, 0]"));
  return result;
}

}  // namespace

std::vector<VerifyProblem> drive_problems() {
  const std::string none = "rigid bodies";
  return {{"bodies-R8", none, driven_crank},
          {"bodies-R8-free", none, free_crank},
          {"bodies-R12", none, universal_joint},
          {"bodies-R15", none, spring_on_a_pin},
          {"body-carried-round", none, carried_round},
          {"bodies-turn-each-other", none, bodies_that_turn_each_other}};
}

}  // namespace nurbeam
