// SPDX-License-Identifier: BSD-3-Clause
// One vehicle's filter: its sensors, the names of its landmarks, and what becomes of each observation.
#pragma once

#include <cstdint>
#include <memory>
#include <variant>

#include "association/association.hpp"
#include "association/frame_index.hpp"
#include "core/arena.hpp"
#include "core/error.hpp"
#include "core/id_table.hpp"
#include "ekf/ekf.hpp"
#include "ekf/iterate.hpp"
#include "geometry/embedding.hpp"
#include "map/global_map.hpp"
#include "map/naming.hpp"
#include "motion/motion.hpp"
#include "sensor/cartesian.hpp"
#include "sensor/custom.hpp"
#include "sensor/range_bearing.hpp"
#include "sensor/stereo_camera.hpp"
#include "sensor/stereo_head.hpp"
#include "slam/filter_options.hpp"

namespace cairn {

constexpr std::uint64_t kNoId = UINT64_MAX;

enum class ClosedBy { none, caller, landmarks, distance, extent, sigma, fix };

// The last attempt to close a submap.
struct ClosingReport {
  bool failed = false;
  ErrorCode error = ErrorCode::state;  // where it failed
  bool no_memory = false;
  std::size_t submaps = 0;
  ClosedBy reason = ClosedBy::none;
  Index landmarks = 0;
  JoinReport join;
  NamingReport naming;  // where observations bring no names
  double seconds = 0.0;
};

struct Observation {
  std::uint64_t id;
  double z[3];
  double covariance[9];  // all zero: the sensor's own
};

enum class Decision { matched, placed, rejected };
enum class Reason { none, gate, batch_gate, no_image, no_place, ambiguous };

struct Match {
  std::uint64_t landmark = kNoId;
  Decision decision = Decision::rejected;
  Reason reason = Reason::none;
  double distance = 0.0;
  double threshold = 0.0;
};

struct UpdateReport {
  Index matched = 0, placed = 0, rejected = 0;
  Index rows = 0;
  int iterations = 0;
  double nis = 0.0;
  Index association_nodes = 0;
  bool association_exhausted = false;
  double association_seconds = 0.0;
  Index deferred = 0;  // landmarks that do not count yet, after it
  Index removed = 0;   // that were missed, or never came to count
};

// Sensors that a filter can hold.
template <class Pose>
struct SensorKinds;
template <>
struct SensorKinds<SE3> {
  using Any = std::variant<StereoHead, StereoCamera, Cartesian<SE3>, CustomSensor<SE3>>;
};
template <>
struct SensorKinds<SE2> {
  using Any = std::variant<RangeBearing, Cartesian<SE2>, CustomSensor<SE2>, ExtendedObservation>;
};

// Of the map that a filter's submaps join.
template <class Pose>
MapOptions<Pose> map_options(const FilterOptions<Pose>& options);

// In space (SE3) or in the plane (SE2). As Landmarks it speaks of space in either case.
template <class Pose>
class Filter final : public Landmarks {
 public:
  using PoseType = Pose;
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using Point = typename Pose::Point;
  using Rotation = typename Pose::Rotation;
  using Square = typename Pose::Square;
  using PointSquare = typename AbsoluteFix<Pose>::PointSquare;
  using Mount = MountError<Pose>;
  using Log = void (*)(void* payload, const char* line);

  Filter(Arena& arena, const FilterOptions<Pose>& options);
  ~Filter() override;
  Filter(const Filter&) = delete;
  Filter& operator=(const Filter&) = delete;
  static std::size_t arena_bytes(const FilterOptions<Pose>& options);     // of the arena that the constructor wants
  static std::size_t required_bytes(const FilterOptions<Pose>& options);  // of all that it takes
  // Instead of a map of its own a vehicle's submaps join this one: for teams. Before the first motion.
  void use_map(std::unique_ptr<GlobalMap<Pose>> map) { map_ = std::move(map); }
  const FilterOptions<Pose>& options() const { return options_; }
  void set_log(Log log, void* payload) { log_ = log, log_payload_ = payload; }

  // --- sensors --- numbered from 0 as they come
  template <class AnySensor>
  int add(const AnySensor& sensor) {
    return add_sensor(AnySensorSlot(sensor));
  }
  int sensor_rows(int sensor) { return sensor_at(sensor).rows(); }
  void point_head(int sensor, double pan, double stick);
  // What the sensor sees for sure: predicted observations within these bounds.
  void set_view(int sensor, const Vector3& lower, const Vector3& upper);
  void set_sighting(int sensor, const MutualSighting& sighting);  // of an extended observation

