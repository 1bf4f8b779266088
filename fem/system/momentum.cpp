#include "fem/system/momentum.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "fem/mesh/widened.h"
#include "fem/system/material_points.h"
#include "fem/system/same_elements.h"
#include "fem/system/with_assembly.h"

namespace nurbeam {

namespace {

// Position in one element as a function of its coordinates.
template <int D>
class ElementPositions {
 public:
  ElementPositions(const MeshElement<D>& e, const ElementVector<D>& q)
      : nodes_(ElementLayout<D>::nodes(q)), basis_(e.element.basis(q)) {
    if (!e.element.fixed()) moving_ = e.element.moving_basis(q, Derivatives::one);
  }

  struct At {
    Eigen::Vector4d by_nodes;                            // by positions and slopes of the nodes
    std::array<Eigen::Matrix<double, D, 1>, 2> by_ends;  // of r at a fixed s, by the places of both ends
  };
  At at(double s) const {
    if (!moving_) {
      const std::array<double, 4> values = basis_.at(s).value;
      const Eigen::Matrix<double, D, 1> none = Eigen::Matrix<double, D, 1>::Zero();
      return {Eigen::Map<const Eigen::Vector4d>(values.data()), {none, none}};
    }
    const MovingRows::Series r = moving_->positions_at(s);
    return {r.value, {nodes_ * r.first[0], nodes_ * r.first[1]}};
  }

 private:
  ElementNodes<D> nodes_;
  ElementBasis<double> basis_;
  std::optional<MovingBasis> moving_;
};

// Material velocities and spins of a motion, at places asked for element by element.
template <int D>
class VelocityField {
 public:
  VelocityField(const Assembly<D>& assembly, const State& state) : assembly_(&assembly), state_(&state) {}

  Eigen::Matrix<double, D, 1> velocity(int beam, double s) {
    using Layout = ElementLayout<D>;
    const MeshElement<D>& e = element_at(beam, s);
    if (!positions_) positions_.emplace(e, x_.q);
    const auto at = positions_->at(e.local(x_.q, s));
    return x_.node_rates() * at.by_nodes + x_.v[Layout::place(0)] * at.by_ends[0] +
           x_.v[Layout::place(1)] * at.by_ends[1];
  }

  double spin(int beam, double s) requires(D == 3) {
    const MeshElement<D>& e = element_at(beam, s);
    if (!spins_) {
      const TwistState x = gather_twist(e, *state_);
      spins_.emplace(Spins{{e.twist->element, x.q}, x.v});
    }
    return spins_->rows.at(e.local(x_.q, s)).dot(spins_->rates);
  }

 private:
  const MeshElement<D>& element_at(int beam, double s) {
    const int span = find_span(*assembly_->model(), assembly_->mesh(), state_->q, beam, s);
    const MeshElement<D>& e = assembly_->elements()[span];
    if (std::exchange(span_, span) == span) return e;
    x_ = gather<D>(e, *state_);
    positions_.reset();
    spins_.reset();
    return e;
  }

