// SPDX-License-Identifier: BSD-3-Clause
// Landmarks of a submap whose names nobody told, against both kinds of map.
#include "map/naming.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <vector>

#include "map/dense_map.hpp"
#include "map/sparse_map.hpp"

namespace {

using namespace cairn;
using Ids = std::vector<std::uint64_t>;

constexpr double kSigma = 0.05;

// Estimates of a submap that ends where it began, known by `end` standard deviations of position.
Submap submap_of(ErrorKind error, const Ids& ids, const std::vector<Vector3>& landmarks, double end = 1e-3) {
  Submap submap;
  submap.error = error;
  submap.ids = ids;
  submap.counts.assign(ids.size(), 1);
  submap.landmarks = landmarks;
  const auto n = static_cast<Eigen::Index>(6 + 3 * ids.size());
  submap.covariance = kSigma * kSigma * Eigen::MatrixXd::Identity(n, n);
  submap.covariance.topLeftCorner<3, 3>() = end * end * Matrix3::Identity();
  submap.covariance.block<3, 3>(3, 3) = 1e-10 * Matrix3::Identity();
  return submap;
}

template <class Visit>
void for_each_map(Visit&& visit) {
  for (const ErrorKind error : {ErrorKind::invariant, ErrorKind::standard})
    for (const bool sparse : {false, true}) {
      CAPTURE(sparse);
      MapOptions options;
      options.error = error;
      options.initial_covariance = 1e-8 * Matrix6::Identity();
      std::unique_ptr<GlobalMap> map;
      if (sparse)
        map = std::make_unique<SparseMap>(options);
      else
        map = std::make_unique<DenseMap>(options);
      visit(*map, error);
    }
}

const std::vector<Vector3> kPlaces{{5, 0, 0}, {7, 3, 1}, {9, -3, 0}, {14, 1, 2}, {20, -4, 1}};

}  // namespace

TEST_CASE("naming: known ones get the map's names, new ones keep theirs, and what is neither goes") {
  for_each_map([](GlobalMap& map, ErrorKind error) {
    map.join(submap_of(error, {1, 2, 3, 4, 5}, kPlaces));
    // Squared distances by a variance of 2 x 0.05^2 and little more: 0.2, 18 (between 11.3 and 21.1) and very much.
    const std::vector<Vector3> seen{
        kPlaces[2] + Vector3(0.03, 0, 0), kPlaces[4] + Vector3(0, 0.3, 0), {-20, 9, 0}, kPlaces[0]};
    for (const bool joint : {false, true}) {
      Submap submap = submap_of(error, {100, 101, 102, 103}, seen);
      for (Eigen::Index i = 0; i < submap.covariance.rows(); ++i) submap.covariance(i, i) *= 1.0 + 1e-6 * i;
      const Submap before = submap;
      NamingOptions options;
      options.joint = joint;
      const NamingReport report = name_landmarks(map, options, submap);
      CHECK(report.named == 2);
      CHECK(report.ambiguous == 1);
      CHECK(!report.exhausted);
      CHECK((report.nodes > 0) == joint);
      CHECK(submap.ids == Ids{3, 102, 1});
      REQUIRE(submap.landmarks.size() == 3);
      CHECK(submap.landmarks[1] == seen[2]);
      REQUIRE(submap.covariance.rows() == 15);
      CHECK(submap.covariance.topLeftCorner<9, 9>() == before.covariance.topLeftCorner<9, 9>());
      CHECK(submap.covariance.bottomRightCorner<6, 6>() == before.covariance.bottomRightCorner<6, 6>());
    }
    Submap named = submap_of(error, {100, 101, 102, 103}, seen);
    name_landmarks(map, NamingOptions(), named);
    const JoinReport joined = map.join(named);
    CHECK(joined.fused == 2);
    CHECK(joined.fresh == 1);
    CHECK(map.size() == 6);
  });
}

TEST_CASE("naming: at an uncertain return one pair is not enough") {
  const std::vector<Vector3> crowd{{5, 0, 0}, {6.5, 1, 0}, {7.5, -1, 0.5}, {9, 0.5, 0}};
  for_each_map([&](GlobalMap& map, ErrorKind error) {
    map.join(submap_of(error, {1, 2, 3, 4}, crowd, 1.5));
    const Vector3 drift(1.2, -0.7, 0.4);
    Submap one = submap_of(error, {100}, {crowd[1] + drift});
    NamingReport report = name_landmarks(map, NamingOptions(), one);
    CHECK(report.named == 0);
    CHECK(report.ambiguous == 1);
    CHECK(one.ids.empty());
    CHECK(one.covariance.rows() == 6);

    Submap more =
        submap_of(error, {100, 101, 102, 103}, {crowd[2] + drift, crowd[0] + drift, crowd[3] + drift, {-9, 0, 0}});
    report = name_landmarks(map, NamingOptions(), more);
    CHECK(report.named == 3);
    CHECK(report.ambiguous == 0);
    CHECK(more.ids == Ids{3, 1, 4, 103});
    NamingOptions strict;
    strict.support = 4;
    Submap again = submap_of(error, {100, 101, 102}, {crowd[2] + drift, crowd[0] + drift, crowd[3] + drift});
    CHECK(name_landmarks(map, strict, again).named == 0);
  });
}

TEST_CASE("naming: an empty map, and a submap without landmarks") {
  for_each_map([](GlobalMap& map, ErrorKind error) {
    Submap first = submap_of(error, {7, 8}, {kPlaces[0], kPlaces[1]});
    const NamingReport report = name_landmarks(map, NamingOptions(), first);
    CHECK(report.named == 0);
    CHECK(report.ambiguous == 0);
    CHECK(first.ids == Ids{7, 8});
    map.join(first);
    Submap none = submap_of(error, {}, {});
    CHECK(name_landmarks(map, NamingOptions(), none).named == 0);
  });
}