  // --- motion --- throws where the result is not finite, with nothing changed
  void set_wheels(const Wheels& wheels) { wheels_ = wheels; }
  void set_twist_noise(const TwistNoise& noise) { twist_noise_ = noise; }
  void predict_wheels(double dt, double left, double right) { propagate(drive_wheels<Pose>(wheels_, left, right, dt)); }
  void predict_twist(double dt, const Vector3& v, const Vector3& w) {
    propagate(integrate_twist<Pose>(v, w, dt, twist_noise_));
  }
  void propagate(const Increment<Pose>& increment);

  // --- observations --- each throws with nothing changed; decisions() holds one a observation after it
  Observation* staging() { return observations_; }  // room for max_observations
  // Of staging(): landmarks, then companions, by their ids, whatever the association.
  void update(int sensor, Index count, Index companions = 0) {
    logged([&] { take_in(sensor, count, companions); });
    close_if_full();
  }
  struct Linear {
    const double* residual;
    Index rows;
    const double* covariance;  // rows x rows
    const double* J_pose;      // rows x 6 row-major, or null; of space, the plane takes its columns
    const std::uint64_t* landmarks;
    Index count;
    const double* J_landmarks;  // rows x 3 count row-major
  };
  void update_linear(const Linear& linear) {
    logged([&] { take_in(linear); });
  }
  void update_fix(const AbsoluteFix<Pose>& fix) {
    logged([&] { take_in(fix); });
  }
  void update_position(const Point& position, const PointSquare& covariance, const Point& lever_arm) {
    update_fix(AbsoluteFix<Pose>::position(position, covariance, lever_arm));
  }
  void update_attitude(const Rotation& attitude, const typename Rotation::Jacobian& covariance) {
    update_fix(AbsoluteFix<Pose>::attitude(attitude, covariance));
  }
  void update_heading(double heading, double sigma) { update_fix(AbsoluteFix<Pose>::heading(heading, sigma)); }
  double* workspace() {
    return ekf_.scratch();
  }  // m^2 + cholesky_workspace(m) doubles, m = kDim max_observations; free between updates
  const Match* decisions() const { return matches_; }
  const UpdateReport& report() const { return report_; }

  void remove_landmark(std::uint64_t id);
  // Landmarks of the open submap or the single map. Merging tells the filter that two are one, gated as an observation:
  // where it passes, `other` is gone. Splitting undoes a mistake: `fresh` stands where `id` does, but for an error.
  void merge_landmarks(std::uint64_t id, std::uint64_t other) {
    logged([&] { take_in_merge(id, other); });
  }
  void split_landmark(std::uint64_t id, std::uint64_t fresh, const PointSquare& covariance);

  // --- companions --- other vehicles, by the caller's names for them; a single map's alone. What is said above of
  // motion and observations holds for the vehicle from which the filter looks: at first its own, look_from() makes it
  // another.
  void name_vehicle(std::uint64_t id) { vehicle_ = id; }  // its own, before there are others
  void add_vehicle(std::uint64_t id, const Pose& pose, const Square& covariance) {
    add_vehicle(id, pose, Square::Zero(), covariance);
  }
  // With an error of J_pose times that of the vehicle looked from, and noise.
  void add_vehicle(std::uint64_t id, const Pose& pose, const Square& J_pose, const Square& noise);
  void remove_vehicle(std::uint64_t id);  // not the one looked from
  void look_from(std::uint64_t id);
  bool has_vehicle(std::uint64_t id) const { return id == vehicle_ || companion(id) >= 0; }
  Pose vehicle_pose(std::uint64_t id) const;
  Square vehicle_covariance(std::uint64_t id) const;

  // --- submaps --- throws with nothing changed
  void close_submap();
  const ClosingReport& closing() const { return closing_; }

  // --- queries ---
  Pose pose() const { return map_ != nullptr ? map_->base() * ekf_.pose() : ekf_.pose(); }
  Square pose_covariance() const;
  Pose local_pose() const { return ekf_.pose(); }
  Square local_pose_covariance() const { return ekf_.pose_covariance(); }
  double pose_nees(const Pose& truth) const;
  double smallest_pivot() { return ekf_.smallest_pivot(); }
  // The map that the caller sees; null: this filter's own landmarks are it.
  const GlobalMap<Pose>* map() const { return map_.get(); }
  const Landmarks& landmarks() const { return map_ != nullptr ? static_cast<const Landmarks&>(*map_) : *this; }
  // Pose, then landmarks of landmarks(), in space; square of 6 + 3 count.
  void pose_joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const;