  const Assembly<D>* assembly_;
  const State* state_;
  // Spin rows of the last element asked for.
  struct Spins {
    TwistElement::MaterialSpinRows rows;
    TwistLayout::Coordinates rates;
  };
  int span_ = -1;
  ElementState<D> x_;
  std::optional<ElementPositions<D>> positions_;
  std::optional<Spins> spins_;
};

// The places that divide an element for integration: its ends, nodes of both meshes and breaks. Moving nodes
// are taken at the riders' present places.
template <int D>
std::vector<double> parts_of(const MeshElement<D>& e, const Mesh& mesh, const Mesh& old, const State& state) {
  const ReferenceCurve& curve = e.element.curve();
  const MeshSpan& span = *e.span;
  const auto rider_at = [&](const MeshNode& node) { return state.q[old.riders[node.rider].place]; };
  std::vector<double> parts{span.place_a >= 0 ? rider_at(mesh.node_a(span)) + span.shift_a : span.s_a,
                            span.place_b >= 0 ? rider_at(mesh.node_b(span)) + span.shift_b : span.s_b};
  const auto add = [&](double place) {
    const double s = curve.unrolled(place, (span.s_a + span.s_b) / 2);
    if (s > parts[0] && s < parts[1]) parts.push_back(s);
  };
  for (const MeshNode& node : old.nodes[span.beam]) add(node.place >= 0 ? state.q[node.place] : node.s);
  for (const double s : curve.breaks()) add(s);
  std::sort(parts.begin(), parts.end());
  return parts;
}

// Calls visit(s, length) for the quadrature points of all parts.
template <class Visit>
void for_each_point(const std::vector<double>& parts, Visit&& visit) {
  for (std::size_t part = 0; part + 1 < parts.size(); ++part) {
    const double length = parts[part + 1] - parts[part];
    for (int g = 0; g < GaussRule::size; ++g)
      visit(parts[part] + length * GaussRule::points[g], length * GaussRule::weights[g]);
  }
}

// Calls visit(roll, at) for the inertia of each body that rolls with a section.
template <class Visit>
void for_each_roll(const BeamSystem& system, Visit&& visit) {
  const Assembly<3>* assembly = system.assembly<3>();
  if (!assembly) return;
  for (const BoundForce<3>& force : assembly->forces())
    std::visit(
        [&](const auto& f) {
          if constexpr (offers_of<decltype(f)>.roll) visit(f, assembly->beams());
        },
        force);
}

}  // namespace

BodyMotions body_motions(const BeamSystem& system, const State& state) {
  BodyMotions motions;
  for (const int r : system.mesh().bodies) {
    motions.velocities.emplace_back(Eigen::Vector3d::Zero());
    motions.velocities.back().head(system.dimension()) = state.v.segment(r, system.dimension());
  }
  motions.spins.assign(system.model().riders.size(), 0);
  for_each_roll(system, [&](const auto& roll, const MeshedBeams<3>& at) {
    motions.spins[roll.rider()] = roll.spin(at, state);
  });
  return motions;
}

CarriedMomentum::CarriedMomentum(const BeamSystem& from, const State& state, const BeamSystem& to)
    : to_(&to), bodies_(body_motions(from, state)), kept_(Eigen::VectorXd::Zero(to.coordinate_count())) {
  if (to.dimension() == 2)
    carry<2>(from, state);
  else
    carry<3>(from, state);
}

template <int D>
void CarriedMomentum::carry(const BeamSystem& from, const State& state) {
  const Assembly<D>&own = *to_->assembly<D>(), &old = *from.assembly<D>();
  const std::vector<const MeshElement<D>*> same = same_elements<D>(own, old);
  VelocityField<D> velocities(old, state);
  for (std::size_t i = 0; i < same.size(); ++i) {
    const MeshElement<D>& e = own.elements()[i];
    const bool is_kept = same[i] && e.element.fixed();
    if (is_kept) {
      const ElementNodes<D> momentum = e.element.nodal_momentum(node_rates(*same[i], state.v));
      for (int k = 0; k < ElementLayout<D>::nodal; ++k) kept_[e.dofs[k]] += momentum.reshaped()[k];
      if (!e.twist) continue;
    }
    const std::vector<double> parts = parts_of(e, own.mesh(), old.mesh(), state);
    if (!is_kept) {
      Element<Eigen::Vector3d>& axis = axes_.emplace_back(Element<Eigen::Vector3d>{i});
      for_each_point(parts, [&](double s, double length) {
        axis.points.push_back({s, length, widened<D>(velocities.velocity(e.span->beam, s))});
      });
    }
    if constexpr (D == 3) {
      if (!e.twist) continue;
      Element<double>& sections = sections_.emplace_back(Element<double>{i});
      for_each_point(parts, [&](double s, double length) {
        sections.points.push_back({s, length, velocities.spin(e.span->beam, s)});
      });
    }
  }
  for (std::size_t body = 0; body < bodies_.velocities.size(); ++body)
    kept_.segment<D>(to_->mesh().bodies[body]) +=
        to_->model().bodies[body].mass * bodies_.velocities[body].head<D>();
  for (const BoundForce<D>& force : old.forces())
    std::visit(
        [&](const auto& f) {
          if constexpr (offers_of<decltype(f)>.carried_momentum) f.add_momentum_in(to_->mesh(), state, kept_);
        },
        force);
  for (const BoundForce<D>& force : own.forces())
    std::visit(
        [&](const auto& f) {
          if constexpr (offers_of<decltype(f)>.momentum_at_place)
            f.add_momentum_of(material_point(from, state, f.beam(), f.s()).velocity, kept_);
        },
        force);
}

Eigen::VectorXd CarriedMomentum::on(const State& state) const {
  Eigen::VectorXd p = kept_;
  with_assembly(
      *to_,
      [&]<int D>(const Assembly<D>& assembly) {
        using Layout = ElementLayout<D>;
        for (const auto& [index, points] : axes_) {
          const MeshElement<D>& e = assembly.elements()[index];
          const ElementPositions<D> positions(e, gather<D>(e, state.q));
          for (const auto& [s, length, v] : points) {
            const auto at = positions.at(s);
            const Eigen::Matrix<double, D, 1> momentum =
                e.element.properties().mass_per_length * length * v.template head<D>();
            for (int k = 0; k < Layout::nodal; ++k) p[e.dofs[k]] += at.by_nodes[k / D] * momentum[k % D];
            for (const int end : {0, 1})
              if (const int place = e.dofs[Layout::place(end)]; place >= 0)
                p[place] += at.by_ends[end].dot(momentum);
          }
        }
        if constexpr (D == 3)
          for (const auto& [index, points] : sections_) {
            const MeshElement<3>& e = assembly.elements()[index];
            const TwistElement::MaterialSpinRows rows(e.twist->element, gather_twist(e, state.q));
            TwistLayout::Coordinates momentum = TwistLayout::Coordinates::Zero();
            for (const auto& [s, length, spin] : points) momentum += length * spin * rows.at(s);
            momentum *= e.element.properties().sections->spin_inertia;
            for (int k = 0; k < TwistLayout::size; ++k)
              if (e.twist->dofs[k] >= 0) p[e.twist->dofs[k]] += momentum[k];
          }
      });
  for_each_roll(*to_, [&](const auto& roll, const MeshedBeams<3>& at) {
    roll.add_momentum(at, state, bodies_.spins[roll.rider()], p);
  });
  return p;
}

}  // namespace nurbeam
