// SPDX-License-Identifier: BSD-3-Clause
// Queries of the sparse map. Covariances are recovered from the factor when they are asked for, and kept until the map
// changes. Included by sparse_map.cpp alone.
#pragma once

#include <algorithm>

#include "map/join/sparse/sparse_map.hpp"

namespace cairn {

template <class Pose>
bool SparseMap<Pose>::find(std::uint64_t id, std::size_t& index) const {
  const auto found = ids_.find(id);
  if (found == ids_.end()) return false;
  index = landmarks_[found->second].slot;
  return true;
}

// Fills the cache, leaf by leaf.
template <class Pose>
class SparseMap<Pose>::CovarianceCache final : public EliminationTree<Pose>::Covariances {
 public:
  explicit CovarianceCache(const SparseMap& map) : map_(map) {}

  void leaf(std::uint32_t number, const Eigen::MatrixXd& in_own_axes) override {
    const Leaf& leaf = map_.leaves_[number];
    Eigen::MatrixXd covariance = in_own_axes;
    map_.to_map_axes(leaf.variables, covariance);
    std::vector<Index> privates;
    for (std::size_t i = 0; i < leaf.landmarks.size(); ++i) {
      const Number landmark = leaf.landmarks[i];
      if (landmark != kNone && !map_.shared(landmark)) privates.push_back(static_cast<Index>(i));
    }
    const std::vector<Index>& shared_ones = leaf.factor->shared();
    for (std::size_t i = 0; i < shared_ones.size(); ++i) {
      const Index at = leaf.order[Factor::column(static_cast<Index>(i))];
      // From the leaf that is asked for it alone: the others agree but for their last bits.
      const Number landmark = leaf.landmarks[shared_ones[i]];
      if (map_.landmarks_[landmark].submaps[0] == number) keep(landmark, covariance.block<kDim, kDim>(at, at));
    }
    if (privates.empty()) return;
    Eigen::MatrixXd A, W, sorted(kDim * static_cast<Index>(privates.size()), covariance.rows());
    leaf.factor->express_private(privates, map_.values(leaf), A, W);
    for (Index c = 0; c < A.cols(); ++c) sorted.col(leaf.order[c]) = A.col(c);
    const Eigen::MatrixXd across = sorted * covariance;
    for (std::size_t a = 0; a < privates.size(); ++a) {
      const auto row = kDim * static_cast<Index>(a);
      keep(leaf.landmarks[privates[a]],
           W.block<kDim, kDim>(row, row) + across.middleRows<kDim>(row) * sorted.middleRows<kDim>(row).transpose());
    }
  }

 private:
  void keep(Number landmark, const PointSquare& covariance) {
    map_.covariances_[landmark] = 0.5 * (covariance + covariance.transpose());
    map_.covariance_of_[landmark] = map_.change_;
  }

  const SparseMap& map_;
};

template <class Pose>
void SparseMap<Pose>::prepare_covariances(const std::vector<std::size_t>& indices) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  covariances_.resize(landmarks_.size());
  covariance_of_.resize(landmarks_.size(), 0);
  std::vector<Number> wanted;
  for (const std::size_t index : indices) {
    const Number landmark = visible_[index];
    if (covariance_of_[landmark] != change_) wanted.push_back(landmarks_[landmark].submaps[0]);
  }
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  if (wanted.empty()) return;
  std::vector<TreeKey> keys;
  for (const Number leaf : wanted) keys.push_back(leaves_[leaf].key);
  CovarianceCache cache(*this);
  tree_.covariances(std::move(keys), cache);
}

template <class Pose>
Matrix3 SparseMap<Pose>::covariance(std::size_t index) const {
  prepare_covariances({index});
  const std::lock_guard<std::mutex> lock(mutex_);
  return Embedding<Pose>::up(covariances_[visible_[index]]);
}

// Columns of the covariance for chosen variables; of the solution their rows alone.
template <class Pose>
class SparseMap<Pose>::Columns final : public EliminationTree<Pose>::System {
 public:
  explicit Columns(std::vector<Variable> variables) : variables_(std::move(variables)) {
    Index state = 0;
    for (const Variable v : variables_) {
      states_.push_back(state);
      state += dimension(v);
    }
    covariance.resize(state, state);
  }
  Index columns() const { return covariance.cols(); }
  Index state(Variable v) const { return states_[position(v)]; }