  // Landmarks: of the open submap, or of the single map
  std::size_t size() const override { return static_cast<std::size_t>(counting()); }
  std::uint64_t id(std::size_t index) const override { return ids_[slot_of(index)]; }
  std::uint64_t observations(std::size_t index) const override { return counts_[slot_of(index)]; }
  Vector3 position(std::size_t index) const override { return Embedding<Pose>::up(ekf_.landmark(slot_of(index))); }
  Matrix3 covariance(std::size_t index) const override {
    return Embedding<Pose>::up(ekf_.landmark_covariance(slot_of(index)));
  }
  bool find(std::uint64_t id, std::size_t& index) const override;
  void joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const override;
  bool planar() const override { return kDim == 2; }

 private:
  using AnySensorSlot = typename SensorKinds<Pose>::Any;

  // A known landmark that this frame may update.
  struct Candidate {
    Index observation;
    Index slot;
    Matrix3 noise;
    Prediction<Pose> prediction;  // at the estimate
    Index number;                 // in the window
  };
  // A landmark that the sensor may see, where observations bring no names.
  struct Expected {
    Index slot;
    Index window;  // among those of all pairs, or kUnpaired
    bool paired;   // in the set that was chosen
    Prediction<Pose> prediction;
    Matrix3 innovation;  // covariance of the prediction
  };
  struct Pair {
    Index expected;
    Vector3 residual;
    Matrix3 innovation;  // covariance, of the observation's noise too
  };
  class PairInnovations;
  // Memory of association, where there is any.
  struct Unknowns {
    Unknowns(Arena& arena, const FilterOptions<Pose>& options);
    static constexpr Index kPairs = 8;  // of one observation, the nearest
    Index most_landmarks, most_observations, most_pairs, most_window;
    Association association;
    FrameIndex frame;
    Expected* expected;
    PairCandidate* pairs;
    Pair* details;
    Index* window;       // slots
    double* covariance;  // of pose and window
    Match* nearest;      // by observation, as are the two below
    Matrix3* noise;
    Index* pairs_of;  // their number
    Index expected_count = 0, pair_count = 0, window_count = 0;
    std::uint64_t next_id = 0;
  };

