// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

import java.lang.annotation.Documented;
import java.lang.annotation.Retention;
import java.lang.annotation.RetentionPolicy;

/**
 * Names what an element stands for in the C interface: functions ({@code cairn_filter_update}), fields
 * ({@code cairn_wheels.radius}), constants ({@code CAIRN_JOIN_AUTO}). The C reference is found by it, and the tests
 * prove by it that nothing is missing.
 */
@Documented
@Retention(RetentionPolicy.RUNTIME)
public @interface CName {
  /**
   * The names.
   *
   * @return one name or more
   */
  String[] value();
}
