// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/elimination_tree.hpp"

#include "map/join/sparse/elimination_builder.hpp"
#include "map/join/sparse/elimination_pass.hpp"
#include "map/join/sparse/elimination_relaxer.hpp"
#include "map/join/sparse/elimination_solver.hpp"

namespace cairn {

template <class Pose>
void EliminationTree<Pose>::set_degree(Variable v, std::int32_t degree) {
  if (static_cast<std::size_t>(v) >= degree_.size()) {
    degree_.resize(static_cast<std::size_t>(v) + 1, 0);
    eliminated_at_.resize(static_cast<std::size_t>(v) + 1, EliminationBuilder<Pose>::kNever);
  }
  degree_[v] = degree;
}

template <class Pose>
void EliminationTree<Pose>::forget(Variable v) {
  degree_[v] = 0;
  eliminated_at_[v] = EliminationBuilder<Pose>::kNever;
}

template <class Pose>
bool EliminationTree<Pose>::update(const LeafSource& source, const Changes& changes, std::size_t& refactored,
                                   std::vector<std::uint32_t>& assembled) {
  std::vector<Touch> touches;
  for (const TreeKey& key : changes.leaves) touches.push_back(touch(key));
  for (const TreeKey& key : changes.removed) touches.push_back(touch(key));
  for (const auto& [v, key] : changes.variables)
    if (eliminated_at(v) != EliminationBuilder<Pose>::kNever) touches.push_back(touch(v, key));
  if (touches.empty()) return true;
  sort_by_key(touches);
  std::vector<std::int16_t> eliminated_at = eliminated_at_;
  assembled.clear();
  EliminationBuilder<Pose> builder(source, degree_, last_, changes.removed, eliminated_at, assembled);
  const FrontPointer top =
      builder.build(crown_ != nullptr ? crown_->child[0] : nullptr, touches.begin(), touches.end());
  const FrontPointer crown = top != nullptr ? builder.crown(top) : nullptr;
  if (builder.failed()) return false;
  crown_ = crown;
  eliminated_at_ = std::move(eliminated_at);
  refactored = builder.made();
  return true;
}

template <class Pose>
double EliminationTree<Pose>::relax(std::vector<Touch> touches, Relaxation& system) {
  if (crown_ == nullptr) return 0.0;
  rests_.take_carried(touches);
  sort_by_key(touches);
  return EliminationRelaxer<Pose>(degree_.size(), rests_, system).relax(*crown_, touches);
}

template <class Pose>
void EliminationTree<Pose>::settle(const Changes& changes, Relaxation& system) {
  if (crown_ == nullptr || rests_.empty()) return;
  std::vector<Touch> touches;
  for (const TreeKey& key : changes.leaves) touches.push_back(touch(key));
  for (const TreeKey& key : changes.removed) touches.push_back(touch(key));
  for (const auto& [v, key] : changes.variables) touches.push_back(touch(v, key));
  sort_by_key(touches);
  EliminationRelaxer<Pose>(degree_.size(), rests_, system).settle(*crown_, touches);
}

template <class Pose>
Eigen::MatrixXd EliminationTree<Pose>::covariance(const std::vector<TreeCombinations>& combinations) const {
  return CombinationSolver<Pose>(combinations, eliminated_at_).covariance(*crown_);
}

template <class Pose>
void EliminationTree<Pose>::covariances(std::vector<TreeKey> leaves, Covariances& visitor) const {
  if (crown_ == nullptr) return;
  std::vector<Touch> touches;
  for (const TreeKey& key : leaves) touches.push_back(touch(key));
  sort_by_key(touches);
  invert_selected<Pose>(*crown_, Eigen::MatrixXd(0, 0), touches.begin(), touches.end(), visitor);
}

template <class Pose>
Eigen::MatrixXd EliminationTree<Pose>::last_covariance() const {
  const TreeFront& front = *crown_;
  const Index d = dimension<Pose>(front.eliminated.back()), n = front.e;
  Eigen::MatrixXd inverse(d, d);
  inverse_from_cholesky(front.factor.data() + (n - d) * (n + 1), n, d, inverse.data(), d);
  return inverse;
}

template <class Pose>
std::size_t EliminationTree<Pose>::memory_bytes() const {
  return crown_ != nullptr ? cairn::memory_bytes(*crown_) : 0;
}

template class EliminationTree<SE2>;
template class EliminationTree<SE3>;

}  // namespace cairn
