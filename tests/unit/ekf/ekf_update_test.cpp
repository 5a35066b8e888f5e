// SPDX-License-Identifier: BSD-3-Clause
// The legal order of an update's calls. Only a commit or a new landmark may change a bit of the state.
#include "ekf/ekf_update.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "ekf/sample_state.hpp"
#include "numerical.hpp"

using namespace cairn;
using namespace cairn::test;

namespace {

constexpr ErrorKind kBoth[] = {ErrorKind::invariant, ErrorKind::standard};

// The rows of one update: sightings y = R^T (l - p) of some points, also with a mount's error. The residuals are some
// centimetres.
template <class Pose>
class Sightings {
 public:
  static constexpr int kDim = Pose::kDim, kDof = Pose::kDof, kMount = kMountErrors<Pose>;
  using Point = typename Pose::Point;
  using PointSquare = Eigen::Matrix<double, kDim, kDim>;

  Sightings(const State<Pose>& state, unsigned seed, std::vector<Index> slots, bool mounted)
      : slots_(std::move(slots)), mounted_(mounted) {
    Random random(seed);
    for (const Index slot : slots_) {
      z_.push_back(state.pose().inverse() * state.landmark(slot) + 0.1 * random.normal_vector<kDim>());
      Eigen::Matrix<double, kDim, kMount> J;
      for (int c = 0; c < kMount; ++c) J.col(c) = random.normal_vector<kDim>();
      J_mount_.push_back(J);
    }
    noise = random_square<kDim>(random, 0.05);
    mount_noise_ = random_square<kMount>(random, 0.02);
  }

  typename State<Pose>::Window window() const {
    return {slots_.data(), static_cast<Index>(slots_.size()), mounted_ ? &mount_noise_ : nullptr};
  }
  bool fill(EkfUpdate<Pose>& update, double* residual_only) const {
    if (residual_only == nullptr) update.batch().clear();
    for (std::size_t a = 0; a < slots_.size(); ++a) {
      const auto number = static_cast<Index>(a);
      const Point l = update.landmark(number);
      Point residual = z_[a] - update.pose().inverse() * l;
      if (mounted_) residual -= J_mount_[a] * update.mount();
      double* to = residual_only != nullptr ? residual_only : update.batch().residual();
      Eigen::Map<Point>(to + kDim * number) = residual;
      if (residual_only != nullptr) continue;
      Prediction<Pose> prediction;
      map_jacobians(update.pose(), l, Prediction<Pose>::ByLandmark::Identity(), prediction);
      const Index row = update.batch().add_rows(kDim);
      const auto pose = update.add_pose_block(row, kDim, prediction.J_z_pose, true);
      update.add_landmark_block(row, kDim, prediction.J_z_landmark, number, pose);
      if (mounted_) update.add_mount_block(row, kDim, J_mount_[a]);
      Eigen::Map<PointSquare>(update.batch().add_noise(row, kDim)) = noise;
    }
    return true;
  }
  void linearise(EkfUpdate<Pose>& update) const {
    update.linearise([&](double* residual_only) { return fill(update, residual_only); });
  }
  // A whole frame, with a landmark placed after the commit.
  void run(State<Pose>& state) const {
    EkfUpdate<Pose> update = state.begin(window());
    linearise(update);
    update.factor();
    update.iterate({4, 1e-6, true}, [&](double* residual_only) { return fill(update, residual_only); });
    update.commit();
    CHECK(place(state, update));
  }
  bool place(const State<Pose>& state, EkfUpdate<Pose>& update) const {
    const Point arm = Point::Constant(2);
    typename State<Pose>::PointByPose J;
    J << PointSquare::Identity(), Pose::Rotation::turn(arm);
    const typename State<Pose>::PointByMount J_mount = J_mount_.front();
    return update.place(state.pose().translation() + arm, J, mounted_ ? &J_mount : nullptr, noise, true);
  }

  PointSquare noise;

