// SPDX-License-Identifier: BSD-3-Clause
// Association of a submap's landmarks without ids, against both kinds of map.
#include "map/naming.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "map/join/dense/dense_map.hpp"
#include "map/join/sparse/sparse_map.hpp"

namespace {

using namespace cairn;
using Ids = std::vector<std::uint64_t>;

constexpr double kSigma = 0.05;

// The estimates of a submap that ends where it began, with the standard deviation `end` of the position.
template <class Pose>
Submap<Pose> submap_of(ErrorKind error, const Ids& ids, const std::vector<Vector3>& landmarks, double end = 1e-3) {
  constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn;
  Submap<Pose> submap;
  submap.error = error;
  submap.ids = ids;
  submap.counts.assign(ids.size(), 1);
  for (const Vector3& l : landmarks) submap.landmarks.push_back(Embedding<Pose>::down(l));
  const auto n = static_cast<Eigen::Index>(Pose::kDof + kDim * ids.size());
  submap.covariance = kSigma * kSigma * Eigen::MatrixXd::Identity(n, n);
  submap.covariance.diagonal().template head<kDim>().setConstant(end * end);
  submap.covariance.diagonal().template segment<kTurn>(kDim).setConstant(1e-10);
  return submap;
}

template <class Pose, class Visit>
void for_each_map(Visit&& visit) {
  for (const ErrorKind error : {ErrorKind::invariant, ErrorKind::standard})
    for (const bool sparse : {false, true}) {
      CAPTURE(sparse);
      MapOptions<Pose> options;
      options.error = error;
      options.initial_covariance = 1e-8 * Pose::Square::Identity();
      std::unique_ptr<GlobalMap<Pose>> map;
      if (sparse)
        map = std::make_unique<SparseMap<Pose>>(options);
      else
        map = std::make_unique<DenseMap<Pose>>(options);
      visit(*map, error);
    }
}

const std::vector<Vector3> kPlaces{{5, 0, 0}, {7, 3, 1}, {9, -3, 0}, {14, 1, 2}, {20, -4, 1}};

}  // namespace

TEST_CASE_TEMPLATE("naming: known ones get the map's names, new ones keep theirs, and what is neither goes", Pose, SE3,
                   SE2) {
  for_each_map<Pose>([](GlobalMap<Pose>& map, ErrorKind error) {
    map.join(submap_of<Pose>(error, {1, 2, 3, 4, 5}, kPlaces));
    // The squared distances with a variance of slightly more than 2 x 0.05^2 are 0.2, 18 (between 11.3 and 21.1, in the
    // plane between 9.2 and 18.4) and very large.
    const std::vector<Vector3> seen{
        kPlaces[2] + Vector3(0.03, 0, 0), kPlaces[4] + Vector3(0, 0.3, 0), {-20, 9, 0}, kPlaces[0]};
    for (const bool joint : {false, true}) {
      Submap<Pose> submap = submap_of<Pose>(error, {100, 101, 102, 103}, seen);
      for (Eigen::Index i = 0; i < submap.covariance.rows(); ++i) submap.covariance(i, i) *= 1.0 + 1e-6 * i;
      const Submap<Pose> before = submap;
      NamingOptions options;
      options.joint = joint;
      const NamingReport report = name_landmarks(map, options, submap);
      CHECK(report.named == 2);
      CHECK(report.ambiguous == 1);
      CHECK(!report.exhausted);
      CHECK((report.nodes > 0) == joint);
      CHECK(submap.ids == Ids{3, 102, 1});
      REQUIRE(submap.landmarks.size() == 3);
      CHECK(submap.landmarks[1] == Embedding<Pose>::down(seen[2]));
      constexpr int kFirst = Pose::kDof + Pose::kDim, kLast = 2 * Pose::kDim;  // the second one is gone
      REQUIRE(submap.covariance.rows() == kFirst + kLast);
      CHECK(submap.covariance.topLeftCorner(kFirst, kFirst) == before.covariance.topLeftCorner(kFirst, kFirst));
      CHECK(submap.covariance.bottomRightCorner(kLast, kLast) == before.covariance.bottomRightCorner(kLast, kLast));
    }
    Submap<Pose> named = submap_of<Pose>(error, {100, 101, 102, 103}, seen);
    name_landmarks(map, NamingOptions(), named);
    const JoinReport joined = map.join(named);
    CHECK(joined.fused == 2);
    CHECK(joined.fresh == 1);
    CHECK(map.size() == 6);
  });
}

