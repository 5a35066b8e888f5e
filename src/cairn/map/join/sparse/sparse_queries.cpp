// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/sparse_queries.hpp"

#include <algorithm>
#include <map>

namespace cairn {
namespace {

// Fills the cache, leaf by leaf.
template <class Pose>
class CovarianceVisitor final : public TreeCovariances {
 public:
  using State = SparseState<Pose>;
  using PointSquare = typename Pose::Rotation::Matrix;

  CovarianceVisitor(const SparseState<Pose>& state, std::vector<PointSquare>& covariances,
                    std::vector<std::uint32_t>& covariance_of)
      : state_(state), covariances_(covariances), covariance_of_(covariance_of) {}

  void leaf(std::uint32_t number, const Eigen::MatrixXd& in_own_axes) override {
    const typename State::Leaf& leaf = state_.leaves[number];
    Eigen::MatrixXd covariance = in_own_axes;
    state_.to_map_axes(leaf.variables, covariance);
    std::vector<Index> privates;
    for (std::size_t i = 0; i < leaf.landmarks.size(); ++i) {
      const std::uint32_t landmark = leaf.landmarks[i];
      if (landmark != State::kNone && !state_.shared(landmark)) privates.push_back(static_cast<Index>(i));
    }
    const std::vector<Index>& shared_ones = leaf.factor->shared();
    for (std::size_t i = 0; i < shared_ones.size(); ++i) {
      const Index at = leaf.order[SubmapFactor<Pose>::column(static_cast<Index>(i))];
      // From one leaf only: other leaves give the same covariance except for its last bits.
      const std::uint32_t landmark = leaf.landmarks[shared_ones[i]];
      if (state_.landmarks[landmark].submaps[0] == number) keep(landmark, covariance.block<kDim, kDim>(at, at));
    }
    if (privates.empty()) return;
    Eigen::MatrixXd A, W, sorted(kDim * static_cast<Index>(privates.size()), covariance.rows());
    leaf.factor->express_private(privates, state_.values(number), A, W);
    for (Index c = 0; c < A.cols(); ++c) sorted.col(leaf.order[c]) = A.col(c);
    const Eigen::MatrixXd across = sorted * covariance;
    for (std::size_t a = 0; a < privates.size(); ++a) {
      const auto row = kDim * static_cast<Index>(a);
      keep(leaf.landmarks[privates[a]],
           W.block<kDim, kDim>(row, row) + across.middleRows<kDim>(row) * sorted.middleRows<kDim>(row).transpose());
    }
  }

 private:
  void keep(std::uint32_t landmark, const PointSquare& covariance) {
    covariances_[landmark] = 0.5 * (covariance + covariance.transpose());
    covariance_of_[landmark] = state_.change;
  }

  static constexpr int kDim = Pose::kDim;

  const State& state_;
  std::vector<PointSquare>& covariances_;
  std::vector<std::uint32_t>& covariance_of_;
};

// Columns of the covariance for chosen variables; only their rows of the solution.
template <class Pose>
class CovarianceColumns final : public TreeSystem {
 public:
  explicit CovarianceColumns(std::vector<Variable> variables) : variables_(std::move(variables)) {
    Index state = 0;
    for (const Variable v : variables_) {
      states_.push_back(state);
      state += dimension<Pose>(v);
    }
    covariance.resize(state, state);
  }
  Index columns() const { return covariance.cols(); }
  Index state(Variable v) const { return states_[position(v)]; }

  void right_hand_side(Variable v, double* b, Index ld) const override {
    const std::size_t at = position(v);
    if (at == variables_.size()) return;
    for (Index d = 0; d < dimension<Pose>(v); ++d) b[(states_[at] + d) * ld + d] += 1.0;
  }
  bool solution(Variable v, const double* x, Index ld) override {
    const std::size_t at = position(v);
    if (at == variables_.size()) return false;
    for (Index c = 0; c < covariance.cols(); ++c)
      for (Index d = 0; d < dimension<Pose>(v); ++d) covariance(states_[at] + d, c) = x[c * ld + d];
    return false;
  }

  Eigen::MatrixXd covariance;

