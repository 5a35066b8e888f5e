/* SPDX-License-Identifier: BSD-3-Clause */
/* The planar vehicle of the tests. */
#include "plane.h"

const double plane_points[POINTS][3] = {{4, 1, 0},  {8, -3, 0}, {12, 2, 0}, {14, 8, 0}, {9, 12, 0},
                                        {3, 13, 0}, {-4, 9, 0}, {-5, 3, 0}, {0, 6, 0},  {6, 6, 0}};

cairn_filter_options plane_options(int32_t vehicle, int32_t error) {
  cairn_filter_options options;
  assert_ok(cairn_filter_options_init(&options, sizeof options, NULL));
  options.vehicle = vehicle, options.state_error = error;
  options.max_landmarks = options.max_observations = POINTS;
  options.gate_probability = options.batch_gate_probability = 1; /* bounds by rows, of which space has more */
  options.initial_pose = pose_at(0.3, -0.2, 0, 0, 0, 0.1);
  options.initial_covariance[0] = 0.02, options.initial_covariance[7] = 0.03, options.initial_covariance[35] = 1e-3;
  options.initial_covariance[1] = options.initial_covariance[6] = 5e-3;
  options.initial_covariance[5] = options.initial_covariance[30] = 1e-3;
  return options;
}

cairn_filter* plane_filter(const cairn_filter_options* options) {
  cairn_filter* filter = NULL;
  assert_ok(cairn_filter_create(options, &filter, NULL));
  return filter;
}

cairn_observation sighting(uint64_t id, double first, double second) {
  cairn_observation o;
  memset(&o, 0, sizeof o);
  o.id = id, o.z[0] = first, o.z[1] = second;
  return o;
}

void plane_polar(const cairn_pose* sensor, const double point[3], double* range, double* bearing) {
  double body[3];
  to_body(sensor, point, body);
  *range = hypot(body[0], body[1]), *bearing = atan2(body[1], body[0]);
}

cairn_range_bearing plane_radar(void) {
  cairn_range_bearing radar;
  assert_ok(cairn_range_bearing_init(&radar, sizeof radar, NULL));
  radar.range_sigma = 0.1, radar.bearing_sigma = 0.01;
  return radar;
}

static bool in_plane(int i) {
  return i == 0 || i == 1 || i == 5;
}

void plane_compare(const cairn_filter* plane, const cairn_filter* space, double tolerance) {
  cairn_pose pa, pb;
  double ca[36], cb[36], error[6];
  size_t na = 0, nb = 0, needed = 0;
  cairn_landmark la[POINTS], lb[POINTS];
  uint64_t ids[POINTS];
  double ja[(6 + 3 * POINTS) * (6 + 3 * POINTS)], jb[(6 + 3 * POINTS) * (6 + 3 * POINTS)];
  assert_ok(cairn_filter_pose(plane, &pa, ca, NULL));
  assert_ok(cairn_filter_pose(space, &pb, cb, NULL));
  assert_ok(cairn_pose_error(&pa, &pb, error, NULL));
  for (int i = 0; i < 6; ++i) assert_near(error[i], 0, tolerance);
  for (int i = 0; i < 36; ++i) {
    const bool counts = in_plane(i / 6) && in_plane(i % 6);
    if (counts)
      assert_near(ca[i], cb[i], tolerance);
    else
      assert_true(ca[i] == 0);
  }
  assert_true(pa.position[2] == 0 && pa.quaternion[1] == 0 && pa.quaternion[2] == 0);
  assert_ok(cairn_map_landmarks(cairn_filter_map(plane), la, POINTS, &na, NULL));
  assert_ok(cairn_map_landmarks(cairn_filter_map(space), lb, POINTS, &nb, NULL));
  assert_int_equal(na, nb);
  for (size_t i = 0; i < na; ++i) {
    ids[i] = la[i].id;
    assert_int_equal(la[i].id, lb[i].id);
    assert_int_equal(la[i].observations, lb[i].observations);
    assert_true(la[i].position[2] == 0);
    for (int k = 0; k < 2; ++k) assert_near(la[i].position[k], lb[i].position[k], tolerance);
    for (int k = 0; k < 9; ++k) {
      if (k / 3 < 2 && k % 3 < 2)
        assert_near(la[i].covariance[k], lb[i].covariance[k], tolerance);
      else
        assert_true(la[i].covariance[k] == 0);
    }
  }
  assert_ok(cairn_filter_joint_covariance(plane, ids, na, ja, LENGTH(ja), &needed, NULL));
  assert_ok(cairn_filter_joint_covariance(space, ids, na, jb, LENGTH(jb), &needed, NULL));
  const size_t side = 6 + 3 * na;
  assert_int_equal(needed, side * side);
  for (size_t i = 0; i < side * side; ++i) {
    const size_t r = i / side, c = i % side;
    const bool row = r < 6 ? in_plane((int)r) : (r - 6) % 3 < 2, column = c < 6 ? in_plane((int)c) : (c - 6) % 3 < 2;
    if (row && column)
      assert_near(ja[i], jb[i], tolerance);
    else
      assert_true(ja[i] == 0);
  }
}
