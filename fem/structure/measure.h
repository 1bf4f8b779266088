#pragma once
#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

namespace nurbeam {

/// Where a part of a beam ends: at a place of the undeformed beam [m], or at a rider, which runs along it.
struct PartEnd {
  double s;
  int rider = -1;
};

/// How far a part of a beam hangs below the line between its ends.
struct PartSag {
  std::string name;  ///< heads its column
  int beam;
  PartEnd from, to;
};

/// The least height of a beam over a profile of the ground, which is straight between its points [m].
struct Clearance {
  std::string name;  ///< heads its column
  int beam;
  std::vector<Eigen::Vector3d> profile;
};

/// What a beam does at a ring: where it runs through an eyelet, or leaves a reel.
struct AtRing {
  enum class Quantity {
    tension_before,  ///< of the beam on the side of its start [N]
    tension_behind,  ///< on the side of its end [N]
    wrap,            ///< angle by which the beam turns in it [rad]
    axial_force,     ///< where it leaves a reel [N]
    stored,          ///< reference length on a reel [m]
    out,             ///< reference length between a reel and the other end of the beam [m]
    rate,            ///< reference length that a reel pays out per second [m/s]
    power            ///< by which the beam's force drives a reel that takes in [W]
  };
  std::string name;  ///< heads its column
  int rider;
  Quantity quantity;
};

/// What a part of the model that turns does: a support, or a rotational connector.
struct OfTurn {
  enum class Quantity {
    angle,         ///< since the drawing [rad]
    spin,          ///< of a support [rad/s]
    drive_moment,  ///< about the axis, by which a support is turned on [N m]
    moment         ///< by which a connector turns its ends back together [N m]
  };
  std::string name;  ///< heads its column
  bool of_support;   ///< else of a rotational connector
  int part;          ///< number among the constraints of the model, or among its rotational connectors
  Quantity quantity;
};

/// Name and unit of a quantity.
struct TurnQuantity {
  OfTurn::Quantity quantity;
  const char* name;
  const char* unit;
};
inline constexpr TurnQuantity turn_quantities[] = {{OfTurn::Quantity::angle, "angle", "rad"},
                                                   {OfTurn::Quantity::spin, "spin", "rad/s"},
                                                   {OfTurn::Quantity::drive_moment, "drive_moment", "N m"},
                                                   {OfTurn::Quantity::moment, "moment", "N m"}};

/// What is measured of a model: shapes along its gravity, beams at rings, and parts that turn.
using Measure = std::variant<PartSag, Clearance, AtRing, OfTurn>;

/// Whether a quantity is of a reel, else of an eyelet.
constexpr bool of_reel(AtRing::Quantity quantity) { return quantity >= AtRing::Quantity::axial_force; }

/// Name and unit of a quantity.
struct RingQuantity {
  AtRing::Quantity quantity;
  const char* name;
  const char* unit;
};
inline constexpr RingQuantity ring_quantities[] = {{AtRing::Quantity::tension_before, "tension_before", "N"},
                                                   {AtRing::Quantity::tension_behind, "tension_behind", "N"},
                                                   {AtRing::Quantity::wrap, "wrap", "rad"},
                                                   {AtRing::Quantity::axial_force, "axial_force", "N"},
                                                   {AtRing::Quantity::stored, "stored", "m"},
                                                   {AtRing::Quantity::out, "out", "m"},
                                                   {AtRing::Quantity::rate, "rate", "m/s"},
                                                   {AtRing::Quantity::power, "power", "W"}};

inline const std::string& name_of(const Measure& measure) {
  return std::visit([](const auto& of) -> const std::string& { return of.name; }, measure);
}

}  // namespace nurbeam
