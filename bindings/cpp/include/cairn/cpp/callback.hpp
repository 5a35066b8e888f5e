// SPDX-License-Identifier: BSD-3-Clause
// Functions of the caller that the library calls. No exception crosses C: it is kept, the call is aborted, and the
// exception is thrown again when the call has returned.
#ifndef CAIRN_CPP_CALLBACK_HPP
#define CAIRN_CPP_CALLBACK_HPP

#include <cairn/cpp/pose.hpp>
#include <exception>
#include <utility>

namespace cairn {

/// What the function that predicts an observation writes. All values are NaN before; each must be written, zeros too.
struct Prediction {
  Span<double> z;                  ///< one value for each row of the sensor
  Span<double> jacobian_pose;      ///< rows x 6, row-major: dz / [dp; dtheta]
  Span<double> jacobian_landmark;  ///< rows x 3, row-major: dz / dlandmark
};

/// What the function that places a landmark writes. All values are NaN before; each must be written, zeros too.
struct Placement {
  Span<double> landmark;       ///< the landmark in the map, m
  Span<double> jacobian_pose;  ///< 3 x 6, row-major: dlandmark / [dp; dtheta]
  Span<double> jacobian_z;     ///< 3 x rows, row-major: dlandmark / dz
};

/// For `place` of a sensor that cannot place landmarks.
struct NoPlace {};

namespace detail {

/// Runs a function of the caller and turns what it does into the answer that C expects.
template <class Function>
std::int32_t answer(std::exception_ptr& thrown, Function function) noexcept {
  try {
    return function() ? 1 : 0;
  } catch (...) {
    thrown = std::current_exception();
    return -1;
  }
}

template <class Predict, class Place>
struct Model {
  Predict predict;
  Place place;
  std::size_t rows;
  std::exception_ptr* thrown;

  static std::int32_t c_predict(void* user, const cairn_pose* pose, const double* landmark, double* z,
                                double* jacobian_pose, double* jacobian_landmark) noexcept {
    Model& model = *static_cast<Model*>(user);
    return answer(*model.thrown, [&]() -> bool {
      Prediction out{{z, model.rows}, {jacobian_pose, 6 * model.rows}, {jacobian_landmark, 3 * model.rows}};
      return model.predict(*reinterpret_cast<const Pose*>(pose), Span<const double>(landmark, 3), out);
    });
  }

  static std::int32_t c_place(void* user, const cairn_pose* pose, const double* z, double* landmark,
                              double* jacobian_pose, double* jacobian_z) noexcept {
    Model& model = *static_cast<Model*>(user);
    return answer(*model.thrown, [&]() -> bool {
      Placement out{{landmark, 3}, {jacobian_pose, 18}, {jacobian_z, 3 * model.rows}};
      return model.place(*reinterpret_cast<const Pose*>(pose), Span<const double>(z, model.rows), out);
    });
  }

  static void c_release(void* user) noexcept { delete static_cast<Model*>(user); }

  static constexpr cairn_custom_place_fn place_function() noexcept {
    if constexpr (std::is_same_v<Place, NoPlace>) {
      return nullptr;
    } else {
      return c_place;
    }
  }
};

template <class Log>
struct LogReceiver {
  Log log;

  static void c_log(void* payload, const char* line) noexcept {
    std::exception_ptr dropped;  // a line belongs to a call that has its own result
    answer(dropped, [&] { return static_cast<LogReceiver*>(payload)->log(line), true; });
  }
  static void c_release(void* payload) noexcept { delete static_cast<LogReceiver*>(payload); }
};

}  // namespace detail

//~ cairn_custom_check
/// Compares a custom sensor's Jacobians with central differences on the manifold, at one pose and landmark. `worst`
/// gets the largest difference; each difference is relative to max(1, |numerical value|). A correct Jacobian gives
/// about 1e-6 or less. If `place` is given, it is checked at the observation that `predict` gives: its Jacobians, and
/// that it returns to the landmark. `relative` is not checked.
///
/// Throws Error: Status::kErrorArgument (also if `predict` refuses the landmark); Status::kErrorCallback.
///
/// Complexity: O(1).
template <class Predict, class Place = NoPlace>
double custom_check(const Custom& custom, Predict predict, Place place, const Pose& pose, Vector<3> landmark) {
  using Model = detail::Model<Predict, Place>;
  std::exception_ptr thrown;
  Model model{std::move(predict), std::move(place), custom.rows, &thrown};
  double worst = 0.0;
  detail::CallError error;
  const cairn_status status = cairn_custom_check(detail::as_c(&custom), Model::c_predict, Model::place_function(),
                                                 &model, detail::as_c(&pose), landmark.get("landmark"), &worst, &error);
  if (thrown != nullptr) std::rethrow_exception(thrown);
  if (status != CAIRN_OK) detail::fail(status, error);
  return worst;
}

}  // namespace cairn

#endif
