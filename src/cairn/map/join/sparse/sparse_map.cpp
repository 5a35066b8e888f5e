// SPDX-License-Identifier: BSD-3-Clause
// The sparse joining: leaves, transactions, closings. The solution: sparse_solve.hpp; queries: sparse_queries.hpp.
#include "map/join/sparse/sparse_map.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

#include "core/chi_square.hpp"
#include "core/error.hpp"
#include "linear/joint_gate.hpp"
#include "map/join/sparse/sparse_queries.hpp"
#include "map/join/sparse/sparse_solve.hpp"
#include "map/join/sparse/sparse_undo.hpp"
#include "sensor/sensor.hpp"

namespace cairn {

template <class Pose>
SparseMap<Pose>::SparseMap(const MapOptions<Pose>& options)
    : options_(options),
      prior_(options.initial_pose),
      prior_covariance_(options.initial_covariance),
      bases_{options.initial_pose},
      base_saved_{0},
      base_covariance_(options.initial_covariance),
      index_([this](std::size_t i) { return position(i); }) {}

template <class Pose>
SparseMap<Pose>::SparseMap(const SparseMap& other)
    : options_(other.options_),
      prior_(other.prior_),
      prior_covariance_(other.prior_covariance_),
      fixes_(other.fixes_),
      bases_(other.bases_),
      base_saved_(other.base_saved_),
      landmarks_(other.landmarks_),
      leaves_(other.leaves_),
      visible_(other.visible_),
      ids_(other.ids_),
      tree_(other.tree_),
      base_covariance_(other.base_covariance_),
      length_scale_(other.length_scale_),
      turn_scale_(other.turn_scale_),
      pending_(other.pending_),
      settled_(other.settled_),
      stale_(other.stale_),
      change_(other.change_),
      index_([this](std::size_t i) { return position(i); }) {
  for (std::size_t i = 0; i < visible_.size(); ++i) index_.add(i);
}

// --- leaves ---

template <class Pose>
FactorValues<Pose> SparseMap<Pose>::values(const Leaf& leaf) const {
  const auto number = static_cast<std::size_t>(&leaf - leaves_.data());
  Values values{bases_[number], bases_[number + 1], {}};
  values.shared.reserve(static_cast<std::size_t>(leaf.factor->shared_count()));
  for (const Index i : leaf.factor->shared()) values.shared.push_back(landmarks_[leaf.landmarks[i]].position);
  return values;
}

// Where the tree stands the leaf that begins at the base of this number.
template <class Pose>
TreeKey SparseMap<Pose>::key_of(Number number) const {
  const Point offset = bases_[number].translation() - options_.initial_pose.translation();
  return TreeKey(Embedding<Pose>::up(offset), number);
}

// The leaf's factor and variables, by which of its landmarks are shared now.
template <class Pose>
void SparseMap<Pose>::shape(Leaf& leaf, Number number) const {
  std::vector<Index> shared_ones;
  for (std::size_t i = 0; i < leaf.landmarks.size(); ++i)
    if (leaf.landmarks[i] != kNone && shared(leaf.landmarks[i])) shared_ones.push_back(static_cast<Index>(i));
  leaf.factor = std::make_shared<const Factor>(leaf.data, std::move(shared_ones));
  struct Column {
    Variable variable;
    Index state;  // of the factor
  };
  std::vector<Column> columns{{base_variable(number), 0}, {base_variable(number + 1), kDof}};
  for (Index i = 0; i < leaf.factor->shared_count(); ++i)
    columns.push_back({landmark_variable(leaf.landmarks[leaf.factor->shared()[i]]), Factor::column(i)});
  std::sort(columns.begin(), columns.end(), [](const Column& a, const Column& b) { return a.variable < b.variable; });
  leaf.variables.clear();
  leaf.states.clear();
  leaf.order.assign(static_cast<std::size_t>(leaf.factor->columns()), 0);
  Index state = 0;
  for (const Column& column : columns) {
    leaf.variables.push_back(column.variable);
    leaf.states.push_back(state);
    for (Index d = 0; d < dimension(column.variable); ++d) leaf.order[column.state + d] = state++;
  }
}

template <class Pose>
typename SparseMap<Pose>::Square SparseMap<Pose>::prior_information() const {
  // What is known exactly counts as known to a micrometre and to a tenth of a microradian.
  Square covariance = prior_covariance_;
  for (int i = 0; i < kDof; ++i) covariance(i, i) += i < kDim ? 1e-12 : 1e-14;
  const typename Pose::Tangent scale = covariance.diagonal().cwiseSqrt().cwiseInverse();
  const Square scaled = scale.asDiagonal() * covariance * scale.asDiagonal();
  return scale.asDiagonal() * scaled.ldlt().solve(Square::Identity()) * scale.asDiagonal();
}

// The tree knows errors in axes that turn with the map: a base's in its own, a landmark's in those of the base that saw
// it first. What a submap tells then depends on how things stand to each other alone, so that its linearisation stays
// good when the map around it turns as a whole.
template <class Pose>
const typename SparseMap<Pose>::Rotation& SparseMap<Pose>::axes(Variable v) const {
  const auto number = static_cast<Number>(v >> 1);
  return bases_[is_landmark(v) ? landmarks_[number].submaps[0] : number].rotation();
}

template <class Pose>
void SparseMap<Pose>::to_map_axes(const std::vector<Variable>& variables, Eigen::MatrixXd& covariance) const {
  Index state = 0;
  const auto turn = [&](const auto& R) {
    constexpr int n = std::decay_t<decltype(R)>::RowsAtCompileTime;
    covariance.middleRows<n>(state) = (R * covariance.middleRows<n>(state)).eval();
    covariance.middleCols<n>(state) = (covariance.middleCols<n>(state) * R.transpose()).eval();
    state += n;
  };
  for (const Variable v : variables) {
    turn(axes(v).matrix());
    if (!is_landmark(v)) turn(axes(v).adjoint());
  }
}

template <class Pose>
void SparseMap<Pose>::note_linearisation(Number number) {
  Leaf& leaf = leaves_[number];
  const Pose T_base_map = bases_[number].inverse();
  leaf.end_then = T_base_map * bases_[number + 1];
  leaf.landmarks_then.clear();
  for (const Index i : leaf.factor->shared())
    leaf.landmarks_then.push_back(T_base_map * landmarks_[leaf.landmarks[i]].position);
  leaf.axes_then.clear();
  for (const Variable v : leaf.variables) leaf.axes_then.push_back(T_base_map.rotation() * axes(v));
}

// How far the leaf's landmarks and axes have moved against its base since it was linearised, in the map's scales.
template <class Pose>
double SparseMap<Pose>::strain(Number number) const {
  const Leaf& leaf = leaves_[number];
  if (leaf.axes_then.size() != leaf.variables.size()) return std::numeric_limits<double>::infinity();
  const Pose T_base_map = bases_[number].inverse();
  double way = (T_base_map * bases_[number + 1].translation() - leaf.end_then.translation()).norm(), turn = 0.0;
  for (std::size_t i = 0; i < leaf.landmarks_then.size(); ++i) {
    const Point& l = landmarks_[leaf.landmarks[leaf.factor->shared()[i]]].position;
    way = std::max(way, (T_base_map * l - leaf.landmarks_then[i]).norm());
  }
  for (std::size_t i = 0; i < leaf.variables.size(); ++i)
    turn = std::max(turn, (T_base_map.rotation() * axes(leaf.variables[i]) * leaf.axes_then[i].inverse()).chord());
  return std::max(way / length_scale_, turn / turn_scale_);
}

template <class Pose>
void SparseMap<Pose>::information(std::uint32_t number, double* H, Index ld) const {
  const Leaf& leaf = leaves_[number];
  std::vector<Rotation> R{axes(base_variable(number)), axes(base_variable(number + 1))};
  for (const Index i : leaf.factor->shared()) R.push_back(axes(landmark_variable(leaf.landmarks[i])));
  Eigen::MatrixXd own = leaf.factor->hessian(values(leaf), R);
  // What tells of a base alone goes with the submap that ends there; of the first, with the one that begins there.
  const auto add = [&](Index base, Eigen::MatrixXd J, const Eigen::MatrixXd& information) {
    J.middleCols<kDim>(0) = (J.middleCols<kDim>(0) * R[base].matrix()).eval();
    J.middleCols<kTurn>(kDim) = (J.middleCols<kTurn>(kDim) * R[base].adjoint()).eval();
    own.block<kDof, kDof>(kDof * base, kDof * base) += J.transpose() * information * J;
  };
  if (number == 0) add(0, prior_jacobian(), prior_information());
  const auto fixes = fixes_.find(number + 1);
  if (fixes != fixes_.end())
    for (const AbsoluteFix<Pose>& fix : fixes->second) {
      const Eigen::MatrixXd noise = fix.covariance().topLeftCorner(fix.rows(), fix.rows());
      add(1, fix.jacobian(bases_[number + 1]).topRows(fix.rows()),
          noise.ldlt().solve(Eigen::MatrixXd::Identity(fix.rows(), fix.rows())));
    }
  // To the tree's order, by blocks of poses and of landmarks.
  const auto put = [&](Index i, Index j, auto rows, auto columns) {
    using Block = Eigen::Matrix<double, decltype(rows)::value, decltype(columns)::value>;
    using Transposed = Eigen::Matrix<double, decltype(columns)::value, decltype(rows)::value>;
    const Index row = leaf.order[i], column = leaf.order[j];
    const auto block = own.block<Block::RowsAtCompileTime, Block::ColsAtCompileTime>(i, j);
    if (row >= column)
      Eigen::Map<Block, 0, Eigen::OuterStride<>>(H + column * ld + row, Eigen::OuterStride<>(ld)) = block;
    else
      Eigen::Map<Transposed, 0, Eigen::OuterStride<>>(H + row * ld + column, Eigen::OuterStride<>(ld)) =
          block.transpose();
  };
  const std::integral_constant<int, kDof> pose;
  const std::integral_constant<int, kDim> point;
  for (const Index j : {Index{0}, Index{kDof}}) {
    for (Index i = j; i < 2 * kDof; i += kDof) put(i, j, pose, pose);
    for (Index i = Factor::column(0); i < own.rows(); i += kDim) put(i, j, point, pose);
  }
  for (Index j = Factor::column(0); j < own.cols(); j += kDim)
    for (Index i = j; i < own.rows(); i += kDim) put(i, j, point, point);
}

template <class Pose>
void SparseMap<Pose>::evaluate(Number number) {
  Leaf& leaf = leaves_[number];
  const typename Factor::Evaluation own = leaf.factor->evaluate(values(leaf));
  leaf.cost = own.cost;
  Eigen::VectorXd gradient(own.gradient.size());  // apart: a resize that fails would leave the old one torn
  for (Index i = 0; i < own.gradient.size(); ++i) gradient(leaf.order[i]) = own.gradient(i);
  leaf.gradient.swap(gradient);
  if (number == 0) {
    const typename Pose::Tangent e = pose_error(bases_[0], prior_);
    const typename Pose::Tangent weighted = prior_information() * e;
    leaf.cost += 0.5 * e.dot(weighted);
    leaf.gradient.template segment<kDof>(leaf.order[0]) += prior_jacobian().transpose() * weighted;
  }
  const auto fixes = fixes_.find(number + 1);
  if (fixes != fixes_.end()) add_fixes(leaf, fixes->second);
  leaf.turned = Rotation();
}

// Of the leaf's end, to the gradient in map axes.
template <class Pose>
void SparseMap<Pose>::add_fixes(Leaf& leaf, const std::vector<AbsoluteFix<Pose>>& fixes) const {
  const Pose& T = bases_[static_cast<std::size_t>(&leaf - leaves_.data()) + 1];
  for (const AbsoluteFix<Pose>& fix : fixes) {
    const int rows = fix.rows();
    const Eigen::VectorXd r = fix.residual(T).head(rows);
    const Eigen::VectorXd weighted = fix.covariance().topLeftCorner(rows, rows).ldlt().solve(r);
    leaf.cost += 0.5 * r.dot(weighted);
    leaf.gradient.template segment<kDof>(leaf.order[kDof]) -= fix.jacobian(T).topRows(rows).transpose() * weighted;
  }
}

// d pose_error(base, prior) by the base's own ordinary error.
template <class Pose>
typename SparseMap<Pose>::Square SparseMap<Pose>::prior_jacobian() const {
  Square J = Square::Identity();
  J.template bottomRightCorner<kTurn, kTurn>() =
      Rotation::left_jacobian_inverse((bases_[0].rotation() * prior_.rotation().inverse()).log());
  return J;
}

template <class Pose>
void SparseMap<Pose>::place_private(Number number) {
  const Leaf& leaf = leaves_[number];
  const Values at = values(leaf);
  const Eigen::VectorXd residual = leaf.factor->residual(at);
  const Eigen::VectorXd weighted = leaf.factor->weighted(residual);
  const typename Factor::Points placed = leaf.factor->place_private(at, residual, weighted);
  for (std::size_t i = 0; i < leaf.landmarks.size(); ++i) {
    const Number landmark = leaf.landmarks[i];
    if (landmark != kNone && !shared(landmark)) landmarks_[landmark].position = placed.col(static_cast<Index>(i));
  }
}

template <class Pose>
double SparseMap<Pose>::cost() const {
  double sum = 0.0;
  for (const Leaf& leaf : leaves_) sum += leaf.cost;
  return sum;
}

template <class Pose>
std::size_t SparseMap<Pose>::memory_bytes() const {
  std::size_t bytes = tree_.memory_bytes();
  for (const Leaf& leaf : leaves_) bytes += leaf.factor->memory_bytes();
  return bytes;
}

// --- transactions ---

template <class Pose>
void SparseMap<Pose>::save_landmark(Undo& undo, Number landmark) {
  if (landmarks_[landmark].saved == undo.change) return;
  undo.positions.emplace_back(landmark, landmarks_[landmark].position);
  landmarks_[landmark].saved = undo.change;
}

template <class Pose>
void SparseMap<Pose>::save_base(Undo& undo, Number base) {
  if (base_saved_[base] == undo.change) return;
  undo.bases.emplace_back(base, bases_[base]);
  base_saved_[base] = undo.change;
}

// And where its private landmarks stand.
template <class Pose>
void SparseMap<Pose>::save_leaf(Undo& undo, Number leaf) {
  if (leaves_[leaf].saved == undo.change) return;
  undo.leaves.emplace_back(leaf, leaves_[leaf]);
  for (const Number landmark : leaves_[leaf].landmarks)
    if (landmark != kNone && landmark < undo.landmarks) save_landmark(undo, landmark);
  leaves_[leaf].saved = undo.change;
}

template <class Pose>
void SparseMap<Pose>::roll_back(Undo& undo) noexcept {
  for (std::size_t i = 0; i < undo.extended.size(); ++i) {
    landmarks_[undo.extended[i]].submaps.pop_back();
    landmarks_[undo.extended[i]].count -= undo.counts[i];
  }
  for (const auto& [landmark, position] : undo.positions) landmarks_[landmark].position = position;
  for (const auto& [base, pose] : undo.bases) bases_[base] = pose;
  for (auto turned = undo.turned.rbegin(); turned != undo.turned.rend(); ++turned)
    leaves_[turned->first].turned = turned->second;
  for (auto& [number, leaf] : undo.leaves) leaves_[number] = std::move(leaf);
  for (Number landmark = undo.landmarks; landmark < landmarks_.size(); ++landmark) {
    ids_.erase(landmarks_[landmark].id);
    index_.remove(landmarks_[landmark].slot);
  }
  landmarks_.resize(undo.landmarks, Landmark());
  leaves_.resize(undo.leaf_count, Leaf());
  bases_.resize(undo.base_count);
  base_saved_.resize(undo.base_count);
  visible_.resize(undo.visible);
  prior_ = undo.prior;
  prior_covariance_ = undo.prior_covariance;
  tree_ = std::move(undo.tree);
  fixes_ = std::move(undo.fixes);
  pending_ = std::move(undo.pending);
  settled_ = undo.settled;
  stale_ = std::move(undo.stale);
  base_covariance_ = undo.base_covariance;
  length_scale_ = undo.length_scale;
  turn_scale_ = undo.turn_scale;
}

template <class Pose>
SparseMap<Pose>::Undo::Undo(const SparseMap& map, Number number)
    : change(number),
      landmarks(static_cast<Number>(map.landmarks_.size())),
      leaf_count(map.leaves_.size()),
      base_count(map.bases_.size()),
      visible(map.visible_.size()),
      prior(map.prior_),
      prior_covariance(map.prior_covariance_),
      tree(map.tree_),
      fixes(map.fixes_),
      pending(map.pending_),
      settled(map.settled_),
      stale(map.stale_),
      base_covariance(map.base_covariance_),
      length_scale(map.length_scale_),
      turn_scale(map.turn_scale_) {}

template <class Pose>
double SparseMap<Pose>::cost_since(const Undo& undo) const {
  double change = 0.0;
  for (std::size_t i = undo.leaf_count; i < leaves_.size(); ++i) change += leaves_[i].cost;
  for (const auto& [number, leaf] : undo.leaves) change += leaves_[number].cost - leaf.cost;
  return change;
}

// --- joining ---

template <class Pose>
class SparseMap<Pose>::Transaction final : public MapTransaction<Pose> {
 public:
  explicit Transaction(SparseMap& map) : map_(map), undo_(std::in_place, map, ++map.change_) {}
  ~Transaction() override {
    if (undo_) map_.roll_back(*undo_);
  }