 private:
  std::size_t position(Variable v) const {
    const auto found = std::lower_bound(variables_.begin(), variables_.end(), v);
    return found != variables_.end() && *found == v ? static_cast<std::size_t>(found - variables_.begin())
                                                    : variables_.size();
  }

  std::vector<Variable> variables_;  // ascending
  std::vector<Index> states_;
};

}  // namespace

template <class Pose>
void SparseCovariances<Pose>::prepare(const SparseState<Pose>& state, const std::vector<std::size_t>& indices) {
  const std::lock_guard<std::mutex> lock(mutex_);
  fill(state, indices);
}

template <class Pose>
void SparseCovariances<Pose>::fill(const SparseState<Pose>& state, const std::vector<std::size_t>& indices) {
  covariances_.resize(state.landmarks.size());
  covariance_of_.resize(state.landmarks.size(), 0);
  std::vector<std::uint32_t> wanted;
  for (const std::size_t index : indices) {
    const std::uint32_t landmark = state.visible[index];
    if (covariance_of_[landmark] != state.change) wanted.push_back(state.landmarks[landmark].submaps[0]);
  }
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  if (wanted.empty()) return;
  std::vector<TreeKey> keys;
  for (const std::uint32_t leaf : wanted) keys.push_back(state.leaves[leaf].key);
  CovarianceVisitor<Pose> visitor(state, covariances_, covariance_of_);
  state.solution.tree.covariances(std::move(keys), visitor);
}

template <class Pose>
typename SparseCovariances<Pose>::PointSquare SparseCovariances<Pose>::of(const SparseState<Pose>& state,
                                                                          std::size_t index) {
  const std::lock_guard<std::mutex> lock(mutex_);
  fill(state, {index});
  return covariances_[state.visible[index]];
}

template <class Pose>
void joint_covariance_of_base(const SparseState<Pose>& state, const std::size_t* indices, std::size_t count,
                              double* matrix, bool errors) {
  constexpr int kDim = Pose::kDim, kDof = Pose::kDof;
  using Number = std::uint32_t;
  const std::vector<Number> error_points =
      errors ? state.errors_at(static_cast<Number>(state.bases.size() - 1)) : std::vector<Number>();
  const auto first = static_cast<Index>(kDof + kDim * error_points.size());
  const auto size = first + static_cast<Index>(kDim * count);
  Eigen::Map<Eigen::MatrixXd> joint(matrix, size, size);
  if (state.leaves.empty()) {
    joint.setIdentity();  // of the systematic errors' points
    joint.template topLeftCorner<kDof, kDof>() = state.solution.base_covariance;
    return;
  }
  // The requested errors are A e + w, where e are the errors of some variables; private landmarks of one submap share
  // w.
  const Variable newest = base_variable(state.bases.size() - 1);
  std::vector<Variable> variables{newest};
  std::vector<TreeTouch> touches{state.solution.tree.touch(newest, state.leaves.back().key)};
  std::map<Number, std::vector<std::size_t>> privates;  // by leaf: which of the requested ones
  const auto want = [&](Variable v, Number leaf) {
    variables.push_back(v);
    touches.push_back(state.solution.tree.touch(v, state.leaves[leaf].key));
  };
  for (const Number point : error_points) want(landmark_variable(point), static_cast<Number>(state.leaves.size() - 1));
  for (std::size_t i = 0; i < count; ++i) {
    const Number landmark = state.visible[indices[i]], leaf = state.landmarks[landmark].submaps[0];
    if (state.shared(landmark))
      want(landmark_variable(landmark), leaf);
    else
      privates[leaf].push_back(i);
  }
  for (const auto& [leaf, asked] : privates)
    for (const Variable v : state.leaves[leaf].variables) want(v, leaf);
  std::sort(variables.begin(), variables.end());
  variables.erase(std::unique(variables.begin(), variables.end()), variables.end());
  CovarianceColumns<Pose> columns(variables);
  state.solution.tree.solve(std::move(touches), columns.columns(), columns);
  state.to_map_axes(variables, columns.covariance);

  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, columns.columns()), W = Eigen::MatrixXd::Zero(size, size);
  A.block<kDof, kDof>(0, columns.state(newest)).setIdentity();
  for (std::size_t i = 0; i < error_points.size(); ++i)
    A.block<kDim, kDim>(static_cast<Index>(kDof + kDim * i), columns.state(landmark_variable(error_points[i])))
        .setIdentity();
  for (std::size_t i = 0; i < count; ++i) {
    const Number landmark = state.visible[indices[i]];
    if (state.shared(landmark))
      A.block<kDim, kDim>(first + static_cast<Index>(kDim * i), columns.state(landmark_variable(landmark)))
          .setIdentity();
  }
  for (const auto& [number, asked] : privates) {
    const typename SparseState<Pose>::Leaf& leaf = state.leaves[number];
    std::vector<Index> local;
    for (const std::size_t i : asked)
      local.push_back(std::find(leaf.landmarks.begin(), leaf.landmarks.end(), state.visible[indices[i]]) -
                      leaf.landmarks.begin());
    Eigen::MatrixXd own, noise, sorted(kDim * static_cast<Index>(local.size()), static_cast<Index>(leaf.order.size()));
    leaf.factor->express_private(local, state.values(number), own, noise);
    for (Index c = 0; c < own.cols(); ++c) sorted.col(leaf.order[c]) = own.col(c);
    for (std::size_t a = 0; a < asked.size(); ++a) {
      const auto row = first + static_cast<Index>(kDim * asked[a]), from = kDim * static_cast<Index>(a);
      for (std::size_t v = 0; v < leaf.variables.size(); ++v) {
        const Index d = dimension<Pose>(leaf.variables[v]);
        A.block(row, columns.state(leaf.variables[v]), kDim, d) = sorted.block(from, leaf.states[v], kDim, d);
      }
      for (std::size_t b = 0; b < asked.size(); ++b)
        W.block<kDim, kDim>(row, first + static_cast<Index>(kDim * asked[b])) =
            noise.block<kDim, kDim>(from, kDim * static_cast<Index>(b));
    }
  }
  joint = A * columns.covariance * A.transpose() + W;
  for (Index c = 0; c < size; ++c)  // both triangles, bit for bit
    for (Index r = c + 1; r < size; ++r) joint(c, r) = joint(r, c);
}

