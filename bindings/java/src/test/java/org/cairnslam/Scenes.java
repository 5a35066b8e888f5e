// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

import java.util.ArrayList;
import java.util.List;

/** Small filters for tests. */
final class Scenes {
  private Scenes() {}

  /** A filter with a cartesian sensor (number 0) that has seen some landmarks. */
  static Filter filter() {
    final Filter filter = new Filter(new FilterOptions().maxLandmarks(50));
    filter.addCartesian(new Cartesian());
    filter.update(0, frame(5, 0));
    return filter;
  }

  static List<Observation> frame(int count, double shift) {
    final List<Observation> frame = new ArrayList<>();
    for (int i = 0; i < count; ++i) {
      frame.add(new Observation().id(i + 1).z(5.0 + i - shift, 7 * i % 10 - 4, 3 * i % 4));
    }
    return frame;
  }

  /** All that a filter tells, for comparisons of before and after. */
  static List<Object> state(Filter filter) {
    final List<Object> state = new ArrayList<>();
    final PoseEstimate estimate = filter.pose();
    state.add(estimate.pose());
    for (double value : estimate.covariance()) {
      state.add(value);
    }
    state.addAll(filter.map().landmarks());
    state.add(filter.lastUpdate());
    state.add(filter.health());
    return state;
  }

  /** A sensor of points, as the functions of a user. */
  static CustomPredict predict() {
    return ConformanceCallbacks.PREDICT.get("body_point");
  }

  static CustomPlace place() {
    return ConformanceCallbacks.PLACE.get("body_point");
  }
}
