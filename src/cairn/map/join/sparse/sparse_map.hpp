// SPDX-License-Identifier: BSD-3-Clause
// The sparse joining: all submaps solved for together, each as one dense observation of its base, its end and its
// landmarks, by damped Gauss-Newton on a factor that a closing changes only where it reaches (docs/submaps.md).
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "geometry/embedding.hpp"
#include "map/global_map.hpp"
#include "map/join/sparse/elimination_tree.hpp"
#include "map/join/sparse/submap_factor.hpp"
#include "map/merge/merge.hpp"
#include "map/spatial_index.hpp"

namespace cairn {

template <class Pose>
class SparseMap final : public GlobalMap<Pose>, private LeafSource {
 public:
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using Point = typename Pose::Point;
  using Rotation = typename Pose::Rotation;
  using Square = typename Pose::Square;
  using Tangent = typename Rotation::Tangent;  // of a turn
  using Jacobian = typename Rotation::Jacobian;
  using PointSquare = typename Rotation::Matrix;

  explicit SparseMap(const MapOptions<Pose>& options);
  SparseMap(const SparseMap& other);
  SparseMap& operator=(const SparseMap&) = delete;

  std::unique_ptr<MapTransaction<Pose>> begin() override;
  void remove(std::uint64_t id) override;
  Pose base() const override { return bases_.back(); }
  Square base_covariance() const override { return base_covariance_; }
  void base_joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const override;
  std::size_t submap_count() const override { return leaves_.size(); }
  Pose submap_base(std::size_t submap) const override { return bases_[submap]; }
  const std::vector<std::uint64_t>& submap_ids(std::size_t submap) const override { return leaves_[submap].data->ids; }

  // Landmarks
  std::size_t size() const override { return visible_.size(); }
  std::uint64_t id(std::size_t index) const override { return landmarks_[visible_[index]].id; }
  std::uint64_t observations(std::size_t index) const override { return landmarks_[visible_[index]].count; }
  Vector3 position(std::size_t index) const override { return Embedding<Pose>::up(point(index)); }
  Matrix3 covariance(std::size_t index) const override;
  bool find(std::uint64_t id, std::size_t& index) const override;
  void joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const override;
  void prepare_covariances(const std::vector<std::size_t>& indices) const override;
  const SpatialIndex* spatial_index() const override { return &index_; }
  MapKind kind() const override { return MapKind::sparse; }
  std::unique_ptr<Landmarks> copy() const override { return std::make_unique<SparseMap>(*this); }

  std::size_t memory_bytes() const;
  double cost() const;  // half the sum of all squared normalised residuals

  // Of space alone. Takes in another map, whose landmarks go by these ids here; `plan` says which are the same and how
  // the frames lie. A call that throws leaves the map in no state to be used: work on a copy (sparse_merge.cpp).
  void append(const SparseMap& other, const MergePlan& plan, const MergeOptions& options, MergeReport& report);

 private:
  using Number = std::uint32_t;
  static constexpr Number kNone = UINT32_MAX;

  struct Landmark {
    std::uint64_t id;
    std::uint64_t count;
    Point position;
    std::vector<Number> submaps;  // that hold it
    Number slot;                  // in visible_, kNone once removed
    Number saved;                 // the change that saved it last
  };
  using Data = SubmapData<Pose>;
  using Factor = SubmapFactor<Pose>;
  using Values = FactorValues<Pose>;
  using Tree = EliminationTree<Pose>;
  struct Leaf {
    TreeKey key;
    std::shared_ptr<const Data> data;
    std::vector<Number> landmarks;  // of the map, by the submap's; kNone: left out
    std::shared_ptr<const Factor> factor;
    std::vector<Variable> variables;  // ascending
    std::vector<Index> states;        // where each begins
    std::vector<Index> order;         // state of the variables by state of the factor
    // How all stood to the base when the tree took its information: the end, the shared landmarks, the variables' axes.
    Pose end_then;
    std::vector<Point> landmarks_then;
    std::vector<Rotation> axes_then;
    double cost = 0.0;
    Eigen::VectorXd gradient;  // in the order of `variables`, in map axes when it was evaluated
    Rotation turned;           // by what it was carried along with others since
    Number saved = 0;
  };
  struct Undo;
  class Transaction;
  class Step;
  struct Before;
  struct StepEntry {  // of one variable, ordinary error in map axes
    Variable variable;
    double value[kDof];
  };
  class Columns;
  class CovarianceCache;

  // LeafSource
  const std::vector<Variable>& variables(std::uint32_t leaf) const override { return leaves_[leaf].variables; }
  void information(std::uint32_t leaf, double* H, Index ld) const override;
  bool absolute(std::uint32_t leaf) const override { return leaf == 0 || fixes_.count(leaf + 1) != 0; }