 private:
  std::vector<Index> slots_;
  bool mounted_;
  std::vector<Point> z_;
  std::vector<Eigen::Matrix<double, kDim, kMount>> J_mount_;
  MountSquare<Pose> mount_noise_;
};

enum Stage { opened, linearised, factored, solved, stepped, committed };
constexpr Stage kStages[] = {opened, linearised, factored, solved, stepped, committed};
constexpr const char* kNames[] = {"opened", "linearised", "factored", "solved", "stepped", "committed"};

template <class Pose>
void advance(EkfUpdate<Pose>& update, const Sightings<Pose>& sightings, Stage from, Stage to) {
  if (from < linearised && to >= linearised) sightings.linearise(update);
  if (from < factored && to >= factored) update.factor();
  if (from < solved && to >= solved) update.solve();
  if (from < stepped && to >= stepped) update.step();
  if (from < committed && to >= committed) update.commit();
}

// Every call of an update that has a place in the order.
template <class Pose>
struct Call {
  const char* name;
  std::vector<Stage> legal;  // if it does not throw
  std::function<void()> run;
};

template <class Pose>
std::vector<Call<Pose>> calls(State<Pose>& state, EkfUpdate<Pose>& update, const Sightings<Pose>& sightings) {
  static const Index all[] = {0, 1, 2};
  static const std::vector<double> zero(64, 0.0);
  constexpr Index kDim = Pose::kDim;
  const auto fill = [&](double* residual_only) { return sightings.fill(update, residual_only); };
  return {
      {"linearise", {opened, linearised, factored, solved, stepped}, [&] { sightings.linearise(update); }},
      {"distance", {linearised}, [&] { (void)update.distance(1, kDim); }},
      {"keep", {linearised, factored}, [&] { update.keep(all, 3, kDim); }},
      {"form_innovation", {linearised, factored}, [&] { update.form_innovation(); }},
      {"invert", {linearised, factored}, [&] { (void)update.invert(); }},
      {"factor", {linearised}, [&] { update.factor(); }},
      {"solve", {factored}, [&] { update.solve(); }},
      {"iterate",
       {factored},
       [&, fill] {
         update.iterate({2, 0.1, true}, fill);
       }},
      {"step", {solved, stepped}, [&] { update.step(); }},
      {"misfit", {solved, stepped}, [&] { (void)update.misfit(zero.data()); }},
      {"commit", {solved, stepped}, [&] { update.commit(); }},
      {"place", {opened, committed}, [&] { (void)sightings.place(state, update); }},
  };
}

bool contains(const std::vector<Stage>& stages, Stage stage) {
  for (const Stage s : stages)
    if (s == stage) return true;
  return false;
}

}  // namespace

TEST_CASE_TEMPLATE("ekf update: a call out of order throws, and the update goes on as if it had not been", Pose, SE2,
                   SE3) {
  for (const ErrorKind error : kBoth)
    for (const Stage stage : kStages) {
      const std::string stage_name = kNames[stage];
      CAPTURE(stage_name);
      SampleState<Pose> straight(error, 1);
      const Sightings<Pose> sightings(straight.state, 2, {2, 0, 5}, true);
      EkfUpdate<Pose> undisturbed = straight.state.begin(sightings.window());
      advance(undisturbed, sightings, opened, committed);
      CHECK(sightings.place(straight.state, undisturbed));
      const Bits expected = bits_of(straight.state);

      constexpr std::size_t kCalls = 12;
      for (std::size_t i = 0; i < kCalls; ++i) {
        SampleState<Pose> sample(error, 1);
        EkfUpdate<Pose> update = sample.state.begin(sightings.window());
        advance(update, sightings, opened, stage);
        const std::vector<Call<Pose>> all = calls(sample.state, update, sightings);
        REQUIRE(all.size() == kCalls);
        const std::string name = all[i].name;
        CAPTURE(name);
        if (contains(all[i].legal, stage)) {
          CHECK_NOTHROW(all[i].run());
          continue;
        }
        const Bits before = bits_of(sample.state);
        std::string message;
        try {
          all[i].run();
        } catch (const std::logic_error& caught) {
          message = caught.what();
        }
        CHECK(message.find("EkfUpdate: ") == 0);
        CHECK(same_bits(bits_of(sample.state), before));
        // `straight` is a run without step(): the commit does not depend on step().
        advance(update, sightings, stage, committed);
        CHECK(sightings.place(sample.state, update));
        CHECK(same_bits(bits_of(sample.state), expected));
      }
    }
}

TEST_CASE_TEMPLATE("ekf update: what is not legal is named with what the update last did", Pose, SE2, SE3) {
  SampleState<Pose> sample(ErrorKind::invariant, 3);
  const Sightings<Pose> sightings(sample.state, 4, {1, 3, 4}, false);
  EkfUpdate<Pose> update = sample.state.begin(sightings.window());
  CHECK_THROWS_WITH_AS(update.factor(), "EkfUpdate: factor() is not legal for an update that was just opened",
                       std::logic_error);
  sightings.linearise(update);
  CHECK_THROWS_WITH_AS(update.commit(), "EkfUpdate: commit() is not legal for an update that was just linearised",
                       std::logic_error);
}

