#pragma once
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "fem/constraints/constraint.h"
#include "fem/element/element_batch.h"
#include "fem/forces/force.h"
#include "fem/model/beam_model.h"
#include "fem/system/pattern_shift.h"
#include "solver/algebra/side_by_side.h"
#include "solver/system/second_order_system.h"

namespace nurbeam {

/// Elements, constraints and forces of a model in one mesh, behind SecondOrderSystem: the only loop over
/// elements.
///
/// Multipliers are in the order of the model's constraints, then of ConstraintSources.
template <int D>
class Assembly final : public SecondOrderSystem {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;

  /// `held`: riders whose place is held at its value in the plan. `like`: a system of the same model, from
  /// which common elements are taken. `neighbour`: a system with this plan, from which the pattern is taken
  /// if it is equal.
  Assembly(std::shared_ptr<const BeamModel> model, MeshPlan plan, const std::vector<bool>& held,
           const Assembly* like = nullptr, const Assembly* neighbour = nullptr);
  // Not copied: constraints and elements refer to this mesh.
  Assembly(const Assembly&) = delete;
  Assembly& operator=(const Assembly&) = delete;

  const std::shared_ptr<const BeamModel>& model() const { return model_; }
  const Mesh& mesh() const { return mesh_; }
  const std::vector<bool>& held() const { return held_; }
  const std::vector<MeshElement<D>>& elements() const { return elements_; }
  const std::vector<BoundForce<D>>& forces() const { return forces_; }
  MeshedBeams<D> beams() const { return {*model_, mesh_, elements_}; }

  /// First multiplier and number of multipliers of a constraint.
  struct Rows {
    int first = 0, count = 0;
  };
  /// The rows of constraint i of the model.
  const Rows& rows_of(int i) const { return constraint_rows_[i]; }
  /// Calls visit(constraint, rows) for every constraint of the mesh in turn.
  template <class Visit>
  void for_each_constraint(Visit&& visit) const {
    for (std::size_t i = 0; i < constraints_.size(); ++i)
      std::visit([&](const auto& c) { visit(c, Rows{constraint_blocks_[i].row, c.rows}); }, constraints_[i]);
  }

  /// Calls visit(constraint, rows) for constraint i of the mesh.
  template <class Visit>
  void visit_constraint(int i, Visit&& visit) const {
    std::visit([&](const auto& c) { visit(c, Rows{constraint_blocks_[i].row, c.rows}); }, constraints_[i]);
  }
  /// Numbers of the forces and constraints of the mesh that belong to parts of the structure; -1 where there
  /// is none.
  struct Parts {
    std::vector<int> friction, held_places;  ///< per rider: its force; the constraint of its place
    std::vector<int> springs, rods;          ///< per connector: its force, or its constraint
    std::vector<int> contacts;               ///< per stop: the constraint that keeps it closed
  };
  const Parts& parts() const { return parts_; }

  /// Force and couple, by the multipliers, on the beam that constraint i of the model holds, or on the first
  /// of two beams [N], [N m]; impulses where `multipliers` are impulses.
  std::pair<Eigen::Vector3d, Eigen::Vector3d> reaction(int i, const State& state,
                                                       const Eigen::VectorXd& multipliers) const;
  /// The moment about its axis by which constraint i of the model turns what it holds [N m].
  double drive_moment(int i, const State& state) const;
  /// Force on a body, without weight, inertia and the forces of riders [N].
  Vector force_on_body(int body, const State& state) const;
  /// The sum of the energies of the elements' axes, with the potential of gravity. `of`: the elements that
  /// count; null: all.
  ElementEnergy axis_energy(const State& state, const std::vector<bool>* of = nullptr) const;
  /// Deformed length of a beam [m].
  double length(int beam, const State& state) const;
  /// Inertia less forces of one element, in its own coordinates, under a load by line_load.
  ElementVector<D> element_force(const MeshElement<D>& e, const State& state, const Vector& load) const;
  /// The dead load of a beam per reference length, its weight included [N/m].
  Vector line_load(int beam, const State& state) const;
  /// The free strain of a beam that has elements, as State::load scales it.
  double free_strain_of(int beam, const State& state) const {
    return free_strain(elements_[mesh_.first_span[beam]], state);
  }
  /// Per element: whether it behaves differently from that of `other`, a system of one mesh of a neighbouring
  /// model, apart from loads and free strains. The comparison is to round-off, for sections in these states,
  /// and for moving ends at corresponding places. `known`: results that are known already, per element; may
  /// be empty.
  std::vector<bool> elements_unlike(const Assembly& other, const std::vector<State>& states,
                                    const std::vector<std::optional<bool>>& known) const;
  /// Whether only elements and loads can differ from `other`, a system of the same kind. Then no forces but
  /// inertia and weight of bodies act, there are no prescribed motions, and the constraints agree to
  /// round-off in these states. The two states must be general and correspond to each other.
  bool differs_in_elements(const Assembly& other, const State& own, const State& of_other) const;
  /// The sides of laws with a kink at 0, for State::sides: for each element whether it is taut, then for each
  /// connector of one sign whether it carries. Empty where there are no such laws.
  Eigen::VectorXd sides(const State& state) const;
  /// Adds to the dynamics of a residual the forces of these elements and all contributions that are no
  /// elements; the constraints need no more.
  void add_residual_of(const std::vector<int>& elements, const State& state,
                       Eigen::Ref<Eigen::VectorXd> dynamics, Eigen::Ref<Eigen::VectorXd> constraints) const;
  /// Forces and couples of forces and bodies on points of beams; those of bodies and supports at nodes act at
  /// the nodes.
  std::vector<PointAction> actions(const State& state) const;
  /// Moves bodies that stand apart to where their nodes, or the sections that they follow, carry them, and
  /// gives them the velocities there.
  void carry_bodies(State& state) const;
  /// Whether the forces of an element are those of form P, for comparison.
  bool is_form_p(const MeshElement<D>& e) const {
    return !e.element.fixed() && model_->beams[e.span->beam].form == Form::virtual_work;
  }

