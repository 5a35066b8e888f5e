// SPDX-License-Identifier: BSD-3-Clause
// Memory, motion, points. Marginals: state_marginals.cpp; companions: state_companions.cpp; submaps: state_compose.cpp.
#include "ekf/state.hpp"

#include "ekf/ekf_update.hpp"
#include "linear/triangle.hpp"

namespace cairn {
namespace {

// Rows of P are this far apart: whole cache lines, and no power of two, whose columns would share their cache sets.
Index leading_dimension(Index states) {
  const Index rounded = (states + 7) / 8 * 8;
  return rounded % 64 == 0 ? rounded + 8 : rounded;
}

}  // namespace

template <class Pose>
UpdateWorkspace<Pose>::UpdateWorkspace(Arena& arena, const StateCapacity<Pose>& capacity, Index ld)
    : slots(arena.take<Index>(capacity.observations)),
      iterate_points(arena.take<double>(Pose::kDim * capacity.observations)),
      batch(arena, capacity.rows(), capacity.window(), capacity.blocks()),
      residual(arena.take<double>(capacity.rows())),
      HP(arena.take<double>(capacity.window() * capacity.rows())),
      S(arena.take<double>(capacity.rows() * capacity.rows())),
      S_inverse(arena.take<double>(capacity.rows() * capacity.rows())),
      innovation(arena.take<double>(capacity.rows())),
      weights(arena.take<double>(capacity.rows())),
      foreseen(arena.take<double>(capacity.rows())),
      error_window(arena.take<double>(capacity.window())),
      columns(arena.take<double>(ld * capacity.window())),
      W(arena.take<double>(ld * capacity.rows())),
      error_state(arena.take<double>(capacity.states() + capacity.kMount)),
      shrunk(arena.take<double>(capacity.states() + capacity.kMount)),
      diagonal(arena.take<double>(capacity.states())),
      mount_cross(arena.take<double>(ld * capacity.kMount)),
      scratch(arena.take<double>(
          std::max({solve_workspace(capacity.rows()),
                    static_cast<std::size_t>(capacity.rows() * capacity.rows()) + cholesky_workspace(capacity.rows()),
                    update_triangle_workspace(capacity.states(),
                                              capacity.rows() + (capacity.systematic > 0 ? 2 : 1) * Pose::kTurn)}))),
      kept(arena.take<Index>(capacity.rows())),
      refused(arena.take<bool>(capacity.rows())) {}

template <class Pose>
State<Pose>::State(Arena& arena, ErrorKind error, const Capacity& capacity)
    : model_(error),
      ld_(leading_dimension(capacity.states() + kMount)),
      points_(arena.take<double>(kDim * capacity.landmarks)),
      attitudes_(arena.take<Rotation>(capacity.companions)),
      systematic_(arena.take<double>(capacity.systematic)),
      walk_(arena.take<double>(capacity.systematic)),
      P_(arena.take<double>(ld_ * capacity.states()), ld_),
      motion_(arena, model_, ld_, capacity.systematic),
      workspace_(arena, capacity, ld_) {}

template <class Pose>
void State<Pose>::start(const Pose& pose, const Square& ordinary_covariance, const SystematicStart& systematic) {
  origin_ = pose.translation();
  pose_ = Pose(pose.rotation(), Point::Zero());
  const Index count = systematic.count;
  layout_.clear(count);
  const Square& covariance = ordinary_covariance;  // xi_p = e_p - G(p) e_R, and p is zero
  for (Index c = 0; c < kDof; ++c)
    for (Index r = c; r < kDof; ++r) P_(r, c) = covariance(r, c);
  for (Index c = 0; c < kDof; ++c) std::fill_n(P_.column(c) + kDof, count, 0.0);
  for (Index i = 0; i < count; ++i) {
    systematic_[i] = systematic.values[i];
    walk_[i] = systematic.walk[i];
    for (Index r = i; r < count; ++r) P_(kDof + r, kDof + i) = systematic.covariance[i * count + r];
  }
  motion_.set_systematic(count, systematic.motion, walk_);
  motion_.clear();
}

template <class Pose>
bool State<Pose>::propagate(const Increment<Pose>& increment, const MotionCoupling<Pose>* coupling) {
  const Pose next = pose_ * increment.T_before_after;
  if (!motion_.add(pose_, next, increment, coupling)) return false;
  pose_ = next;
  if (far_from_origin()) move_origin();
  return true;
}

template <class Pose>
bool State<Pose>::widen(const Square& ordinary_covariance) {
  return motion_.widen(model_.own(ordinary_covariance, pose_.translation()));
}

template <class Pose>
void State<Pose>::write_covariance(Index rank, const double* columns) {
  const Index n = states();
  for (Index c = 0; c < layout_.moving(); ++c)
    std::copy(columns + c * ld_ + c, columns + c * ld_ + n, P_.column(c) + c);
  const TriangleTerm terms[] = {
      {workspace_.W, ld_, workspace_.W, ld_, rank, -1.0}, motion_.term(), motion_.second_term()};
  if (rank + motion_.rank() > 0)
    update_triangle(P_.column(0), ld_, n, terms, motion_.turns() ? 3 : 2, workspace_.scratch);
  motion_.clear();
}

template <class Pose>
void State<Pose>::apply_pending() {
  if (!motion_.any()) return;
  motion_.prepare(layout_, points_, P_);
  motion_.moving_columns(P_, states(), workspace_.columns);
  write_covariance(0, workspace_.columns);
}

template <class Pose>
void State<Pose>::move(const double* error) {
  const Tangent pose_error = Eigen::Map<const Tangent>(error + layout_.pose().offset);
  const typename ErrorModel<Pose>::PointRetraction move_point(model_, pose_error.template tail<kTurn>());
  for (Index b = 0; b < layout_.blocks(); ++b) {
    const Block block = layout_.block(b);
    const double* e = error + block.offset;
    switch (block.retraction) {
      case Retraction::pose:
        model_.retract(pose_error, pose_);
        break;
      case Retraction::number:
        for (Index i = 0; i < block.size; ++i) systematic_[i] += e[i];
        break;
      case Retraction::attitude: {
        const typename Rotation::Tangent turn = Eigen::Map<const typename Rotation::Tangent>(e);
        attitudes_[block.number] = Rotation::exp(turn) * attitudes_[block.number];
        break;
      }
      case Retraction::point:
        place_of(block.number) = move_point(local(block.number), Eigen::Map<const Point>(e));
        break;
    }
  }
}

// The part of a new landmark's covariance that systematic errors have.
template <class Pose>
typename State<Pose>::PointSquare State<Pose>::covariance_by(const ErrorColumns<kDim>& errors,
                                                             const PointByPose& J) const {
  PointSquare sum = PointSquare::Zero();
  for (Index i = 0; i < errors.count; ++i) {
    const Index at = kDof + errors.first + i;
    Point with_pose = Point::Zero();  // covariance of J e_pose with the error
    for (Index k = 0; k < kDof; ++k) with_pose += J.col(k) * P_(at, k);
    const PointSquare mixed = with_pose * errors.J.col(i).transpose();
    sum += mixed + mixed.transpose();
    for (Index j = 0; j < errors.count; ++j)
      sum += P_.symmetric(at, kDof + errors.first + j) * errors.J.col(i) * errors.J.col(j).transpose();
  }
  return sum;
}

template <class Pose>
bool State<Pose>::augment(const Point& position, const PointByPose& J_pose, const PointSquare& noise, bool relative,
                          const PointByMount* J_mount, const SharedMount* mount, const ErrorColumns<kDim>* errors) {
  const Point landmark = position - origin_;
  // Jacobians by the state's own errors: xi_l = e_l - G(l) xi_R, and e_p = xi_p + G(p) xi_R.
  PointByPose J = J_pose;
  if (model_.invariant()) {
    if (relative) {
      J.template rightCols<kTurn>().setZero();
    } else {
      J.template rightCols<kTurn>() +=
          J_pose.template leftCols<kDim>() * model_.arm(pose_.translation()) - model_.arm(landmark);
    }
  }
  const bool shares = J_mount != nullptr;
  const PointByMount M = shares ? *J_mount : PointByMount(PointByMount::Zero());
  const MountSquare<Pose> mount_covariance = shares ? mount->covariance : MountSquare<Pose>(MountSquare<Pose>::Zero());
  if (errors != nullptr) apply_pending();  // so that the covariances below are those of P
  const Square pose = pose_block();
  PointByMount cross;  // covariance of the new landmark with the mount
  Eigen::Matrix<double, kDof, kMount> pose_mount = Eigen::Matrix<double, kDof, kMount>::Zero();
  if (shares)
    for (Index c = 0; c < kMount; ++c)
      for (Index r = 0; r < kDof; ++r) pose_mount(r, c) = mount->cross[c * ld_ + r];
  cross = J * pose_mount + M * mount_covariance;
  const PointSquare mixed = J * pose_mount * M.transpose();
  PointSquare block =
      J * pose * J.transpose() + mixed + mixed.transpose() + M * mount_covariance * M.transpose() + noise;
  if (errors != nullptr) {
    const PointSquare by_errors = covariance_by(*errors, J);
    block += by_errors;
    for (Index i = 0; shares && i < errors->count; ++i) {
      PointSquare with_mount = PointSquare::Zero();
      for (Index c = 0; c < kMount; ++c) {
        const double covariance = mount->cross[c * ld_ + kDof + errors->first + i];
        cross.col(c) += errors->J.col(i) * covariance;
        with_mount += errors->J.col(i) * covariance * M.col(c).transpose();
      }
      block += with_mount + with_mount.transpose();
    }
  }
  if (!landmark.allFinite() || !J.allFinite() || !block.allFinite()) return false;
  // Beside a pose that is hardly known, the landmark's own noise would be lost to rounding: it is raised.
  for (Index d = 0; d < kDim; ++d) {
    const double rest = 1e-14 * block(d, d);
    if (rest > 1e-6 * noise(d, d)) block(d, d) += rest;
  }
  apply_pending();

  const Index n = states();
  for (Index c = 0; c < n; ++c)
    for (Index r = 0; r < kDim; ++r) {
      double value = 0.0;
      for (Index k = 0; k < kDof; ++k) value += J(r, k) * P_.symmetric(c, k);
      if (shares)
        for (Index k = 0; k < kMount; ++k) value += M(r, k) * mount->cross[k * ld_ + c];
      for (Index i = 0; errors != nullptr && i < errors->count; ++i)
        value += errors->J(r, i) * P_.symmetric(c, kDof + errors->first + i);
      P_(n + r, c) = value;
    }
  for (Index c = 0; c < kDim; ++c)
    for (Index r = c; r < kDim; ++r) P_(n + r, n + c) = 0.5 * (block(r, c) + block(c, r));
  if (shares)
    for (Index c = 0; c < kMount; ++c)
      for (Index r = 0; r < kDim; ++r) mount->cross[c * ld_ + n + r] = cross(r, c);
  place_of(size()) = landmark;
  layout_.add_points(1);
  return true;
}

// The invariant error xi_l = e_l - G(l) xi_R of the copy is that of the landmark plus the noise, because both have the
// same position.
template <class Pose>
void State<Pose>::duplicate(Index slot, const PointSquare& noise) {
  const Index n = states(), from = layout_.point(slot).offset;
  for (Index c = 0; c < n; ++c)
    for (Index d = 0; d < kDim; ++d) P_(n + d, c) = P_.symmetric(from + d, c);
  for (Index c = 0; c < kDim; ++c)
    for (Index r = c; r < kDim; ++r) P_(n + r, n + c) = P_(from + r, from + c) + noise(r, c);
  place_of(size()) = local(slot);
  layout_.add_points(1);
}

template <class Pose>
void State<Pose>::exchange_landmarks(Index a, Index b) {
  if (a == b) return;
  const Index at_a = layout_.point(a).offset, at_b = layout_.point(b).offset;
  for (Index d = 0; d < kDim; ++d) P_.exchange(at_a + d, at_b + d, states());
  for (Index c = 0; c < kMount; ++c) {  // of an update that places landmarks
    double* cross = workspace_.mount_cross + c * ld_;
    std::swap_ranges(cross + at_a, cross + at_a + kDim, cross + at_b);
  }
  const Point kept = local(a);
  place_of(a) = local(b);
  place_of(b) = kept;
}

template <class Pose>
void State<Pose>::remove(Index slot) {
  // Motion that is held back needs no change: it depends on each landmark only through the landmark's position.
  const Index last = size() - 1;
  if (slot != last) {
    const Index to = layout_.point(slot).offset, from = layout_.point(last).offset;
    for (Index c = 0; c < to; ++c)
      for (Index r = 0; r < kDim; ++r) P_(to + r, c) = P_(from + r, c);
    for (Index c = 0; c < kDim; ++c)
      for (Index r = c; r < kDim; ++r) P_(to + r, to + c) = P_(from + r, from + c);
    for (Index c = to + kDim; c < from; ++c)
      for (Index r = 0; r < kDim; ++r) P_(c, to + r) = P_(from + r, c);
    for (Index c = 0; c < kMount; ++c) {  // of an update that places landmarks
      double* cross = workspace_.mount_cross + c * ld_;
      std::copy_n(cross + from, kDim, cross + to);
    }
    place_of(slot) = local(last);
  }
  layout_.remove_last_point();
}

template <class Pose>
typename State<Pose>::Backup State<Pose>::backup() const {
  const Index n = states();
  Backup backup{pose_,
                origin_,
                {points_, points_ + kDim * size()},
                {},
                {systematic_, systematic_ + systematic()},
                {attitudes_, attitudes_ + companions()},
                motion_.snapshot()};
  backup.triangle.reserve(n * (n + 1) / 2);
  for (Index c = 0; c < n; ++c) backup.triangle.insert(backup.triangle.end(), P_.column(c) + c, P_.column(c) + n);
  return backup;
}

template <class Pose>
void State<Pose>::restore(const Backup& backup) {
  pose_ = backup.pose;
  origin_ = backup.origin;
  const Index points = static_cast<Index>(backup.points.size()) / kDim;
  layout_.add_points(points - size());
  std::copy(backup.points.begin(), backup.points.end(), points_);
  std::copy(backup.systematic.begin(), backup.systematic.end(), systematic_);
  std::copy(backup.attitudes.begin(), backup.attitudes.end(), attitudes_);
  const double* from = backup.triangle.data();
  const Index n = states();
  for (Index c = 0; c < n; from += n - c, ++c) std::copy_n(from, n - c, P_.column(c) + c);
  motion_.restore(backup.motion);
}

template struct UpdateWorkspace<SE2>;
template struct UpdateWorkspace<SE3>;
template class State<SE2>;
template class State<SE3>;

}  // namespace cairn