  void join(const Submap<Pose>& submap) override;
  FixReport fix(const AbsoluteFix<Pose>& fix, double threshold) override;
  JoinReport commit() override;

 private:
  SparseMap& map_;
  std::optional<Undo> undo_;
  JoinReport report_;
  bool changed_ = false;
};

template <class Pose>
std::unique_ptr<MapTransaction<Pose>> SparseMap<Pose>::begin() {
  return std::make_unique<Transaction>(*this);
}

template <class Pose>
void SparseMap<Pose>::Transaction::join(const Submap<Pose>& submap) {
  std::vector<char> left_out(submap.ids.size(), 0);
  changed_ = true;
  const Number leaf = map_.add(submap, left_out, *undo_, report_);
  if (report_.rows == 0 || !map_.suspicious(leaf, report_)) return;
  // Something does not fit: the exact gates, which are dearer, tell what.
  map_.roll_back(*undo_);
  undo_.reset();
  map_.gate(submap, left_out);
  report_ = JoinReport();
  undo_.emplace(map_, ++map_.change_);
  map_.add(submap, left_out, *undo_, report_);
}

template <class Pose>
FixReport SparseMap<Pose>::Transaction::fix(const AbsoluteFix<Pose>& fix, double threshold) {
  if (changed_) map_.refresh_base_covariance();
  const FixReport report = map_.fix_base(fix, threshold, *undo_);
  changed_ = changed_ || (report.accepted && !map_.leaves_.empty());
  return report;
}

template <class Pose>
JoinReport SparseMap<Pose>::Transaction::commit() {
  if (changed_) map_.finish(*undo_, report_);
  undo_.reset();
  return report_;
}

// Adds the submap and solves; the report tells how well the fused landmarks agree.
template <class Pose>
typename SparseMap<Pose>::Number SparseMap<Pose>::add(const Submap<Pose>& submap, const std::vector<char>& left_out,
                                                      Undo& undo, JoinReport& report) {
  const Number leaf = take_in(submap, left_out, undo, report);
  optimise(undo, report);
  report.rows = kDim * report.fused;
  if (report.rows == 0) return leaf;
  // To first order the cost grows by half of what the fused landmarks' two estimates have against each other.
  report.threshold = chi_square_quantile(static_cast<double>(report.rows), options_.joint_gate_probability);
  report.distance = 2.0 * cost_since(undo);
  if (report.distance > report.threshold && !settled_) {  // it may be too early to tell
    optimise(undo, report);
    report.distance = 2.0 * cost_since(undo);
  }
  return leaf;
}

// Appends the submap, its end and its new landmarks, and makes the factor anew where that reaches.
template <class Pose>
typename SparseMap<Pose>::Number SparseMap<Pose>::take_in(const Submap<Pose>& submap, const std::vector<char>& left_out,
                                                          Undo& undo, JoinReport& report) {
  const auto number = static_cast<Number>(leaves_.size());
  const Pose base = bases_.back();
  bases_.push_back(base * submap.T_base_end);
  base_saved_.push_back(undo.change);
  Leaf leaf;
  leaf.data = std::make_shared<const Data>(submap);
  leaf.key = key_of(number);
  leaf.saved = undo.change;
  TreeChanges changes;
  std::vector<Number> reshaped;
  for (std::size_t i = 0; i < submap.ids.size(); ++i) {
    const auto known = ids_.find(submap.ids[i]);
    if (known != ids_.end() && left_out[i] != 0) {
      leaf.landmarks.push_back(kNone);
      ++report.refused;
      continue;
    }
    if (known == ids_.end()) {
      const auto landmark = static_cast<Number>(landmarks_.size());
      landmarks_.push_back({submap.ids[i],
                            submap.counts[i],
                            base * submap.landmarks[i],
                            {number},
                            static_cast<Number>(visible_.size()),
                            undo.change});
      visible_.push_back(landmark);
      ids_.emplace(submap.ids[i], landmark);
      index_.add(visible_.size() - 1);
      leaf.landmarks.push_back(landmark);
      ++report.fresh;
      continue;
    }
    const Number landmark = known->second;
    save_landmark(undo, landmark);
    undo.counts.push_back(submap.counts[i]);
    undo.extended.push_back(landmark);
    Landmark& l = landmarks_[landmark];
    try {
      l.submaps.push_back(number);
    } catch (...) {
      undo.extended.pop_back();
      throw;
    }
    l.count += submap.counts[i];
    leaf.landmarks.push_back(landmark);
    ++report.fused;
    if (l.submaps.size() == 2)
      reshaped.push_back(l.submaps[0]);
    else
      changes.variables.emplace_back(landmark_variable(landmark), leaves_[l.submaps[0]].key);
    tree_.set_degree(landmark_variable(landmark), static_cast<std::int32_t>(l.submaps.size()));
  }
  if (visible_.size() > options_.max_landmarks)
    throw Error(ErrorCode::capacity, "submap: %zu new landmarks, and the map holds %zu of max_landmarks = %zu",
                report.fresh, undo.visible, options_.max_landmarks);
  shape(leaf, number);
  leaves_.push_back(std::move(leaf));
  set_scales(submap);
  evaluate(number);
  std::sort(reshaped.begin(), reshaped.end());
  reshaped.erase(std::unique(reshaped.begin(), reshaped.end()), reshaped.end());
  for (const Number old : reshaped) {
    save_leaf(undo, old);
    shape(leaves_[old], old);
    evaluate(old);
    changes.leaves.push_back(leaves_[old].key);
  }
  // A base is held by the submap that ends there and by the one that begins there. The newest one waits for the latter,
  // and is eliminated last of all until then.
  tree_.set_degree(base_variable(number), number == 0 ? 1 : 2);
  tree_.set_degree(base_variable(number + 1), 2);
  changes.leaves.push_back(leaves_[number].key);
  refactor(std::move(changes), undo, report);
  return number;
}

template <class Pose>
void SparseMap<Pose>::set_scales(const Submap<Pose>& submap) {
  std::vector<double> sigmas;
  double extent = 1.0;
  for (Index i = 0; i < submap.size(); ++i) {
    const PointSquare P = submap.covariance.template block<kDim, kDim>(kDof + kDim * i, kDof + kDim * i);
    sigmas.push_back(std::sqrt(P.trace()));
    extent = std::max(extent, submap.landmarks[i].norm());
  }
  if (sigmas.empty()) sigmas.push_back(std::sqrt(submap.covariance.template topLeftCorner<kDim, kDim>().trace()));
  const auto median = sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() / 2);
  std::nth_element(sigmas.begin(), median, sigmas.end());
  if (!(*median > 0.0)) return;
  length_scale_ = std::min(length_scale_, *median);
  turn_scale_ = std::min(turn_scale_, *median / extent);
}

