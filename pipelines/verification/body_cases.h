#pragma once
#include <Eigen/Geometry>
#include <string>

#include "pipelines/verification/rope_cases.h"
#include "pipelines/verification/verify.h"

/// Rigid bodies as case files.
namespace nurbeam::verification {

std::string vector_text(const Eigen::Vector3d& v);

/// Runs a case of bodies in motion; `parts` are its other lists, `output` further keys of the output.
RunRecord run_bodies(const std::string& bodies, const std::string& parts, double end, double every,
                     const std::string& gravity = "[0, 0, -9.81]", const std::string& output = {});

/// A body with its mass, its centre and its inertia along the axes of the drawing.
std::string body_text(const std::string& name, double mass, const Eigen::Vector3d& at,
                      const Eigen::Vector3d& inertia, const std::string& more = {});

const BodyRecord& body_at(const RunRecord& run, std::size_t frame, std::size_t body = 0);
Eigen::Quaterniond attitude_of(const BodyRecord& body);
/// Its angular velocity along its own axes [rad/s].
Eigen::Vector3d own_spin(const BodyRecord& body);

/// Rows for the components of a vector that are not known to be 0.
void add_vector(VerifyResult& result, const std::string& quantity, const Eigen::Vector3d& reference,
                const std::string& source, const Eigen::Vector3d& computed, double tolerance);

/// Where a bar of this length hangs from the origin, at an angle from the vertical towards x; and that angle.
Eigen::Vector3d hanging(double angle, double length);
double angle_of(const Eigen::Vector3d& r);

/// A rail "rail" in the shape of a vertical ring about the origin, from its highest point round.
std::string ring_rail(double radius, const std::string& more = {});
/// A point of a body slides on the rail.
std::string wheel(const std::string& of, const std::string& point, const Eigen::Vector3d& near,
                  const std::string& more = {});

}  // namespace nurbeam::verification
