// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

import static org.junit.jupiter.api.Assertions.assertEquals;
import static org.junit.jupiter.api.Assertions.assertThrows;
import static org.junit.jupiter.api.Assertions.assertTrue;

import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.Callable;
import java.util.concurrent.CyclicBarrier;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Many threads: each has its own message, and a handle serves one after the other. */
@Timeout(60)
class ThreadsTest {
  private static final int THREADS = 16;

  /** Runs a task in all threads at once, and throws what one of them throws. */
  private static void together(Task task) throws Exception {
    final ExecutorService executor = Executors.newFixedThreadPool(THREADS);
    final CyclicBarrier start = new CyclicBarrier(THREADS);
    try {
      final List<Future<?>> results = new ArrayList<>();
      for (int i = 0; i < THREADS; ++i) {
        final int number = i;
        results.add(executor.submit((Callable<Void>) () -> {
          start.await();
          task.run(number);
          return null;
        }));
      }
      for (Future<?> result : results) {
        result.get();
      }
    } finally {
      executor.shutdown();
      assertTrue(executor.awaitTermination(30, TimeUnit.SECONDS));
    }
  }

  private interface Task {
    void run(int number) throws Exception;
  }

  private static void failsWithItsOwn(Filter filter, int value) {
    final CairnException failure = assertThrows(CairnException.class, () -> filter.predictWheels(-value, 1, 1));
    assertEquals("dt must be > 0, and is -" + value, failure.getMessage());
  }

  @Test
  void everyMessageIsItsOwn() throws Exception {
    together(number -> {
      try (Filter filter = new Filter()) {
        for (int i = 1; i <= 500; ++i) {
          failsWithItsOwn(filter, 1000 * number + i);
        }
      }
    });
  }

  @Test
  void everyMessageOfOneHandleIsItsOwn() throws Exception {
    try (Filter filter = new Filter()) {
      together(number -> {
        for (int i = 1; i <= 500; ++i) {
          failsWithItsOwn(filter, 1000 * number + i);
        }
      });
    }
  }

  @Test
  void oneHandleServesOneAfterTheOther() throws Exception {
    try (Filter filter = Scenes.filter(); Filter alone = Scenes.filter()) {
      together(number -> {
        for (int i = 0; i < 50; ++i) {
          filter.predictTwist(0.1, new double[] {1, 0, 0}, new double[3]);
          assertEquals(5, filter.map().landmarks().size());
          assertEquals(36, filter.pose().covariance().length);
        }
      });
      for (int i = 0; i < 50 * THREADS; ++i) {
        alone.predictTwist(0.1, new double[] {1, 0, 0}, new double[3]);
      }
      assertEquals(Scenes.state(alone), Scenes.state(filter));
    }
  }

  @Test
  void closingWaitsOrIsSeen() throws Exception {
    for (int round = 0; round < 50; ++round) {
      final Filter filter = Scenes.filter();
      together(number -> {
        if (number == 0) {
          filter.close();
          return;
        }
        try {
          for (int i = 0; i < 20; ++i) {
            filter.predictTwist(0.1, new double[3], new double[3]);
          }
        } catch (IllegalStateException closed) {
          assertEquals("the Filter is closed", closed.getMessage());
        }
      });
    }
  }

  @Test
  void twoMapsCannotWaitForEachOther() throws Exception {
    try (Filter filter = Scenes.filter(); CairnMap one = filter.map().copy(); CairnMap other = filter.map().copy()) {
      together(number -> {
        for (int i = 0; i < 20; ++i) {
          try {
            (number % 2 == 0 ? one : other).merge(number % 2 == 0 ? other : one);
          } catch (CairnException refused) {
            assertTrue(refused.getMessage().length() > 0);
          }
        }
      });
      assertEquals(5, one.size());
    }
  }
}