  int coordinate_count() const override { return mesh_.coordinate_count; }
  int constraint_count() const override { return constraint_count_; }
  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd> constraints) const override;
  void constraints(const State& state, Eigen::Ref<Eigen::VectorXd> constraints) const override;
  const SparsePattern& tangent_pattern() const override { return pattern_; }
  void tangent(const State& state, const TangentWeights& w, SparseValues kkt) const override;
  void tangents(const State& state, const std::array<TangentWeights, 2>& w,
                const std::array<Eigen::SparseMatrix<double>*, 2>& kkt) const override;
  void residual_near(const State& state, const std::vector<bool>& near, Eigen::Ref<Eigen::VectorXd> dynamics,
                     Eigen::Ref<Eigen::VectorXd> constraints) const override;
  void tangent_near(const State& state, const TangentWeights& w, const std::vector<bool>& near,
                    double* values) const override;
  /// Unknowns of elements with moving ends and of riders' places, and those that constraints tie to them.
  const std::vector<int>& moving_unknowns() const override { return moving_.unknowns; }
  void moving_tangent(const State& state, const TangentWeights& w, Eigen::MatrixXd& part) const override;
  bool has_constant_constraints() const override;
  void turning_speeds(const State& state, Eigen::Ref<Eigen::VectorXd> speeds) const override;
  Eigen::VectorXd constraint_rate(const State& state) const override;
  Eigen::VectorXd constraint_product(const State& state, const Eigen::VectorXd& x) const override;
  Eigen::VectorXd constraint_curvature(const State& state) const override;
  double step_limit(const State& state) const override;
  bool admissible(const State& state) const override;
  Eigen::VectorXd coordinate_scale() const override;
  Eigen::VectorXd committed(const State& state) const override;
  bool forces_depend_on_multipliers() const override;
  bool has_constant_inertia() const override;

 private:
  // A run of entries: rows that follow one another in columns that do too. `value`: index of the first entry
  // among the values of the iteration matrix; `stride`: distance between columns.
  struct Run {
    int value, stride;
    std::uint8_t column, columns, row, rows;

    /// Adds a column if it follows; `first`: index of its first entry.
    bool takes(int next, int first) {
      const int by = first - value - (columns - 1) * stride;
      if (next != column + columns || (columns > 1 && by != stride)) return false;
      stride = by;
      ++columns;
      return true;
    }
  };
  using Runs = std::span<const Run>;
  // Coordinates of one contribution, -1 where there is none, and the runs of its entries.
  struct Block {
    std::vector<int> dofs;
    std::vector<Run> runs;
  };
  // The runs of the entries of elements, in order.
  struct ElementRuns {
    std::vector<Run> runs;
    std::vector<int> starts = {0};  // first run of each element, and the end

    Runs operator[](int i) const { return {runs.data() + starts[i], runs.data() + starts[i + 1]}; }
    /// Appends the runs of elements `first` to `end` of another list, whose entries lie further on by `by`.
    void append(const ElementRuns& other, int first, int end, int by) {
      const int before = static_cast<int>(runs.size()) - other.starts[first];
      for (int i = first; i < end; ++i) starts.push_back(other.starts[i + 1] + before);
      const auto of = other.runs.begin();
      const auto added = runs.insert(runs.end(), of + other.starts[first], of + other.starts[end]);
      std::for_each(added, runs.end(), [&](Run& run) { run.value += by; });
    }
  };
  struct ConstraintBlock {
    int row, rows;
    Block block;
    std::vector<int> gradient_values, transposed_values;  // rows x dofs, column by column
  };
  // The part of the tangent that changes most often, with positions in a matrix of its own.
  struct MovingPart {
    std::vector<int> unknowns;
    std::vector<int> elements, constraints;
    ElementRuns element_runs, twist_runs;            // of `elements`
    std::vector<ConstraintBlock> constraint_blocks;  // of `constraints`
  };
  // The elements of one beam. `batched`: elements computed in batches, in the order of the batches; `others`:
  // the rest.
  struct Walk {
    std::vector<ElementBatch<D>> batches;
    std::vector<int> batched, others;
    std::vector<std::array<int, 2>> reaches;  // the lowest and the highest coordinate of each batch
  };
  template <class Wanted>
  struct Sink;
  struct All;
  struct Near;
  enum class Moving { included, left_out };  // elements whose ends move