  // Numerical refusals are worth a line in the log.
  template <class Function>
  void logged(Function&& function) const {
    try {
      function();
    } catch (const Error& error) {
      if (error.code() == ErrorCode::numerical) say("%s", error.what());
      throw;
    }
  }
  // Slots: companions, landmarks that count, landmarks that do not yet.
  Index landmark_count() const { return ekf_.size() - ekf_.companions(); }
  Index counting() const { return landmark_count() - deferred_; }
  Index first_deferred() const { return ekf_.size() - deferred_; }
  Index slot_of(std::size_t landmark) const { return ekf_.companions() + static_cast<Index>(landmark); }
  std::vector<Index> slots_of(const std::size_t* landmarks, std::size_t count) const;
  Index companion(std::uint64_t id) const;  // number, or -1
  Index companion_at(std::uint64_t id) const;
  struct Sightings {  // of a landmark, by frames
    std::uint64_t placed, seen;
    Index missed;  // in a row
  };
  struct View {
    bool set;
    Vector3 lower, upper;
  };
  void move_slot(Index from, Index to);
  void exchange_slots(Index a, Index b);
  void append_landmark(std::uint64_t id);
  Index slot_at(std::uint64_t id) const;
  void take_in_merge(std::uint64_t id, std::uint64_t other);
  void review_landmarks(int sensor, Index count);
  bool in_view(const Sensor<Pose>& sensor, const View& view, Index slot) const;
  // A landmark's image from the predicted pose, and its covariance but for the mount's part; false where it has none.
  bool image_of(const Sensor<Pose>& sensor, Index slot, Prediction<Pose>& prediction, Matrix3& covariance) const;
  void take_in(int sensor, Index count, Index companions);
  void take_in(const Linear& linear);
  void take_in(const AbsoluteFix<Pose>& fix);
  int add_sensor(const AnySensorSlot& sensor);
  AnySensorSlot& sensor_slot(int sensor);
  const Sensor<Pose>& sensor_at(int sensor);
  void sort_out(const Sensor<Pose>& sensor, Index count, Index companions);
  void sort_companions(const Sensor<Pose>& sensor, Index first, Index count);
  void sort_by_id(const Sensor<Pose>& sensor, Index count);
  void sort_by_association(const Sensor<Pose>& sensor, Index count);
  void predict_all(const Sensor<Pose>& sensor);
  void find_pairs(const Sensor<Pose>& sensor, Index count);
  void consider_pair(const Sensor<Pose>& sensor, Index observation, Index expected);
  void gather_pairs(Index count);
  bool confusable(const Sensor<Pose>& sensor, Index count, Index observation, const Pair& pair) const;
  bool other_than_paired(const Sensor<Pose>& sensor, Index count, Index observation) const;
  void settle_pairs(const Sensor<Pose>& sensor, Index count);
  void add_candidate(const Sensor<Pose>& sensor, Index observation, Index slot, const Prediction<Pose>& prediction);
  void add_new_one(const Sensor<Pose>& sensor, Index observation);
  Matrix3 noise_of(const Sensor<Pose>& sensor, const Observation& observation) const;
  bool linearise(const Sensor<Pose>& sensor, double* residual_only);
  void open_candidates(const Sensor<Pose>& sensor);
  void gate_each();
  void keep(Index count, Index rows);
  void gate_batch(const Sensor<Pose>& sensor);
  template <class Linearise>
  void iterate(int iterations, bool relative, Linearise&& linearise);
  void keep_founded();
  void place_new(const Sensor<Pose>& sensor);
  template <class Linearise>
  void update_alone(Index rows, int iterations, std::uint64_t landmark, Linearise&& linearise);
  void start_report(Index count);
  void finish_report(Index count);
  double batch_threshold(Index rows);
  double single_threshold(Index rows) const;
  void update_map_by_fix(const AbsoluteFix<Pose>& fix);
  ClosedBy full() const;
  Submap<Pose> take_submap() const;
  FixReport join_submap(ClosedBy reason, const AbsoluteFix<Pose>* fix = nullptr, double threshold = 0.0);
  void close_if_full();
  void forget_local(std::int32_t slot);
  static std::unique_ptr<GlobalMap<Pose>> make_map(const FilterOptions<Pose>& options);
  void say(const char* format, ...) const __attribute__((format(printf, 2, 3)));

  FilterOptions<Pose> options_;
  Ekf<Pose> ekf_;
  std::unique_ptr<GlobalMap<Pose>> map_;  // null: a single map
  double driven_ = 0.0;                   // in the open submap, m
  ClosingReport closing_;
  std::size_t frames_to_wait_ = 0, next_wait_ = 1;  // before another attempt to close
  IdTable slots_;
  IdTable frame_ids_;
  std::uint64_t* ids_;  // by slot: those of companions are of vehicles
  std::uint64_t* counts_;
  Sightings* sightings_;
  Index deferred_ = 0;
  std::uint64_t frames_ = 0;
  std::uint64_t vehicle_ = 0;  // looked from

  unsigned char* sensor_storage_;
  View* views_;  // by sensor
  int sensor_count_ = 0;
  Wheels wheels_;
  TwistNoise twist_noise_;

  Observation* observations_;
  Match* matches_;
  Match* next_matches_;
  Candidate* candidates_;
  Index candidate_count_ = 0;
  Index* window_slots_;
  Index* kept_;
  Index* new_ones_;
  Index new_count_ = 0;
  Unknowns unknowns_;
  double new_thresholds_[4] = {};
  double* residual_;
  double* thresholds_;  // chi-square bounds of a batch by its rows, filled as they are first asked for
  double gate_thresholds_[7] = {};
  UpdateReport report_, next_report_;
  Log log_ = nullptr;
  void* log_payload_ = nullptr;
};

// Gauss-Newton on the batch, which stands factored at the prediction, and the commit; see iterate_and_commit().
template <class Pose>
template <class Linearise>
void Filter<Pose>::iterate(int iterations, bool relative, Linearise&& linearise) {
  next_report_.nis = ekf_.nis();
  next_report_.iterations =
      iterate_and_commit(ekf_, {iterations, options_.iteration_tolerance, relative}, residual_, linearise);
  next_report_.rows = ekf_.batch().rows();
}

extern template class Filter<SE2>;
extern template class Filter<SE3>;

}  // namespace cairn
