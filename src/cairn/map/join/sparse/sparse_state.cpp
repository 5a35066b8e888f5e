// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/sparse_state.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <type_traits>

namespace cairn {

template <class Pose>
SparseState<Pose>::SparseState(const MapOptions<Pose>& map_options)
    : options(map_options),
      error_points(map_options.errors),
      solution(map_options.initial_pose, map_options.initial_covariance),
      bases{Base{map_options.initial_pose}} {
  for (Index i = 0; i < error_points.constant() + error_points.walking(); ++i) {
    (i < error_points.constant() ? constant_errors : walking_errors).push_back(static_cast<Number>(landmarks.size()));
    landmarks.push_back({0, 0, Point::Zero(), {}, kNone, 0, true});
  }
}

template <class Pose>
std::vector<typename SparseState<Pose>::Number> SparseState<Pose>::errors_at(Number base) const {
  std::vector<Number> points = constant_errors;
  const auto first = walking_errors.begin() + static_cast<std::ptrdiff_t>(base) * error_points.walking();
  points.insert(points.end(), first, first + error_points.walking());
  return points;
}

template <class Pose>
Eigen::VectorXd SparseState<Pose>::error_values(const std::vector<Number>& points) const {
  Eigen::VectorXd values(static_cast<Index>(kDim * points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    values.segment<kDim>(static_cast<Index>(kDim * i)) = landmarks[points[i]].position;
  return values;
}

template <class Pose>
bool SparseState<Pose>::find(std::uint64_t id, std::size_t& index) const {
  const auto found = ids.find(id);
  if (found == ids.end()) return false;
  index = landmarks[found->second].slot;
  return true;
}

template <class Pose>
FactorValues<Pose> SparseState<Pose>::values(const Leaf& leaf, const Factor& factor) const {
  Values values{bases[leaf.poses[0]].pose, bases[leaf.poses[1]].pose, {}, error_values(leaf.errors)};
  values.shared.reserve(static_cast<std::size_t>(factor.shared_count()));
  for (const Index i : factor.shared()) values.shared.push_back(landmarks[leaf.landmarks[i]].position);
  return values;
}

template <class Pose>
PlaceValues<Pose> SparseState<Pose>::place_values(const Leaf& leaf) const {
  PlaceValues<Pose> values{bases[leaf.base()].pose, {}, {}};
  values.poses.reserve(leaf.poses.size() - 1);
  for (std::size_t k = 1; k < leaf.poses.size(); ++k) values.poses.push_back(bases[leaf.poses[k]].pose);
  values.landmarks.reserve(leaf.landmarks.size());
  for (const Number landmark : leaf.landmarks) values.landmarks.push_back(landmarks[landmark].position);
  return values;
}

// Of a single landmark.
template <class Pose>
typename SparseState<Pose>::Rotation::Matrix SparseState<Pose>::landmark_information(const Leaf& leaf, Index i) const {
  const Rotation& base = bases[leaf.base()].pose.rotation();
  return leaf.place != nullptr ? leaf.place->landmark_information(i, base) : leaf.factor->landmark_information(i, base);
}

// The key in the tree of the leaf of this number, which begins at this base.
template <class Pose>
TreeKey SparseState<Pose>::key_of(Number number, Number base) const {
  const Point offset = bases[base].pose.translation() - options.initial_pose.translation();
  return TreeKey(Embedding<Pose>::up(offset), number);
}

// Makes a submap's factor for the landmarks that are shared now, and the leaf's variables.
template <class Pose>
void SparseState<Pose>::shape(Leaf& leaf) const {
  if (leaf.place == nullptr) {
    std::vector<Index> shared_ones;
    for (std::size_t i = 0; i < leaf.landmarks.size(); ++i)
      if (leaf.landmarks[i] != kNone && shared(leaf.landmarks[i])) shared_ones.push_back(static_cast<Index>(i));
    leaf.factor = std::make_shared<const Factor>(leaf.data, std::move(shared_ones));
  }
  struct Column {
    Variable variable;
    Index state;  // of the factor
  };
  std::vector<Column> columns;
  for (std::size_t k = 0; k < leaf.poses.size(); ++k)
    columns.push_back({base_variable(leaf.poses[k]), static_cast<Index>(kDof * k)});
  const Index shared_landmarks = leaf.shared_count(), errors = static_cast<Index>(leaf.errors.size());
  for (Index i = 0; i < shared_landmarks; ++i)
    columns.push_back({landmark_variable(leaf.shared(i)), leaf.state_of_shared(i)});
  for (Index i = 0; i < errors; ++i)
    columns.push_back({landmark_variable(leaf.errors[i]), leaf.state_of_shared(shared_landmarks + i)});
  std::sort(columns.begin(), columns.end(), [](const Column& a, const Column& b) { return a.variable < b.variable; });
  leaf.variables.clear();
  leaf.states.clear();
  leaf.order.assign(static_cast<std::size_t>(leaf.state_of_shared(shared_landmarks + errors)), 0);
  Index state = 0;
  for (const Column& column : columns) {
    leaf.variables.push_back(column.variable);
    leaf.states.push_back(state);
    for (Index d = 0; d < dimension(column.variable); ++d) leaf.order[column.state + d] = state++;
  }
}

// The errors in the tree are in axes that turn with the map: a base's error in its own axes, a landmark's error in the
// axes of the base that saw it first. The information of a submap then depends on relative poses only, so that its
// linearisation stays valid when the map around it turns as a whole.
template <class Pose>
const typename SparseState<Pose>::Rotation& SparseState<Pose>::axes(Variable v) const {
  static const Rotation kStill{};
  if (is_error(v)) return kStill;
  const auto number = static_cast<Number>(v >> 1);
  return bases[is_landmark(v) ? leaves[landmarks[number].submaps[0]].base() : number].pose.rotation();
}

// Calls `turn(state, R)` for all states of the variables: those from `state` on turn with R, from own axes to the
// map's.
template <class Pose>
template <class Turn>
void SparseState<Pose>::for_axes(const std::vector<Variable>& variables, Turn&& turn) const {
  Index state = 0;
  for (const Variable v : variables) {
    turn(state, axes(v).matrix());
    if (!is_landmark(v)) turn(state + kDim, axes(v).adjoint());
    state += dimension(v);
  }
}

template <class Pose>
void SparseState<Pose>::to_map_axes(const std::vector<Variable>& variables, Eigen::MatrixXd& covariance) const {
  for_axes(variables, [&](Index state, const auto& R) {
    constexpr int n = std::decay_t<decltype(R)>::RowsAtCompileTime;
    covariance.middleRows<n>(state) = (R * covariance.middleRows<n>(state)).eval();
    covariance.middleCols<n>(state) = (covariance.middleCols<n>(state) * R.transpose()).eval();
  });
}

template <class Pose>
void SparseState<Pose>::by_own_axes(const std::vector<Variable>& variables, Eigen::MatrixXd& columns) const {
  for_axes(variables, [&](Index state, const auto& R) {
    constexpr int n = std::decay_t<decltype(R)>::RowsAtCompileTime;
    columns.middleCols<n>(state) = (columns.middleCols<n>(state) * R).eval();
  });
}

template <class Pose>
void SparseState<Pose>::note_linearisation(Number number) {
  Leaf& leaf = leaves[number];
  const Pose T_base_map = bases[leaf.base()].pose.inverse();
  leaf.poses_then.clear();
  for (std::size_t k = 1; k < leaf.poses.size(); ++k)
    leaf.poses_then.push_back(T_base_map * bases[leaf.poses[k]].pose.translation());
  leaf.landmarks_then.clear();
  for (Index i = 0; i < leaf.shared_count(); ++i)
    leaf.landmarks_then.push_back(T_base_map * landmarks[leaf.shared(i)].position);
  leaf.axes_then.clear();
  for (const Variable v : leaf.variables) leaf.axes_then.push_back(T_base_map.rotation() * axes(v));
}

// The largest motion of the leaf's landmarks and axes against its base since it was linearised, in the map's scales.
template <class Pose>
double SparseState<Pose>::strain(Number number) const {
  const Leaf& leaf = leaves[number];
  if (leaf.axes_then.size() != leaf.variables.size()) return std::numeric_limits<double>::infinity();
  const Pose T_base_map = bases[leaf.base()].pose.inverse();
  double way = 0.0, turn = 0.0;
  const auto moves = [&](const Point& now, const Point& then) {
    way = std::max(way, (T_base_map * now - then).norm());
  };
  for (std::size_t k = 0; k < leaf.poses_then.size(); ++k)
    moves(bases[leaf.poses[k + 1]].pose.translation(), leaf.poses_then[k]);
  for (std::size_t i = 0; i < leaf.landmarks_then.size(); ++i)
    moves(landmarks[leaf.shared(static_cast<Index>(i))].position, leaf.landmarks_then[i]);
  for (std::size_t i = 0; i < leaf.variables.size(); ++i) {
    if (is_error(leaf.variables[i])) continue;
    turn = std::max(turn, (T_base_map.rotation() * axes(leaf.variables[i]) * leaf.axes_then[i].inverse()).chord());
  }
  return std::max(way / solution.length_scale, turn / solution.turn_scale);
}

template <class Pose>
void SparseState<Pose>::evaluate(Number number) {
  Leaf& leaf = leaves[number];
  Eigen::VectorXd own, gradient(static_cast<Index>(leaf.order.size()));  // a failing resize must not spoil the old one
  const auto take = [&](auto&& evaluation) {
    leaf.cost = evaluation.cost;
    own.swap(evaluation.gradient);
  };
  if (leaf.place != nullptr)
    take(leaf.place->evaluate(place_values(leaf)));
  else
    take(leaf.factor->evaluate(values(number)));
  for (Index i = 0; i < own.size(); ++i) gradient(leaf.order[i]) = own(i);
  leaf.gradient.swap(gradient);
  if (number == 0) {
    const typename Pose::Tangent e = pose_error(bases[0].pose, solution.anchors.prior());
    const typename Pose::Tangent weighted = solution.anchors.prior_information() * e;
    leaf.cost += 0.5 * e.dot(weighted);
    leaf.gradient.template segment<kDof>(leaf.order[0]) +=
        solution.anchors.prior_jacobian(bases[0].pose).transpose() * weighted;
    const Eigen::VectorXd s = error_values(errors_at(0));  // their prior has unit covariance
    leaf.cost += 0.5 * s.squaredNorm();
    for (Index i = 0; i < s.size(); ++i)
      leaf.gradient(leaf.order[static_cast<std::size_t>(Factor::column(leaf.factor->shared_count()) + i)]) += s(i);
  }
  if (const auto* fixes = solution.anchors.fixes_of(number)) add_fixes(leaf, bases[leaf.poses[1]].pose, *fixes);
  leaf.turned = Rotation();
}

// Adds fixes of the leaf's end to its cost and, in map axes, to its gradient.
template <class Pose>
void SparseState<Pose>::add_fixes(Leaf& leaf, const Pose& T, const std::vector<AbsoluteFix<Pose>>& fixes) const {
  for (const AbsoluteFix<Pose>& fix : fixes) {
    const int rows = fix.rows();
    const Eigen::VectorXd r = fix.residual(T).head(rows);
    const Eigen::VectorXd weighted = fix.covariance().topLeftCorner(rows, rows).ldlt().solve(r);
    leaf.cost += 0.5 * r.dot(weighted);
    leaf.gradient.template segment<kDof>(leaf.order[kDof]) -= fix.jacobian(T).topRows(rows).transpose() * weighted;
  }
}

template <class Pose>
void SparseState<Pose>::place_private(Number number) {
  const Leaf& leaf = leaves[number];
  if (leaf.data == nullptr) return;
  const Values at = values(number);
  const Eigen::VectorXd residual = leaf.factor->residual(at);
  const Eigen::VectorXd weighted = leaf.factor->weighted(residual);
  const typename Factor::Points placed = leaf.factor->place_private(at, residual, weighted);
  for (std::size_t i = 0; i < leaf.landmarks.size(); ++i) {
    const Number landmark = leaf.landmarks[i];
    if (landmark != kNone && !shared(landmark)) landmarks[landmark].position = placed.col(static_cast<Index>(i));
  }
}

template <class Pose>
double SparseState<Pose>::cost() const {
  double sum = 0.0;
  for (const Leaf& leaf : leaves) sum += leaf.cost;
  return sum;
}

template <class Pose>
std::size_t SparseState<Pose>::memory_bytes() const {
  std::size_t bytes = solution.tree.memory_bytes();
  for (const Leaf& leaf : leaves)
    if (leaf.used()) bytes += leaf.place != nullptr ? leaf.place->memory_bytes() : leaf.factor->memory_bytes();
  return bytes;
}

// The force of the leaf's factor on its i-th shared landmark, in map axes.
template <class Pose>
typename SparseState<Pose>::Point SparseState<Pose>::force_on(const Leaf& leaf, Index i) const {
  return leaf.turned * Point(leaf.gradient.template segment<kDim>(leaf.order[leaf.state_of_shared(i)]));
}

template <class Pose>
void SparseState<Pose>::refresh_base_covariance() {
  Eigen::MatrixXd newest = solution.tree.last_covariance();
  to_map_axes({base_variable(solution.newest)}, newest);
  solution.base_covariance = newest;
}

template struct SparseState<SE2>;
template struct SparseState<SE3>;

}  // namespace cairn
