// What is felt on a rail: in a loop, and on a banked curve.

#include <cmath>
#include <numbers>

#include "nurbs/number_text.h"
#include "pipelines/verification/body_cases.h"

namespace nurbeam {

namespace {

using namespace verification;
using Vector = Eigen::Vector3d;
using std::numbers::pi;

constexpr double loop = 7, gravity = 9.81;

// A moment of a run that begins there.
RunRecord moment(const std::string& bodies, const std::string& parts) {
  return run_bodies(bodies, parts, 1e-3, 1e-3, "[0, 0, -9.81]", R"(, "accelerations": true)");
}
std::string loop_rail() {
  return R"(, "beams": [)" + ring_rail(loop, R"(, "orientation": { "start": [0, 0, -1] })") + "]";
}

/// A point in a loop of 7 m, at 21 m/s where it is lowest.
VerifyResult point_in_a_loop() {
  VerifyResult result;
  for (const auto& [degrees, felt] : {std::pair{0, 7.424553747}, {90, 4.423528932}, {180, 1.422504117}}) {
    const double angle = degrees * pi / 180,
                 speed = std::sqrt(21 * 21 - 2 * gravity * loop * (1 - std::cos(angle)));
    const RunRecord run =
        moment(R"({ "name": "car", "mass": 500 })",
               loop_rail() + R"(, "sliding_joints": [{ "body": "car", "beam": "rail", "at": { "near": )" +
                   vector_text(hanging(angle, loop)) + R"( }, "speed": )" + text_of(speed, 17) + " }]");
    result.add("load factor upwards at " + std::to_string(degrees) + " degrees", felt, "energy and v^2/R",
               body_at(run, 0).felt->load_factor.z(), 1e-6);
  }
  return result;
}

/// A body on two wheels 1.8 m apart in that loop, 3 rad/s where it is lowest; its centre is 1 m inside.
VerifyResult cart_in_a_loop() {
  constexpr double mass = 500, inertia = 200, half = 0.9;
  const double inside = std::sqrt(loop * loop - half * half), lever = inside - 1,
               open = std::asin(half / loop);
  VerifyResult result;
  const std::string source = "energy and Newton's law";
  for (const auto& [degrees, x, z, seat_x, seat_z] :
       {std::tuple{0, 0., 6.453489806, -0.550646755, 6.178166429},
        {90, 0.011206364, 3.474877720, -0.289738709, 3.199554343},
        {180, 0., 0.496265634, -0.151124064, 0.420703602}}) {
    const double angle = degrees * pi / 180;
    const double spin =
        std::sqrt(9 - 2 * mass * gravity * lever * (1 - std::cos(angle)) / (mass * lever * lever + inertia));
    // It runs towards greater angles.
    const Vector forward(std::cos(angle), 0, std::sin(angle)), inwards(-std::sin(angle), 0, std::cos(angle));
    const Vector middle = -inside * inwards;
    const Vector front = hanging(angle + open, loop), rear = hanging(angle - open, loop);
    const RunRecord run =
        moment(body_text("cart", mass, middle + inwards, {inertia, inertia, inertia},
                         R"(, "axes": { "x": )" + vector_text(forward) + R"(, "z": )" + vector_text(inwards) +
                             R"( }, "angular_velocity": )" + vector_text(Vector(0, -spin, 0)) +
                             R"(, "points": { "front": )" + vector_text(front) + R"(, "rear": )" +
                             vector_text(rear) + R"(, "seat": )" +
                             vector_text(middle + 0.6 * forward + 1.3 * inwards) + " }"),
               loop_rail() + R"(, "sliding_joints": [)" + wheel("cart", "front", front) + ", " +
                   wheel("cart", "rear", rear) + "]");
    const std::string when = " at " + std::to_string(degrees) + " degrees";
    const Vector centre = body_at(run, 0).felt->load_factor, seat = body_at(run, 0, 3).felt->load_factor;
    result.add("load factor of the centre, forward" + when, x, source, centre.x(), 1e-6);
    result.add("upwards" + when, z, source, centre.z(), 1e-6);
    result.add("load factor of the seat, forward" + when, seat_x, source, seat.x(), 1e-6);
    result.add("upwards there" + when, seat_z, source, seat.z(), 1e-6);
  }
  return result;
}

/// On a level circle of 20 m at 12 m/s, banked by 30 degrees; the centre is 1.1 m up along the section.
VerifyResult banked_curve() {
  constexpr double radius = 20, bank = pi / 6, up = 1.1;
  const double c = std::cos(bank), s = std::sin(bank);
  const Vector at(radius, 0, 0), forward(0, 1, 0), section_up(-s, 0, c);
  std::string points, weights;
  for (const auto& [x, y] :
       {std::pair{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}}) {
    points += (points.empty() ? "" : ", ") + vector_text(Vector(radius * x, radius * y, 0));
    weights += (weights.empty() ? "" : ", ") + text_of(x != 0 && y != 0 ? std::sqrt(0.5) : 1.0, 17);
  }
  const RunRecord run = moment(
      body_text("car", 500, at + up * section_up, {150, 300, 350},
                R"(, "axes": { "x": [0, 1, 0], "z": )" + vector_text(section_up) +
                    R"( }, "points": { "bogie": )" + vector_text(at) + " }"),
      R"(, "beams": [{ "name": "rail", "rigid": true, "orientation": { "up": [0, 0, 1], "twist": [[0, -30], [1000, -30]] },
           "axis": { "nurbs": { "degree": 2, "control_points": [)" +
          points + R"(], "weights": [)" + weights +
          R"(], "knots": [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4] } } }], "sliding_joints": [)" +
          wheel("car", "bogie", at, R"(, "follows": "section", "speed": 12)") + "]");
  VerifyResult result;
  const std::string source = "Newton's law";
  const Vector felt = body_at(run, 0).felt->load_factor;
  result.add("load factor upwards", 1.223323888, source, felt.z(), 1e-6);
  result.add("to the left", 0.118175919, source, felt.y(), 1e-6);
  const Vector force = body_at(run, 0, 1).joint_force, left = section_up.cross(forward);
  result.add("force of the rail upwards [N]", 5998.354606, source, force.dot(section_up), 1e-3);
  result.add("to the left [N]", 579.454939, source, force.dot(left), 1e-3);
  return result;
}

}  // namespace

std::vector<VerifyProblem> felt_problems() {
  const std::string none = "rigid bodies";
  return {{"bodies-G1", none, point_in_a_loop},
          {"bodies-G2", none, cart_in_a_loop},
          {"bodies-G3", none, banked_curve}};
}

}  // namespace nurbeam
