/* SPDX-License-Identifier: BSD-3-Clause */
/* Somebody else's program, valid as C99 and as C++17: drives the default world to its end and prints what it counted.
 */
#include <cairn/sim.h>
#include <stdio.h>

static int failed(cairn_status status, const char* call) {
  if (status == CAIRN_OK) return 0;
  fprintf(stderr, "%s: %s\n", call, cairn_sim_last_message());
  return 1;
}

int main(void) {
  cairn_world_options options;
  cairn_world* world = NULL;
  cairn_world_step step;
  size_t steps = 0, i, motions = 0, observations = 0;

  step.struct_size = sizeof step;
  if (failed(cairn_world_options_init(&options, sizeof options, NULL), "options_init")) return 1;
  if (failed(cairn_world_create(&options, &world, NULL), "create")) return 1;
  if (failed(cairn_world_steps(world, &steps, NULL), "steps")) return 1;
  for (i = 0; i < steps; ++i) {
    if (failed(cairn_world_next(world, &step, NULL), "next")) return 1;
    motions += step.motion_count;
    observations += step.observation_count;
  }
  cairn_world_destroy(world);
  printf("%lu steps, %lu motions, %lu observations\n", (unsigned long)steps, (unsigned long)motions,
         (unsigned long)observations);
  return steps == 201 && motions == 2000 && observations > 1000 ? 0 : 2;
}
