// SPDX-License-Identifier: BSD-3-Clause
// The options of a filter: their defaults, their checks, and their conversion to the options of the core. Numbers and
// choices come from one table, options/filter_options.def.
#include <algorithm>
#include <initializer_list>

#include "capi/convert.hpp"
#include "capi/filter_handle.hpp"
#include "capi/read_errors.hpp"
#include "options/bounds.hpp"

using namespace cairn;
using namespace cairn::capi;
using namespace cairn::options;

#define CONSTANTS(...) \
  { __VA_ARGS__ }

namespace cairn {
namespace capi {
namespace {

std::int32_t first_of(std::initializer_list<std::int32_t> constants) {
  return *constants.begin();
}

cairn_filter_options default_options() {
  cairn_filter_options options = {};
  options.struct_size = sizeof options;
  write_pose(SE3(), &options.initial_pose);
#define FILTER_CHOICE(field, constants, words, flag) options.field = first_of(CONSTANTS constants);
#define FILTER_WHOLE(field, initial, lower, upper, flag) options.field = initial;
#define FILTER_REAL(field, initial, bounds, flag) options.field = initial;
#include "options/filter_options.def"
  return options;
}

void check_choice(std::int32_t value, std::initializer_list<std::int32_t> constants, const char* list,
                  const char* name) {
  if (std::find(constants.begin(), constants.end(), value) == constants.end())
    throw Error(ErrorCode::argument, "%s is %d; set it to one of %s", name, value, list);
}

void check_bounds(double value, const Bounds& bounds, const char* name) {
  check_finite(value, name);
  if (bounds.contain(value)) return;
  if (bounds.unbounded())
    throw Error(ErrorCode::argument, "%s must be %s %g, and is %g", name, bounds.lower_open ? ">" : ">=", bounds.lower,
                value);
  throw Error(ErrorCode::argument, "%s must lie in %c%g, %g%c, and is %g", name, bounds.lower_open ? '(' : '[',
              bounds.lower, bounds.upper, bounds.upper_open ? ')' : ']', value);
}

void check_filter_options(const cairn_filter_options& o) {
  check_reserved(o.reserved, "options.reserved");
  // A dense map allocates the memory of all its landmarks at creation.
  const bool sparse = o.submap_landmarks > 0 && o.join != CAIRN_JOIN_DENSE;
  if (!sparse) check_range(o.max_landmarks, 1, 30000, "options.max_landmarks");
#define FILTER_CHOICE(field, constants, words, flag) \
  check_choice(o.field, CONSTANTS constants, #constants, "options." #field);
#define FILTER_WHOLE(field, initial, lower, upper, flag) check_range(o.field, lower, upper, "options." #field);
#define FILTER_REAL(field, initial, bounds, flag) check_bounds(o.field, bounds, "options." #field);
#include "options/filter_options.def"
}

ErrorKind error_of(const cairn_filter_options& o) {
  return o.state_error == CAIRN_STATE_ERROR_STANDARD ? ErrorKind::standard : ErrorKind::invariant;
}

JoinKind join_of(const cairn_filter_options& o) {
  return o.join == CAIRN_JOIN_DENSE    ? JoinKind::dense
         : o.join == CAIRN_JOIN_SPARSE ? JoinKind::sparse
                                       : JoinKind::automatic;
}

LossKind join_loss_of(const cairn_filter_options& o) {
  return o.join_loss == CAIRN_LOSS_HUBER    ? LossKind::huber
         : o.join_loss == CAIRN_LOSS_CAUCHY ? LossKind::cauchy
                                            : LossKind::none;
}

AssociationKind association_of(const cairn_filter_options& o) {
  return o.association == CAIRN_ASSOCIATION_NEAREST ? AssociationKind::nearest
         : o.association == CAIRN_ASSOCIATION_JOINT ? AssociationKind::joint
                                                    : AssociationKind::known;
}

SystematicOptions systematic_of(const cairn_filter_options& o) {
  SystematicOptions options;
  const bool planar = o.vehicle == CAIRN_VEHICLE_PLANAR;
  double* const sigma = options.motion_sigma;
  double* const walk = options.motion_walk;
  read_errors(o.velocity_bias_sigma, o.velocity_bias_walk, 3, "options.velocity_bias", planar ? Axes::xy : Axes::all,
              sigma, walk);
  read_errors(o.rate_bias_sigma, o.rate_bias_walk, 3, "options.rate_bias", planar ? Axes::z : Axes::all, sigma + 3,
              walk + 3);
  read_errors(o.wheel_scale_sigma, o.wheel_scale_walk, 2, "options.wheel_scale", Axes::all,
              sigma + MotionErrors::kScale, walk + MotionErrors::kScale);
  return options;
}

// A start that is not known at all has a large covariance, but not one that no map has.
template <class Pose>
void check_initial_covariance(const typename Pose::Square& covariance) {
  for (int i = 0; i < Pose::kDof; ++i) {
    const double largest = i < Pose::kDim ? kLargestPositionSigma : kLargestAttitudeSigma;
    if (covariance(i, i) > largest * largest)
      throw Error(ErrorCode::argument,
                  "options.initial_covariance: the variance of the %s is %g, and must be at most %g",
                  i < Pose::kDim ? "position" : "attitude", covariance(i, i), largest * largest);
  }
}

template <class Pose>
FilterOptions<Pose> options_of(const cairn_filter_options& o) {
  FilterOptions<Pose> options;
  options.initial_pose = read_pose_of<Pose>(&o.initial_pose, "options.initial_pose");
  options.initial_covariance = read_pose_covariance<Pose>(o.initial_covariance, "options.initial_covariance");
  check_initial_covariance<Pose>(options.initial_covariance);
  options.error = error_of(o);
  options.join = join_of(o);
  options.join_loss = join_loss_of(o);
  options.association = association_of(o);
  options.apply_noise = o.noise_learning == CAIRN_NOISE_APPLIED;
  options.by_likelihood =
      options.association == AssociationKind::nearest && o.association_distance == CAIRN_DISTANCE_LIKELIHOOD;
  // Numbers have the same name on both sides.
#define FILTER_WHOLE(field, initial, lower, upper, flag) options.field = static_cast<decltype(options.field)>(o.field);
#define FILTER_REAL(field, initial, bounds, flag) options.field = o.field;
#include "options/filter_options.def"
  options.systematic = systematic_of(o);
  return options;
}

}  // namespace

std::variant<FilterOptions<SE3>, FilterOptions<SE2>> read_filter_options(const cairn_filter_options* user) {
  const cairn_filter_options o = read_options(user, default_options(), "options");
  check_filter_options(o);
  if (o.vehicle == CAIRN_VEHICLE_PLANAR) return options_of<SE2>(o);
  return options_of<SE3>(o);
}

}  // namespace capi
}  // namespace cairn

extern "C" {

cairn_status cairn_filter_options_init(cairn_filter_options* options, size_t struct_size, cairn_error* error) {
  return guard(error, [&] { init_options(options, struct_size, default_options(), "options"); });
}

}  // extern "C"