  void batch_elements();
  void bind_constraints(Binding<D>& binding);
  void find_parts();
  void bind_forces(const Binding<D>& binding);
  void list_blocks();
  bool couples_as(const Assembly& other) const;
  void take_pattern(const Assembly& other);
  bool shift_pattern(const Assembly& other);
  void build_pattern();
  void locate_blocks();
  CoupledGroups coupled_groups() const;
  void mark_constrained(std::vector<bool>& marked) const;
  void choose_moving_part();
  template <class Matrix>
  static void scatter(Runs runs, const Matrix& matrix, double* values);
  // The coordinates of an element's sections; none without torsion.
  std::span<const int> twist_dofs(int element) const {
    if (!elements_[element].twist) return {};
    return elements_[element].twist->dofs;
  }
  template <class IndexOf>
  static void locate(std::span<const int> dofs, const IndexOf& index_of, std::vector<Run>& runs);
  template <class IndexOf>
  void locate_elements(const std::vector<int>& elements, const IndexOf& index_of, ElementRuns& element_runs,
                       ElementRuns& twist_runs) const;
  template <class IndexOf>
  void locate(ConstraintBlock& block, const IndexOf& index_of) const;
  template <class Work>
  static void for_each_batch(const Walk& walk, const Work& work);
  void add_element_tangent(int i, const State& state, const Vector& load, const TangentWeights& w, Runs runs,
                           Runs twist_runs, double* values) const;
  template <class Wanted>
  void add_tangents(const State& state, const TangentWeights& w, const Wanted& wanted, double* values,
                    Moving moving = Moving::included) const;
  template <class Wanted>
  void add_batch_tangents(int beam, const State& state, const TangentWeights& w, const Wanted& wanted,
                          double* values) const;
  void add_constraint_tangent(int i, const State& state, const TangentWeights& w,
                              const ConstraintBlock& block, double* values) const;
  int part_count(int beam) const;
  void add_element(const MeshElement<D>& e, const State& state, const Vector& load,
                   Eigen::Ref<Eigen::VectorXd> dynamics) const;
  void add_part(int beam, int part, const State& state, const Vector& load,
                Eigen::Ref<Eigen::VectorXd> dynamics) const;
  void add_constraint_product(int i, const State& state, const Eigen::VectorXd& x,
                              Eigen::Ref<Eigen::VectorXd> product) const;
  void add_forces_and_constraints(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                                  Eigen::Ref<Eigen::VectorXd> constraints) const;

  std::shared_ptr<const BeamModel> model_;
  Mesh mesh_;
  std::vector<bool> held_;
  std::vector<int> moving_spans_;  // spans with a moving end
  std::vector<MeshElement<D>> elements_;
  std::vector<Walk> walks_;  // per beam
  std::vector<BoundConstraint<D>> constraints_;
  std::vector<int> turning_;  // constraints whose gradient turns
  Parts parts_;
  std::vector<BoundForce<D>> forces_;

  int constraint_count_ = 0;
  std::vector<Rows> constraint_rows_;  // rows of the model's constraints
  ElementRuns element_runs_;
  ElementRuns twist_runs_;  // for beams with torsion; empty for other elements
  std::vector<Block> force_blocks_;
  std::vector<ConstraintBlock> constraint_blocks_;
  std::vector<int> over_mesh_;  // constraints that move over the mesh
  MovingPart moving_;
  SparsePattern pattern_;
};

// Calls work(i) for each batch, in a long beam several at a time. The beam is divided into an even number of
// pieces; first every other piece is worked on, then the rest. Two batches with a common node, on a ring also
// the first and the last, are thus never worked on at once. A node has only the two elements beside it, so
// sums do not depend on the order.
template <int D>
template <class Work>
void Assembly<D>::for_each_batch(const Walk& walk, const Work& work) {
  constexpr int shortest = 32, fewest = 8;
  const int count = static_cast<int>(walk.batches.size());
  const int pieces = count / (2 * shortest) * 2;
  const auto begin = [&](int piece) { return static_cast<int>(static_cast<long>(count) * piece / pieces); };
  if (pieces < fewest) {
    for (int i = 0; i < count; ++i) work(i);
    return;
  }
  for (int first : {0, 1})
    side_by_side(pieces / 2, [&](int k) {
      const int piece = 2 * k + first;
      for (int i = begin(piece); i < begin(piece + 1); ++i) work(i);
    });
}

extern template class Assembly<2>;
extern template class Assembly<3>;

}  // namespace nurbeam
