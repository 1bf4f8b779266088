// Rigid bodies that fly, hang, roll and are joined, against the equations of their motion. The references
// were integrated in other coordinates by a method of order eight to 1e-12, or have a closed form.

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <string>

#include "nurbs/number_text.h"
#include "pipelines/verification/body_cases.h"
#include "pipelines/verification/verify.h"

namespace nurbeam {

namespace {

using namespace verification;
using Vector = Eigen::Vector3d;

/// A body turns about the axis of its middle moment of inertia, and flips: Dzhanibekov.
VerifyResult flips() {
  const RunRecord run = run_bodies(
      body_text("body", 1, {0, 0, 0}, {0.2, 0.35, 0.5}, R"(, "angular_velocity": [0.02, 6, 0.03])"), "", 10,
      1, "[0, 0, 0]");
  VerifyResult result;
  const std::string source = "Euler's equations";
  add_vector(result, "spin after 1 s [rad/s]", {-0.234152044, 5.994814218, 0.150568495}, source,
             own_spin(body_at(run, 1)), 1e-6);
  add_vector(result, "spin after 5 s [rad/s]", {0.070178824, -5.999569026, 0.052057919}, source,
             own_spin(body_at(run, 5)), 1e-6);
  const Eigen::Vector4d p(-0.825764744, 0.034262058, -0.562967018, -0.002614343);
  for (int k = 0; k < 4; ++k)
    result.add(std::string("q") + "wxyz"[k] + " after 10 s", p[k], source, body_at(run, 10).turn->attitude[k],
               1e-6);
  return result;
}

/// A body is thrown, without air: its axis goes round its angular momentum at 48.166378315 rad/s.
VerifyResult thrown() {
  const RunRecord run = run_bodies(body_text("body", 1, {0, 0, 0}, {0.05, 0.05, 0.08},
                                             R"(, "velocity": [5, 2, 12], "angular_velocity": [4, 0, 30])"),
                                   "", 2, 0.5);
  VerifyResult result;
  add_vector(result, "axis after 0.5 s", {0.041548176, 0.072017062, 0.996537652}, "closed form",
             attitude_of(body_at(run, 1)) * Vector::UnitZ(), 1e-6);
  add_vector(result, "axis after 2 s", {0.123461102, -0.072307364, 0.989711575}, "closed form",
             attitude_of(body_at(run, 4)) * Vector::UnitZ(), 1e-6);
  add_vector(result, "centre after 2 s [m]", {10, 4, 4.38}, "closed form", body_at(run, 4).point.position,
             1e-6);
  return result;
}

/// A top on a ball, 60 degrees from the vertical, spins at 60 rad/s about its axis alone, and nutates.
VerifyResult top() {
  const double s = std::sin(std::numbers::pi / 3), c = 0.5;
  const RunRecord run =
      run_bodies(body_text("top", 2, Vector(0.15 * s, 0, 0.15 * c), {0.01, 0.01, 0.02},
                           R"(, "axes": { "x": )" + vector_text(Vector(c, 0, -s)) + R"(, "z": )" +
                               vector_text(Vector(s, 0, c)) + R"( }, "angular_velocity": )" +
                               vector_text(Vector(60 * s, 0, 60 * c))),
                 R"(, "supports": [{ "body": "top", "at": [0, 0, 0], "type": "pinned" }])", 1, 0.1);
  VerifyResult result;
  add_vector(result, "axis after 0.1 s", {0.924885058, 0.135276613, 0.355370042}, "Euler's equations",
             body_at(run, 1).point.position / 0.15, 1e-6);
  add_vector(result, "axis after 1 s", {-0.678862684, 0.590754222, 0.436067547}, "Euler's equations",
             body_at(run, 10).point.position / 0.15, 1e-6);
  return result;
}

/// A compound pendulum on a pin comes back after its period.
VerifyResult compound_pendulum() {
  const double period = 2.510534360, angle = 2 * std::numbers::pi / 3;
  const RunRecord run = run_bodies(
      body_text("pendulum", 12, hanging(angle, 0.7), {1.1, 1.1, 1.1}),
      R"(, "supports": [{ "body": "pendulum", "at": [0, 0, 0], "type": "pinned", "axis": [0, 1, 0] }])",
      period, period / 4);
  VerifyResult result;
  result.add("angle after a period [rad]", angle, "elliptic integral",
             angle_of(body_at(run, 4).point.position), 1e-6);
  result.add("angle after a quarter [rad]", 0, "elliptic integral", angle_of(body_at(run, 1).point.position),
             1e-6);
  return result;
}

/// A body swings below a trolley on a level rail.
VerifyResult trolley() {
  const RunRecord run = run_bodies(
      R"({ "name": "trolley", "mass": 50 }, )" +
          body_text("body", 80, hanging(std::numbers::pi / 4, 1.2), {40, 40, 40}),
      R"(, "beams": [{ "name": "rail", "rigid": true, "axis": { "polyline": [[-5, 0, 0], [5, 0, 0]] } }],
         "sliding_joints": [{ "body": "trolley", "beam": "rail", "at": { "length": 5 } }],
         "joints": [{ "between": [{ "body": "body", "at": [0, 0, 0] }, { "body": "trolley" }], "type": "hinged" }])",
      3, 0.5);
  VerifyResult result;
  const auto check = [&](std::size_t frame, double x, double angle) {
    const Vector there = body_at(run, frame).point.position,
                 swings = body_at(run, frame, 1).point.position - there;
    const std::string when = " after " + text_of(0.5 * static_cast<double>(frame)) + " s";
    result.add("trolley" + when + " [m]", x, "Lagrange's equations", there.x(), 1e-6);
    result.add("angle" + when + " [rad]", angle, "Lagrange's equations", angle_of(swings), 1e-6);
  };
  check(1, 0.447812326, 0.100865200);
  check(2, 1.035150647, -0.767946745);
  check(6, 0.955911082, -0.627788224);
  return result;
}

/// A double pendulum of two bodies on pins.
VerifyResult double_pendulum() {
  const double first = 1.2, second = -0.4;
  const Vector knee = hanging(first, 0.9);
  const RunRecord run =
      run_bodies(body_text("a", 3, hanging(first, 0.4), {0.05, 0.05, 0.05}) + ", " +
                     body_text("b", 2, knee + hanging(second, 0.5), {0.03, 0.03, 0.03}),
                 R"(, "supports": [{ "body": "a", "at": [0, 0, 0], "type": "pinned", "axis": [0, 1, 0] }],
         "joints": [{ "between": [{ "body": "b", "at": )" +
                     vector_text(knee) + R"( }, { "body": "a", "at": )" + vector_text(knee) +
                     R"( }], "type": "hinged", "axis": [0, 1, 0], "name": "knee" }])",
                 3, 0.5);
  VerifyResult result;
  const auto check = [&](std::size_t frame, double a, double b) {
    const Vector of_a = body_at(run, frame).point.position,
                 of_b = body_at(run, frame, 1).point.position -
                        attitude_of(body_at(run, frame)) * (knee - hanging(first, 0.4)) - of_a;
    const std::string when = " after " + text_of(0.5 * static_cast<double>(frame)) + " s [rad]";
    result.add("first angle" + when, a, "Lagrange's equations", angle_of(of_a), 1e-6);
    result.add("second angle" + when, b, "Lagrange's equations", angle_of(of_b), 1e-6);
  };
  check(1, -0.405109250, 1.062534735);
  check(3, 0.510127157, -1.469446515);
  check(6, 0.177656116, 0.146305738);
  return result;
}

/// A gondola on two rods is pushed at rest, and swings.
VerifyResult gondola() {
  const double z = std::sqrt(4 - 0.36);
  const auto rod = [&](const std::string& name, double x) {
    return R"({ "name": ")" + name + R"(", "type": "rod", "from": { "body": "gondola", "at": )" +
           vector_text(Vector(x, 0, -z)) + R"( }, "to": { "point": )" + vector_text(Vector(2 * x, 0, 0)) +
           " } }";
  };
  const RunRecord run = run_bodies(
      body_text("gondola", 100, Vector(0, 0, -z - 0.5), {14, 20, 16}, R"(, "angular_velocity": [0, 0.8, 0])"),
      R"(, "connectors": [)" + rod("left", -0.6) + ", " + rod("right", 0.6) + "]", 2, 1);
  VerifyResult result;
  add_vector(result, "centre after 1 s [m]", {-0.131843224, 0, -2.395466221}, "Lagrange's equations",
             body_at(run, 1).point.position, 1e-6);
  add_vector(result, "centre after 2 s [m]", {0.235592279, 0, -2.366677203}, "Lagrange's equations",
             body_at(run, 2).point.position, 1e-6);
  return result;
}

/// Two satellites that turn, and a rope between places of them that goes taut and slack.
VerifyResult satellites() {
  const RunRecord run =
      run_bodies(body_text("a", 60, {0, 0, 0}, {8, 12, 15},
                           R"(, "velocity": [0, -0.4, 0], "angular_velocity": [0.1, 0.3, -0.2])") +
                     ", " +
                     body_text("b", 25, {21.7, 0, 0}, {2, 3, 2.5},
                               R"(, "velocity": [0, 1.5, 0.6], "angular_velocity": [0.5, 0, 0.3])"),
                 R"(, "connectors": [{ "name": "rope", "type": "tension-only", "stiffness": 400, "length": 20,
           "from": { "body": "a", "at": [0.8, 0.2, 0] }, "to": { "body": "b", "at": [21.2, 0, 0.1] } }])",
                 10, 5, "[0, 0, 0]");
  VerifyResult result;
  add_vector(result, "first after 5 s [m]", {2.633785159, -1.995642660, 0.021939736},
             "Newton's and Euler's laws", body_at(run, 1).point.position, 1e-5);
  add_vector(result, "second after 10 s [m]", {8.907111260, 14.978009108, 5.893240663},
             "Newton's and Euler's laws", body_at(run, 2, 1).point.position, 1e-5);
  result.add("energy [J]", 70.863872889, "at the start", run.frames.at(2).energy.total, 1e-5);
  return result;
}

/// A body slides without friction along a bar that turns freely about the vertical, and then on a spring.
VerifyResult slider_on_bar() {
  VerifyResult result;
  const auto slide = [](const std::string& spring) {
    return run_bodies(
        body_text("body", 2, {0.3, 0, 0}, {0.1, 0.1, 0.1}, R"(, "angular_velocity": [0, 0, 6])") + ", " +
            body_text("bar", 1, {0, 0, 0}, {0.1, 0.4, 0.4}, R"(, "angular_velocity": [0, 0, 6])"),
        R"(, "supports": [{ "body": "bar", "type": "pinned", "axis": [0, 0, 1] }],
           "joints": [{ "between": [{ "body": "body" }, { "body": "bar" }], "type": "slide", "axis": [1, 0, 0] }])" +
            spring,
        2, 0.1);
  };
  const auto check = [&](const RunRecord& run, std::size_t frame, const std::string& how, double r,
                         double rate) {
    const PointRecord& there = body_at(run, frame).point;
    const double distance = there.position.norm();
    const std::string when = how + " after " + text_of(0.1 * static_cast<double>(frame)) + " s";
    result.add("distance" + when + " [m]", r, "Lagrange's equations", distance, 1e-6);
    result.add("speed along the bar" + when + " [m/s]", rate, "Lagrange's equations",
               there.velocity.dot(there.position) / distance, 1e-6);
  };
  const RunRecord freely = slide("");
  check(freely, 2, "", 0.510445428, 2.022093699);
  check(freely, 5, "", 1.344831254, 3.196623776);
  const RunRecord on_spring = slide(
      R"(, "connectors": [{ "name": "spring", "type": "spring", "stiffness": 150, "length": 0.3, "from": { "body": "body" },
           "to": { "body": "bar" } }])");
  check(on_spring, 5, ", on a spring", 0.424386210, -1.184819906);
  check(on_spring, 20, ", on a spring", 0.300010377, -0.014971197);
  return result;
}

