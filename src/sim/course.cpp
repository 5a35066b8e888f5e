// SPDX-License-Identifier: BSD-3-Clause
// Two courses: the circle of the Mars paper, and laps on a closed curve with bends. The third one, a chain of circles,
// is in traverse.cpp.
#include "sim/course.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "geometry/angle.hpp"

namespace cairn::sim {
namespace {

class Circle : public Course {
 public:
  explicit Circle(const cairn_world_options& o)
      : centre_(o.centre[0], o.centre[1]),
        radius_(o.radius > 0 ? o.radius : std::hypot(kStartX, kStartY) * o.landmarks / 200.0),
        start_(o.start_azimuth),
        laps_(o.laps > 0 ? o.laps : 1),
        strip_(o.strip) {
    if (o.radius <= 0) strip_ = std::min(strip_, 0.9 * radius_);  // a small circle with few landmarks
    if (radius_ <= strip_)
      throw Error(ErrorCode::argument, "options.radius = %g must exceed options.strip = %g", radius_, strip_);
  }

  double length() const override { return 2 * kPi * radius_ * laps_; }

  Place at(double s) const override {
    const double azimuth = start_ + s / radius_;
    return {centre_.x() + radius_ * std::cos(azimuth), centre_.y() + radius_ * std::sin(azimuth), azimuth + kPi / 2};
  }

  // Landmarks are uniform in azimuth and in radius.
  std::vector<Vector2> scatter(Random& random, std::size_t count) const override {
    std::vector<Vector2> places(count);
    for (Vector2& place : places) {
      const double azimuth = random.uniform(0, 2 * kPi), radius = radius_ + random.uniform(-strip_, strip_);
      place = centre_ + radius * Vector2(std::cos(azimuth), std::sin(azimuth));
    }
    return places;
  }

 private:
  Vector2 centre_;
  double radius_, start_, laps_, strip_;
};

// The curve r(a) = scale (1 + sum_m size_m cos(m a + phase_m)) about a centre. Different parts of the curve stay apart,
// and its curvature is at most about twice that of a circle of its mean radius.
class Laps : public Course {
 public:
  explicit Laps(const cairn_world_options& o) : laps_(o.laps > 0 ? o.laps : 2) {
    Random random(o.seed, Stream::course);
    constexpr double kSizes[kWaves] = {0.10, 0.05, 0.02};
    for (int i = 0; i < kWaves; ++i) waves_[i] = {i + 2.0, kSizes[i], random.uniform(0, 2 * kPi)};
    const double start = random.uniform(0, 2 * kPi);
    tabulate();
    // The area of a strip along a closed curve is its length times its width, whatever the bends. For few landmarks the
    // course would become shorter than the strip is wide; then the course is kept longer and the landmarks are less
    // dense.
    const double asked = o.landmarks * o.landmark_area / (2 * o.strip);
    scale_ = std::max(asked, 2 * kPi * 3 * o.strip) / lap_;
    strip_ = o.strip;
    tabulate();
    start_ = arc_to(start);
    const Vector2 point = point_at(start);
    centre_ = Vector2(kStartX, kStartY) - point;
  }

  double length() const override { return laps_ * lap_; }

  Place at(double s) const override {
    const double angle = angle_at(std::fmod(start_ + s, lap_));
    const Vector2 point = centre_ + point_at(angle);
    const Shape f = shape(angle);
    const double c = std::cos(angle), n = std::sin(angle);
    return {point.x(), point.y(), std::atan2(f.slope * n + f.radius * c, f.slope * c - f.radius * n)};
  }

  // Landmarks are uniform over the area. In a left bend of curvature k, a place at `offset` to the left of the line
  // represents 1 - k offset times the area of a place on the line; rejection sampling takes this into account.
  std::vector<Vector2> scatter(Random& random, std::size_t count) const override {
    std::vector<Vector2> places;
    while (places.size() < count) {
      const double angle = angle_at(random.uniform(0, lap_)), offset = random.uniform(-strip_, strip_);
      const Shape f = shape(angle);
      const double pace = std::hypot(f.radius, f.slope);
      const double curvature = (f.radius * f.radius + 2 * f.slope * f.slope - f.radius * f.bend) / (pace * pace * pace);
      if (random.uniform(0, 2) >= 1 - curvature * offset) continue;
      const double c = std::cos(angle), n = std::sin(angle);
      const Vector2 tangent(f.slope * c - f.radius * n, f.slope * n + f.radius * c);
      places.push_back(centre_ + point_at(angle) + offset / pace * Vector2(-tangent.y(), tangent.x()));
    }
    return places;
  }

 private:
  static constexpr int kWaves = 3, kTable = 4096;
  struct Wave {
    double number, size, phase;
  };
  struct Shape {
    double radius, slope, bend;  // r and its first and second derivatives by the angle
  };

  Shape shape(double angle) const {
    Shape f{scale_, 0, 0};
    for (const Wave& w : waves_) {
      const double c = scale_ * w.size * std::cos(w.number * angle + w.phase);
      const double s = scale_ * w.size * std::sin(w.number * angle + w.phase);
      f.radius += c;
      f.slope -= w.number * s;
      f.bend -= w.number * w.number * c;
    }
    return f;
  }

  double pace(double angle) const {
    const Shape f = shape(angle);
    return std::hypot(f.radius, f.slope);
  }

  // Length of the curve between two near angles: Gauss-Legendre quadrature with three points.
  double arc(double from, double to) const {
    const double middle = (from + to) / 2, half = (to - from) / 2, node = std::sqrt(0.6) * half;
    return half / 9 * (5 * pace(middle - node) + 8 * pace(middle) + 5 * pace(middle + node));
  }

  void tabulate() {
    table_.assign(kTable + 1, 0);
    for (int i = 0; i < kTable; ++i) table_[i + 1] = table_[i] + arc(node(i), node(i + 1));
    lap_ = table_.back();
  }

  static double node(int i) { return 2 * kPi * i / kTable; }

  double arc_to(double angle) const {
    const int i = std::min(static_cast<int>(angle / (2 * kPi) * kTable), kTable - 1);
    return table_[i] + arc(node(i), angle);
  }

  // The angle after `s` metres of a lap: Newton's method, started from the table.
  double angle_at(double s) const {
    const auto next = std::upper_bound(table_.begin() + 1, table_.end() - 1, s);
    const int i = static_cast<int>(next - table_.begin()) - 1;
    double angle = node(i) + (node(i + 1) - node(i)) * (s - table_[i]) / (table_[i + 1] - table_[i]);
    for (int k = 0; k < 3; ++k) angle += (s - table_[i] - arc(node(i), angle)) / pace(angle);
    return angle;
  }

  Vector2 point_at(double angle) const { return shape(angle).radius * Vector2(std::cos(angle), std::sin(angle)); }

  Wave waves_[kWaves];
  double laps_, scale_ = 1, strip_ = 0, lap_ = 0, start_ = 0;
  Vector2 centre_ = Vector2::Zero();
  std::vector<double> table_;
};

}  // namespace

std::unique_ptr<Course> make_circle(const cairn_world_options& options) {
  return std::make_unique<Circle>(options);
}

std::unique_ptr<Course> make_laps(const cairn_world_options& options) {
  return std::make_unique<Laps>(options);
}

std::unique_ptr<Course> make_course(const cairn_world_options& options) {
  switch (options.course) {
    case CAIRN_COURSE_LAPS:
      return make_laps(options);
    case CAIRN_COURSE_TRAVERSE:
      return make_traverse(options);
    default:
      return make_circle(options);
  }
}

}  // namespace cairn::sim
