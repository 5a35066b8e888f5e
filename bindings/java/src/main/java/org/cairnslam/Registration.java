// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

import com.sun.jna.Pointer;
import java.util.Arrays;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.AtomicLong;

/**
 * The functions of a user that C calls. C knows a registration by a number, which it gets as the pointer `user`, and
 * releases it by that number.
 *
 * @param custom says how long the arrays of the functions are
 * @param customPredict a function of a sensor
 * @param customPlace a function of a sensor, or null
 * @param log a log
 */
record Registration(Custom custom, CustomPredict customPredict, CustomPlace customPlace, Log log) {
  private static final AtomicLong NUMBERS = new AtomicLong(1);
  private static final Map<Long, Registration> REGISTERED = new ConcurrentHashMap<>();

  static long register(Registration registration) {
    final long user = NUMBERS.getAndIncrement();
    REGISTERED.put(user, registration);
    return user;
  }

  static Registration of(long user) {
    return REGISTERED.get(user);
  }

  static void release(long user) {
    REGISTERED.remove(user);
  }

  /** For tests: how many functions C still knows. */
  static int count() {
    return REGISTERED.size();
  }

  static double[] read(long address, int length) {
    final double[] values = new double[length];
    new Pointer(address).read(0, values, 0, length);
    return values;
  }

  static void write(long address, double[] values) {
    new Pointer(address).write(0, values, 0, values.length);
  }

  /** As in C: a value that is not written stays NaN, and is refused. */
  static double[] room(int length) {
    final double[] values = new double[length];
    Arrays.fill(values, Double.NaN);
    return values;
  }

  /** A log cannot abort a call: what it throws goes where exceptions of threads go. */
  static void uncaught(Throwable thrown) {
    final Thread thread = Thread.currentThread();
    try {
      thread.getUncaughtExceptionHandler().uncaughtException(thread, thrown);
    } catch (Throwable ignored) {
      // Nothing may unwind through C.
    }
  }
}