/// A moment that turns with a body at rest, and one that stays in space.
VerifyResult moments() {
  VerifyResult result;
  const auto check = [&](const char* follower, const std::string& how, const Vector& two, const Vector& six) {
    const RunRecord run =
        run_bodies(body_text("body", 1, {0, 0, 0}, {0.2, 0.35, 0.5}),
                   std::string(R"(, "loads": [{ "body": "body", "moment": [0.3, 0.2, -0.1], "follower": )") +
                       follower + " }]",
                   6, 2, "[0, 0, 0]");
    add_vector(result, "spin after 2 s, " + how + " [rad/s]", two, "Euler's equations",
               own_spin(body_at(run, 1)), 1e-6);
    add_vector(result, "spin after 6 s, " + how + " [rad/s]", six, "Euler's equations",
               own_spin(body_at(run, 3)), 1e-6);
    result.add("energy from nowhere, " + how + " [J]", 0, "balance of energy",
               run.frames.at(3).energy.total - run.frames.at(0).energy.total, 1e-5);
  };
  check("true", "turning", {3.150125523, -0.037055791, -0.702479147},
        {8.980129232, 0.490523997, -0.500070585});
  check("false", "fixed", {3.117848579, -0.694367032, -0.669620718},
        {9.452458248, -1.487758567, -2.186226605});
  return result;
}