TEST_CASE_TEMPLATE("ekf update: a new landmark ends an update without rows, and more may follow", Pose, SE2, SE3) {
  SampleState<Pose> sample(ErrorKind::invariant, 5);
  const Sightings<Pose> sightings(sample.state, 6, {1, 3, 4}, true);
  for (const bool empty_batch : {false, true}) {  // not linearised, or linearised with no rows
    SampleState<Pose> one(ErrorKind::invariant, 5);
    EkfUpdate<Pose> update = one.state.begin(sightings.window());
    if (empty_batch) update.linearise([&](double*) { return update.batch().clear(), true; });
    CHECK(sightings.place(one.state, update));
    CHECK_THROWS_AS(sightings.linearise(update), std::logic_error);
    CHECK_THROWS_AS(update.factor(), std::logic_error);
    CHECK(sightings.place(one.state, update));
    CHECK(one.state.size() == SampleState<Pose>::kPoints + 2);
    CHECK(one.state.smallest_pivot() > 0);
  }
}

TEST_CASE_TEMPLATE("ekf update: one that is dropped leaves every bit of the state, and of the frames that follow", Pose,
                   SE2, SE3) {
  for (const ErrorKind error : kBoth)
    for (const bool mounted : {false, true})
      for (const Stage stage : {opened, linearised, factored, solved, stepped}) {
        const std::string stage_name = kNames[stage];
        CAPTURE(stage_name);
        CAPTURE(mounted);
        SampleState<Pose> sample(error, 7), twin(error, 7);
        const Bits before = bits_of(sample.state);
        REQUIRE(same_bits(before, bits_of(twin.state)));
        {
          const Sightings<Pose> dropped(sample.state, 8, {6, 0, 1, 3}, mounted);
          EkfUpdate<Pose> update = sample.state.begin(dropped.window());
          advance(update, dropped, opened, stage);
          if (stage == stepped) {  // a second linearisation, and a gate
            dropped.linearise(update);
            const Index blocks[] = {1, 2};
            update.keep(blocks, 2, Pose::kDim);
            (void)update.invert();
            update.factor();
            update.solve();
          }
        }
        CHECK(same_bits(bits_of(sample.state), before));
        CHECK((sample.state.pose().translation() - twin.state.pose().translation()).norm() == 0);

        Random random(9), same_random(9);
        for (const bool mount_in_frame : {true, false}) {
          const Sightings<Pose> frame(twin.state, 10, {7, 2, 0}, mount_in_frame);
          frame.run(sample.state);
          frame.run(twin.state);
          CHECK(same_bits(bits_of(sample.state), bits_of(twin.state)));
          sample.propagate(random);
          twin.propagate(same_random);
          CHECK(same_bits(bits_of(sample.state), bits_of(twin.state)));
        }
      }
}

TEST_CASE_TEMPLATE("ekf update: a factor that does not exist is a numerical error, with nothing changed", Pose, SE2,
                   SE3) {
  for (const ErrorKind error : kBoth) {
    SampleState<Pose> sample(error, 11), twin(error, 11);
    const Bits before = bits_of(sample.state);
    Sightings<Pose> sightings(sample.state, 12, {1, 4, 2}, false);
    const auto good = sightings.noise;
    EkfUpdate<Pose> update = sample.state.begin(sightings.window());
    const auto numerical = [&](const auto& call) {
      try {
        call();
      } catch (const Error& caught) {
        return caught.code() == ErrorCode::numerical;
      }
      return false;
    };
    const auto closed = [&] {  // until the batch is linearised again
      CHECK_THROWS_AS(update.factor(), std::logic_error);
      CHECK_THROWS_AS(update.solve(), std::logic_error);
      CHECK_THROWS_AS((void)update.distance(0, Pose::kDim), std::logic_error);
      CHECK_THROWS_AS(update.commit(), std::logic_error);
      CHECK_THROWS_AS((void)sightings.place(sample.state, update), std::logic_error);
      CHECK(same_bits(bits_of(sample.state), before));
    };
    sightings.noise *= -1e6;
    sightings.linearise(update);
    CHECK(update.distance(0, Pose::kDim) == std::numeric_limits<double>::infinity());  // no gate accepts it
    CHECK(numerical([&] { (void)update.invert(); }));
    CHECK(numerical([&] { update.factor(); }));
    closed();
    sightings.noise = good * std::numeric_limits<double>::quiet_NaN();
    sightings.linearise(update);
    CHECK(numerical([&] { update.factor(); }));
    closed();
    sightings.noise = good;
    update.linearise([&](double*) {
      sightings.fill(update, nullptr);
      update.batch().residual()[1] = std::numeric_limits<double>::infinity();
      return true;
    });
    CHECK(numerical([&] { update.factor(); }));
    closed();
    CHECK(numerical([&] { update.linearise([](double*) { return false; }); }));  // a row without a residual
    CHECK(same_bits(bits_of(sample.state), before));

    advance(update, sightings, opened, committed);
    EkfUpdate<Pose> other = twin.state.begin(sightings.window());
    advance(other, sightings, opened, committed);
    CHECK(same_bits(bits_of(sample.state), bits_of(twin.state)));
  }
}

