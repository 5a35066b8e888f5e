// SPDX-License-Identifier: BSD-3-Clause
// The map that closed submaps join, in one of two ways: dense (dense_map.hpp) or sparse (sparse_map.hpp).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "map/landmarks.hpp"
#include "map/submap.hpp"
#include "sensor/absolute_fix.hpp"

namespace cairn {

struct JoinReport {
  std::size_t fused = 0, fresh = 0, refused = 0;
  std::size_t relinearised = 0, refactored = 0;
  std::size_t carried = 0;  // sparse: submaps that moved rigidly with others, unvisited; summed over the solutions
  int iterations = 0;
  std::size_t rows = 0;  // of the joint test of the fused landmarks
  double distance = 0.0, threshold = 0.0;
  double worst_refused = 0.0;               // squared distance of the refused landmark that contradicts most
  double moved_max = 0.0, moved_rms = 0.0;  // of landmarks that the map held before
};

struct FixReport {
  bool accepted = false;
  int iterations = 0;
  double distance = 0.0;
};

template <class Pose>
struct MapOptions {
  ErrorKind error = ErrorKind::invariant;
  std::size_t max_landmarks = 1000;
  std::size_t submap_capacity = 64;  // landmarks of a submap at most
  int iterations = 3;
  double iteration_tolerance = 0.1;
  double gate_probability = 0.99;  // of a single fused landmark
  double joint_gate_probability = 0.9999;
  double step_tolerance = 1e-2;         // sparse: smaller steps are not taken (standard deviations)
  double convergence_tolerance = 1e-2;  // sparse: no step follows a smaller one (standard deviations)
  double cost_tolerance = 1e-3;         // sparse: no step follows if the cost falls by less
  int most_iterations = 6;              // sparse: linear solutions of a closing; the joint test may need more
  bool fuse = true;                     // sparse: submaps of one place become one (docs/submaps.md)
  std::size_t max_companions = 0;       // dense: other vehicles whose submaps join the map, too
  Pose initial_pose;
  typename Pose::Square initial_covariance = Pose::Square::Zero();  // ordinary
  SharedErrorOptions errors;                                        // that the submaps share
};

// One change of a map, all or nothing: a transaction that is destroyed without commit() leaves the map as it was. After
// a call that throws, it can only be destroyed. A map has one transaction at a time, and answers queries only after it.
template <class Pose>
class MapTransaction {
 public:
  virtual ~MapTransaction() = default;
  // Adds a submap that began at the map's base; its end is the new base. At most once. Returns the report so far.
  virtual JoinReport join(const Submap<Pose>& submap) = 0;
  // Applies an absolute fix to the base, unless its squared distance exceeds `threshold`. At most once, after join().
  virtual FixReport fix(const AbsoluteFix<Pose>& fix, double threshold) = 0;
  // Makes the change final; the last call. Returns the report of the join, which is complete only now.
  virtual JoinReport commit() = 0;
};

// Every call that throws leaves the map as it was.
template <class Pose>
class GlobalMap : public Landmarks {
 public:
  bool planar() const final { return Pose::kDim == 2; }
  // Two answers of the map at one revision are equal.
  std::uint64_t revision() const { return revision_; }

  virtual std::unique_ptr<MapTransaction<Pose>> begin() = 0;
  // A transaction with one step.
  JoinReport join(const Submap<Pose>& submap) {
    const auto transaction = begin();
    transaction->join(submap);
    return transaction->commit();
  }
  FixReport fix(const AbsoluteFix<Pose>& fix, double threshold) {
    const auto transaction = begin();
    const FixReport report = transaction->fix(fix, threshold);
    transaction->commit();
    return report;
  }
  virtual void remove(std::uint64_t id) = 0;

  // Where the next submap begins.
  virtual Pose base() const = 0;
  virtual typename Pose::Square base_covariance() const = 0;  // of [dp; dtheta]
  // Of [base; landmarks], ordinary errors, kDof + kDim count on a side, both triangles.
  virtual void base_joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const = 0;
  // The systematic errors that the submaps share, where the next submap begins; and the joint covariance of
  // [base; errors; landmarks], ordinary errors.
  virtual Eigen::VectorXd errors() const = 0;
  virtual Eigen::MatrixXd joint_with_errors(const std::size_t* indices, std::size_t count) const = 0;

  virtual std::size_t submap_count() const = 0;
  virtual Pose submap_base(std::size_t submap) const = 0;
  virtual const std::vector<std::uint64_t>& submap_ids(std::size_t submap) const = 0;

 protected:
  void change() { ++revision_; }  // to be called by all that may change an answer

 private:
  std::uint64_t revision_ = 0;
};

}  // namespace cairn
