/* SPDX-License-Identifier: BSD-3-Clause */
/* The world of the tests, and the sensors that observe it. */
#include "support.h"

uint64_t random_bits(generator* random) { /* splitmix64 */
  uint64_t z = (random->state += UINT64_C(0x9E3779B97F4A7C15));
  z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
  return z ^ (z >> 31);
}

double random_uniform(generator* random, double lower, double upper) {
  return lower + (upper - lower) * (double)(random_bits(random) >> 11) / 9007199254740992.0;
}

/* Sum of twelve uniform numbers: it uses no library function whose rounding differs between machines. */
double random_normal(generator* random, double sigma) {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += random_uniform(random, 0.0, 1.0);
  return sigma * sum;
}

void rotation_matrix(const double q[4], double m[9]) {
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  m[0] = 1 - 2 * (y * y + z * z), m[1] = 2 * (x * y - w * z), m[2] = 2 * (x * z + w * y);
  m[3] = 2 * (x * y + w * z), m[4] = 1 - 2 * (x * x + z * z), m[5] = 2 * (y * z - w * x);
  m[6] = 2 * (x * z - w * y), m[7] = 2 * (y * z + w * x), m[8] = 1 - 2 * (x * x + y * y);
}

void cross_matrix(const double v[3], double m[9]) {
  m[0] = 0, m[1] = -v[2], m[2] = v[1];
  m[3] = v[2], m[4] = 0, m[5] = -v[0];
  m[6] = -v[1], m[7] = v[0], m[8] = 0;
}

void multiply3(const double a[9], const double b[9], double out[9]) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
}

static void apply(const double m[9], const double v[3], double out[3]) {
  for (int i = 0; i < 3; ++i) out[i] = m[3 * i] * v[0] + m[3 * i + 1] * v[1] + m[3 * i + 2] * v[2];
}

static void apply_transposed(const double m[9], const double v[3], double out[3]) {
  for (int i = 0; i < 3; ++i) out[i] = m[i] * v[0] + m[3 + i] * v[1] + m[6 + i] * v[2];
}

void to_body(const cairn_pose* pose, const double point[3], double out[3]) {
  double m[9], d[3];
  rotation_matrix(pose->quaternion, m);
  for (int i = 0; i < 3; ++i) d[i] = point[i] - pose->position[i];
  apply_transposed(m, d, out);
}

void to_map(const cairn_pose* pose, const double point[3], double out[3]) {
  double m[9], turned[3];
  rotation_matrix(pose->quaternion, m);
  apply(m, point, turned);
  for (int i = 0; i < 3; ++i) out[i] = turned[i] + pose->position[i];
}

cairn_pose pose_at(double x, double y, double z, double roll, double pitch, double yaw) {
  cairn_pose pose = {{x, y, z}, {1, 0, 0, 0}};
  assert_ok(cairn_quaternion_from_euler(roll, pitch, yaw, pose.quaternion, NULL));
  return pose;
}

void diagonal(double* matrix, int size, double value) {
  for (int i = 0; i < size * size; ++i) matrix[i] = i % (size + 1) == 0 ? value : 0.0;
}

/* A custom sensor that gives the point in the body frame. */
int32_t point_predict(void* user, const cairn_pose* pose, const double landmark[3], double* z, double* jacobian_pose,
                      double* jacobian_landmark) {
  double m[9], d[3], cross[9], mt[9], turn[9];
  (void)user;
  rotation_matrix(pose->quaternion, m);
  for (int i = 0; i < 3; ++i) d[i] = landmark[i] - pose->position[i];
  apply_transposed(m, d, z);
  cross_matrix(d, cross);
  for (int i = 0; i < 9; ++i) mt[i] = m[3 * (i % 3) + i / 3];
  multiply3(mt, cross, turn);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      jacobian_landmark[3 * i + j] = mt[3 * i + j];
      jacobian_pose[6 * i + j] = -mt[3 * i + j];
      jacobian_pose[6 * i + 3 + j] = turn[3 * i + j];
    }
  return 1;
}