  static Index dimension(Variable v) { return cairn::dimension<Pose>(v); }
  const Point& point(std::size_t index) const { return landmarks_[visible_[index]].position; }
  bool shared(Number landmark) const { return landmarks_[landmark].submaps.size() > 1; }
  Values values(const Leaf& leaf) const;
  const Rotation& axes(Variable v) const;
  const Point& place_of(Variable v) const {
    const auto number = static_cast<Number>(v >> 1);
    return is_landmark(v) ? landmarks_[number].position : bases_[number].translation();
  }
  void to_map_axes(const std::vector<Variable>& variables, Eigen::MatrixXd& covariance) const;
  void note_linearisation(Number leaf);
  double strain(Number leaf) const;
  TreeKey key_of(Number number) const;
  void shape(Leaf& leaf, Number number) const;
  void evaluate(Number leaf);
  void add_fixes(Leaf& leaf, const std::vector<AbsoluteFix<Pose>>& fixes) const;
  Point force_on(const Leaf& leaf, Index shared_landmark) const;
  void place_private(Number leaf);
  template <class Visit>
  void for_leaves_of(Variable v, Visit&& visit) const;
  void gradient_of(Variable v, double* b) const;
  Square prior_information() const;
  Square prior_jacobian() const;

  void save_landmark(Undo& undo, Number landmark);
  void save_base(Undo& undo, Number base);
  void save_leaf(Undo& undo, Number leaf);
  void roll_back(Undo& undo) noexcept;

  Number add(const Submap<Pose>& submap, const std::vector<char>& left_out, Undo& undo, JoinReport& report);
  Number take_in(const Submap<Pose>& submap, const std::vector<char>& left_out, Undo& undo, JoinReport& report);
  void set_scales(const Submap<Pose>& submap);
  void refactor(TreeChanges changes, Undo& undo, JoinReport& report);
  void place(const Step& step, double factor, const Before& from);
  Before save_step(const Step& step, Undo& undo);
  double take_step(const Step& step, double factor, const Before& from);
  void take_back(const Step& step, Before& from);
  FixReport fix_base(const AbsoluteFix<Pose>& fix, double threshold, Undo& undo);
  void refresh_base_covariance();
  void optimise(Undo& undo, JoinReport& report);
  bool suspicious(Number leaf, const JoinReport& report) const;
  void gate(const Submap<Pose>& submap, std::vector<char>& left_out) const;
  void finish(Undo& undo, JoinReport& report);
  void note_moves(const Undo& undo) noexcept;
  double cost_since(const Undo& undo) const;
  // Of append():
  Number bridge(const Submap<Pose>& link, Undo& undo);
  bool anchored() const;
  void find_worst(Number offset, MergeReport& report, const SparseMap& other, const MergePlan& plan) const;

  MapOptions<Pose> options_;
  Pose prior_;  // the first base
  Square prior_covariance_;
  std::map<Number, std::vector<AbsoluteFix<Pose>>> fixes_;  // by base
  std::vector<Pose> bases_;
  std::vector<Number> base_saved_;
  std::vector<Landmark> landmarks_;
  std::vector<Leaf> leaves_;
  std::vector<Number> visible_;
  std::unordered_map<std::uint64_t, Number> ids_;
  Tree tree_;
  Square base_covariance_;
  // What a step is measured by: the smallest typical standard deviation of a landmark in its submap, and the turn that
  // moves the submap's farthest landmark so far.
  double length_scale_ = std::numeric_limits<double>::infinity(), turn_scale_ = length_scale_;
  std::vector<Number> pending_;  // leaves evaluated since the tree took their forces in
  bool settled_ = true;          // whether the last optimisation converged
  std::vector<Number> stale_;    // leaves to be linearised anew
  Number change_ = 0;
  SpatialIndex index_;
  mutable std::mutex mutex_;  // of what follows
  mutable std::vector<PointSquare> covariances_;
  mutable std::vector<Number> covariance_of_;  // the change that a covariance belongs to
};

// Maps of space alone are appended to each other (sparse_merge.cpp).
template <>
void SparseMap<SE3>::append(const SparseMap& other, const MergePlan& plan, const MergeOptions& options,
                            MergeReport& report);
template <>
SparseMap<SE3>::Number SparseMap<SE3>::bridge(const Submap<SE3>& link, Undo& undo);
template <>
bool SparseMap<SE3>::anchored() const;
template <>
void SparseMap<SE3>::find_worst(Number offset, MergeReport& report, const SparseMap& other,
                                const MergePlan& plan) const;

extern template class SparseMap<SE2>;
extern template class SparseMap<SE3>;

}  // namespace cairn
