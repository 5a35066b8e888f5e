// SPDX-License-Identifier: BSD-3-Clause
// A course on a chain of touching circles. Circles with even numbers are driven anticlockwise, the others clockwise, so
// that the course is smooth from one circle to the next. On each circle the rover drives one and a quarter rounds.
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "geometry/angle.hpp"
#include "sim/course.hpp"

namespace cairn::sim {
namespace {

constexpr double kQuarter = kPi / 2;
constexpr int kFewestOfRing = 16;
constexpr int kRows = 10, kColumns = 720;  // resolution of the sums over the strip of a circle

Vector2 direction(double angle) {
  return Vector2(std::cos(angle), std::sin(angle));
}

class Traverse : public Course {
 public:
  explicit Traverse(const cairn_world_options& o) : closed_(o.traverse_closed != 0), strip_(o.strip) {
    lay_out(o);
    for (const Round& round : rounds_) ends_.push_back(length() + round.radius * round.angle);
  }

  double length() const override { return ends_.empty() ? 0 : ends_.back(); }

  Place at(double s) const override {
    const auto end = std::upper_bound(ends_.begin(), ends_.end() - 1, s);
    const Round& round = rounds_[end - ends_.begin()];
    const double driven = s - (end == ends_.begin() ? 0 : *(end - 1));
    const double azimuth = round.entry + round.sense * driven / round.radius;
    const Vector2 point = round.centre + round.radius * direction(azimuth);
    return {point.x(), point.y(), azimuth + round.sense * kQuarter};
  }

  // Landmarks are uniform over the union of the strips of all circles. Where two strips overlap, only the earlier
  // circle places landmarks.
  std::vector<Vector2> scatter(Random& random, std::size_t count) const override {
    std::vector<double> ends;
    for (std::size_t i = 0; i < circles(); ++i) ends.push_back((ends.empty() ? 0 : ends.back()) + rounds_[i].radius);
    std::vector<Vector2> places;
    while (places.size() < count) {
      const double pick = random.uniform(0, ends.back());
      const std::size_t i = std::upper_bound(ends.begin(), ends.end() - 1, pick) - ends.begin();
      const double inner = rounds_[i].radius - strip_, outer = rounds_[i].radius + strip_;
      const double radius = std::sqrt(random.uniform(inner * inner, outer * outer));
      const Vector2 place = rounds_[i].centre + radius * direction(random.uniform(0, 2 * kPi));
      if (!taken(i, place)) places.push_back(place);
    }
    return places;
  }

 private:
  struct Round {
    Vector2 centre;
    double radius, entry, sense,
        angle;                         // entry: azimuth; sense: +1 is anticlockwise, -1 clockwise; angle: driven angle
    std::vector<std::size_t> earlier;  // earlier circles whose strips overlap the strip of this one
  };

  std::size_t circles() const { return rounds_.size() - (closed_ ? 1 : 0); }

  bool in_strip(const Round& round, const Vector2& place) const {
    return std::abs((place - round.centre).norm() - round.radius) < strip_;
  }

  bool taken(std::size_t circle, const Vector2& place) const {
    const std::vector<std::size_t>& earlier = rounds_[circle].earlier;
    return std::any_of(earlier.begin(), earlier.end(), [&](std::size_t i) { return in_strip(rounds_[i], place); });
  }

  // Chooses the number of circles from the number of landmarks, then scales the circles until the area fits.
  void lay_out(const cairn_world_options& o) {
    const double ground = o.landmarks * o.landmark_area;
    const double smallest = 2 * kPi * 2 * strip_;  // length of the smallest circle: radius 2 strip
    const auto most = std::max<std::int64_t>(1, std::llround(std::floor(ground / (2 * strip_ * smallest))));
    auto count =
        std::max<std::int64_t>(std::min<std::int64_t>(3, most), std::llround(ground / (2 * strip_ * o.round_length)));
    count = std::min(count, most);
    if (closed_) {
      count = std::max<std::int64_t>(kFewestOfRing, count / 2 * 2);
      if (count > most)
        throw Error(ErrorCode::argument,
                    "options.traverse_closed needs %d circles, and options.landmarks = %u fill only %lld; use more "
                    "landmarks",
                    kFewestOfRing, o.landmarks, static_cast<long long>(most));
    }
    std::vector<double> radii(count);
    Random random(o.seed, Stream::course);
    for (double& radius : radii) radius = o.round_length / (2 * kPi) * (1 + o.round_variation * random.uniform(-1, 1));
    double scale = 1;
    for (int pass = 0; pass < 4; ++pass) {
      double sum = 0;
      for (const double radius : radii) sum += radius;
      // With very few landmarks the circles would be too small for their strips: they keep the smallest size.
      if (pass == 0) scale = ground / (2 * strip_ * 2 * kPi * sum);
      if (scale * sum < count * smallest / (2 * kPi)) scale = count * smallest / (2 * kPi) / sum;
      for (double& radius : radii) radius *= scale;
      chain(radii);
      find_overlaps();
      scale = ground / covered();
    }
  }