int32_t point_place(void* user, const cairn_pose* pose, const double* z, double landmark[3], double* jacobian_pose,
                    double* jacobian_z) {
  double m[9], arm[3], cross[9];
  (void)user;
  rotation_matrix(pose->quaternion, m);
  apply(m, z, arm);
  cross_matrix(arm, cross);
  for (int i = 0; i < 3; ++i) {
    landmark[i] = pose->position[i] + arm[i];
    for (int j = 0; j < 3; ++j) {
      jacobian_z[3 * i + j] = m[3 * i + j];
      jacobian_pose[6 * i + j] = i == j;
      jacobian_pose[6 * i + 3 + j] = -cross[3 * i + j];
    }
  }
  return 1;
}

int32_t range_predict(void* user, const cairn_pose* pose, const double landmark[3], double* z, double* jacobian_pose,
                      double* jacobian_landmark) {
  double d[3], square = 0;
  (void)user;
  for (int i = 0; i < 3; ++i) d[i] = landmark[i] - pose->position[i], square += d[i] * d[i];
  z[0] = sqrt(square);
  if (!(z[0] > 0.1)) return 0;
  for (int i = 0; i < 3; ++i) {
    jacobian_landmark[i] = d[i] / z[0];
    jacobian_pose[i] = -d[i] / z[0];
    jacobian_pose[3 + i] = 0;
  }
  return 1;
}

cairn_stereo_head test_head(void) {
  cairn_stereo_head head;
  const double tilt[4] = {0.99500416527802576610, 0, 0.09983341664682815230, 0}; /* 0.2 rad about y */
  assert_ok(cairn_stereo_head_init(&head, sizeof head, NULL));
  head.encoder_mode = CAIRN_ENCODER_PER_FRAME;
  head.platform[0] = 0.2, head.platform[2] = 0.5;
  head.stick[0] = 0.1, head.stick[2] = 0.3;
  memcpy(head.camera_quaternion, tilt, sizeof tilt);
  head.range_sigma = 0.2;
  head.azimuth_sigma = head.elevation_sigma = 0.01;
  head.pan_sigma = head.stick_sigma = 0.002;
  return head;
}

cairn_stereo_camera test_camera(void) {
  cairn_stereo_camera camera;
  assert_ok(cairn_stereo_camera_init(&camera, sizeof camera, NULL));
  return camera;
}

cairn_cartesian test_cartesian(void) {
  cairn_cartesian cartesian;
  assert_ok(cairn_cartesian_init(&cartesian, sizeof cartesian, NULL));
  return cartesian;
}

own_sensor test_point(void) {
  own_sensor own = {{0}, point_predict, point_place, NULL};
  assert_ok(cairn_custom_init(&own.model, sizeof own.model, NULL));
  own.model.sigma[0] = own.model.sigma[1] = own.model.sigma[2] = 0.1;
  return own;
}

own_sensor test_range(void) {
  own_sensor own = {{0}, range_predict, NULL, NULL};
  assert_ok(cairn_custom_init(&own.model, sizeof own.model, NULL));
  own.model.rows = 1;
  own.model.sigma[0] = 0.1;
  return own;
}

cairn_status add_own(cairn_filter* filter, const own_sensor* own, int32_t* sensor) {
  return cairn_filter_add_custom(filter, &own->model, own->predict, own->place, own->user, NULL, sensor, NULL);
}

cairn_status check_own(const own_sensor* own, const cairn_pose* pose, const double landmark[3], double* worst) {
  return cairn_custom_check(&own->model, own->predict, own->place, own->user, pose, landmark, worst, NULL);
}

void world_init(world* w, uint64_t seed) {
  memset(w, 0, sizeof *w);
  w->random.state = seed;
  w->noise = 1.0;
  w->truth = pose_at(5, 0, 0.5, 0.05, -0.03, PI / 2);
  for (int i = 0; i < WORLD_LANDMARKS; ++i) {
    const double angle = 2 * PI * i / WORLD_LANDMARKS, radius = random_uniform(&w->random, 9, 16);
    w->landmarks[i][0] = radius * cos(angle);
    w->landmarks[i][1] = radius * sin(angle);
    w->landmarks[i][2] = random_uniform(&w->random, -2, 3);
  }
}

