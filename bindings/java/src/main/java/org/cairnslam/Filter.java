// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

import java.util.Objects;

/** Estimates the pose of one vehicle and its map together. */
@CName("cairn_filter")
public final class Filter extends FilterCalls {
  /** Makes a filter with the library's defaults. */
  public Filter() {
    this(new FilterOptions());
  }

  /**
   * Makes a filter. All its memory for predictions and updates is taken here.
   *
   * @param options copied
   */
  @CName("cairn_filter_create")
  public Filter(FilterOptions options) {
    super(create(options));
  }

  /**
   * Adds a sensor that the caller models. The filter keeps the functions until it is closed.
   *
   * @param custom what the sensor measures
   * @param predict predicts an observation
   * @param place places a new landmark; null: the sensor places none
   * @return the number of the sensor
   */
  @CName("cairn_filter_add_custom")
  public int addCustom(Custom custom, CustomPredict predict, CustomPlace place) {
    Objects.requireNonNull(custom, "custom");
    Objects.requireNonNull(predict, "predict");
    final long user = Registration.register(new Registration(custom.copy(), predict, place, null));
    boolean kept = false;
    try (Call call = new Call()) {
      call.lock(this, true);
      final Call.Block customAt = call.in(custom);
      final Call.Block sensorAt = call.longs(1);
      call.check(CairnNative.cairn_filter_add_custom(address(), customAt.address, Bridges.CUSTOM_PREDICT,
          place == null ? 0 : Bridges.CUSTOM_PLACE, user, Bridges.RELEASE, sensorAt.address, call.error()));
      kept = true;
      return sensorAt.getInt();
    } finally {
      if (!kept) {
        Registration.release(user);
      }
    }
  }

  /**
   * Sets the function that gets the lines of the filter's log. The filter keeps it until another one is set or the
   * filter is closed.
   *
   * @param log gets each line; null: nobody gets them
   */
  @CName("cairn_filter_set_log")
  public void setLog(Log log) {
    final long payload = log == null ? 0 : Registration.register(new Registration(null, null, null, log));
    boolean kept = false;
    try (Call call = new Call()) {
      call.lock(this, true);
      call.check(CairnNative.cairn_filter_set_log(address(), log == null ? 0 : Bridges.LOG, payload,
          log == null ? 0 : Bridges.RELEASE, call.error()));
      kept = true;
    } finally {
      if (!kept) {
        Registration.release(payload);
      }
    }
  }

  /**
   * Compares the Jacobians of functions for {@link #addCustom} with differences. A wrong Jacobian makes a filter
   * inconsistent, and nothing else shows it.
   *
   * @param custom what the sensor measures
   * @param predict predicts an observation
   * @param place places a new landmark; may be null
   * @param pose the pose of the body at which they are compared
   * @param landmark the 3 coordinates of a landmark that the sensor sees from there
   * @return the largest difference, relative to the size of the Jacobian
   */
  @CName("cairn_custom_check")
  public static double checkCustom(Custom custom, CustomPredict predict, CustomPlace place, Pose pose,
      double... landmark) {
    Objects.requireNonNull(custom, "custom");
    Objects.requireNonNull(predict, "predict");
    Objects.requireNonNull(pose, "pose");
    Check.length(landmark.length, 3, "landmark");
    final long user = Registration.register(new Registration(custom.copy(), predict, place, null));
    try (Call call = new Call()) {
      final Call.Block customAt = call.in(custom);
      final Call.Block poseAt = call.in(pose);
      final Call.Block landmarkAt = call.in(landmark);
      final Call.Block worstAt = call.doubles(1);
      call.check(CairnNative.cairn_custom_check(customAt.address, Bridges.CUSTOM_PREDICT,
          place == null ? 0 : Bridges.CUSTOM_PLACE, user, poseAt.address, landmarkAt.address, worstAt.address,
          call.error()));
      return worstAt.getDouble();
    } finally {
      Registration.release(user);
    }
  }
}
