// SPDX-License-Identifier: BSD-3-Clause
#include "ekf/ekf_update.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/compiler.hpp"
#include "linear/triangle.hpp"

namespace cairn {

template <class Pose>
EkfUpdate<Pose>::EkfUpdate(State<Pose>& state, const typename State<Pose>::Window& window)
    : state_(state),
      workspace_(state.workspace_),
      window_(state.systematic(), window.mount_noise != nullptr ? kMount : 0, window.count),
      pose_(state.pose_) {
  for (Index a = 0; a < window.count; ++a) {
    workspace_.slots[a] = window.slots[a];
    place_of(a) = state.local(window.slots[a]);
  }
  if (window.mount_noise != nullptr) {
    mount_covariance_ = *window.mount_noise;
    for (Index c = 0; c < kMount; ++c) std::fill_n(workspace_.mount_cross + c * state_.ld_, state_.states(), 0.0);
  }
  gather_columns();
  std::fill_n(workspace_.error_window, window_.columns(), 0.0);
  batch().clear();
}

template <class Pose>
void EkfUpdate<Pose>::require(bool legal, const char* call) const {
  if (legal) return;
  static const char* const kStages[] = {"opened", "linearised", "factored", "solved", "committed"};
  throw std::logic_error(std::string("EkfUpdate: ") + call + "() is not legal for an update that was just " +
                         kStages[static_cast<int>(stage_)]);
}

// Writes the window's columns of P_now, with the rows of the mount behind those of the states.
template <class Pose>
void EkfUpdate<Pose>::gather_columns() {
  constexpr Index kAhead = 4;  // columns
  const Index n = state_.states(), ld = state_.ld_, mount = window_.mount_size();
  const LowerTriangle& P = state_.P_;
  PendingMotion<Pose>& motion = state_.motion_;
  double* const columns = workspace_.columns;
  const Index moving = window_.moving();
  motion.prepare(state_.layout_, state_.points_, P);
  motion.moving_columns(P, n, columns);
  // The mount's errors are states for as long as the frame lasts, independent of all others before it.
  for (Index i = 0; i < mount; ++i)
    for (Index c = 0; c < window_.columns(); ++c) columns[c * ld + n + i] = 0.0;
  for (Index i = 0; i < mount; ++i) {
    std::fill_n(columns + (window_.mount() + i) * ld, n, 0.0);
    for (Index r = 0; r < mount; ++r) columns[(window_.mount() + i) * ld + n + r] = mount_covariance_(r, i);
  }
  // The entries of P to the left of a landmark's diagonal block lie along rows: each column costs a cache line. The
  // loop visits all landmarks for a few columns at a time, so that it stays within few pages, and prefetches the lines
  // of the next landmarks.
  for (Index c = moving; c < n; c += kAhead) {
    const double* from_columns = P.column(c);
    for (Index a = 0; a < window_.points(); ++a) {
      const Index from = state_.layout_.point(workspace_.slots[a]).offset;
      if (c >= from) continue;
      double* to = columns + window_.point(a) * ld + c;
      if (c + kAhead > from) {
        for (Index k = 0; c + k < from; ++k)
          for (Index d = 0; d < kDim; ++d) to[d * ld + k] = from_columns[k * ld + from + d];
        continue;
      }
      for (Index k = 0; k < kAhead; ++k) CAIRN_PREFETCH_READ(from_columns + (kAhead + k) * ld + from);
      for (Index d = 0; d < kDim; ++d)
        for (Index k = 0; k < kAhead; ++k) to[d * ld + k] = from_columns[k * ld + from + d];
    }
  }
  for (Index a = 0; a < window_.points(); ++a) {
    const Index from = state_.layout_.point(workspace_.slots[a]).offset;
    double* to = columns + window_.point(a) * ld;
    for (Index c = 0; c < moving; ++c)
      for (Index d = 0; d < kDim; ++d) to[d * ld + c] = columns[c * ld + from + d];
    for (Index d = 0; d < kDim; ++d)
      for (Index r = 0; r < kDim; ++r) to[d * ld + from + r] = P.symmetric(from + r, from + d);
    for (Index d = 0; d < kDim; ++d)
      std::copy_n(P.column(from + d) + from + kDim, n - from - kDim, to + d * ld + from + kDim);
    for (Index d = 0; d < kDim; ++d) motion.add_change(from + d, n, to + d * ld);  // + U N U_a^T
  }
}

template <class Pose>
void EkfUpdate<Pose>::compute_innovation() {
  const Index m = batch().rows(), n = state_.states(), ld = state_.ld_;
  double* const W = workspace_.W;
  double* const HP = workspace_.HP;
  batch().times_transposed(workspace_.columns, ld, n + window_.mount_size(), W, ld);
  const auto take_rows = [&](Index row, Index count, Index column) {
    constexpr Index kAtOnce = 4;
    Index j = 0;
    for (; j + kAtOnce <= m; j += kAtOnce)
      for (Index k = 0; k < count; ++k)
        for (Index i = 0; i < kAtOnce; ++i) HP[(column + k) * m + j + i] = W[(j + i) * ld + row + k];
    for (; j < m; ++j)
      for (Index k = 0; k < count; ++k) HP[(column + k) * m + j] = W[j * ld + row + k];
  };
  take_rows(0, window_.moving(), 0);
  take_rows(n, window_.mount_size(), window_.mount());
  for (Index a = 0; a < window_.points(); ++a)
    take_rows(state_.layout_.point(workspace_.slots[a]).offset, kDim, window_.point(a));
  stage_ = Stage::linearised;
  form_innovation();
}

template <class Pose>
void EkfUpdate<Pose>::form_innovation() {
  require(stage_ == Stage::linearised || stage_ == Stage::factored, "form_innovation");
  const Index m = batch().rows();
  double prior[kDim];
  double largest = 0.0;
  for (Index d = 0; d < kDim; ++d) largest = std::max(largest, prior[d] = workspace_.columns[d * state_.ld_ + d]);
  batch().innovation_covariance(workspace_.HP, m, workspace_.S, m, prior, largest > kHardlyKnown ? kDim : 0);
  std::copy_n(batch().residual(), m, workspace_.innovation);
  stage_ = Stage::linearised;
}

template <class Pose>
double EkfUpdate<Pose>::distance(Index block, Index rows) const {
  require(stage_ == Stage::linearised, "distance");
  const Index m = batch().rows();
  const double distance =
      squared_distance(batch().residual() + block * rows, workspace_.S + block * rows * (m + 1), m, rows);
  return distance >= 0.0 ? distance : std::numeric_limits<double>::infinity();
}

template <class Pose>
void EkfUpdate<Pose>::keep(const Index* blocks, Index count, Index rows) {
  require(stage_ == Stage::linearised || stage_ == Stage::factored, "keep");
  const Index before = batch().rows(), m = count * rows, ld = state_.ld_;
  const Index height = state_.states() + window_.mount_size();
  double* const W = workspace_.W;
  double* const HP = workspace_.HP;
  for (Index k = 0; k < count; ++k)
    for (Index r = 0; r < rows && blocks[k] != k; ++r)
      std::copy_n(W + (blocks[k] * rows + r) * ld, height, W + (k * rows + r) * ld);
  for (Index c = 0; c < window_.columns(); ++c)
    for (Index k = 0; k < count; ++k)
      std::memmove(HP + c * m + k * rows, HP + c * before + blocks[k] * rows, rows * sizeof(double));
  batch().keep(blocks, count, rows);
  form_innovation();
}

template <class Pose>
InverseInnovation EkfUpdate<Pose>::invert() {
  require(stage_ == Stage::linearised || stage_ == Stage::factored, "invert");
  form_innovation();  // S may be overwritten by its factor
  const Index m = batch().rows();
  double* const L = workspace_.scratch;
  for (Index j = 0; j < m; ++j) std::copy(workspace_.S + j * m + j, workspace_.S + (j + 1) * m, L + j * m + j);
  if (!cholesky(L, m, m, workspace_.scratch + m * m)) throw_not_definite();
  inverse_from_cholesky(L, m, m, workspace_.S_inverse, m);

  double* const u = workspace_.residual;  // S^-1 r
  std::fill_n(u, m, 0.0);
  for (Index j = 0; j < m; ++j)
    for (Index i = 0; i < m; ++i) u[i] += workspace_.S_inverse[j * m + i] * batch().residual()[j];
  double sum = 0.0;
  for (Index i = 0; i < m; ++i) sum += u[i] * batch().residual()[i];
  return {workspace_.S_inverse, u, sum, workspace_.scratch};
}

template <class Pose>
bool EkfUpdate<Pose>::try_factor() {
  require(stage_ == Stage::linearised, "factor");
  const Index m = batch().rows();
  stage_ = Stage::open;  // S is overwritten, even if it has no factor
  if (!cholesky(workspace_.S, m, m, workspace_.scratch)) return false;
  // The residual of the iterated filter: r(x_i) + H_i xi_i (Bell and Cathey 1993); xi is zero at the first
  // linearisation.
  double* const innovation = workspace_.innovation;
  batch().add_product(1.0, workspace_.error_window, innovation);
  std::copy_n(innovation, m, workspace_.foreseen);
  solve_lower(workspace_.S, m, m, innovation);
  nis_ = 0.0;
  for (Index i = 0; i < m; ++i) nis_ += innovation[i] * innovation[i];
  if (!std::isfinite(nis_)) return false;
  stage_ = Stage::factored;
  return true;
}

template <class Pose>
void EkfUpdate<Pose>::whiten(double* x) const {
  require(stage_ == Stage::factored, "whiten");
  solve_lower(workspace_.S, batch().rows(), batch().rows(), x);
}

template <class Pose>
void EkfUpdate<Pose>::solve() {
  require(stage_ == Stage::factored, "solve");
  const Index m = batch().rows();
  double* const weights = workspace_.weights;
  std::copy_n(workspace_.innovation, m, weights);
  solve_lower_transposed(workspace_.S, m, m, weights);
  for (Index c = 0; c < window_.columns(); ++c) workspace_.error_window[c] = dot(workspace_.HP + c * m, weights, m);
  batch().add_product(-1.0, workspace_.error_window, workspace_.foreseen);
  stage_ = Stage::solved;
}

template <class Pose>
void EkfUpdate<Pose>::step() {
  require(stage_ == Stage::solved, "step");
  const Tangent error = Eigen::Map<const Tangent>(workspace_.error_window);
  iterating_ = true;
  pose_ = state_.pose_;
  state_.model_.retract(error, pose_);
  for (Index i = 0; i < window_.mount_size(); ++i) mount_(i) = workspace_.error_window[window_.mount() + i];
  const typename ErrorModel<Pose>::PointRetraction move_point(state_.model_, error.template tail<kTurn>());
  for (Index a = 0; a < window_.points(); ++a)
    place_of(a) = move_point(state_.local(workspace_.slots[a]),
                             Eigen::Map<const Point>(workspace_.error_window + window_.point(a)));
}

template <class Pose>
Pose EkfUpdate<Pose>::solved_pose() const {
  Pose pose = state_.pose_;
  if (stage_ == Stage::solved) state_.model_.retract(Eigen::Map<const Tangent>(workspace_.error_window), pose);
  return Pose(pose.rotation(), pose.translation() + state_.origin_);
}

template <class Pose>
MountError<Pose> EkfUpdate<Pose>::solved_mount() const {
  MountError<Pose> mount = mount_;
  for (Index i = 0; i < window_.mount_size() && stage_ == Stage::solved; ++i)
    mount(i) = workspace_.error_window[window_.mount() + i];
  return mount;
}

template <class Pose>
double EkfUpdate<Pose>::misfit(const double* residual) const {
  require(stage_ == Stage::solved, "misfit");
  double sum = 0.0;
  for (Index i = 0; i < batch().rows(); ++i) {
    const double difference = residual[i] - workspace_.foreseen[i];
    sum += difference * difference / batch().noise_variance(i);
  }
  return std::sqrt(sum);
}

template <class Pose>
bool EkfUpdate<Pose>::try_commit() {
  require(stage_ == Stage::solved, "commit");
  stage_ = Stage::open;  // W is overwritten, even if the commit is refused
  const Index n = state_.states(), m = batch().rows(), ld = state_.ld_;
  // P H^T of the last linearisation becomes W = P H^T L^-T. The error xi = W L^-1 r and the decrease of the diagonal by
  // P_new = P - W W^T (Mars paper, eq. 13) are computed before anything is changed.
  const RowSums sums{workspace_.innovation, workspace_.shrunk, workspace_.error_state};
  solve_right_transposed(workspace_.S, m, m, workspace_.W, ld, n + window_.mount_size(), workspace_.scratch, &sums);

  const PendingMotion<Pose>& motion = state_.motion_;
  double* const diagonal = workspace_.diagonal;
  const Index moving = window_.moving();
  for (Index i = 0; i < n; ++i) diagonal[i] = i < moving ? workspace_.columns[i * ld + i] : state_.P_(i, i);
  for (Index twice = 0; twice < (motion.turns() ? 2 : 1); ++twice)
    for (Index t = 0; t < motion.rank(); ++t)
      for (Index i = moving; i < n; ++i) diagonal[i] += motion.left()[t * ld + i] * motion.right()[t * ld + i];
  for (Index i = 0; i < n; ++i) {
    if (!(std::abs(workspace_.error_state[i]) <= kFarthest)) return false;  // also refuses NaN
    // A variance after the update must exceed the rounding error of the variance before it. A zero variance stays zero.
    if (!(diagonal[i] - workspace_.shrunk[i] >= kLeast * diagonal[i] && diagonal[i] >= 0.0) && !pose_alone())
      return false;
  }
  if (pose_alone()) {
    bool cancels = false;
    for (Index i = 0; i < n; ++i)
      cancels = cancels || !(diagonal[i] - workspace_.shrunk[i] >= 1e-8 * diagonal[i]) ||
                (i < kDim && diagonal[i] > kHardlyKnown);
    if (cancels) return commit_pose_alone();
  }

  if (window_.mount_size() != 0) correlate_mount();
  state_.write_covariance(m, workspace_.columns);
  state_.move(workspace_.error_state);
  double turn = 0.0;
  for (Index t = kDim; t < kDof; ++t) turn += diagonal[t];
  state_.raise_variances(diagonal, turn);
  stage_ = Stage::committed;
  return true;
}

// The mount's error after the update: its estimate, its covariance, and its covariance with every state.
template <class Pose>
void EkfUpdate<Pose>::correlate_mount() {
  const Index n = state_.states(), m = batch().rows(), ld = state_.ld_;
  double* const cross = workspace_.mount_cross;
  for (Index c = 0; c < kMount; ++c) std::fill_n(cross + c * ld, n, 0.0);
  for (Index j = 0; j < m; ++j) {
    const double* W = workspace_.W + j * ld;
    for (Index c = 0; c < kMount; ++c) {
      for (Index i = 0; i < n; ++i) cross[c * ld + i] -= W[i] * W[n + c];
      for (Index r = 0; r < kMount; ++r) mount_covariance_(r, c) -= W[n + r] * W[n + c];
    }
  }
  for (Index i = 0; i < kMount; ++i) mount_(i) = workspace_.error_window[window_.mount() + i];
}

template <class Pose>
bool EkfUpdate<Pose>::place(const Point& position, const PointByPose& J_pose, const PointByMount* J_mount,
                            const PointSquare& noise, bool relative, const ErrorColumns<kDim>* errors) {
  require(stage_ == Stage::committed || batch().rows() == 0, "place");
  stage_ = Stage::committed;  // the window's columns are those of the state before
  const typename State<Pose>::SharedMount mount{mount_covariance_, workspace_.mount_cross};
  return state_.augment(position, J_pose, noise, relative, J_mount, &mount, errors);
}

template class EkfUpdate<SE2>;
template class EkfUpdate<SE3>;

}  // namespace cairn