bool world_see(const world* w, int sensor, double pan, double stick, const double point[3], double z[3]) {
  double b[3];
  to_body(&w->truth, point, b);
  const double range = sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
  if (range < 1 || range > 40) return false;
  if (sensor == HEAD) {
    const cairn_stereo_head head = test_head();
    cairn_pose platform = pose_at(0, 0, 0, 0, stick, pan), camera = {{0, 0, 0}, {1, 0, 0, 0}};
    double s[3], c[3];
    memcpy(platform.position, head.platform, sizeof platform.position);
    memcpy(camera.position, head.stick, sizeof camera.position);
    memcpy(camera.quaternion, head.camera_quaternion, sizeof camera.quaternion);
    to_body(&platform, b, s);
    to_body(&camera, s, c);
    const double level = sqrt(c[0] * c[0] + c[1] * c[1]);
    z[0] = sqrt(level * level + c[2] * c[2]), z[1] = atan2(c[1], c[0]), z[2] = atan2(c[2], level);
    return z[0] > 1 && fabs(z[2]) < 1.2;
  }
  if (sensor == CAMERA) {
    const cairn_stereo_camera camera = test_camera();
    const double x = -b[1], y = -b[2], depth = b[0];
    if (depth < 1) return false;
    z[0] = camera.fu * x / depth + camera.cu;
    z[1] = camera.fu * (x - camera.baseline) / depth + camera.cu;
    z[2] = camera.fv * y / depth + camera.cv;
    return z[0] > -400 && z[0] < 1040; /* a wide field of view */
  }
  if (sensor == RANGE) {
    z[0] = range, z[1] = z[2] = 0;
    return true;
  }
  memcpy(z, b, sizeof b);
  return true;
}

static void observe(world* w, frame* f) {
  static const double sigma[SENSORS][3] = {{0.2, 0.01, 0.01}, {1, 1, 1}, {0.1, 0.1, 0.1}, {0.1, 0.1, 0.1}, {0.1, 0, 0}};
  f->count = 0;
  for (int i = 0; i < WORLD_LANDMARKS; ++i) {
    cairn_observation* o = &f->observations[f->count];
    memset(o, 0, sizeof *o);
    o->id = (uint64_t)i + 1;
    if (!world_see(w, f->sensor, f->pan, f->stick, w->landmarks[i], o->z)) continue;
    for (int k = 0; k < 3; ++k) o->z[k] += w->noise * random_normal(&w->random, sigma[f->sensor][k]);
    ++f->count;
  }
}

void world_frame(world* w, frame* f) {
  const double speed = 0.5, turn = 0.1, dt = 0.2, angle = turn * dt;
  const cairn_pose move = {{speed / turn * sin(angle), speed / turn * (1 - cos(angle)), 0},
                           {cos(angle / 2), 0, 0, sin(angle / 2)}};
  memset(f, 0, sizeof *f);
  assert_ok(cairn_pose_compose(&w->truth, &move, &w->truth, NULL));
  f->motion = (int)(w->step % MOTIONS);
  f->dt = dt;
  f->left = (speed - turn / 2) / 0.3 + w->noise * random_normal(&w->random, 0.01);
  f->right = (speed + turn / 2) / 0.3 + w->noise * random_normal(&w->random, 0.01);
  for (int i = 0; i < 3; ++i) {
    f->velocity[i] = (i == 0) * speed + w->noise * random_normal(&w->random, 0.02);
    f->rate[i] = (i == 2) * turn + w->noise * random_normal(&w->random, 0.002);
  }
  f->increment = move;
  for (int i = 0; i < 3; ++i) f->increment.position[i] += w->noise * random_normal(&w->random, 0.005);
  for (int i = 0; i < 6; ++i) f->increment_covariance[7 * i] = i < 3 ? 2.5e-5 : 1e-6;
  f->sensor = (int)((w->step + CARTESIAN) % SENSORS);
  f->pan = 0.3 * sin(0.1 * w->step), f->stick = 0.1;
  observe(w, f);
  f->has_position = w->step % 5 == 4;
  f->has_attitude = w->step % 7 == 6;
  f->has_heading = w->step % 11 == 10;
  for (int i = 0; i < 3; ++i) f->position[i] = w->truth.position[i] + w->noise * random_normal(&w->random, 0.5);
  memcpy(f->quaternion, w->truth.quaternion, sizeof f->quaternion);
  double m[9];
  rotation_matrix(w->truth.quaternion, m);
  f->heading = atan2(m[3], m[0]) + w->noise * random_normal(&w->random, 0.02);
  ++w->step;
}
