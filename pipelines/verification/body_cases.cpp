#include "pipelines/verification/body_cases.h"

#include <cmath>
#include <utility>

#include "nurbs/number_text.h"

namespace nurbeam::verification {

using Vector = Eigen::Vector3d;

std::string vector_text(const Vector& v) {
  return "[" + text_of(v.x(), 17) + ", " + text_of(v.y(), 17) + ", " + text_of(v.z(), 17) + "]";
}

RunRecord run_bodies(const std::string& bodies, const std::string& parts, double end, double every,
                     const std::string& gravity, const std::string& output) {
  return run_text(R"({ "nurbeam": 1, "gravity": )" + gravity + R"(, "bodies": [)" + bodies + "]" + parts +
                  R"(, "analysis": { "end_time": )" + text_of(end, 17) +
                  R"(, "tolerance": 1e-9, "integrator": { "type": "radau" } }, "output": { "every": )" +
                  text_of(every, 17) + output + " } }");
}

std::string body_text(const std::string& name, double mass, const Vector& at, const Vector& inertia,
                      const std::string& more) {
  return R"({ "name": ")" + name + R"(", "mass": )" + text_of(mass, 17) + R"(, "position": )" +
         vector_text(at) + R"(, "inertia": )" + vector_text(inertia) + more + " }";
}

const BodyRecord& body_at(const RunRecord& run, std::size_t frame, std::size_t body) {
  return run.frames.at(frame).bodies.at(body);
}
Eigen::Quaterniond attitude_of(const BodyRecord& body) {
  const Eigen::Vector4d& q = body.turn->attitude;
  return {q[0], q[1], q[2], q[3]};
}
Vector own_spin(const BodyRecord& body) { return attitude_of(body).conjugate() * body.turn->spin; }

void add_vector(VerifyResult& result, const std::string& quantity, const Vector& reference,
                const std::string& source, const Vector& computed, double tolerance) {
  for (int k = 0; k < 3; ++k)
    if (reference[k] != 0)
      result.add(quantity + "." + "xyz"[k], reference[k], source, computed[k], tolerance);
}

Vector hanging(double angle, double length) {
  return {length * std::sin(angle), 0, -length * std::cos(angle)};
}
double angle_of(const Vector& r) { return std::atan2(r.x(), -r.z()); }

std::string ring_rail(double radius, const std::string& more) {
  std::string points, weights;
  for (const auto& [x, z] :
       {std::pair{0, 1}, {1, 1}, {1, 0}, {1, -1}, {0, -1}, {-1, -1}, {-1, 0}, {-1, 1}, {0, 1}}) {
    points += (points.empty() ? "" : ", ") + vector_text(Vector(radius * x, 0, radius * z));
    weights += (weights.empty() ? "" : ", ") + text_of(x != 0 && z != 0 ? std::sqrt(0.5) : 1.0, 17);
  }
  return R"({ "name": "rail", "rigid": true, "axis": { "nurbs": { "degree": 2, "control_points": [)" +
         points + R"(], "weights": [)" + weights + R"(], "knots": [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4] } })" +
         more + " }";
}
std::string wheel(const std::string& of, const std::string& point, const Vector& near,
                  const std::string& more) {
  return R"({ "body": ")" + of + R"(", "point": ")" + point + R"(", "beam": "rail", "at": { "near": )" +
         vector_text(near) + " }" + more + " }";
}

}  // namespace nurbeam::verification
