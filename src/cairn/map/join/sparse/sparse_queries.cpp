// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/sparse_queries.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

namespace cairn {
namespace {

// Hands over the covariances of landmarks, leaf by leaf.
template <class Pose>
class CovarianceVisitor final : public TreeCovariances {
 public:
  using State = SparseState<Pose>;
  using PointSquare = typename Pose::Rotation::Matrix;
  using Keep = std::function<void(std::uint32_t, const PointSquare&)>;

  CovarianceVisitor(const SparseState<Pose>& state, Keep keep) : state_(state), keep_(std::move(keep)) {}

  void leaf(std::uint32_t number, const Eigen::MatrixXd& in_own_axes) override {
    const typename State::Leaf& leaf = state_.leaves[number];
    Eigen::MatrixXd covariance = in_own_axes;
    state_.to_map_axes(leaf.variables, covariance);
    std::vector<Index> privates;
    for (std::size_t i = 0; i < leaf.landmarks.size(); ++i) {
      const std::uint32_t landmark = leaf.landmarks[i];
      if (landmark != State::kNone && !state_.shared(landmark)) privates.push_back(static_cast<Index>(i));
    }
    for (Index i = 0; i < leaf.shared_count(); ++i) {
      const Index at = leaf.order[leaf.state_of_shared(i)];
      // From one leaf only: other leaves give the same covariance except for its last bits.
      const std::uint32_t landmark = leaf.shared(i);
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
    keep_(landmark, 0.5 * (covariance + covariance.transpose()));
  }

  static constexpr int kDim = Pose::kDim;

  const State& state_;
  Keep keep_;
};

// Chosen errors in map axes, each a combination of variables' errors plus a rest that is independent of all variables.
template <class Pose>
class ChosenErrors {
 public:
  using State = SparseState<Pose>;
  using Number = typename State::Number;

  ChosenErrors(const State& state, Index size) : state_(state), rest_(Eigen::MatrixXd::Zero(size, size)) {}

  // The error of a variable, from this row on. `leaf` holds the variable.
  void add(Variable v, Number leaf, Index row) {
    const Index d = dimension<Pose>(v);
    add(state_.solution.tree.touch(v, state_.leaves[leaf].key), {v}, Eigen::MatrixXd::Identity(d, d));
    for (Index i = 0; i < d; ++i) rows_.push_back(row + i);
  }
  // The errors of landmarks, by index, from these rows on.
  void add_landmarks(const std::size_t* indices, std::size_t count, Index row) {
    std::map<Number, std::vector<std::size_t>> privates;  // by leaf: which of them
    for (std::size_t i = 0; i < count; ++i) {
      const Number landmark = state_.visible[indices[i]], leaf = state_.landmarks[landmark].submaps[0];
      if (state_.shared(landmark))
        add(landmark_variable(landmark), leaf, row + static_cast<Index>(kDim * i));
      else
        privates[leaf].push_back(i);
    }
    for (const auto& [leaf, chosen] : privates) add_private(leaf, indices, chosen, row);
  }
  Eigen::MatrixXd covariance() const {
    Eigen::MatrixXd sum = rest_;
    const Eigen::MatrixXd part = state_.solution.tree.covariance(combinations_);
    for (Index c = 0; c < part.cols(); ++c)
      for (Index r = 0; r < part.rows(); ++r) sum(rows_[r], rows_[c]) += part(r, c);
    return sum;
  }

 private:
  static constexpr int kDim = Pose::kDim;

  void add(const TreeTouch& touch, const std::vector<Variable>& variables, Eigen::MatrixXd A) {
    state_.by_own_axes(variables, A);
    combinations_.push_back({touch, variables, A.transpose()});
  }
  // Private landmarks of one submap share their rest.
  void add_private(Number number, const std::size_t* indices, const std::vector<std::size_t>& chosen, Index row) {
    const typename State::Leaf& leaf = state_.leaves[number];
    std::vector<Index> local;
    for (const std::size_t i : chosen)
      local.push_back(std::find(leaf.landmarks.begin(), leaf.landmarks.end(), state_.visible[indices[i]]) -
                      leaf.landmarks.begin());
    Eigen::MatrixXd own, noise, sorted(kDim * static_cast<Index>(local.size()), static_cast<Index>(leaf.order.size()));
    leaf.factor->express_private(local, state_.values(number), own, noise);
    for (Index c = 0; c < own.cols(); ++c) sorted.col(leaf.order[c]) = own.col(c);
    add(state_.solution.tree.touch(leaf.key), leaf.variables, std::move(sorted));
    std::vector<Index> rows;
    for (const std::size_t i : chosen)
      for (Index d = 0; d < kDim; ++d) rows.push_back(row + static_cast<Index>(kDim * i) + d);
    rest_(rows, rows) = noise;
    rows_.insert(rows_.end(), rows.begin(), rows.end());
  }

