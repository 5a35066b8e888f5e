// SPDX-License-Identifier: BSD-3-Clause
// The global map of a filter: closes submaps into it, and computes the vehicle's pose in it. A filter with a single map
// has no global map: its local map is the map that the caller sees.
#pragma once

#include <memory>

#include "map/global_map.hpp"
#include "map/naming.hpp"
#include "slam/log.hpp"
#include "slam/seen_again.hpp"
#include "slam/submap_policy.hpp"
#include "slam/trajectory.hpp"

namespace cairn {

// The last attempt to close a submap.
struct ClosingReport {
  bool failed = false;
  ErrorCode error = ErrorCode::state;  // where it failed
  bool no_memory = false;
  std::size_t submaps = 0;
  ClosedBy reason = ClosedBy::none;
  Index landmarks = 0;
  JoinReport join;
  NamingReport naming;                                    // if observations bring no ids
  double widened_position = 0.0, widened_attitude = 0.0;  // of the motion to the submap's base, standard deviations
  bool widened() const { return widened_position > 0.0 || widened_attitude > 0.0; }
  double seconds = 0.0;
};

// The options of the map that a filter's submaps join.
template <class Pose>
MapOptions<Pose> map_options(const FilterOptions<Pose>& options);
// The same, with these systematic errors.
template <class Pose>
MapOptions<Pose> map_options(const FilterOptions<Pose>& options, const SystematicErrors& errors);

template <class Pose>
class SubmapKeeper {
 public:
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using Square = typename Pose::Square;

  SubmapKeeper(const FilterOptions<Pose>& options, LocalMap<Pose>& local, Trajectory<Pose>& trajectory, const Log& log);
  static std::size_t required_bytes(const FilterOptions<Pose>& options);  // of the map, if it is known beforehand

  const GlobalMap<Pose>* map() const { return map_.get(); }  // null: a single map
  void use_map(std::unique_ptr<GlobalMap<Pose>> map) { map_ = std::move(map); }
  void make_map();                     // as the options say
  const Landmarks& landmarks() const;  // the map that the caller sees
  void drive(double distance) { policy_.drive(distance); }
  void remove_landmark(std::uint64_t id);

  // --- closing --- throws with nothing changed
  void close();
  void close_if_full();  // a closing that fails leaves the submap open, and later frames try again
  // The map's base gets an absolute fix, after the open submap is closed, so that the vehicle's pose is the base. From
  // then on the error of its base is a state of each submap that begins (docs/submaps.md, "Fixes").
  FixReport fix(const AbsoluteFix<Pose>& fix, double threshold);
  // An absolute fix that updates the open submap and its base together: whether it can be one, what fills the update,
  // and that the update has used it.
  bool takes(const AbsoluteFix<Pose>& fix) const;
  bool fill_fix(EkfUpdate<Pose>& update, const AbsoluteFix<Pose>& fix, double* residual_only) const;
  void note_fix() { ++fixes_; }
  Pose base() const;  // as the open submap knows it, if it takes fixes
  // Landmarks that the open submap and the map have in common: how often the submap has observed them, and whether they
  // agree with where the map has them.
  std::uint64_t observed_again() const;
  bool agrees_with_map() const { return given(common(), nullptr, 0).agrees; }
  const ClosingReport& closing() const { return closing_; }

  // --- the vehicle in the map that the caller sees --- errors of base and open submap are independent, given the
  // systematic errors and the landmarks that both have in common
  struct Estimate {
    Pose pose;
    Square covariance;
  };
  Estimate vehicle() const;
  double pose_nees(const Pose& truth) const;
  void keep_pose();  // adds the pose to the trajectory
  typename Trajectory<Pose>::Open open_submap() const;
  // Values and covariance (both triangles) of the systematic errors.
  void systematic(double* values, double* covariance) const;
  // Covariance of [pose; landmarks of landmarks()], in space: 6 + 3 count on a side.
  void pose_joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const;

 private:
  // The vehicle in the map, and the joint covariance of [pose; landmarks] in ordinary errors. Where systematic errors
  // are states, place_with_errors() tells them from map and open submap together, and common landmarks wait for the
  // closing.
  struct Place {
    Pose pose;
    Eigen::MatrixXd joint;
  };
  typename SeenAgain<Pose>::Given given(const std::vector<CommonLandmark>& common, const std::size_t* indices,
                                        std::size_t count) const;
  Place place(const std::vector<CommonLandmark>& common, const std::size_t* indices, std::size_t count) const;
  Place place_with_errors(const std::size_t* indices, std::size_t count) const;
  bool shares_errors() const { return map_ != nullptr && local_.systematic().any(); }
  // Whether what the open submap tells depends on numbers that it shares with the map.
  bool shares() const { return shares_errors() || fixed(); }
  bool fixed() const { return fixes_ > 0; }
  SubmapErrors take_errors(const std::vector<Index>& slots) const;
  FixedBase<Pose> fixed_base() const;
  void open();                         // a new submap; after a closing it does not fail
  std::vector<Index> joining() const;  // slots of the landmarks that join the map
  std::vector<CommonLandmark> common() const;
  bool compares_deferred() const { return options_.deferred_sightings <= 1; }
  Submap<Pose> take_submap() const;
  FixReport join(ClosedBy reason, const AbsoluteFix<Pose>* fix = nullptr, double threshold = 0.0);
  std::unique_ptr<MapTransaction<Pose>> join(Submap<Pose>& submap, ClosingReport& report);
  void soften(Submap<Pose>& submap) const;
  void find_back(Submap<Pose>& submap, ClosingReport& report) const;
  bool moved() const;

  const FilterOptions<Pose>& options_;
  LocalMap<Pose>& local_;
  Trajectory<Pose>& trajectory_;
  const Log& log_;
  std::unique_ptr<GlobalMap<Pose>> map_;
  SubmapPolicy<Pose> policy_;
  RobustLoss loss_;  // of the landmarks that a submap shares with the map
  mutable SeenAgain<Pose> seen_again_;
  Eigen::VectorXd prior_;             // of the systematic errors, with which the open submap began
  Eigen::MatrixXd prior_covariance_;  // of the same
  Eigen::VectorXd next_prior_;        // of the next submap
  Eigen::MatrixXd next_covariance_;
  bool gets_fixes_ = false;  // the error of the base is a state of the submaps from the next one on
  int fixes_ = 0;            // that the open submap has used
  Pose base_;                // of the open submap, when it began
  Square base_covariance_ = Square::Zero();
  ClosingReport closing_;
};

extern template class SubmapKeeper<SE2>;
extern template class SubmapKeeper<SE3>;

}  // namespace cairn
