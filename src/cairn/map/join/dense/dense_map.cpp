// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/dense/dense_map.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/chi_square.hpp"
#include "ekf/iterate.hpp"
#include "sensor/sensor.hpp"

namespace cairn {
namespace {

template <class Pose>
typename Ekf<Pose>::Capacity capacity_of(const MapOptions<Pose>& options) {
  return {static_cast<Index>(options.max_landmarks + options.max_companions),
          static_cast<Index>(std::min(options.submap_capacity, options.max_landmarks)),
          static_cast<Index>(options.max_companions)};
}

// Rows and columns of a symmetric matrix of the landmarks' blocks behind the states of the pose.
template <class Pose>
std::vector<Eigen::Index> states_of(const std::vector<Eigen::Index>& landmarks) {
  std::vector<Eigen::Index> states;
  for (const Eigen::Index i : landmarks)
    for (Eigen::Index d = 0; d < Pose::kDim; ++d) states.push_back(Pose::kDof + Pose::kDim * i + d);
  return states;
}

// How far landmarks moved between two states of the map.
template <class Pose>
void measure_movement(const std::vector<typename Pose::Point>& before, const Ekf<Pose>& ekf, JoinReport& report) {
  double sum = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double way = (ekf.landmark(ekf.companions() + static_cast<Index>(i)) - before[i]).squaredNorm();
    report.moved_max = std::max(report.moved_max, std::sqrt(way));
    sum += way;
  }
  if (!before.empty()) report.moved_rms = std::sqrt(sum / static_cast<double>(before.size()));
}

}  // namespace

template <class Pose>
DenseMap<Pose>::DenseMap(const MapOptions<Pose>& options) : DenseMap(options, required_bytes(options)) {}

template <class Pose>
DenseMap<Pose>::DenseMap(const MapOptions<Pose>& options, std::size_t bytes)
    : options_(options),
      arena_(bytes),
      ekf_(arena_, options.error, capacity_of(options)),
      indices_(arena_, options.max_landmarks),
      ids_(arena_.take<std::uint64_t>(options.max_landmarks)),
      counts_(arena_.take<std::uint64_t>(options.max_landmarks)) {
  ekf_.start(options.initial_pose, options.initial_covariance);
}

template <class Pose>
std::size_t DenseMap<Pose>::required_bytes(const MapOptions<Pose>& options) {
  Arena measure;
  const Ekf<Pose> ekf(measure, options.error, capacity_of(options));
  const IdTable slots(measure, options.max_landmarks);
  measure.take<std::uint64_t>(options.max_landmarks);
  measure.take<std::uint64_t>(options.max_landmarks);
  return measure.used();
}

template <class Pose>
void DenseMap<Pose>::open(const std::vector<Pair>& pairs) {
  std::vector<Index> slots;
  for (const Pair& pair : pairs) slots.push_back(pair.slot);
  ekf_.open(slots.data(), static_cast<Index>(slots.size()), nullptr);
}

// The submap's estimates of the known landmarks are observations from its base: y = R_S^T (l - p_S), with one full
// noise block, their covariance in the submap. This is eq. 30 of the Mars paper with the rotation that its constant
// Jacobian leaves out.
template <class Pose>
bool DenseMap<Pose>::linearise(const Submap<Pose>& submap, const std::vector<Pair>& pairs, const Eigen::MatrixXd& noise,
                               double* residual_only) {
  const Pose T = ekf_.iterate_pose();
  if (residual_only == nullptr) ekf_.batch().clear();
  for (std::size_t a = 0; a < pairs.size(); ++a) {
    const Point l = ekf_.iterate_landmark(static_cast<Index>(a));
    const Point residual = submap.landmarks[pairs[a].local] - T.inverse() * l;
    double* target = residual_only != nullptr ? residual_only : ekf_.batch().residual();
    std::copy_n(residual.data(), kDim, target + kDim * a);
    if (residual_only != nullptr) continue;
    Prediction<Pose> prediction;
    map_jacobians(T, l, Prediction<Pose>::ByLandmark::Identity(), prediction);
    const Index row = ekf_.batch().add_rows(kDim);
    const auto pose = ekf_.add_pose_block(row, kDim, prediction.J_z_pose, true);
    ekf_.add_landmark_block(row, kDim, prediction.J_z_landmark, static_cast<Index>(a), pose);
  }
  if (residual_only != nullptr) return true;
  const std::size_t rows = kDim * pairs.size();
  double* block = ekf_.batch().add_noise(0, static_cast<Index>(rows));
  for (std::size_t c = 0; c < rows; ++c)
    for (std::size_t r = 0; r < rows; ++r)
      block[c * rows + r] = noise(kDof + kDim * pairs[r / kDim].local + static_cast<Eigen::Index>(r % kDim),
                                  kDof + kDim * pairs[c / kDim].local + static_cast<Eigen::Index>(c % kDim));
  return true;
}