  const State& state_;
  std::vector<TreeCombinations> combinations_;
  std::vector<Index> rows_;  // by column of the combinations
  Eigen::MatrixXd rest_;
};

}  // namespace

template <class Pose>
void SparseCovariances<Pose>::prepare(const SparseState<Pose>& state, const std::vector<std::size_t>& indices) {
  const std::lock_guard<std::mutex> lock(mutex_);
  invert(state, indices);
}

template <class Pose>
void SparseCovariances<Pose>::resize(const SparseState<Pose>& state) {
  covariances_.resize(state.landmarks.size());
  found_.resize(state.landmarks.size());
}

template <class Pose>
void SparseCovariances<Pose>::invert(const SparseState<Pose>& state, const std::vector<std::size_t>& indices) {
  resize(state);
  std::vector<std::uint32_t> wanted;
  const Found inverted{state.change, By::inversion};
  for (const std::size_t index : indices) {
    const std::uint32_t landmark = state.visible[index];
    if (found_[landmark] != inverted) wanted.push_back(state.landmarks[landmark].submaps[0]);
  }
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  if (wanted.empty()) return;
  std::vector<TreeKey> keys;
  for (const std::uint32_t leaf : wanted) keys.push_back(state.leaves[leaf].key);
  CovarianceVisitor<Pose> visitor(state, [&](std::uint32_t landmark, const PointSquare& covariance) {
    covariances_[landmark] = covariance;
    found_[landmark] = inverted;
  });
  state.solution.tree.covariances(std::move(keys), visitor);
}

template <class Pose>
typename SparseCovariances<Pose>::PointSquare SparseCovariances<Pose>::of(const SparseState<Pose>& state,
                                                                          std::size_t index) {
  const std::lock_guard<std::mutex> lock(mutex_);
  invert(state, {index});
  return covariances_[state.visible[index]];
}

template <class Pose>
typename SparseCovariances<Pose>::PointSquare SparseCovariances<Pose>::alone(const SparseState<Pose>& state,
                                                                             std::size_t index) {
  const std::lock_guard<std::mutex> lock(mutex_);
  resize(state);
  const std::uint32_t landmark = state.visible[index];
  const Found by_path{state.change, By::path};
  if (found_[landmark] != by_path) {
    ChosenErrors<Pose> chosen(state, Pose::kDim);
    chosen.add_landmarks(&index, 1, 0);
    covariances_[landmark] = chosen.covariance();
    found_[landmark] = by_path;
  }
  return covariances_[landmark];
}

template <class Pose>
void joint_covariance_of_base(const SparseState<Pose>& state, const std::size_t* indices, std::size_t count,
                              double* matrix, bool errors) {
  constexpr int kDim = Pose::kDim, kDof = Pose::kDof;
  using Number = std::uint32_t;
  const std::vector<Number> error_points = errors ? state.errors_at(state.solution.newest) : std::vector<Number>();
  const auto first = static_cast<Index>(kDof + kDim * error_points.size());
  const auto size = first + static_cast<Index>(kDim * count);
  Eigen::Map<Eigen::MatrixXd> joint(matrix, size, size);
  const Number last = state.bases[state.solution.newest].leaves[0];
  if (last == SparseState<Pose>::kNone) {
    joint.setIdentity();  // of the systematic errors' points
    joint.template topLeftCorner<kDof, kDof>() = state.solution.base_covariance;
    return;
  }
  ChosenErrors<Pose> chosen(state, size);
  chosen.add(base_variable(state.solution.newest), last, 0);
  for (std::size_t i = 0; i < error_points.size(); ++i)
    chosen.add(landmark_variable(error_points[i]), last, static_cast<Index>(kDof + kDim * i));
  chosen.add_landmarks(indices, count, first);
  joint = chosen.covariance();
  for (Index c = 0; c < size; ++c)  // both triangles, bit for bit
    for (Index r = c + 1; r < size; ++r) joint(c, r) = joint(r, c);
}

template <class Pose>
Eigen::VectorXd errors_of(const SparseState<Pose>& state) {
  const ErrorPoints<Pose>& points = state.error_points;
  const Eigen::VectorXd values = state.error_values(state.errors_at(state.solution.newest));
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