TEST_CASE_TEMPLATE("naming: the bounds are those of so many coordinates", Pose, SE3, SE2) {
  for_each_map<Pose>([](GlobalMap<Pose>& map, ErrorKind error) {
    map.join(submap_of<Pose>(error, {1, 2, 3, 4, 5}, kPlaces));
    const auto name = [&](double squared_distance) {
      const Vector3 apart(0, kSigma * std::sqrt(2 * squared_distance), 0);
      Submap<Pose> submap = submap_of<Pose>(error, {100}, {kPlaces[1] + apart});
      return name_landmarks(map, NamingOptions(), submap);
    };
    CHECK(name(8.5).named == 1);
    CHECK(name(10.3).named == (Pose::kDim == 3 ? 1 : 0));  // between 9.2 and 11.3
    CHECK(name(12.0).named == 0);
    CHECK(name(17.5).ambiguous == 1);
    CHECK(name(19.7).ambiguous == (Pose::kDim == 3 ? 1 : 0));  // between 18.4 and 21.1
    CHECK(name(22.0).ambiguous == 0);
  });
}

TEST_CASE_TEMPLATE("naming: at an uncertain return one pair is not enough", Pose, SE3, SE2) {
  const std::vector<Vector3> crowd{{5, 0, 0}, {6.5, 1, 0}, {7.5, -1, 0.5}, {9, 0.5, 0}};
  for_each_map<Pose>([&](GlobalMap<Pose>& map, ErrorKind error) {
    map.join(submap_of<Pose>(error, {1, 2, 3, 4}, crowd, 1.5));
    const Vector3 drift(1.2, -0.7, 0.4);
    Submap<Pose> one = submap_of<Pose>(error, {100}, {crowd[1] + drift});
    NamingReport report = name_landmarks(map, NamingOptions(), one);
    CHECK(report.named == 0);
    CHECK(report.ambiguous == 1);
    CHECK(one.ids.empty());
    CHECK(one.covariance.rows() == Pose::kDof);

    Submap<Pose> more = submap_of<Pose>(error, {100, 101, 102, 103},
                                        {crowd[2] + drift, crowd[0] + drift, crowd[3] + drift, {-9, 0, 0}});
    report = name_landmarks(map, NamingOptions(), more);
    CHECK(report.named == 3);
    CHECK(report.ambiguous == 0);
    CHECK(more.ids == Ids{3, 1, 4, 103});
    NamingOptions strict;
    strict.support = 4;
    Submap<Pose> again =
        submap_of<Pose>(error, {100, 101, 102}, {crowd[2] + drift, crowd[0] + drift, crowd[3] + drift});
    CHECK(name_landmarks(map, strict, again).named == 0);
  });
}

TEST_CASE_TEMPLATE("naming: an empty map, and a submap without landmarks", Pose, SE3, SE2) {
  for_each_map<Pose>([](GlobalMap<Pose>& map, ErrorKind error) {
    Submap<Pose> first = submap_of<Pose>(error, {7, 8}, {kPlaces[0], kPlaces[1]});
    const NamingReport report = name_landmarks(map, NamingOptions(), first);
    CHECK(report.named == 0);
    CHECK(report.ambiguous == 0);
    CHECK(first.ids == Ids{7, 8});
    map.join(first);
    Submap<Pose> none = submap_of<Pose>(error, {}, {});
    CHECK(name_landmarks(map, NamingOptions(), none).named == 0);
  });
}