// Each pair by itself, then all jointly; what is refused leaves `pairs`. The batch stands factored at the end.
template <class Pose>
void DenseMap<Pose>::gate(const Submap<Pose>& submap, std::vector<Pair>& pairs, const Eigen::MatrixXd& noise,
                          JoinReport& report) {
  const auto refill = [&] {
    open(pairs);
    fill_batch(ekf_, [&](double* residual_only) { return linearise(submap, pairs, noise, residual_only); });
  };
  refill();
  const double single = chi_square_quantile(kDim, options_.gate_probability);
  const Index m = ekf_.batch().rows();
  std::vector<Pair> passed;
  for (std::size_t a = 0; a < pairs.size(); ++a) {
    const double distance =
        squared_distance(ekf_.batch().residual() + kDim * a, ekf_.innovation() + kDim * a * (m + 1), m, kDim);
    if (distance < 0.0) throw_not_definite();
    if (distance <= single) passed.push_back(pairs[a]);
  }
  if (passed.size() < pairs.size()) {
    pairs.swap(passed);
    refill();
  }
  std::vector<char> refused(pairs.size(), 0);
  std::vector<double> u(kDim * pairs.size());
  const auto bound = [&](Index rows) {
    return chi_square_quantile(static_cast<double>(rows), options_.joint_gate_probability);
  };
  const Index left = gate_jointly(
      ekf_, static_cast<Index>(pairs.size()), kDim, u.data(), bound, [&](Index a) { return refused[a] != 0; },
      [&](Index a, double, double) { refused[a] = 1; });
  if (left < static_cast<Index>(pairs.size())) {
    passed.clear();
    for (std::size_t a = 0; a < pairs.size(); ++a)
      if (refused[a] == 0) passed.push_back(pairs[a]);
    pairs.swap(passed);
    refill();
    if (!ekf_.factor()) throw_not_definite();
  }
  report.rows = kDim * pairs.size();
  report.distance = ekf_.nis();
  report.threshold = report.rows > 0 ? bound(static_cast<Index>(report.rows)) : 0.0;
}

// Fuses the known landmarks, by which the submap's rest moves, and hands that over.
template <class Pose>
void DenseMap<Pose>::fuse_and_compose(const Submap<Pose>& submap, const std::vector<Pair>& pairs,
                                      const Eigen::MatrixXd& joint, const std::vector<Index>& slots,
                                      std::vector<Point>& landmarks, typename Ekf<Pose>::Handover& handover,
                                      JoinReport& report) {
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(kDim * pairs.size()));
  if (!pairs.empty()) {
    std::vector<double> residual(kDim * pairs.size());
    report.iterations =
        iterate_and_commit(ekf_, {options_.iterations, options_.iteration_tolerance, true}, residual.data(),
                           [&](double* residual_only) { return linearise(submap, pairs, joint, residual_only); });
    const Pose T_base_map = ekf_.pose().inverse();
    for (std::size_t a = 0; a < pairs.size(); ++a)
      shift.segment<kDim>(kDim * static_cast<Eigen::Index>(a)) =
          T_base_map * ekf_.landmark(pairs[a].slot) - submap.landmarks[pairs[a].local];
  }
  const Eigen::VectorXd error = handover.K * shift;
  const typename Rotation::Tangent turn = error.segment<kTurn>(kDim);
  const bool invariant = submap.error == ErrorKind::invariant;
  const Rotation R = Rotation::exp(turn);
  const typename Rotation::Matrix V = Rotation::translation_jacobian(turn);
  const auto moved = [&](const Point& x, const Point& e) -> Point {
    if (!invariant) return x + e;
    return R * x + V * e;
  };
  handover.T_base_end =
      Pose(R * submap.T_base_end.rotation(), moved(submap.T_base_end.translation(), error.head<kDim>()));
  for (std::size_t a = 0; a < landmarks.size(); ++a)
    landmarks[a] = moved(landmarks[a], error.segment<kDim>(kDof + kDim * static_cast<Eigen::Index>(a)));
  handover.fused = slots.data();
  handover.fused_count = static_cast<Index>(slots.size());
  handover.fresh = landmarks.data();
  handover.fresh_count = static_cast<Index>(landmarks.size());
  ekf_.compose(handover);
}