/// A body hangs from three springs.
VerifyResult hung_body() {
  const auto spring = [](int i, double k, const Vector& from, const Vector& to) {
    return R"({ "name": "spring )" + std::to_string(i) + R"(", "type": "spring", "stiffness": )" +
           text_of(k) + R"(, "length": 1.5, "from": { "body": "body", "at": )" + vector_text(from) +
           R"( }, "to": { "point": )" + vector_text(to) + " } }";
  };
  const RunRecord run = run_text(
      R"({ "nurbeam": 1, "bodies": [)" + body_text("body", 30, {0, 0, 0}, {2, 2, 2}) +
      R"(], "connectors": [)" + spring(1, 800, {1, 0, 0.1}, {1.5, 0, 2}) + ", " +
      spring(2, 900, {-1, 0.5, 0.1}, {-1, 0.8, 2}) + ", " +
      spring(3, 1000, {-1, -0.6, 0.1}, {-1.2, -0.6, 2.2}) + R"(], "analysis": { "type": "static" } })");
  VerifyResult result;
  const Snapshot& rest = run.frames.back();
  add_vector(result, "centre [m]", {0.169625583, 0.051872650, 0.349888929}, "least potential energy",
             rest.bodies[0].point.position, 1e-6);
  const Vector forces(145.191546, 75.942290, 79.527326);
  for (std::size_t i = 0; i < 3; ++i)
    result.add("force of spring " + std::to_string(i + 1) + " [N]", forces[static_cast<Eigen::Index>(i)],
               "least potential energy", rest.connectors[i].force, 1e-3);
  return result;
}

