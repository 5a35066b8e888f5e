// SPDX-License-Identifier: BSD-3-Clause
// Closes submaps, and composes the pose of the vehicle from base and open submap.
#include "slam/submap_keeper.hpp"

#include <chrono>
#include <new>
#include <optional>
#include <vector>

#include "core/chi_square.hpp"
#include "core/error.hpp"
#include "geometry/embedding.hpp"
#include "map/join/dense/dense_map.hpp"
#include "map/join/sparse/sparse_map.hpp"
#include "map/submap_innovation.hpp"
#include "slam/motion_vote.hpp"

namespace cairn {
namespace {

// Up to this number of landmarks a dense closing is the cheaper one (docs/submaps.md).
constexpr Index kDenseAtMost = 100;

template <class Pose>
NamingOptions naming_options(const FilterOptions<Pose>& options) {
  NamingOptions naming;
  naming.joint = options.association == AssociationKind::joint;
  naming.nodes = options.association_nodes;
  naming.support = options.association_support;
  naming.gate_probability = options.gate_probability;
  naming.joint_gate_probability = options.batch_gate_probability;
  naming.new_probability = options.new_probability;
  return naming;
}

}  // namespace

template <class Pose>
MapOptions<Pose> map_options(const FilterOptions<Pose>& options) {
  return map_options(options, SystematicErrors(options.systematic, true));
}

template <class Pose>
MapOptions<Pose> map_options(const FilterOptions<Pose>& options, const SystematicErrors& errors) {
  MapOptions<Pose> map;
  map.error = options.error;
  map.max_landmarks = static_cast<std::size_t>(options.max_landmarks);
  map.submap_capacity = static_cast<std::size_t>(options.local_landmarks());
  map.iterations = options.iterations;
  map.iteration_tolerance = options.iteration_tolerance;
  map.gate_probability = options.gate_probability;
  map.joint_gate_probability = options.batch_gate_probability;
  map.step_tolerance = options.step_tolerance;
  map.initial_pose = options.initial_pose;
  map.initial_covariance = options.initial_covariance;
  for (Index i = 0; i < errors.count(); ++i) {
    map.errors.sigma.push_back(errors.sigma(i));
    if (errors.numbers(i).walked != SystematicErrors::kNone) map.errors.walking.push_back(i);
  }
  return map;
}

template <class Pose>
bool FilterOptions<Pose>::sparse() const {
  if (single_map()) return false;
  return join == JoinKind::sparse || (join == JoinKind::automatic && max_landmarks > kDenseAtMost);
}

template <class Pose>
SubmapKeeper<Pose>::SubmapKeeper(const FilterOptions<Pose>& options, LocalMap<Pose>& local,
                                 Trajectory<Pose>& trajectory, const Log& log)
    : options_(options),
      local_(local),
      trajectory_(trajectory),
      log_(log),
      policy_(options, local),
      loss_(options.join_loss, options.join_loss_width),
      seen_again_(options) {}

template <class Pose>
void SubmapKeeper<Pose>::make_map() {
  if (options_.single_map()) return;
  if (options_.sparse())
    map_ = std::make_unique<SparseMap<Pose>>(map_options(options_, local_.systematic()));
  else
    map_ = std::make_unique<DenseMap<Pose>>(map_options(options_, local_.systematic()));
  if (!shares_errors()) return;
  const Index g = local_.systematic().count();
  next_prior_ = Eigen::VectorXd::Map(local_.systematic().initial_values().data(), g);
  next_covariance_ = Eigen::MatrixXd::Map(local_.systematic().initial_covariance().data(), g, g);
  prior_ = next_prior_;
  prior_covariance_ = next_covariance_;
  open();
}

template <class Pose>
std::size_t SubmapKeeper<Pose>::required_bytes(const FilterOptions<Pose>& options) {
  if (options.single_map() || options.sparse()) return 0;
  SystematicErrors errors(options.systematic, true);
  for (Index i = 0; i < options.max_sensor_errors; ++i) errors.add(0, 0, 1.0, 1.0);
  return DenseMap<Pose>::required_bytes(map_options(options, errors));
}

template <class Pose>
const Landmarks& SubmapKeeper<Pose>::landmarks() const {
  if (map_ != nullptr) return *map_;
  return local_;
}

template <class Pose>
void SubmapKeeper<Pose>::remove_landmark(std::uint64_t id) {
  const std::optional<Index> slot = local_.table().find(id);
  std::size_t index = 0;
  const bool mapped = map_ != nullptr && map_->find(id, index);
  if (!slot && !mapped)
    throw Error(ErrorCode::not_found, "id: the map has no landmark %llu", static_cast<unsigned long long>(id));
  if (mapped) map_->remove(id);
  if (slot) local_.forget(*slot);
}

// Landmarks that count join the map. One that is deferred for fear of a gross error does so, too, if the map knows it:
// the closing compares both.
template <class Pose>
std::vector<Index> SubmapKeeper<Pose>::joining() const {
  const LandmarkTable& table = local_.table();
  std::vector<Index> slots;
  slots.reserve(static_cast<std::size_t>(table.landmarks()));
  for (Index slot = 0; slot < table.size(); ++slot) {
    std::size_t index = 0;
    if (table.counts(slot) || (compares_deferred() && map_->find(table.id(slot), index))) slots.push_back(slot);
  }
  return slots;
}

// Those of the joining landmarks that the map knows.
template <class Pose>
std::vector<CommonLandmark> SubmapKeeper<Pose>::common() const {
  const LandmarkTable& table = local_.table();
  std::vector<CommonLandmark> both;
  for (Index slot = 0; slot < table.size(); ++slot) {
    std::size_t index = 0;
    if ((table.counts(slot) || compares_deferred()) && map_->find(table.id(slot), index)) both.push_back({slot, index});
  }
  return both;
}

template <class Pose>
std::uint64_t SubmapKeeper<Pose>::observed_again() const {
  std::uint64_t sum = 0;
  for (const CommonLandmark& landmark : common()) sum += local_.table().observations(landmark.slot);
  return sum;
}

template <class Pose>
Submap<Pose> SubmapKeeper<Pose>::take_submap() const {
  const State<Pose>& state = local_.state();
  Submap<Pose> submap;
  submap.error = options_.error;
  submap.T_base_end = state.pose();
  const std::vector<Index> slots = joining();
  const auto count = static_cast<Index>(slots.size()), n = kDof + kDim * count;
  submap.ids.reserve(slots.size());
  submap.counts.reserve(slots.size());
  submap.landmarks.reserve(slots.size());
  for (const Index slot : slots) {
    submap.ids.push_back(local_.table().id(slot));
    submap.counts.push_back(local_.table().observations(slot));
    submap.landmarks.push_back(state.landmark(slot));
  }
  submap.covariance.resize(n, n);
  state.gather(slots.data(), count, submap.covariance.data(), n);
  if (shares()) submap.errors = take_errors(slots);
  if (fixed()) submap.base = base_;
  return submap;
}

namespace {

// The submap's known landmarks against the map.
template <class Pose>
struct Agreement {
  Agreement(const GlobalMap<Pose>& map, const Submap<Pose>& submap) {
    std::vector<std::size_t> indices;
    std::vector<typename Pose::Point> points;
    for (Eigen::Index i = 0; i < submap.size(); ++i) {
      std::size_t index = 0;
      if (!map.find(submap.ids[static_cast<std::size_t>(i)], index)) continue;
      locals.push_back(i);
      indices.push_back(index);
      points.push_back(Embedding<Pose>::down(map.position(index)));
    }
    if (locals.empty()) return;
    const auto size = static_cast<Eigen::Index>(Pose::kDof + Pose::kDim * locals.size());
    Eigen::MatrixXd P(size, size), noise = submap.covariance;
    map.base_joint_covariance(indices.data(), indices.size(), P.data());
    to_ordinary(submap, locals, noise);
    innovation.emplace(map.base(), P, points, submap, locals, noise);
  }

