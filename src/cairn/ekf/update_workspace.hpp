// SPDX-License-Identifier: BSD-3-Clause
// The memory of an update. It is allocated once, at creation: an update allocates nothing.
#pragma once

#include "core/arena.hpp"
#include "ekf/batch.hpp"
#include "sensor/sensor.hpp"

namespace cairn {

// The capacity of a filter's state.
template <class Pose>
struct StateCapacity {
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof, kMount = kMountErrors<Pose>;
  Index landmarks;     // companions among them
  Index observations;  // points that one batch may touch
  Index companions = 0;
  Index systematic = 0;
  Index rows() const { return std::max<Index>({kDim * observations, kDof, systematic}); }
  Index window() const { return kDof + systematic + kMount + kDim * observations; }
  Index states() const { return kDof + systematic + kTurn * companions + kDim * landmarks; }
  Index blocks() const { return (systematic > 0 ? 4 : 3) * observations + 1; }  // of a batch's Jacobian
};

// m rows of the batch, n states, w columns of the window; `ld` rows lie between columns that have a row a state.
template <class Pose>
struct UpdateWorkspace {
  UpdateWorkspace(Arena& arena, const StateCapacity<Pose>& capacity, Index ld);

  Index* slots;            // of the window's points
  double* iterate_points;  // their positions at the iterate
  Batch batch;
  double* residual;      // m: residuals at a trial iterate
  double* HP;            // m x w: the window's columns of H P
  double* S;             // m x m: innovation covariance, then its factor
  double* S_inverse;     // m x m
  double* innovation;    // m: r + H xi at the last linearisation, then L^-1 of it
  double* weights;       // m: S^-1 (r + H xi)
  double* foreseen;      // m: residual that the linear model predicts at its own solution
  double* error_window;  // w: error of the iterate against the estimate
  double* columns;       // ld x w: the window's columns of P_now, with a row for each error of the mount
  double* W;             // ld x m: P H^T, after the commit times L^-T
  double* error_state;   // n: error of the whole state
  double* shrunk;        // n: decrease of the diagonal by an update
  double* diagonal;      // n
  double* mount_cross;   // ld x kMount: covariance of every state with the mount after the commit
  double* scratch;       // m^2 + cholesky_workspace(m), and what the kernels ask for
  Index* kept;           // a number for each point of the window: which blocks the gates leave
  bool* refused;
};

}  // namespace cairn
