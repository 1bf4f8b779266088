#pragma once
using Constraint = std::variant<Support, BeamJoint>;
