// SPDX-License-Identifier: BSD-3-Clause
// What the open submap has seen again of the map, and what absolute fixes told, gives the pose of its base, and of the
// vehicle, before it is closed (docs/submaps.md, "The pose").
#pragma once

#include <Eigen/Cholesky>
#include <mutex>
#include <optional>
#include <vector>

#include "ekf/state.hpp"
#include "map/fixed_base.hpp"
#include "map/global_map.hpp"
#include "map/submap_innovation.hpp"
#include "slam/filter_options.hpp"

namespace cairn {

// A landmark that the open submap and the map have in common.
struct CommonLandmark {
  Index slot;         // in the open submap
  std::size_t index;  // in the map
};

// Where both have their common landmarks, and how well they know them: the joint covariances, in ordinary errors, of
// [base; landmarks; landmarks that were asked for] in the map and of [vehicle; landmarks] in the submap. If there were
// fixes, they have corrected the map's part, and Sigma is that of the submap given the error of its base.
template <class Pose>
struct CommonPlaces {
  std::vector<typename Pose::Point> in_map, in_submap;
  Eigen::MatrixXd P, Sigma;
  std::optional<FixedBase<Pose>> fixed;
  Eigen::MatrixXd gain;  // of [vehicle; landmarks] in the submap, by the error of the base
};

// Queries may run at the same time.
template <class Pose>
class SeenAgain {
 public:
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using Point = typename Pose::Point;
  using Square = typename Pose::Square;
  using Matrix = Eigen::MatrixXd;
  using Vector = Eigen::VectorXd;
  using Commons = std::vector<CommonLandmark>;

  explicit SeenAgain(const FilterOptions<Pose>& options);

  // Base and vehicle in the submap, given that the common landmarks are the same ones in both. The landmarks that were
  // asked for stay where the map has them, and so does their covariance.
  struct Given {
    Pose base, vehicle;
    Matrix covariance;    // of [base; vehicle; landmarks of the map that were asked for], ordinary errors
    bool agrees = false;  // most common landmarks pass the gates
  };
  // `fixed`: what fixes in the open submap told, if there were any; the error of its base is then the state's last
  // systematic error.
  Given given(const GlobalMap<Pose>& map, const State<Pose>& open, const Commons& landmarks, const std::size_t* indices,
              std::size_t count, const std::optional<FixedBase<Pose>>& fixed = std::nullopt);

 private:
  void gather_given_base(const State<Pose>& open, const std::vector<Index>& slots, CommonPlaces<Pose>& common) const;
  void correct(const CommonPlaces<Pose>& common, Given& given) const;
  Matrix joint(const GlobalMap<Pose>& map, const Commons& common, const std::size_t* indices, std::size_t count);
  void condition(CommonPlaces<Pose> common, Given& given) const;
  std::vector<Eigen::Index> accepted(const SubmapInnovation<Pose>& innovation) const;
  bool iterate(const Pose& base, const CommonPlaces<Pose>& common, SubmapInnovation<Pose>& innovation,
               Eigen::LLT<Matrix>& factor, Vector& weights) const;
  void correct(const CommonPlaces<Pose>& common, const SubmapInnovation<Pose>& innovation,
               const Eigen::LLT<Matrix>& factor, const Vector& weights, Given& given) const;
  // Of the vehicle in the submap, by the ordinary error of the base.
  static Square vehicle_by_base(const CommonPlaces<Pose>& common, const Pose& base) {
    return common.gain.template topRows<kDof>() * pose_error_jacobian(base, common.fixed->at);
  }

  const FilterOptions<Pose>& options_;
  double single_gate_;
  std::mutex mutex_;  // guards the members below: the joint covariance of base and common landmarks, while it holds
  std::uint64_t revision_ = 0;
  std::vector<std::size_t> landmarks_;
  Matrix P_;
};

extern template class SeenAgain<SE2>;
extern template class SeenAgain<SE3>;

}  // namespace cairn
