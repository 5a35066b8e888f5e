/* SPDX-License-Identifier: BSD-3-Clause */
/* Writes the log that examples/demo.sh runs: a rover drives two laps over rolling ground and sees the boulders
 * beside its course. Each line is one record, in SI units and radians. The program always writes the same bytes:
 *
 *   T k t x y z roll pitch yaw       true pose at step k, at time t
 *   O k dx dy dz droll dpitch dyaw   measured motion from step k-1 to k, in the body frame of k-1
 *   Z k id range azimuth elevation   measured boulder, from the body (azimuth left, elevation up positive)
 *   L id x y z                       true boulders, at the end
 *
 * Noise: 2 cm and 0.1 degrees for a motion; 0.1 m, 0.5 and 0.5 degrees for a boulder. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#define PI 3.14159265358979323846
#define DEGREE (PI / 180.0)

enum { LAPS = 2, STEPS_A_LAP = 300, BOULDERS = 160, SEEN_AT_ONCE = 10 };

typedef struct pose {
  double position[3];
  double axes[3][3]; /* axes[i]: the body's i-th axis (x forward, y left, z up) in the world */
} pose;

typedef struct sighting {
  int boulder;
  double range, azimuth, elevation;
} sighting;

/* Random numbers: the upper bits of Knuth's 64-bit congruential generator; Box and Muller for normal ones. */
static uint64_t random_state = 20260101u;

static double uniform(void) {
  random_state = random_state * 6364136223846793005u + 1442695040888963407u;
  return ((double)(random_state >> 11) + 0.5) / 9007199254740992.0; /* in (0, 1) */
}

static double normal(double sigma) {
  const double radius = sqrt(-2.0 * log(uniform()));
  return sigma * radius * cos(2.0 * PI * uniform());
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double c[3]) {
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}

static void normalise(double a[3]) {
  const double length = sqrt(dot(a, a));
  for (int i = 0; i < 3; ++i) a[i] /= length;
}

/* The ground: low hills of two wavelengths. */
static double height(double x, double y) {
  return 1.2 * sin(x / 13.0) * cos(y / 17.0) + 0.7 * cos((x - 2.0 * y) / 29.0);
}

/* The course: a bean around the origin, 35 to 55 m away from it. */
static void course(double angle, double offset, double xy[2]) {
  const double radius = 45.0 + 6.0 * cos(2.0 * angle) + 4.0 * sin(3.0 * angle) + offset;
  xy[0] = radius * cos(angle);
  xy[1] = radius * sin(angle);
}

/* The rover at a point of its course: it stands flat on the ground and points ahead. */
static void stand(double angle, pose* rover) {
  const double eps = 1e-4;
  double here[2], ahead[2];
  course(angle, 0.0, here);
  course(angle + eps, 0.0, ahead);
  const double x = here[0], y = here[1];
  rover->position[0] = x;
  rover->position[1] = y;
  rover->position[2] = height(x, y);
  double *forward = rover->axes[0], *left = rover->axes[1], *up = rover->axes[2];
  up[0] = (height(x - eps, y) - height(x + eps, y)) / (2.0 * eps);
  up[1] = (height(x, y - eps) - height(x, y + eps)) / (2.0 * eps);
  up[2] = 1.0;
  normalise(up);
  const double heading[3] = {ahead[0] - x, ahead[1] - y, 0.0};
  cross(up, heading, left);
  normalise(left);
  cross(left, up, forward);
}

/* Roll, pitch and yaw of a body: its axes are the columns of Rz(yaw) Ry(pitch) Rx(roll). */
static void euler(const pose* body, double angles[3]) {
  angles[0] = atan2(body->axes[1][2], body->axes[2][2]);
  angles[1] = -asin(fmax(-1.0, fmin(1.0, body->axes[0][2])));
  angles[2] = atan2(body->axes[0][1], body->axes[0][0]);
}

/* A direction of the world, in the body frame. */
static void to_body(const pose* body, const double v[3], double v_body[3]) {
  for (int i = 0; i < 3; ++i) v_body[i] = dot(body->axes[i], v);
}

static void print_truth(int step, const pose* truth) {
  double angles[3];
  euler(truth, angles);
  printf("T %d %.3f %.9f %.9f %.9f %.9f %.9f %.9f\n", step, 1.0 * step, truth->position[0], truth->position[1],
         truth->position[2], angles[0], angles[1], angles[2]);
}

static void print_motion(int step, const pose* before, const pose* after) {
  double moved[3], moved_body[3], angles[3];
  pose turned;
  for (int i = 0; i < 3; ++i) moved[i] = after->position[i] - before->position[i];
  to_body(before, moved, moved_body);
  for (int i = 0; i < 3; ++i) to_body(before, after->axes[i], turned.axes[i]);
  euler(&turned, angles);
  printf("O %d", step);
  for (int i = 0; i < 3; ++i) printf(" %.9f", moved_body[i] + normal(0.02));
  for (int i = 0; i < 3; ++i) printf(" %.9f", angles[i] + normal(0.1 * DEGREE));
  printf("\n");
}

static int nearer(const void* a, const void* b) {
  const double range_a = ((const sighting*)a)->range, range_b = ((const sighting*)b)->range;
  return (range_a > range_b) - (range_a < range_b);
}

/* The nearest boulders within 25 m and 60 degrees to either side. */
static void print_sightings(int step, const pose* truth, double boulders[][3]) {
  sighting seen[BOULDERS];
  size_t count = 0;
  for (int i = 0; i < BOULDERS; ++i) {
    double way[3], m[3];
    for (int j = 0; j < 3; ++j) way[j] = boulders[i][j] - truth->position[j];
    to_body(truth, way, m);
    const sighting s = {i, sqrt(dot(m, m)), atan2(m[1], m[0]), atan2(m[2], sqrt(m[0] * m[0] + m[1] * m[1]))};
    if (s.range > 1.0 && s.range < 25.0 && fabs(s.azimuth) < 60.0 * DEGREE) seen[count++] = s;
  }
  qsort(seen, count, sizeof seen[0], nearer);
  for (size_t i = 0; i < count && i < SEEN_AT_ONCE; ++i) {
    const double range = seen[i].range + normal(0.1);
    const double azimuth = seen[i].azimuth + normal(0.5 * DEGREE);
    const double elevation = seen[i].elevation + normal(0.5 * DEGREE);
    printf("Z %d %d %.9f %.9f %.9f\n", step, seen[i].boulder, range, azimuth, elevation);
  }
}

int main(void) {
  double boulders[BOULDERS][3];
  for (int i = 0; i < BOULDERS; ++i) {
    const double angle = 2.0 * PI * uniform(), offset = 36.0 * uniform() - 18.0;
    course(angle, offset, boulders[i]);
    boulders[i][2] = height(boulders[i][0], boulders[i][1]) + 1.5 * uniform();
  }
  pose before = {{0}, {{0}}}, now;
  for (int step = 0; step <= LAPS * STEPS_A_LAP; ++step) {
    stand(2.0 * PI * step / STEPS_A_LAP, &now);
    print_truth(step, &now);
    if (step > 0) print_motion(step, &before, &now);
    print_sightings(step, &now, boulders);
    before = now;
  }
  for (int i = 0; i < BOULDERS; ++i) printf("L %d %.9f %.9f %.9f\n", i, boulders[i][0], boulders[i][1], boulders[i][2]);
  return fflush(stdout) == 0 && !ferror(stdout) ? 0 : 1;
}