  std::vector<Eigen::Index> locals;  // in the submap
  std::optional<SubmapInnovation<Pose>> innovation;
};

}  // namespace

// The robust loss of the options: a landmark that contradicts the map gets a larger covariance in the submap.
template <class Pose>
void SubmapKeeper<Pose>::soften(Submap<Pose>& submap) const {
  if (!loss_.robust()) return;
  const Agreement<Pose> known(*map_, submap);
  if (!known.innovation) return;
  const std::vector<double> factors = noise_factors(*known.innovation, loss_);
  for (std::size_t a = 0; a < factors.size(); ++a) inflate(submap, known.locals[a], factors[a]);
}

// If most known landmarks contradict the map and agree on another pose of the submap's base, the motion to this base is
// widened (docs/update.md, "Finding back").
template <class Pose>
void SubmapKeeper<Pose>::find_back(Submap<Pose>& submap, ClosingReport& report) const {
  const Agreement<Pose> known(*map_, submap);
  if (!known.innovation) return;
  const SubmapInnovation<Pose>& innovation = *known.innovation;
  BoundsByRows bounds = {};
  bounds[kDim] = chi_square_quantile(kDim, options_.gate_probability);
  std::vector<Witness<Pose>> witnesses;
  for (Eigen::Index a = 0; a < innovation.count(); ++a) {
    Witness<Pose> witness = {};
    typename Witness<Pose>::ByPose J = Witness<Pose>::ByPose::Zero();
    J.template topRows<kDim>() = innovation.by_base[static_cast<std::size_t>(a)];
    witness.rows = kDim;
    witness.position = map_->base().translation();
    if (witness.whiten(innovation.residual.data() + kDim * a, J,
                       innovation.S.data() + kDim * a * (innovation.S.rows() + 1), innovation.S.rows()))
      witnesses.push_back(witness);
  }
  const auto count = static_cast<Index>(witnesses.size());
  const MotionVote<Pose> vote = vote_motion(witnesses.data(), count, bounds);
  if (2 * vote.agreeing <= count || kDim * vote.agreeing < kDof + kDim) return;
  // The motion of the base in the axes of the submap.
  const typename Pose::Tangent motion = Pose::turn_axes(map_->base().rotation().inverse()) * vote.motion;
  widen(submap, Square(motion * motion.transpose()));
  report.widened_position = motion.template head<kDim>().norm();
  report.widened_attitude = motion.template tail<Pose::kTurn>().norm();
  log_.say("closing: %td of %td known landmarks contradict the map and agree on another pose of the submap, %g m away",
           vote.agreeing, count, report.widened_position);
}

// A transaction in which the submap has joined.
template <class Pose>
std::unique_ptr<MapTransaction<Pose>> SubmapKeeper<Pose>::join(Submap<Pose>& submap, ClosingReport& report) {
  auto transaction = map_->begin();
  const JoinReport tried = transaction->join(submap);
  if (tried.refused <= tried.fused) return transaction;
  transaction.reset();
  find_back(submap, report);
  transaction = map_->begin();
  transaction->join(submap);
  return transaction;
}

// Closes the open submap, even an empty one, and starts a new one at the vehicle's pose (Mars paper, eq. 14-16). A fix
// is applied to the new base; if either step fails, neither is done.
template <class Pose>
FixReport SubmapKeeper<Pose>::join(ClosedBy reason, const AbsoluteFix<Pose>* fix, double threshold) {
  ClosingReport next;
  const auto begin = std::chrono::steady_clock::now();
  next.reason = reason;
  Submap<Pose> submap = take_submap();
  next.landmarks = submap.size();
  if (shares_errors()) systematic(next_prior_.data(), next_covariance_.data());
  if (options_.association != AssociationKind::known) {
    next.naming = name_landmarks(*map_, naming_options(options_), submap);
    if (next.naming.exhausted)
      log_.say("closing: association stopped at %td joint tests, with %zu of %td landmarks named", next.naming.nodes,
               next.naming.named, next.landmarks);
  }
  FixReport fixed;
  {
    soften(submap);
    const auto transaction = join(submap, next);
    if (fix != nullptr) fixed = transaction->fix(*fix, threshold);
    next.join = transaction->commit();
  }
  trajectory_.end_submap(map_->submap_count() - 1, submap.T_base_end, local_.state().pose_covariance());
  open();
  policy_.restart();
  next.submaps = map_->submap_count();
  next.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  closing_ = next;
  if (next.join.refused > 0)
    log_.say("closing: %zu of %zu known landmarks contradict the map and were left out", next.join.refused,
             next.join.refused + next.join.fused);
  return fixed;
}

template <class Pose>
void SubmapKeeper<Pose>::close() {
  if (map_ == nullptr)
    throw Error(ErrorCode::state, "filter: it keeps a single map; create it with submap_landmarks to have submaps");
  if (local_.table().counting() == 0)
    throw Error(ErrorCode::state, "filter: the open submap holds no landmark; nothing to close");
  join(ClosedBy::caller);
}

template <class Pose>
void SubmapKeeper<Pose>::close_if_full() {
  if (map_ == nullptr) return;
  const ClosedBy reason = policy_.limit();
  if (reason == ClosedBy::none || policy_.wait()) return;
  ClosingReport failed;
  failed.failed = true;
  failed.submaps = map_->submap_count();
  failed.reason = reason;
  failed.landmarks = local_.table().counting();
  try {
    join(reason);
    return;
  } catch (const Error& error) {
    failed.error = error.code();
    log_.say("closing: put off: %s", error.what());
  } catch (const std::bad_alloc&) {
    failed.no_memory = true;
    log_.say("closing: put off: memory could not be had");
  }
  closing_ = failed;
  policy_.put_off();
}

template <class Pose>
bool SubmapKeeper<Pose>::moved() const {
  const State<Pose>& state = local_.state();
  return state.size() > 0 || policy_.driven() > 0.0 || !state.pose_covariance().isZero(0.0) ||
         !state.pose().rotation().matrix().isIdentity(0.0);
}

template <class Pose>
FixReport SubmapKeeper<Pose>::fix(const AbsoluteFix<Pose>& fix, double threshold) {
  gets_fixes_ = true;
  if (moved()) return join(ClosedBy::fix, &fix, threshold);
  const FixReport report = map_->fix(fix, threshold);
  open();  // at a base that is better known
  return report;
}

template <class Pose>
typename SeenAgain<Pose>::Given SubmapKeeper<Pose>::given(const std::vector<CommonLandmark>& common,
                                                          const std::size_t* indices, std::size_t count) const {
  const auto base = fixed() ? std::optional<FixedBase<Pose>>(fixed_base()) : std::nullopt;
  return seen_again_.given(*map_, local_.state(), common, indices, count, base);
}

template <class Pose>
typename SubmapKeeper<Pose>::Place SubmapKeeper<Pose>::place(const std::vector<CommonLandmark>& common,
                                                             const std::size_t* indices, std::size_t count) const {
  const auto given = this->given(common, indices, count);
  const ProductJacobians J(given.base, given.vehicle);
  const auto landmarks = static_cast<Eigen::Index>(kDim * count);
  Place place{given.base * given.vehicle, Eigen::MatrixXd(kDof + landmarks, kDof + landmarks)};
  Eigen::Matrix<double, kDof, 2 * kDof> both;
  both << J.by_a, J.by_b;
  const Eigen::MatrixXd across = both * given.covariance.topRows(2 * kDof);
  const Square own = across.leftCols(2 * kDof) * both.transpose();
  place.joint.template topLeftCorner<kDof, kDof>() = own.template selfadjointView<Eigen::Lower>();
  place.joint.topRightCorner(kDof, landmarks) = across.rightCols(landmarks);
  place.joint.bottomLeftCorner(landmarks, kDof) = across.rightCols(landmarks).transpose();
  place.joint.bottomRightCorner(landmarks, landmarks) = given.covariance.bottomRightCorner(landmarks, landmarks);
  return place;
}

template <class Pose>
typename SubmapKeeper<Pose>::Estimate SubmapKeeper<Pose>::vehicle() const {
  const State<Pose>& state = local_.state();
  if (map_ == nullptr) return {state.pose(), state.pose_covariance()};
  if (shares_errors()) {
    const Place own = place_with_errors(nullptr, 0);
    return {own.pose, own.joint};
  }
  const std::vector<CommonLandmark> both = common();
  if (both.empty() && !fixed())  // no memory is needed
    return {map_->base() * state.pose(),
            ProductJacobians(map_->base(), state.pose()).covariance(map_->base_covariance(), state.pose_covariance())};
  const Place own = place(both, nullptr, 0);
  return {own.pose, own.joint};
}

template <class Pose>
void SubmapKeeper<Pose>::pose_joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const {
  const std::size_t size = kDof + kDim * count;
  const auto n = static_cast<Eigen::Index>(size);
  Eigen::MatrixXd joint(n, n);
  if (map_ == nullptr)
    local_.pose_joint_covariance(indices, count, joint.data());
  else
    joint = shares_errors() ? place_with_errors(indices, count).joint : place(common(), indices, count).joint;
  with_pose<Pose>(joint.data(), count, matrix);
}

template <class Pose>
double SubmapKeeper<Pose>::pose_nees(const Pose& truth) const {
  if (map_ == nullptr) return local_.state().pose_nees(truth);
  const Estimate own = vehicle();
  return State<Pose>::nees(options_.error, options_.initial_pose.translation(), truth, own.pose, own.covariance);
}

template <class Pose>
void SubmapKeeper<Pose>::keep_pose() {
  if (trajectory_.capacity() == 0) return;
  const std::size_t submap = map_ != nullptr ? map_->submap_count() : 0;
  trajectory_.add(submap, local_.state().pose(), local_.state().pose_covariance());
}

template <class Pose>
typename Trajectory<Pose>::Open SubmapKeeper<Pose>::open_submap() const {
  const State<Pose>& state = local_.state();
  if (map_ == nullptr || trajectory_.capacity() == 0) return {};
  const std::vector<CommonLandmark> both = shares_errors() ? std::vector<CommonLandmark>() : common();
  if (both.empty() && !fixed())
    return {map_->base(), map_->base() * state.pose(), state.pose(), state.pose_covariance()};
  const auto given = this->given(both, nullptr, 0);
  return {given.base, given.base * given.vehicle, state.pose(), state.pose_covariance()};
}

template MapOptions<SE2> map_options(const FilterOptions<SE2>&);
template MapOptions<SE3> map_options(const FilterOptions<SE3>&);
template MapOptions<SE2> map_options(const FilterOptions<SE2>&, const SystematicErrors&);
template MapOptions<SE3> map_options(const FilterOptions<SE3>&, const SystematicErrors&);
template bool FilterOptions<SE2>::sparse() const;
template bool FilterOptions<SE3>::sparse() const;
template class SubmapKeeper<SE2>;
template class SubmapKeeper<SE3>;

}  // namespace cairn
