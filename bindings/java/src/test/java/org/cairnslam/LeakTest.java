// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

import static org.junit.jupiter.api.Assertions.assertEquals;
import static org.junit.jupiter.api.Assertions.assertTrue;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;

/** Filters that come and go leave nothing. */
class LeakTest {
  private static final int FILTERS = 10000;
  private static final long TOLERATED_KIB = 16384;
  private static final Path STATUS = Path.of("/proc/self/status");

  /** Memory of the process that is no file, after all filters that nobody uses are gone. */
  private static long residentKib(int known) throws Exception {
    for (int i = 0; i < 500 && (i == 0 || Registration.count() > known); ++i) {
      System.gc();
      Thread.sleep(10);
    }
    for (String line : Files.readAllLines(STATUS)) {
      if (line.startsWith("RssAnon:")) {
        return Long.parseLong(line.replaceAll("[^0-9]", ""));
      }
    }
    throw new AssertionError("no RssAnon in " + STATUS);
  }

  private static FilterOptions small() {
    return new FilterOptions().maxLandmarks(8).maxObservations(4).maxSensors(2);
  }

  private static void make(int count, boolean close) throws Exception {
    for (int i = 0; i < count; ++i) {
      final Filter filter = new Filter(small());
      filter.addCustom(new Custom(), Scenes.predict(), Scenes.place());
      filter.setLog(line -> {});
      filter.update(0, Scenes.frame(3, 0));
      if (close) {
        filter.close();
      } else if (i % 500 == 499) {
        System.gc();
        Thread.sleep(20);
      }
    }
  }

  private static void leavesNothing(boolean close) throws Exception {
    assumeTrue(Files.exists(STATUS));
    final int known = Registration.count();
    make(2 * FILTERS / 10, close);
    final long before = residentKib(known);
    make(FILTERS, close);
    final long grown = residentKib(known) - before;
    final long each = Filter.requiredBytes(small()) / 1024;
    System.out.printf("leak: %d filters of %d KiB, %s: memory grew by %d KiB%n", FILTERS, each,
        close ? "closed" : "left to the garbage collector", grown);
    assertEquals(known, Registration.count(), "functions that C still knows");
    // The collector frees in bursts, and C's allocator keeps the memory of a burst: a tenth of what a leak would take.
    final long tolerated = close ? TOLERATED_KIB : FILTERS * each / 10;
    assertTrue(grown < tolerated, "memory grew by " + grown + " KiB");
  }

  @Test
  void closedFiltersLeaveNothing() throws Exception {
    leavesNothing(true);
  }

  @Test
  void forgottenFiltersLeaveNothing() throws Exception {
    leavesNothing(false);
  }
}
