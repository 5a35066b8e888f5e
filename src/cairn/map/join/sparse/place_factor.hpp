// SPDX-License-Identifier: BSD-3-Clause
// The factor of several submaps of one place that became one (docs/submaps.md, "A map that does not grow"): a quadratic
// cost of the errors of poses and landmarks in the frame of the place's base.
#pragma once

#include <cstdint>
#include <vector>

#include "map/join/sparse/packed.hpp"
#include "map/join/sparse/quadratic.hpp"

namespace cairn {

// Values of the variables of a place: its base, other poses, landmarks; in the map frame.
template <class Pose>
struct PlaceValues {
  Pose base;
  std::vector<Pose> poses;
  std::vector<typename Pose::Point> landmarks;
};

template <class Pose>
class PlaceFactor {
 public:
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using Matrix = Eigen::MatrixXd;
  using Vector = Eigen::VectorXd;
  using Rotation = typename Pose::Rotation;
  using PointSquare = typename Rotation::Matrix;
  using Values = PlaceValues<Pose>;

  // The cost of [poses; landmarks] about the values, by ordinary errors in the frame of the base.
  PlaceFactor(const Values& values, std::vector<std::uint64_t> ids, const Quadratic& cost);

  const std::vector<std::uint64_t>& ids() const { return ids_; }  // of the landmarks, when they were fused
  // Columns of the Jacobian: base, poses, landmarks; ordinary errors in map axes.
  Index columns() const { return kDof + information_.size(); }
  struct Evaluation {
    double cost = 0.0;
    Vector gradient;  // columns()
  };
  Evaluation evaluate(const Values& values) const;
  // J^T Lambda J, lower triangle, with complete diagonal blocks of poses and of landmarks; by errors in the given axes
  // of base, poses and landmarks.
  Matrix hessian(const Values& values, const std::vector<Rotation>& axes) const;
  // Block of the information of a single landmark, in map axes.
  PointSquare landmark_information(Index i, const Rotation& base) const;

  std::size_t memory_bytes() const { return information_.memory_bytes(); }

 private:
  using Point = typename Pose::Point;
  using Tangent = typename Rotation::Tangent;

  // By the errors of base and of the rows' own variables.
  struct Jacobian {
    std::vector<typename Rotation::Turn> lever;     // of each pose and landmark, by the base's turn
    std::vector<typename Rotation::Jacobian> turn;  // of each pose's turn by its own; by the base's its negative
  };
  Index row(std::size_t number) const;  // of a pose or landmark, in the order of the rows
  Vector residual(const Values& values) const;
  Jacobian jacobian(const Values& values, const Vector& residual) const;

  std::vector<Pose> poses_;  // when they were fused, in the frame of the base
  std::vector<Point> landmarks_;
  std::vector<std::uint64_t> ids_;
  Packed information_;  // of [poses; landmarks]
  Vector pull_;         // the gradient at those values
  double constant_;     // the cost at those values
};

extern template class PlaceFactor<SE2>;
extern template class PlaceFactor<SE3>;

}  // namespace cairn
