// SPDX-License-Identifier: BSD-3-Clause
// What bad input gets, who owns what, and what callbacks and threads may do.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#include <atomic>
#include <limits>
#include <memory>
#include <thread>
#if __cplusplus >= 202002L
#include <span>
#endif

#include "scene.hpp"

using cairn::Error;
using cairn::Filter;
using cairn::Status;
using scene::bytes_of;
using scene::points;
using scene::small;

namespace {

/// The error of a call that must fail.
template <class Function>
Error error_of(Function function) {
  try {
    function();
  } catch (const Error& error) {
    return error;
  }
  throw std::logic_error("the call succeeded");
}

template <class Function>
void check_error(Status status, const std::string& message, Function function) {
  const Error error = error_of(function);
  CHECK(error.status() == status);
  CHECK(error.what() == message);
}

Filter filter_with_points(std::int32_t& sensor) {
  Filter filter(small());
  sensor = filter.add_cartesian({});
  filter.predict_twist(0.1, {1, 0, 0}, {0, 0, 0.1});
  filter.update(sensor, points());
  return filter;
}

}  // namespace

TEST_CASE("options have the defaults of the library, and copies with one other value") {
  cairn_filter_options c;
  REQUIRE(cairn_filter_options_init(&c, sizeof c, nullptr) == CAIRN_OK);
  const cairn::FilterOptions options;
  CHECK(std::memcmp(&options, &c, sizeof c) == 0);
  const auto other = options.with_join(cairn::Join::kSparse).with_submap_landmarks(60);
  CHECK(other.join == cairn::Join::kSparse);
  CHECK(other.submap_landmarks == 60);
  CHECK(options.submap_landmarks == c.submap_landmarks);
  const cairn::Pose pose, identity = cairn::pose_identity();
  CHECK(pose.position == identity.position);
  CHECK(pose.quaternion == identity.quaternion);
}

TEST_CASE("an error has the status and the message of the library, and changes nothing") {
  std::int32_t sensor = -1;
  Filter filter = filter_with_points(sensor);
  const auto before = bytes_of(filter);
  cairn_error c;
  c.struct_size = sizeof c;
  REQUIRE(cairn_filter_predict_wheels(filter.c_handle(), -1.0, 1.0, 1.0, &c) == CAIRN_ERROR_ARGUMENT);
  check_error(Status::kErrorArgument, c.message, [&] { filter.predict_wheels(-1.0, 1.0, 1.0); });
  CHECK(error_of([&] { filter.map().landmark(77); }).status() == Status::kErrorNotFound);
  CHECK(error_of([&] { filter.update(sensor + 1, points()); }).status() == Status::kErrorNotFound);
  CHECK(bytes_of(filter) == before);
  CHECK(cairn::status_name(Status::kErrorNotFound) == std::string("CAIRN_ERROR_NOT_FOUND"));
  CHECK(cairn::constant_name(static_cast<Status>(-77)) == std::string());
}

TEST_CASE("a handle that is closed or was moved from is an error") {
  std::int32_t sensor = -1;
  Filter filter = filter_with_points(sensor);
  Filter moved = std::move(filter);
  CHECK(!filter.is_open());
  check_error(Status::kErrorState, "this filter is closed, or was moved from", [&] { filter.pose(); });
  CHECK(moved.map().size() == 4);
  moved.close();
  moved.close();
  check_error(Status::kErrorState, "this filter is closed, or was moved from", [&] { moved.close_submap(); });
  check_error(Status::kErrorState, "this filter is closed, or was moved from", [&] { moved.map(); });
}

