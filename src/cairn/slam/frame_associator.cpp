// SPDX-License-Identifier: BSD-3-Clause
// Association of a frame: pairs, the choice among them, and the observations that are left over.
#include "slam/frame_associator.hpp"

#include <algorithm>
#include <chrono>

#include "association/doubt.hpp"

namespace cairn {
namespace {

template <class Pose>
Association::Capacity room_of(const FilterOptions<Pose>& options) {
  const AssociationCapacity<Pose> most(options);
  return {most.observations, most.pairs, most.window};
}

}  // namespace

template <class Pose>
FrameAssociator<Pose>::FrameAssociator(Arena& arena, const FilterOptions<Pose>& options, const LocalMap<Pose>& map,
                                       Thresholds& thresholds, FrameReport& report, const Log& log)
    : options_(options),
      map_(map),
      thresholds_(thresholds),
      report_(report),
      log_(log),
      association_(arena, room_of(options)),
      pairs_(arena, options, map, thresholds) {
  const AssociationCapacity<Pose> most(options);
  const Index n = most.landmarks == 0 ? 0 : Pose::kDof + Pose::kDim * most.window;
  covariance_ = arena.take<double>(static_cast<std::size_t>(n * n));
  paired_ = arena.take<bool>(static_cast<std::size_t>(most.landmarks));
}

// Joint compatibility asks for the innovations of the pairs that were found.
template <class Pose>
class FrameAssociator<Pose>::PairInnovations final : public Innovations {
 public:
  PairInnovations(const FrameAssociator& associator, const Sensor<Pose>& sensor)
      : pairs_(associator.pairs_),
        thresholds_(associator.thresholds_),
        joint_(associator.covariance_),
        rows_(sensor.rows()),
        common_mount_(sensor.mount_noise_mode() == MountNoise::per_frame
                          ? sensor.mount_noise()
                          : MountSquare<Pose>(MountSquare<Pose>::Zero())) {}

  Index rows() const override { return rows_; }
  double threshold(Index rows) const override { return thresholds_.joint(rows); }
  void innovation(Index a, double* nu) const override { std::copy_n(pairs_.pair(a).residual.data(), rows_, nu); }
  // J_a P J_b^T, and the noise of the mount's angles if all observations of a frame have it in common.
  void covariance(Index a, Index b, double* block) const override {
    Matrix3 S;
    if (a == b) {
      S = pairs_.pair(a).innovation;
    } else {
      const auto &first = pairs_.image_of_pair(a), &second = pairs_.image_of_pair(b);
      const Index n = Pose::kDof + Pose::kDim * pairs_.window_count();
      S = image_covariance(Eigen::Map<const Eigen::MatrixXd>(joint_, n, n), first.prediction, first.window,
                           second.prediction, second.window) +
          first.prediction.J_z_mount * common_mount_ * second.prediction.J_z_mount.transpose();
    }
    for (Index c = 0; c < rows_; ++c) std::copy_n(S.data() + 3 * c, rows_, block + rows_ * c);
  }

