/* SPDX-License-Identifier: BSD-3-Clause */
/* Somebody else's program, valid as C99 and as C++17: drives 10 m, sees one landmark from both ends, and prints which
 * build of the library it was given. Exits 0 where the numbers are right. */
#include <cairn/cairn.h>
#include <stdio.h>

static int failed(cairn_status status, const char* call) {
  if (status == CAIRN_OK) return 0;
  fprintf(stderr, "%s: %s: %s\n", call, cairn_status_name(status), cairn_last_message());
  return 1;
}

int main(void) {
  cairn_filter_options options;
  cairn_cartesian sensor;
  cairn_filter* filter = NULL;
  cairn_landmark landmark;
  cairn_pose pose;
  int32_t number = -1;
  int step;
  const double velocity[3] = {1.0, 0.0, 0.0}, rate[3] = {0.0, 0.0, 0.0};
  cairn_observation seen = {7, {20.0, 3.0, 1.0}, {0.0}};

  if (failed(cairn_filter_options_init(&options, sizeof options, NULL), "options_init")) return 1;
  if (failed(cairn_filter_create(&options, &filter, NULL), "create")) return 1;
  if (failed(cairn_cartesian_init(&sensor, sizeof sensor, NULL), "cartesian_init")) return 1;
  if (failed(cairn_filter_add_cartesian(filter, &sensor, &number, NULL), "add_cartesian")) return 1;
  if (failed(cairn_filter_update(filter, number, &seen, 1, NULL, NULL), "first update")) return 1;
  for (step = 0; step < 100; ++step) {
    if (failed(cairn_filter_predict_twist(filter, 0.1, velocity, rate, NULL), "predict")) return 1;
  }
  seen.z[0] = 10.0;
  if (failed(cairn_filter_update(filter, number, &seen, 1, NULL, NULL), "second update")) return 1;
  if (failed(cairn_filter_pose(filter, &pose, NULL, NULL), "pose")) return 1;
  if (failed(cairn_map_landmark(cairn_filter_map(filter), 7, &landmark, NULL), "landmark")) return 1;
  cairn_filter_destroy(filter);

  printf("%s %s\n", cairn_version(), cairn_build());
  if (!(pose.position[0] > 9.999 && pose.position[0] < 10.001)) return 2;
  if (!(landmark.position[0] > 19.999 && landmark.position[0] < 20.001 && landmark.observations == 2)) return 3;
  return 0;
}