// The filter is backed up before its first change; the lists of landmarks and submaps change in commit() only.
template <class Pose>
class DenseMap<Pose>::Transaction final : public MapTransaction<Pose> {
 public:
  explicit Transaction(DenseMap& map) : map_(map) {}
  ~Transaction() override {
    if (backup_) map_.ekf_.restore(*backup_);
  }

  void join(const Submap<Pose>& submap) override;
  FixReport fix(const AbsoluteFix<Pose>& fix, double threshold) override;
  JoinReport commit() override;

 private:
  DenseMap& map_;
  std::optional<typename Ekf<Pose>::Backup> backup_;
  JoinReport report_;
  std::vector<Pair> pairs_;            // known landmarks that are fused
  std::vector<Eigen::Index> fresh_;    // the submap's new landmarks, by their number there
  std::vector<std::uint64_t> counts_;  // of the submap's landmarks
  std::vector<Point> before_;          // the map's landmarks
  std::optional<Closed> closed_;       // the submap, once joined
};

template <class Pose>
std::unique_ptr<MapTransaction<Pose>> DenseMap<Pose>::begin() {
  return std::make_unique<Transaction>(*this);
}

template <class Pose>
void DenseMap<Pose>::Transaction::join(const Submap<Pose>& submap) {
  for (Eigen::Index i = 0; i < submap.size(); ++i) {
    const std::int32_t index = map_.indices_.find(submap.ids[i]);
    if (index == IdTable::kAbsent)
      fresh_.push_back(i);
    else
      pairs_.push_back({i, map_.slot_of(static_cast<std::size_t>(index))});
  }
  if (map_.size() + fresh_.size() > map_.options_.max_landmarks)
    throw Error(ErrorCode::capacity, "submap: %zu new landmarks, and the map holds %zu of max_landmarks = %zu",
                fresh_.size(), map_.size(), map_.options_.max_landmarks);
  const std::size_t known = pairs_.size();
  std::vector<Eigen::Index> known_ones;
  for (const Pair& pair : pairs_) known_ones.push_back(pair.local);
  Eigen::MatrixXd joint = submap.covariance;
  to_ordinary(submap, known_ones, joint);
  if (!pairs_.empty()) map_.gate(submap, pairs_, joint, report_);
  report_.fused = pairs_.size();
  report_.fresh = fresh_.size();
  report_.refused = known - pairs_.size();

  // The rest of the submap's error is K y + w by the fused landmarks' y.
  std::vector<Eigen::Index> fused, rest;
  for (Eigen::Index d = 0; d < kDof; ++d) rest.push_back(d);
  for (const Pair& pair : pairs_) fused.push_back(pair.local);
  const std::vector<Eigen::Index> of_fused = states_of<Pose>(fused), of_fresh = states_of<Pose>(fresh_);
  rest.insert(rest.end(), of_fresh.begin(), of_fresh.end());
  typename Ekf<Pose>::Handover handover;
  const Eigen::MatrixXd cross = joint(of_fused, rest);
  handover.K = pairs_.empty() ? Eigen::MatrixXd(rest.size(), 0)
                              : Eigen::MatrixXd(joint(of_fused, of_fused).ldlt().solve(cross).transpose());
  handover.W = joint(rest, rest);
  handover.W -= handover.K * cross;
  if (!handover.K.allFinite() || !handover.W.allFinite()) throw_not_definite();
  std::vector<Index> slots;
  for (const Pair& pair : pairs_) slots.push_back(pair.slot);
  std::vector<Point> landmarks;
  for (std::size_t i = 0; i < map_.size(); ++i) before_.push_back(map_.ekf_.landmark(map_.slot_of(i)));
  for (const Eigen::Index i : fresh_) landmarks.push_back(submap.landmarks[i]);
  counts_ = submap.counts;
  closed_.emplace(Closed{map_.base(), submap.ids});
  std::vector<Closed>& all_closed = map_.closed_;
  if (all_closed.size() == all_closed.capacity()) all_closed.reserve(2 * all_closed.size() + 8);

  // Nothing was changed so far.
  backup_.emplace(map_.ekf_.backup());
  map_.fuse_and_compose(submap, pairs_, joint, slots, landmarks, handover, report_);
}