 private:
  const FramePairs<Pose>& pairs_;
  Thresholds& thresholds_;
  const double* joint_;
  Index rows_;
  MountSquare<Pose> common_mount_;
};

template <class Pose>
void FrameAssociator<Pose>::sort_landmarks(const Frame<Pose>& frame, SortedFrame<Pose>& sorted) {
  const auto start = std::chrono::steady_clock::now();
  pairs_.find(frame);
  choose_pairs(frame);
  association_.demand_support(options_.association_support,
                              [&](Index observation, Index pair) { return confusable(frame, observation, pair); });
  settle(frame, sorted);
  report_.update().association_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <class Pose>
void FrameAssociator<Pose>::choose_pairs(const Frame<Pose>& frame) {
  const Index count = frame.landmarks;
  if (options_.association == AssociationKind::nearest)
    return association_.nearest_neighbour(pairs_.candidates(), pairs_.pairs(), count);
  map_.state().gather_ordinary(pairs_.window(), pairs_.window_count(), covariance_,
                               Pose::kDof + Pose::kDim * pairs_.window_count());
  const PairInnovations innovations(*this, frame.sensor);
  association_.joint_compatibility(pairs_.candidates(), pairs_.pairs(), count, innovations, options_.association_nodes);
  report_.update().association_nodes = association_.nodes();
  report_.update().association_exhausted = association_.exhausted();
  if (association_.exhausted())
    log_.say("update: association stopped at %td joint tests, with %td of %td observations paired",
             association_.nodes(), association_.pairs(), count);
}

// Whether the pair may be wrong by chance: the prediction is uncertain, and another landmark or another observation is
// so near that it could be mistaken for this one.
template <class Pose>
bool FrameAssociator<Pose>::confusable(const Frame<Pose>& frame, Index observation, Index pair) const {
  const Sensor<Pose>& sensor = frame.sensor;
  const Index rows = sensor.rows();
  const Matrix3& innovation = pairs_.pair(pair).innovation;
  const auto& own = pairs_.image_of_pair(pair);
  const Matrix3 noise = innovation - own.covariance;
  const Doubt doubt(innovation, noise, rows, thresholds_.new_landmark(rows));
  if (!doubt.stale()) return false;
  for (Index e = 0; e < pairs_.images(); ++e)
    if (e != pairs_.pair(pair).image && doubt.confuses(sensor.residual(pairs_.image(e).prediction.z, own.prediction.z)))
      return true;
  for (Index o = 0; o < frame.landmarks; ++o)
    if (o != observation && doubt.confuses(sensor.residual(frame.z(o), own.prediction.z))) return true;
  return false;
}

// Whether the observation is of a new landmark although some landmarks of the map are near it. This holds if each of
// these was paired in this frame (a sensor sees a landmark once a frame), and if no other observation is so near that
// noise could have made two observations of one landmark.
template <class Pose>
bool FrameAssociator<Pose>::is_new(const Frame<Pose>& frame, Index observation) const {
  const Sensor<Pose>& sensor = frame.sensor;
  const Index rows = sensor.rows();
  const double bound = thresholds_.new_landmark(rows);
  const Vector3 z = frame.z(observation);
  const Matrix3& noise = pairs_.noise(observation);
  for (Index e = 0; e < pairs_.images(); ++e) {
    const auto& image = pairs_.image(e);
    if (!paired_[e] && within_bound(sensor.residual(z, image.prediction.z), image.covariance + noise, rows, bound))
      return false;
  }
  for (Index o = 0; o < frame.landmarks; ++o)
    if (o != observation &&
        within_bound(sensor.residual(z, frame.z(o)), noise + pairs_.noise(o), rows, thresholds_.single(rows)))
      return false;
  return true;
}

template <class Pose>
void FrameAssociator<Pose>::add_new(const Frame<Pose>& frame, Index observation, SortedFrame<Pose>& sorted) {
  if (!sorted.add_new(frame, observation, map_.state().pose()))
    report_.match(observation) = {kNoId, Decision::rejected, Reason::no_place, 0.0, 0.0};
}

// Paired observations go to the update. Another observation is of a new landmark if it is far from every landmark.
template <class Pose>
void FrameAssociator<Pose>::settle(const Frame<Pose>& frame, SortedFrame<Pose>& sorted) {
  const Index rows = frame.sensor.rows();
  std::fill_n(paired_, pairs_.images(), false);
  for (Index i = 0; i < frame.landmarks; ++i) {
    const Index chosen = association_.chosen(i);
    if (chosen != kUnpaired) paired_[pairs_.pair(chosen).image] = true;
  }
  for (Index i = 0; i < frame.landmarks; ++i) {
    Match& match = report_.match(i);
    const auto& nearest = pairs_.nearest(i);
    const Index chosen = association_.chosen(i);
    if (chosen != kUnpaired) {
      const auto& image = pairs_.image_of_pair(chosen);
      match.landmark = map_.table().id(image.slot);
      sorted.add_candidate(frame, i, image.slot, image.prediction);
    } else if (nearest.distance > thresholds_.new_landmark(rows)) {
      add_new(frame, i, sorted);
    } else {
      match.landmark = nearest.landmark;
      match.distance = nearest.distance;
      match.threshold = std::min(thresholds_.single(rows), thresholds_.new_landmark(rows));
      match.reason = nearest.distance <= match.threshold ? Reason::ambiguous : Reason::gate;
      if (is_new(frame, i)) add_new(frame, i, sorted);
    }
  }
}

template class FrameAssociator<SE2>;
template class FrameAssociator<SE3>;

}  // namespace cairn
