// SPDX-License-Identifier: BSD-3-Clause
// Updates of a filter: observations, absolute fixes, and rows that the caller linearised.
#include "capi/filter_handle.hpp"
#include "capi/read_observation.hpp"
#include "core/chi_square.hpp"

using namespace cairn;
using namespace cairn::capi;

namespace cairn {
namespace capi {

void write_match(const Match& match, cairn_match* out) {
  out->landmark = match.landmark;
  out->result = match.decision == Decision::matched  ? CAIRN_RESULT_MATCHED
                : match.decision == Decision::placed ? CAIRN_RESULT_NEW
                                                     : CAIRN_RESULT_REJECTED;
  switch (match.reason) {
    case Reason::none:
      out->reason = CAIRN_REASON_NONE;
      break;
    case Reason::gate:
      out->reason = CAIRN_REASON_GATE;
      break;
    case Reason::batch_gate:
      out->reason = CAIRN_REASON_BATCH_GATE;
      break;
    case Reason::no_image:
      out->reason = CAIRN_REASON_NO_IMAGE;
      break;
    case Reason::no_place:
      out->reason = CAIRN_REASON_NO_PLACE;
      break;
    case Reason::ambiguous:
      out->reason = CAIRN_REASON_AMBIGUOUS;
      break;
    case Reason::no_room:
      out->reason = CAIRN_REASON_NO_ROOM;
      break;
    case Reason::contradicted:
      out->reason = CAIRN_REASON_CONTRADICTED;
      break;
  }
  out->distance = match.distance;
  out->threshold = match.threshold;
}

namespace {

template <class AnyFilter>
void write_matches(const AnyFilter& filter, std::size_t count, cairn_match* matches) {
  if (matches == nullptr) return;
  for (std::size_t i = 0; i < count; ++i) write_match(filter.matches()[i], matches + i);
}

}  // namespace

void read_observation(const cairn_observation& from, const char* array, std::size_t number, std::size_t rows,
                      bool named, Observation& to) {
  if (named && from.id == CAIRN_ID_NONE)
    throw Error(ErrorCode::argument, "%s[%zu].id is CAIRN_ID_NONE, which no landmark or vehicle has", array, number);
  // The name of a field is written only for an error, because that takes longer than the checks.
  char name[64];
  if (!all_finite(from.z, rows)) {
    std::snprintf(name, sizeof name, "%s[%zu].z", array, number);
    check_finite(from.z, rows, name);
  }
  bool given = false;
  for (std::size_t i = 0; i < rows * rows; ++i) given = given || from.covariance[i] != 0.0;
  if (given) {
    std::snprintf(name, sizeof name, "%s[%zu].covariance", array, number);
    check_covariance(from.covariance, rows, false, name);
  }
  to.id = from.id;
  std::fill_n(to.z, 3, 0.0);
  std::copy_n(from.z, rows, to.z);
  std::fill_n(to.covariance, 9, 0.0);
  std::copy_n(from.covariance, rows * rows, to.covariance);
}

}  // namespace capi
}  // namespace cairn

extern "C" {

cairn_status cairn_filter_update(cairn_filter* filter, int32_t sensor, const cairn_observation* observations,
                                 size_t count, cairn_match* matches, cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](auto& f) {
      const std::size_t rows = static_cast<std::size_t>(f.sensor_rows(sensor));
      if (count > 0) check_pointer(observations, "observations");
      const std::size_t most = static_cast<std::size_t>(f.options().max_observations);
      if (count > most)
        throw Error(ErrorCode::capacity, "count: %zu observations, and max_observations is %zu", count, most);
      const bool named = f.options().association == AssociationKind::known;
      for (std::size_t i = 0; i < count; ++i)
        read_observation(observations[i], "observations", i, rows, named, filter->observations[i]);
      f.update(sensor, filter->observations, static_cast<Index>(count));
      write_matches(f, count, matches);
    });
  });
}