  void chain(const std::vector<double>& radii) {
    const std::size_t n = radii.size();
    std::vector<double> extra(n, 0);  // driven angle of each circle beyond one and a quarter rounds
    if (closed_) {
      for (std::size_t i = 0; i < n; ++i) extra[i] = sense(i) * 2 * kPi / n;
      close(radii, extra);
    }
    rounds_.clear();
    const double entry = -kQuarter;  // the first circle is entered at its lowest point, heading along x
    const Vector2 start(kStartX, kStartY);
    rounds_.push_back({start - radii[0] * direction(entry), radii[0], entry, 1, 0, {}});
    for (std::size_t i = 0; i < n; ++i) {
      rounds_[i].angle = 2 * kPi + kQuarter + extra[i];
      if (i + 1 == n) break;
      const double out = exit_of(rounds_[i]);
      const Vector2 centre = rounds_[i].centre + (radii[i] + radii[i + 1]) * direction(out);
      rounds_.push_back({centre, radii[i + 1], wrap_angle(out + kPi), sense(i + 1), 0, {}});
    }
    if (closed_) {  // back at the start: one more round on the first circle
      Round home = rounds_[0];
      home.angle = 2 * kPi;
      rounds_.push_back(home);
    }
  }

  static double sense(std::size_t i) { return i % 2 == 0 ? 1 : -1; }
  static double exit_of(const Round& round) { return wrap_angle(round.entry + round.sense * round.angle); }

  // Changes the driven angles so that the chain ends at its start with the same heading. These are three conditions;
  // Gauss-Newton meets them with the smallest change of the angles.
  static void close(const std::vector<double>& radii, std::vector<double>& extra) {
    const std::size_t n = radii.size();
    for (int iteration = 0; iteration < 50; ++iteration) {
      std::vector<double> out(n);
      double entry = -kQuarter;
      Vector3 gap = Vector3::Zero();
      for (std::size_t i = 0; i < n; ++i) {
        out[i] = entry + sense(i) * (kQuarter + extra[i]);
        gap.head<2>() += (radii[i] + radii[(i + 1) % n]) * direction(out[i]);
        entry = out[i] + kPi;
      }
      gap.z() = wrap_angle(entry + kQuarter);
      if (gap.norm() < 1e-9) return;
      std::vector<Vector3> J(n);
      Vector2 later = Vector2::Zero();  // derivative of the gap by out[i], ..., out[n - 1] together
      Matrix3 N = Matrix3::Zero();
      for (std::size_t i = n; i-- > 0;) {
        later += (radii[i] + radii[(i + 1) % n]) * direction(out[i] + kQuarter);
        J[i] << sense(i) * later, sense(i);
        N += J[i] * J[i].transpose();
      }
      const Vector3 step = N.inverse() * gap;
      for (std::size_t i = 0; i < n; ++i) extra[i] -= J[i].dot(step);
    }
    throw Error(ErrorCode::argument,
                "options: the circles of this seed do not close to a ring; reduce round_variation or use another seed");
  }

  void find_overlaps() {
    for (std::size_t i = 0; i < circles(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double reach = rounds_[i].radius + rounds_[j].radius + 2 * strip_;
        if ((rounds_[i].centre - rounds_[j].centre).squaredNorm() < reach * reach) rounds_[i].earlier.push_back(j);
      }
    }
  }

  double covered() const {
    double sum = 0;
    for (std::size_t i = 0; i < circles(); ++i) {
      const Round& round = rounds_[i];
      for (int row = 0; row < kRows; ++row) {
        const double radius = round.radius + strip_ * ((row + 0.5) * 2 / kRows - 1);
        int free = 0;
        for (int column = 0; column < kColumns; ++column)
          free += !taken(i, round.centre + radius * direction(2 * kPi * (column + 0.5) / kColumns));
        sum += 2 * kPi * radius * (2 * strip_ / kRows) * free / kColumns;
      }
    }
    return sum;
  }

  bool closed_;
  double strip_;
  std::vector<Round> rounds_;
  std::vector<double> ends_;  // end of each round in metres along the drive
};

}  // namespace

std::unique_ptr<Course> make_traverse(const cairn_world_options& options) {
  return std::make_unique<Traverse>(options);
}

}  // namespace cairn::sim