TEST_CASE_TEMPLATE("ekf update: a commit that would lose definiteness is a numerical error, with nothing changed", Pose,
                   SE2, SE3) {
  constexpr Index kDim = Pose::kDim;
  for (const ErrorKind error : kBoth) {
    SampleState<Pose> sample(error, 13), twin(error, 13);
    const Bits before = bits_of(sample.state);
    // "Noise" of -P/2 leaves S = P/2, and P - P S^-1 P = -P.
    const Index slot = 4;
    const typename State<Pose>::PointSquare noise = -0.5 * sample.state.landmark_covariance(slot);
    EkfUpdate<Pose> update = sample.state.begin({&slot, 1});
    update.linearise([&](double*) {
      const Index row = update.batch().add_rows(kDim);
      const auto pose = update.add_pose_block(row, kDim, State<Pose>::PointByPose::Zero(), false);
      update.add_landmark_block(row, kDim, State<Pose>::PointSquare::Identity(), 0, pose);
      Eigen::Map<typename State<Pose>::PointSquare>(update.batch().add_noise(row, kDim)) = noise;
      Eigen::Map<typename Pose::Point>(update.batch().residual()).setConstant(0.1);
      return true;
    });
    update.factor();
    update.solve();
    bool numerical = false;
    try {
      update.commit();
    } catch (const Error& caught) {
      numerical = caught.code() == ErrorCode::numerical;
    }
    CHECK(numerical);
    CHECK(same_bits(bits_of(sample.state), before));
    CHECK_THROWS_AS(update.commit(), std::logic_error);
    CHECK_THROWS_AS(update.factor(), std::logic_error);
    CHECK_THROWS_AS(update.solve(), std::logic_error);
    CHECK(same_bits(bits_of(sample.state), before));

    const Sightings<Pose> frame(twin.state, 14, {4, 6, 0}, true);
    frame.run(sample.state);
    frame.run(twin.state);
    CHECK(same_bits(bits_of(sample.state), bits_of(twin.state)));
    CHECK(sample.state.smallest_pivot() > 0);
  }
}

TEST_CASE_TEMPLATE(
    "ekf update: the iterate begins at the estimate, and the commit moves the estimate as step() moved it", Pose, SE2,
    SE3) {
  for (const ErrorKind error : kBoth) {
    SampleState<Pose> sample(error, 15);
    const Index slots[] = {5, 0, 3};
    const Sightings<Pose> sightings(sample.state, 16, {5, 0, 3}, true);
    EkfUpdate<Pose> update = sample.state.begin(sightings.window());
    CHECK_FALSE(update.iterating());
    CHECK(pose_error(update.pose(), sample.state.pose()).norm() == 0);
    for (Index a = 0; a < 3; ++a) CHECK(update.landmark(a) == sample.state.landmark(slots[a]));
    CHECK(update.mount().norm() == 0);
    advance(update, sightings, opened, stepped);
    CHECK(update.iterating());
    CHECK(pose_error(update.pose(), sample.state.pose()).norm() > 1e-6);
    CHECK(update.mount().norm() > 1e-6);
    advance(update, sightings, stepped, committed);
    const double size = 1 + sample.state.pose().translation().norm();
    CHECK(pose_error(update.pose(), sample.state.pose()).norm() < 1e-12 * size);
    for (Index a = 0; a < 3; ++a) CHECK((update.landmark(a) - sample.state.landmark(slots[a])).norm() < 1e-12 * size);
  }
}