template <class Pose>
Eigen::VectorXd errors_of(const SparseState<Pose>& state) {
  const ErrorPoints<Pose>& points = state.error_points;
  const Eigen::VectorXd values =
      state.error_values(state.errors_at(static_cast<std::uint32_t>(state.bases.size() - 1)));
  Eigen::VectorXd errors(points.count());
  for (Index i = 0; i < points.count(); ++i) errors(i) = points.unit(i) * values(points.at(i));
  return errors;
}

// From the points' numbers to the errors in their units.
template <class Pose>
Eigen::MatrixXd joint_with_errors_of(const SparseState<Pose>& state, const std::size_t* indices, std::size_t count) {
  constexpr int kDim = Pose::kDim, kDof = Pose::kDof;
  const ErrorPoints<Pose>& points = state.error_points;
  const Index landmarks = static_cast<Index>(kDim * count), n = kDof + points.size() + landmarks;
  Eigen::MatrixXd joint(n, n), J = Eigen::MatrixXd::Zero(kDof + points.count() + landmarks, n);
  joint_covariance_of_base(state, indices, count, joint.data(), true);
  J.topLeftCorner(kDof, kDof).setIdentity();
  for (Index i = 0; i < points.count(); ++i) J(kDof + i, kDof + points.at(i)) = points.unit(i);
  J.bottomRightCorner(landmarks, landmarks).setIdentity();
  return J * joint * J.transpose();
}

template class SparseCovariances<SE2>;
template class SparseCovariances<SE3>;
template void joint_covariance_of_base(const SparseState<SE2>&, const std::size_t*, std::size_t, double*, bool);
template void joint_covariance_of_base(const SparseState<SE3>&, const std::size_t*, std::size_t, double*, bool);
template Eigen::VectorXd errors_of(const SparseState<SE2>&);
template Eigen::VectorXd errors_of(const SparseState<SE3>&);
template Eigen::MatrixXd joint_with_errors_of(const SparseState<SE2>&, const std::size_t*, std::size_t);
template Eigen::MatrixXd joint_with_errors_of(const SparseState<SE3>&, const std::size_t*, std::size_t);

}  // namespace cairn