TEST_CASE("a view of a map does not outlive its owner, a copy does") {
  std::int32_t sensor = -1;
  auto filter = std::make_unique<Filter>(filter_with_points(sensor));
  const cairn::MapView view = filter->map();
  cairn::Map copy = view.copy();
  cairn::MapView of_copy = copy;
  filter->predict_twist(0.1, {1, 0, 0}, {0, 0, 0});
  CHECK(view.size() == 4);
  filter.reset();
  check_error(Status::kErrorState, "this filter is closed, or was moved from", [&] { view.size(); });
  CHECK(copy.landmarks().size() == 4);
  check_error(Status::kErrorArgument, error_of([&] { copy.merge(copy); }).what(), [&] { copy.merge(of_copy); });
  cairn::Map moved = std::move(copy);
  CHECK(of_copy.size() == 4);
  CHECK(error_of([&] { copy.size(); }).status() == Status::kErrorState);
  moved.close();
  check_error(Status::kErrorState, "this map is closed, or was moved from", [&] { of_copy.size(); });
}

TEST_CASE("every contiguous container is an array, and a wrong shape is refused") {
  std::int32_t sensor = -1;
  Filter filter = filter_with_points(sensor);
  const cairn::MapView map = filter.map();
  const double c_array[] = {4.0, 1.0, 0.5};
  const std::array<double, 3> array = {4.0, 1.0, 0.5};
  const std::vector<double> vector(array.begin(), array.end());
  CHECK(map.within(c_array, 1.0).size() == 1);
  CHECK(map.within(array, 1.0).size() == 1);
  CHECK(map.within(vector, 1.0).size() == 1);
  CHECK(map.within({4.0, 1.0, 0.5}, 1.0).size() == 1);
#if __cplusplus >= 202002L
  CHECK(map.within(std::span<const double>(vector), 1.0).size() == 1);
  CHECK(map.within(std::span<const double, 3>(array), 1.0).size() == 1);
#endif
  const auto before = bytes_of(filter);
  check_error(Status::kErrorArgument, "centre must have 3 values, and has 2", [&] { map.within({4.0, 1.0}, 1.0); });
  check_error(Status::kErrorArgument, "rate must have 3 values, and has 0",
              [&] { filter.predict_twist(0.1, vector, std::vector<double>()); });
  std::vector<cairn::Match> matches(3);
  check_error(Status::kErrorArgument, "matches must have 4 values, and has 3",
              [&] { filter.update_into(sensor, points(), matches); });
  check_error(Status::kErrorArgument, "covariance must have 4 values, and has 3", [&] {
    filter.update_linear({1.0, 2.0}, {1.0, 0.0, 1.0}, {}, {}, {});
  });
  CHECK(bytes_of(filter) == before);
  CHECK(filter.update(sensor, {}).empty());
}

TEST_CASE("ids use all 64 bits") {
  Filter filter(small());
  const std::int32_t sensor = filter.add_cartesian({});
  const std::uint64_t large = (std::uint64_t{1} << 53) + 1;
  filter.update(sensor, points(large));
  filter.update(sensor, points(cairn::kIdNone - 4));
  CHECK(filter.map().landmark(large).id == large);
  CHECK(filter.map().landmark(cairn::kIdNone - 1).id == cairn::kIdNone - 1);
  CHECK(error_of([&] { filter.update(sensor, points(cairn::kIdNone)); }).status() == Status::kErrorArgument);
}

TEST_CASE("what a callback throws aborts the call, leaves the filter as before, and reaches the caller") {
  Filter filter(small());
  bool fail = false;
  const std::int32_t sensor = filter.add_custom({}, scene::MapAxes{&fail}, scene::PlaceInMapAxes());
  filter.update(sensor, points());
  filter.predict_twist(0.1, {1, 0, 0}, {0, 0, 0});
  const auto before = bytes_of(filter);
  fail = true;
  CHECK_THROWS_WITH_AS(filter.update(sensor, points()), "the model does not want to", std::out_of_range);
  CHECK(bytes_of(filter) == before);
  fail = false;
  CHECK(filter.update(sensor, points())[0].result == cairn::Result::kMatched);
  CHECK(cairn::custom_check({}, scene::MapAxes(), scene::PlaceInMapAxes(), {}, {3, 2, 1}) < 1e-6);
  fail = true;
  CHECK_THROWS_AS(cairn::custom_check({}, scene::MapAxes{&fail}, scene::PlaceInMapAxes(), {}, {3, 2, 1}),
                  std::out_of_range);
}

