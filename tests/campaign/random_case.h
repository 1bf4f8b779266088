#pragma once
#include <nlohmann/json.hpp>

namespace nurbeam::campaign {

using Json = nlohmann::ordered_json;

/// A case that nobody would think of: planar or spatial, one to three beams of lines, arcs, splines and
/// rings, cables or with torsion, supports, joints, sliding bodies, loads and motions over time, any
/// integrator. The same for the same seed. It moves for some hundred steps at most.
Json random_case(unsigned long seed);
/// The same of what resists, holds and connects: bodies with friction, drag and stops on guides, rings, ropes
/// and bars, in the plane and in space, with loads that hang on them, trains and droppers.
Json random_mechanics(unsigned long seed);

}  // namespace nurbeam::campaign