/// A body on two wheels, 1.6 m apart, swings in a ring.
VerifyResult two_wheels() {
  const double R = 3, half = std::asin(0.8 / R), start = std::numbers::pi / 3, period = 4.007518833;
  const Vector front = hanging(start + half, R), rear = hanging(start - half, R),
               centre = hanging(start, R * std::cos(half) + 0.5);
  const RunRecord run =
      run_bodies(body_text("cart", 120, centre, {30, 30, 30},
                           R"(, "points": { "front": )" + vector_text(front) + R"(, "rear": )" +
                               vector_text(rear) + " }"),
                 R"(, "beams": [)" + ring_rail(R) + R"(], "sliding_joints": [)" +
                     wheel("cart", "front", front) + ", " + wheel("cart", "rear", rear) + "]",
                 period, period / 4);
  VerifyResult result;
  result.add("angle after a period [rad]", start, "elliptic integral",
             angle_of(body_at(run, 4).point.position), 1e-5);
  result.add("spin at the bottom [rad/s]", 1.682587581, "energy", body_at(run, 1).turn->spin.norm(), 1e-5);
  result.add("force of a wheel at the bottom [N]", 1208.436981, "Newton's law",
             body_at(run, 1, 1).joint_force.norm(), 1e-2);
  return result;
}

/// The same body runs on a parabola, z = x^2/6.
VerifyResult parabola() {
  constexpr double X = 6;
  const auto point = [](double x) { return Vector(x, 0, x * x / 6); };
  const Vector rear = point(-3.5);
  double low = -3.5, high = -1.9;
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    ((point(middle) - rear).norm() < 1.6 ? low : high) = middle;
  }
  const Vector front = point(low), along = (front - rear) / 1.6,
               centre = (front + rear) / 2 + 0.5 * Vector(along.z(), 0, -along.x());
  const RunRecord run = run_bodies(
      body_text(
          "cart", 120, centre, {30, 30, 30},
          R"(, "points": { "rear": )" + vector_text(rear) + R"(, "front": )" + vector_text(front) + " }"),
      R"(, "beams": [{ "name": "rail", "rigid": true, "axis": { "nurbs": { "degree": 2, "control_points": [)" +
          vector_text(point(-X)) + ", " + vector_text(Vector(0, 0, -X * X / 6)) + ", " +
          vector_text(point(X)) +
          R"(], "knots": [0, 0, 0, 1, 1, 1] } } }],
         "sliding_joints": [)" +
          wheel("cart", "rear", rear) + ", " + wheel("cart", "front", front) + "]",
      1.5, 0.5);
  VerifyResult result;
  const auto check = [&](std::size_t frame, const Vector& centre, double x_rear, double x_front) {
    const std::string when = " after " + text_of(0.5 * static_cast<double>(frame)) + " s [m]";
    add_vector(result, "centre" + when, centre, "Lagrange's equations", body_at(run, frame).point.position,
               1e-5);
    result.add("rear wheel" + when, x_rear, "Lagrange's equations", body_at(run, frame, 1).point.position.x(),
               1e-5);
    result.add("front wheel" + when, x_front, "Lagrange's equations",
               body_at(run, frame, 2).point.position.x(), 1e-5);
  };
  check(1, {-2.648026297, 0, 0.585055376}, -2.971225580, -1.709718118);
  check(2, {-0.643654141, 0, -0.337583773}, -1.339757281, 0.233732210);
  check(3, {1.856288967, 0, 0.079364862}, 0.914808062, 2.322883163);
  return result;
}