TEST_CASE("a callback that calls its own filter gets an error") {
  Filter filter(small());
  const auto predict = [&filter](const cairn::Pose&, cairn::Span<const double>, cairn::Prediction&) {
    filter.pose();
    return true;
  };
  const std::int32_t sensor = filter.add_custom({}, predict, scene::PlaceInMapAxes());
  filter.update(sensor, points());
  filter.predict_twist(0.1, {1, 0, 0}, {0, 0, 0});
  check_error(Status::kErrorState,
              "this filter is in use by another thread, or by the call that runs this callback: one at a time",
              [&] { filter.update(sensor, points()); });
  CHECK(filter.map().size() == 4);
}

TEST_CASE("callbacks are freed with the filter, once") {
  const auto token = std::make_shared<int>(0);
  {
    Filter filter(small());
    const auto never = [token](const cairn::Pose&, cairn::Span<const double>, cairn::Prediction&) { return false; };
    filter.add_custom({}, never, scene::PlaceInMapAxes());
    filter.set_log([token](const char*) {});
    CHECK(token.use_count() == 4);
    filter.set_log([](const char*) { throw std::runtime_error("dropped"); });
    CHECK(token.use_count() == 3);
    cairn::Custom wrong;
    wrong.rows = 7;
    CHECK_THROWS_AS(filter.add_custom(wrong, never), Error);
    CHECK(token.use_count() == 3);
    filter.clear_log();
    filter.close();
    CHECK(token.use_count() == 2);  // this test and its copy of the function
  }
  CHECK(token.use_count() == 1);
}

TEST_CASE("two threads on one filter: an error, never a crash") {
  std::int32_t sensor = -1;
  Filter filter = filter_with_points(sensor);
  std::atomic<int> done{0}, refused{0}, other{0};
  const auto work = [&](bool change) {
    for (int i = 0; i < 2000; ++i) {
      try {
        if (change) {
          filter.update(sensor, points());
        } else {
          filter.map().landmarks();
          filter.pose();
        }
        ++done;
      } catch (const Error& error) {
        ++(error.status() == Status::kErrorState ? refused : other);
      }
    }
  };
  std::thread threads[] = {std::thread(work, true), std::thread(work, true), std::thread(work, false)};
  for (std::thread& thread : threads) thread.join();
  CHECK(done + refused == 6000);
  CHECK(done > 0);
  CHECK(other == 0);
  filter.update(sensor, points());
}

TEST_CASE("queries run side by side, and each thread has its own message") {
  std::int32_t sensor = -1;
  const Filter filter = filter_with_points(sensor);
  std::atomic<int> wrong{0};
  std::vector<std::thread> threads;
  for (int number = 0; number < 16; ++number)
    threads.emplace_back([&, number] {
      for (int i = 0; i < 200; ++i) {
        if (filter.map().size() != 4) ++wrong;
        try {
          filter.map().within({0, 0, 0}, -1 - number);
          ++wrong;
        } catch (const Error& error) {
          if (std::string(error.what()).find("is " + std::to_string(-1 - number)) == std::string::npos) ++wrong;
        }
      }
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(wrong == 0);
}

TEST_CASE("10,000 filters with callbacks and copies take no memory") {
  long before = 0;
  for (int i = 0; i < 11000; ++i) {
    if (i == 1000) before = scene::resident_kib();
    Filter filter(small());
    const std::int32_t sensor = filter.add_custom({}, scene::MapAxes(), scene::PlaceInMapAxes());
    filter.set_log([](const char*) {});
    filter.update(sensor, points());
    const cairn::Map copy = filter.map().copy();
    CHECK_THROWS_AS(filter.close_submap(), Error);
  }
  const long grown = scene::resident_kib() - before;
  MESSAGE("resident memory grew by " << grown << " KiB");
  CHECK(grown < 512);
}
