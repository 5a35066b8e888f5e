// SPDX-License-Identifier: BSD-3-Clause
// The interface of everything that holds landmarks (filters and maps), and the queries that need only this interface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/types.hpp"

namespace cairn {

class SpatialIndex;

// How a map holds its landmarks: with their joint covariance, or as a sparse system of submaps.
enum class MapKind { dense, sparse };

// A landmark with fewer observations is young: it bears no witness about the pose, and may have been placed wrongly.
constexpr std::uint64_t kGrownUp = 10;
// A contradiction is gross if an honest observation contradicts as much with less than this chance.
constexpr double kGrossChance = 1e-6;

class Landmarks {
 public:
  virtual ~Landmarks() = default;
  virtual std::size_t size() const = 0;
  // `index` counts from 0 to size() - 1 and holds until the map changes.
  virtual std::uint64_t id(std::size_t index) const = 0;
  virtual std::uint64_t observations(std::size_t index) const = 0;
  virtual Vector3 position(std::size_t index) const = 0;
  virtual Matrix3 covariance(std::size_t index) const = 0;
  // The same, up to rounding, of a landmark whose neighbours are not asked for: a map may have a cheaper way to it.
  virtual Matrix3 covariance_alone(std::size_t index) const { return covariance(index); }
  // Finds the index of an id. Returns false if there is no such landmark.
  virtual bool find(std::uint64_t id, std::size_t& index) const = 0;
  // Joint covariance of `count` positions, 3 count x 3 count.
  virtual void joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const = 0;
  // Announces that the covariances of these landmarks will be needed: a map may compute them together, which is
  // cheaper.
  virtual void prepare_covariances(const std::vector<std::size_t>&) const {}
  // A spatial index of the positions, by landmark index. Null if queries look at all landmarks.
  virtual const SpatialIndex* spatial_index() const { return nullptr; }
  // Whether all landmarks are points of the plane: z = 0, with no covariance in z.
  virtual bool planar() const { return false; }
  virtual MapKind kind() const { return MapKind::dense; }
  // An independent map with these landmarks: a SparseMap copies itself, everything else becomes DenseLandmarks.
  virtual std::unique_ptr<Landmarks> copy() const;
};

// Convert a joint covariance of a pose and `count` landmarks, which has kDof + kDim count rows. with_pose() gives the
// covariance in space, 6 + 3 count rows; without_pose() gives only its part for the landmarks.
template <class Pose>
void with_pose(const double* joint, std::size_t count, double* matrix);
template <class Pose>
void without_pose(const double* joint, std::size_t count, double* matrix);

// Indices of all landmarks by ascending id.
std::vector<std::size_t> all_by_id(const Landmarks& map);
// Indices of all landmarks within `radius` of `centre`, nearest first, ties by id.
std::vector<std::size_t> within(const Landmarks& map, const Vector3& centre, double radius);
// Indices of the `count` nearest landmarks, nearest first, ties by id.
std::vector<std::size_t> nearest(const Landmarks& map, const Vector3& point, std::size_t count);
// Indices of all landmarks in a closed box, by ascending id.
std::vector<std::size_t> in_box(const Landmarks& map, const Vector3& lower, const Vector3& upper);

}  // namespace cairn