// What the leaf's factor exerts on its i-th shared landmark, in map axes.
template <class Pose>
typename SparseMap<Pose>::Point SparseMap<Pose>::force_on(const Leaf& leaf, Index i) const {
  return leaf.turned * Point(leaf.gradient.template segment<kDim>(leaf.order[Factor::column(i)]));
}

// Whether the fused landmarks' estimates contradict each other, jointly or one by one; the latter judged from below: a
// landmark's share of S^-1 nu is the force that the new submap exerts on it, and the covariance of its nu, given all
// other states, is the sum of the inverses of what the new submap and the old ones know of it.
template <class Pose>
bool SparseMap<Pose>::suspicious(Number number, const JoinReport& report) const {
  if (report.distance > report.threshold) return true;
  const Leaf& leaf = leaves_[number];
  // Of many that are as they should be, one is beyond the single gate as likely as not.
  const double count = std::max(1.0, static_cast<double>(report.fused));
  const double bound = chi_square_quantile(kDim, std::pow(options_.gate_probability, 1.0 / count));
  for (Index i = 0; i < leaf.factor->shared_count(); ++i) {
    const Number landmark = leaf.landmarks[leaf.factor->shared()[i]];
    PointSquare old = PointSquare::Zero();
    for (const Number other : landmarks_[landmark].submaps) {
      if (other == number) continue;
      const std::vector<Index>& shared_there = leaves_[other].factor->shared();
      for (std::size_t j = 0; j < shared_there.size(); ++j)
        if (leaves_[other].landmarks[shared_there[j]] == landmark)
          old += leaves_[other].factor->landmark_information(static_cast<Index>(j), bases_[other].rotation());
    }
    const PointSquare fresh = leaf.factor->landmark_information(i, bases_[number].rotation());
    const Point force = force_on(leaf, i);
    if (force.dot((fresh.inverse() + old.inverse()) * force) > bound) return true;
  }
  return false;
}