cairn_status cairn_filter_update_linear(cairn_filter* filter, const double* residual, size_t rows,
                                        const double* covariance, const double* jacobian_pose,
                                        const uint64_t* landmarks, size_t count, const double* jacobian_landmarks,
                                        cairn_match* match, cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](auto& f) {
      check_pointer(residual, "residual");
      constexpr std::size_t kDim = PoseOf<decltype(f)>::kDim;
      const std::size_t most = static_cast<std::size_t>(f.options().max_observations);
      if (rows == 0) throw Error(ErrorCode::argument, "rows is 0; an update has at least one");
      if (rows > kDim * most)
        throw Error(ErrorCode::capacity, "rows: %zu, and %zu max_observations is %zu", rows, kDim, kDim * most);
      if (count > most)
        throw Error(ErrorCode::capacity, "count: %zu landmarks, and max_observations is %zu", count, most);
      check_finite(residual, rows, "residual");
      check_pointer(covariance, "covariance");
      check_covariance(covariance, rows, false, "covariance", f.workspace());
      if (jacobian_pose != nullptr) check_finite(jacobian_pose, 6 * rows, "jacobian_pose");
      if (count > 0) {
        check_pointer(landmarks, "landmarks");
        check_pointer(jacobian_landmarks, "jacobian_landmarks");
        check_finite(jacobian_landmarks, 3 * count * rows, "jacobian_landmarks");
      } else if (jacobian_pose == nullptr) {
        throw Error(ErrorCode::argument, "jacobian_pose is NULL and count 0: the rows depend on nothing");
      }
      f.update_linear({residual, static_cast<Index>(rows), covariance, jacobian_pose, landmarks,
                       static_cast<Index>(count), jacobian_landmarks});
      write_matches(f, 1, match);
    });
  });
}

cairn_status cairn_filter_update_position(cairn_filter* filter, const double position[3], const double covariance[9],
                                          const double lever_arm[3], cairn_match* match, cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](auto& f) {
      check_pointer(position, "position");
      check_position(position, 3, "position");
      using Pose = PoseOf<decltype(f)>;
      const auto noise = read_point_covariance<Pose>(covariance, "covariance");
      if (lever_arm != nullptr) check_position(lever_arm, 3, "lever_arm");
      const Vector3 arm = lever_arm != nullptr ? Vector3(lever_arm) : Vector3(Vector3::Zero());
      f.update_position(Embedding<Pose>::down(Vector3(position)), noise, Embedding<Pose>::down(arm));
      write_matches(f, 1, match);
    });
  });
}

cairn_status cairn_filter_update_attitude(cairn_filter* filter, const double quaternion[4], const double covariance[9],
                                          cairn_match* match, cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](auto& f) {
      const SO3 attitude = read_quaternion(quaternion, "quaternion");
      check_pointer(covariance, "covariance");
      if constexpr (PoseOf<decltype(f)>::kDim == 2) {
        check_covariance(covariance + 8, 1, false, "covariance of the yaw");
        if (!AbsoluteFix<SE3>::heading(0.0, 1.0).defined(SE3(attitude, Vector3::Zero())))
          throw Error(ErrorCode::argument, "quaternion: its x axis is vertical and has no heading in the plane");
        f.update_attitude(Embedding<SE2>::down(SE3(attitude, Vector3::Zero())).rotation(), Vector1(covariance[8]));
      } else {
        check_covariance(covariance, 3, false, "covariance");
        f.update_attitude(attitude, Matrix3(Eigen::Map<const Matrix3>(covariance)));
      }
      write_matches(f, 1, match);
    });
  });
}

cairn_status cairn_filter_update_heading(cairn_filter* filter, double heading, double sigma, cairn_match* match,
                                         cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](auto& f) {
      check_finite(heading, "heading");
      check_sigma(sigma, "sigma");
      f.update_heading(heading, sigma);
      write_matches(f, 1, match);
    });
  });
}

cairn_status cairn_filter_merge_landmarks(cairn_filter* filter, uint64_t id, uint64_t other, cairn_match* match,
                                          cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](auto& f) {
      f.merge_landmarks(id, other);
      write_matches(f, 1, match);
    });
  });
}

cairn_status cairn_filter_last_update(const cairn_filter* filter, cairn_update_report* report, cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](const auto& f) {
      const UpdateReport& r = f.report();
      cairn_update_report out = {};
      out.matched = static_cast<std::uint32_t>(r.matched);
      out.placed = static_cast<std::uint32_t>(r.placed);
      out.rejected = static_cast<std::uint32_t>(r.rejected);
      out.rows = static_cast<std::uint32_t>(r.rows);
      out.iterations = static_cast<std::uint32_t>(r.iterations);
      out.nis = r.nis;
      if (r.rows > 0) {
        out.nis_lower = chi_square_quantile(static_cast<double>(r.rows), 0.025);
        out.nis_upper = chi_square_quantile(static_cast<double>(r.rows), 0.975);
      }
      out.association_nodes = static_cast<std::uint32_t>(r.association_nodes);
      out.association_exhausted = r.association_exhausted ? 1 : 0;
      out.association_seconds = r.association_seconds;
      out.deferred = static_cast<std::uint32_t>(r.deferred);
      out.removed = static_cast<std::uint32_t>(r.removed);
      out.widened_position = r.widened_position;
      out.widened_attitude = r.widened_attitude;
      out.placed_again = static_cast<std::uint32_t>(r.placed_again);
      write_report(out, report);
    });
  });
}

}  // extern "C"