template <class Pose>
FixReport DenseMap<Pose>::Transaction::fix(const AbsoluteFix<Pose>& fix, double threshold) {
  if (!backup_) backup_.emplace(map_.ekf_.backup());
  return map_.fix_base(fix, threshold);
}

template <class Pose>
JoinReport DenseMap<Pose>::Transaction::commit() {
  backup_.reset();
  if (!closed_) return report_;
  for (std::size_t a = 0; a < fresh_.size(); ++a) {
    const std::size_t index = map_.size() - fresh_.size() + a;
    map_.ids_[index] = closed_->ids[fresh_[a]];
    map_.counts_[index] = counts_[fresh_[a]];
    map_.indices_.set(map_.ids_[index], static_cast<std::int32_t>(index));
  }
  for (const Pair& pair : pairs_) map_.counts_[pair.slot - map_.ekf_.companions()] += counts_[pair.local];
  measure_movement<Pose>(before_, map_.ekf_, report_);
  map_.closed_.push_back(std::move(*closed_));
  return report_;
}

template <class Pose>
FixReport DenseMap<Pose>::fix_base(const AbsoluteFix<Pose>& fix, double threshold) {
  FixReport report;
  const auto linearise = [&](double* residual_only) { return linearise_fix(ekf_, fix, residual_only); };
  ekf_.open(nullptr, 0, nullptr);
  fill_batch(ekf_, linearise);
  if (!ekf_.factor()) throw_not_definite();
  report.distance = ekf_.nis();
  report.accepted = report.distance <= threshold;
  double residual[3];
  if (report.accepted)
    report.iterations =
        iterate_and_commit(ekf_, {options_.iterations, options_.iteration_tolerance, false}, residual, linearise);
  return report;
}

template <class Pose>
void DenseMap<Pose>::remove(std::uint64_t id) {
  const std::int32_t index = indices_.find(id);
  if (index == IdTable::kAbsent) return;
  const std::size_t last = size() - 1;
  ekf_.remove(slot_of(static_cast<std::size_t>(index)));
  indices_.erase(id);
  if (static_cast<std::size_t>(index) == last) return;
  ids_[index] = ids_[last];
  counts_[index] = counts_[last];
  indices_.set(ids_[index], index);
}

template <class Pose>
bool DenseMap<Pose>::find(std::uint64_t id, std::size_t& index) const {
  const std::int32_t found = indices_.find(id);
  if (found == IdTable::kAbsent) return false;
  index = static_cast<std::size_t>(found);
  return true;
}

template <class Pose>
Index DenseMap<Pose>::companion(std::uint64_t id) const {
  const auto found = std::find(companions_.begin(), companions_.end(), id);
  if (found == companions_.end())
    throw Error(ErrorCode::not_found, "vehicle: the map knows no vehicle %llu", static_cast<unsigned long long>(id));
  return found - companions_.begin();
}

template <class Pose>
void DenseMap<Pose>::add_vehicle(std::uint64_t id, const Pose& pose, const typename Pose::Square& covariance) {
  if (!closed_.empty())
    throw Error(ErrorCode::state, "vehicle: the map holds submaps already; vehicles join it before the first one");
  if (companions_.size() == options_.max_companions)
    throw Error(ErrorCode::capacity, "vehicle: the map has room for %zu beside its own", options_.max_companions);
  companions_.reserve(companions_.size() + 1);
  if (!ekf_.add_companion(pose, Pose::Square::Zero(), covariance))
    throw Error(ErrorCode::numerical, "vehicle: its pose or covariance is not finite; nothing was changed");
  companions_.push_back(id);
}

template <class Pose>
void DenseMap<Pose>::look_from(std::uint64_t id) {
  if (id == vehicle_) return;
  const Index k = companion(id);
  ekf_.activate(k);
  std::swap(companions_[static_cast<std::size_t>(k)], vehicle_);
}

template <class Pose>
void DenseMap<Pose>::base_joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const {
  std::vector<Index> slots;
  for (std::size_t i = 0; i < count; ++i) slots.push_back(slot_of(indices[i]));
  ekf_.gather_ordinary(slots.data(), static_cast<Index>(count), matrix, static_cast<Index>(kDof + kDim * count));
}

template <class Pose>
void DenseMap<Pose>::joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const {
  const std::size_t size = kDof + kDim * count;
  std::vector<double> joint(size * size);
  base_joint_covariance(indices, count, joint.data());
  without_pose<Pose>(joint.data(), count, matrix);
}

template class DenseMap<SE2>;
template class DenseMap<SE3>;

}  // namespace cairn