/// 80 kg on wheels of 0.35 kg m^2 in all, radius 0.12 m, roll down 25 degrees.
VerifyResult rolls_down() {
  const double slope = 25 * std::numbers::pi / 180;
  const RunRecord run = run_bodies(
      body_text("cart", 80, {0, 0, 0}, {10, 10, 10}, R"(, "points": { "wheel": [0, 0, 0] })"),
      R"(, "beams": [{ "name": "rail", "rigid": true, "axis": { "polyline": [[0, 0, 0], )" +
          vector_text(20 * Vector(std::cos(slope), 0, -std::sin(slope))) + R"(] } }], "sliding_joints": [)" +
          wheel("cart", "wheel", {0, 0, 0}, R"(, "rolling_mass": )" + text_of(0.35 / (0.12 * 0.12), 17)) +
          "]",
      1, 1);
  VerifyResult result;
  result.add("acceleration [m/s^2]", 3.179800060, "closed form", 2 * body_at(run, 1).point.position.norm(),
             1e-6);
  return result;
}

/// A satellite on a circular orbit swings in its plane by the gradient of gravity.
VerifyResult libration() {
  constexpr double n = 2 * std::numbers::pi / 5400, period = 7439.440269, start = 50;
  const RunRecord run = run_bodies(body_text("satellite", 100, {0, 0, 0}, {8, 12, 15},
                                             R"(, "turned": { "axis": [0, 0, 1], "angle": 50 })"),
                                   R"(, "frame": { "rate": [0, 0, )" + text_of(n, 17) +
                                       R"(], "gravity_gradient": { "radial": [1, 0, 0] } })",
                                   period, period / 4, "[0, 0, 0]");
  VerifyResult result;
  const auto angle = [&](std::size_t frame) {
    return 2 * std::atan2(body_at(run, frame).turn->attitude[3], body_at(run, frame).turn->attitude[0]) *
           180 / std::numbers::pi;
  };
  result.add("angle after a period [degrees]", start, "elliptic integral", angle(4), 1e-4);
  result.add("angle after a half [degrees]", -start, "elliptic integral", angle(2), 1e-4);
  return result;
}

/// A body that follows the section of a helical rail slides down it: its inertia about the vertical counts.
VerifyResult helical_rail() {
  constexpr double R = 4, rise = 1.2;
  // A helix as a curve through many of its points: exact to 1e-9 of its radius where it is used.
  std::string points;
  for (int i = 0; i <= 400; ++i) {
    const double a = -2 * std::numbers::pi * i / 400;
    points += (i == 0 ? "" : ", ") + vector_text(Vector(R * std::cos(a), R * std::sin(a), rise * a));
  }
  const RunRecord run =
      run_bodies(body_text("cart", 90, {R, 0, 0}, {20, 20, 35}, R"(, "points": { "wheel": [4, 0, 0] })"),
                 R"(, "beams": [{ "name": "rail", "rigid": true, "orientation": { "up": [0, 0, 1] },
           "axis": { "through": [)" +
                     points + R"(] } }], "sliding_joints": [)" +
                     wheel("cart", "wheel", {R, 0, 0}, R"(, "follows": "section")") + "]",
                 1, 1);
  VerifyResult result;
  result.add("acceleration along the rail [m/s^2]", 2.757396470, "closed form",
             2 * body_at(run, 1, 1).s.value(), 1e-4);
  return result;
}

}  // namespace

std::vector<VerifyProblem> body_problems() {
  const std::string none = "rigid bodies";
  return {{"body-flips", none, flips},
          {"body-thrown", none, thrown},
          {"body-top", none, top},
          {"body-pendulum", none, compound_pendulum},
          {"body-trolley", none, trolley},
          {"body-double-pendulum", none, double_pendulum},
          {"body-gondola", none, gondola},
          {"body-satellites", none, satellites},
          {"body-slides", none, slider_on_bar},
          {"body-moments", none, moments},
          {"body-hung", none, hung_body},
          {"body-two-wheels", none, two_wheels},
          {"body-parabola", none, parabola},
          {"body-rolls", none, rolls_down},
          {"body-libration", none, libration},
          {"body-helical-rail", none, helical_rail}};
}

}  // namespace nurbeam