  void right_hand_side(Variable v, double* b, Index ld) const override {
    const std::size_t at = position(v);
    if (at == variables_.size()) return;
    for (Index d = 0; d < dimension(v); ++d) b[(states_[at] + d) * ld + d] += 1.0;
  }
  bool solution(Variable v, const double* x, Index ld) override {
    const std::size_t at = position(v);
    if (at == variables_.size()) return false;
    for (Index c = 0; c < covariance.cols(); ++c)
      for (Index d = 0; d < dimension(v); ++d) covariance(states_[at] + d, c) = x[c * ld + d];
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

template <class Pose>
void SparseMap<Pose>::base_joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const {
  const auto size = static_cast<Index>(kDof + kDim * count);
  Eigen::Map<Eigen::MatrixXd> joint(matrix, size, size);
  if (leaves_.empty()) {
    joint = base_covariance_;
    return;
  }
  // All asked for are A e + w by chosen variables' errors e; only private landmarks of one submap share a w.
  const Variable newest = base_variable(bases_.size() - 1);
  std::vector<Variable> variables{newest};
  std::vector<TreeTouch> touches{tree_.touch(newest, leaves_.back().key)};
  std::map<Number, std::vector<std::size_t>> privates;  // by leaf: which of those asked for
  const auto want = [&](Variable v, Number leaf) {
    variables.push_back(v);
    touches.push_back(tree_.touch(v, leaves_[leaf].key));
  };
  for (std::size_t i = 0; i < count; ++i) {
    const Number landmark = visible_[indices[i]], leaf = landmarks_[landmark].submaps[0];
    if (shared(landmark))
      want(landmark_variable(landmark), leaf);
    else
      privates[leaf].push_back(i);
  }
  for (const auto& [leaf, asked] : privates)
    for (const Variable v : leaves_[leaf].variables) want(v, leaf);
  std::sort(variables.begin(), variables.end());
  variables.erase(std::unique(variables.begin(), variables.end()), variables.end());
  Columns columns(variables);
  tree_.solve(std::move(touches), columns.columns(), columns);
  to_map_axes(variables, columns.covariance);

  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, columns.columns()), W = Eigen::MatrixXd::Zero(size, size);
  A.block<kDof, kDof>(0, columns.state(newest)).setIdentity();
  for (std::size_t i = 0; i < count; ++i) {
    const Number landmark = visible_[indices[i]];
    if (shared(landmark))
      A.block<kDim, kDim>(static_cast<Index>(kDof + kDim * i), columns.state(landmark_variable(landmark)))
          .setIdentity();
  }
  for (const auto& [number, asked] : privates) {
    const Leaf& leaf = leaves_[number];
    std::vector<Index> local;
    for (const std::size_t i : asked)
      local.push_back(std::find(leaf.landmarks.begin(), leaf.landmarks.end(), visible_[indices[i]]) -
                      leaf.landmarks.begin());
    Eigen::MatrixXd own, noise, sorted(kDim * static_cast<Index>(local.size()), static_cast<Index>(leaf.order.size()));
    leaf.factor->express_private(local, values(leaf), own, noise);
    for (Index c = 0; c < own.cols(); ++c) sorted.col(leaf.order[c]) = own.col(c);
    for (std::size_t a = 0; a < asked.size(); ++a) {
      const auto row = static_cast<Index>(kDof + kDim * asked[a]), from = kDim * static_cast<Index>(a);
      for (std::size_t v = 0; v < leaf.variables.size(); ++v) {
        const Index d = dimension(leaf.variables[v]);
        A.block(row, columns.state(leaf.variables[v]), kDim, d) = sorted.block(from, leaf.states[v], kDim, d);
      }
      for (std::size_t b = 0; b < asked.size(); ++b)
        W.block<kDim, kDim>(row, static_cast<Index>(kDof + kDim * asked[b])) =
            noise.block<kDim, kDim>(from, kDim * static_cast<Index>(b));
    }
  }
  joint = A * columns.covariance * A.transpose() + W;
  for (Index c = 0; c < size; ++c)  // both triangles, bit for bit
    for (Index r = c + 1; r < size; ++r) joint(c, r) = joint(r, c);
}

template <class Pose>
void SparseMap<Pose>::joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const {
  const std::size_t size = kDof + kDim * count;
  std::vector<double> joint(size * size);
  base_joint_covariance(indices, count, joint.data());
  without_pose<Pose>(joint.data(), count, matrix);
}

}  // namespace cairn
