// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

/** Refuses arguments that C cannot be given. */
final class Check {
  private static final long UNSIGNED_INT = 0xffffffffL;

  private Check() {}

  static void length(int has, long takes, String name) {
    if (has != takes) {
      throw new IllegalArgumentException(name + " takes " + takes + " values, and gets " + has);
    }
  }

  /** An array has at most 2^31 - 1 bytes, because buffers of Java have. */
  static int bytes(long count, int size) {
    if (count < 0 || count > Integer.MAX_VALUE / size) {
      throw new IllegalArgumentException("an array of " + count + " elements of " + size + " bytes is impossible");
    }
    return (int) (count * size);
  }

  static int unsigned(long value, String name) {
    if (value < 0 || value > UNSIGNED_INT) {
      throw new IllegalArgumentException(name + " must lie in [0, " + UNSIGNED_INT + "], and is " + value);
    }
    return (int) value;
  }

  static long notNegative(long value, String name) {
    if (value < 0) {
      throw new IllegalArgumentException(name + " must be >= 0, and is " + value);
    }
    return value;
  }

  static void type(StructArray<?> array, StructType<?> type, String name) {
    if (array.type != type) {
      throw new ClassCastException(name + " takes an array of " + type.javaClass().getSimpleName() + ", and gets one of "
          + array.type.javaClass().getSimpleName());
    }
  }
}