// Gates the known landmarks against the map as it is: nu = y_submap - R^T (l - p), S = H P H^T + Sigma_DD; each by
// itself, then jointly. What does not pass is left out.
template <class Pose>
void SparseMap<Pose>::gate(const Submap<Pose>& submap, std::vector<char>& left_out) const {
  std::vector<Index> known;
  std::vector<std::size_t> indices;
  for (Index i = 0; i < submap.size(); ++i) {
    std::size_t index = 0;
    if (!find(submap.ids[i], index)) continue;
    known.push_back(i);
    indices.push_back(index);
  }
  Eigen::MatrixXd joint = submap.covariance;
  to_ordinary(submap, known, joint);
  const double single = chi_square_quantile(kDim, options_.gate_probability);
  for (bool first = true;; first = false) {
    const auto count = static_cast<Index>(known.size()), m = kDim * count;
    if (count == 0) return;
    Eigen::MatrixXd P(kDof + m, kDof + m), H = Eigen::MatrixXd::Zero(m, kDof + m), S(m, m);
    base_joint_covariance(indices.data(), indices.size(), P.data());
    Eigen::VectorXd residual(m);
    for (Index a = 0; a < count; ++a) {
      const Point l = point(indices[a]);
      Prediction<Pose> prediction;
      map_jacobians(base(), l, Prediction<Pose>::ByLandmark::Identity(), prediction);
      H.block<kDim, kDof>(kDim * a, 0) = prediction.J_z_pose.template topRows<kDim>();
      H.block<kDim, kDim>(kDim * a, kDof + kDim * a) = prediction.J_z_landmark.template topRows<kDim>();
      residual.segment<kDim>(kDim * a) = submap.landmarks[known[a]] - base().inverse() * l;
      for (Index b = 0; b < count; ++b)
        S.block<kDim, kDim>(kDim * a, kDim * b) =
            joint.block<kDim, kDim>(kDof + kDim * known[a], kDof + kDim * known[b]);
    }
    S += H * P * H.transpose();
    if (first) {
      std::vector<Index> passed;
      std::vector<std::size_t> passed_indices;
      for (Index a = 0; a < count; ++a) {
        const double distance = squared_distance(residual.data() + kDim * a, S.data() + kDim * a * (m + 1), m, kDim);
        if (distance >= 0.0 && distance <= single) {
          passed.push_back(known[a]);
          passed_indices.push_back(indices[a]);
        } else {
          left_out[known[a]] = 1;
        }
      }
      const bool all = passed.size() == known.size();
      known.swap(passed);
      indices.swap(passed_indices);
      if (!all) continue;
    }
    Eigen::MatrixXd inverse = S.selfadjointView<Eigen::Lower>().ldlt().solve(Eigen::MatrixXd::Identity(m, m));
    Eigen::VectorXd u = inverse * residual;
    std::vector<double> workspace(static_cast<std::size_t>(kDim * (kDim + m)));
    gate_by_inverse(
        inverse.data(), count, kDim, u.data(), residual.dot(u), workspace.data(),
        [&](Index rows) { return chi_square_quantile(static_cast<double>(rows), options_.joint_gate_probability); },
        [&](Index a) { return left_out[known[a]] != 0; }, [&](Index a, double, double) { left_out[known[a]] = 1; });
    return;
  }
}

template <class Pose>
void SparseMap<Pose>::refresh_base_covariance() {
  Eigen::MatrixXd newest = tree_.last_covariance();
  to_map_axes({base_variable(bases_.size() - 1)}, newest);
  base_covariance_ = newest;
}

template <class Pose>
void SparseMap<Pose>::finish(Undo& undo, JoinReport& report) {
  for (const auto& [number, leaf] : undo.leaves) place_private(number);
  for (std::size_t i = undo.leaf_count; i < leaves_.size(); ++i) place_private(static_cast<Number>(i));
  refresh_base_covariance();
  double sum = 0.0;
  for (const auto& [landmark, before] : undo.positions) {
    const double way = (landmarks_[landmark].position - before).squaredNorm();
    sum += way;
    report.moved_max = std::max(report.moved_max, std::sqrt(way));
  }
  if (undo.landmarks > 0) report.moved_rms = std::sqrt(sum / undo.landmarks);
  note_moves(undo);
}

// To the spatial index, which may want memory for single moves, but none to hear that all have moved.
template <class Pose>
void SparseMap<Pose>::note_moves(const Undo& undo) noexcept {
  try {
    for (const auto& [landmark, before] : undo.positions)
      if (landmarks_[landmark].slot != kNone) index_.moved(landmarks_[landmark].slot);
  } catch (...) {
    index_.moved_all();
  }
}

template <class Pose>
void SparseMap<Pose>::remove(std::uint64_t id) {
  const auto found = ids_.find(id);
  if (found == ids_.end()) return;
  Landmark& landmark = landmarks_[found->second];
  const Number last = visible_.back(), slot = landmark.slot;
  visible_[slot] = last;
  landmarks_[last].slot = slot;
  landmark.slot = kNone;
  visible_.pop_back();
  index_.remove(visible_.size());
  if (slot < visible_.size()) index_.moved(slot);
  ids_.erase(found);
}

template class SparseMap<SE2>;
template class SparseMap<SE3>;

}  // namespace cairn
