// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

import static org.junit.jupiter.api.Assertions.assertEquals;
import static org.junit.jupiter.api.Assertions.assertFalse;
import static org.junit.jupiter.api.Assertions.assertSame;
import static org.junit.jupiter.api.Assertions.assertThrows;

import java.io.IOException;
import java.util.List;
import org.junit.jupiter.api.Test;

/** Functions of the user that C calls: what they throw, what they may not, when they are forgotten. */
class CallbackTest {
  /** What the sensor of {@link #withSensor} does before it predicts. */
  private Runnable before = () -> {};

  private Filter withSensor() {
    final Filter filter = Scenes.filter();
    filter.addCustom(new Custom(), (pose, landmark, z, jacobianPose, jacobianLandmark) -> {
      before.run();
      return Scenes.predict().predict(pose, landmark, z, jacobianPose, jacobianLandmark);
    }, Scenes.place());
    return filter;
  }

  @SuppressWarnings("unchecked")
  private static <E extends Throwable> void throwAny(Throwable thrown) throws E {
    throw (E) thrown;
  }

  private void aborts(Throwable thrown) {
    try (Filter filter = withSensor()) {
      filter.update(1, Scenes.frame(5, 0.1));
      final List<Object> state = Scenes.state(filter);
      final int[] calls = {0};
      before = () -> {
        if (++calls[0] == 3) {
          CallbackTest.<RuntimeException>throwAny(thrown);
        }
      };
      assertSame(thrown, assertThrows(Throwable.class, () -> filter.update(1, Scenes.frame(5, 0.2))));
      final CairnException why = (CairnException) thrown.getSuppressed()[0];
      assertEquals(Status.ERROR_CALLBACK, why.status());
      assertEquals(state, Scenes.state(filter), "the filter is as before");
      before = () -> {};
      filter.update(1, Scenes.frame(5, 0.2));
      assertFalse(state.equals(Scenes.state(filter)));
    }
  }

  @Test
  void exceptionAbortsTheCall() {
    aborts(new IllegalArgumentException("no"));
  }

  @Test
  void checkedExceptionAbortsTheCall() {
    aborts(new IOException("the map of the lens cannot be read"));
  }

  @Test
  void errorAbortsTheCall() {
    aborts(new StackOverflowError());
    aborts(new AssertionError());
  }

  @Test
  void ownFilterIsRefused() {
    try (Filter filter = withSensor(); Filter other = Scenes.filter()) {
      before = filter::pose;
      assertEquals("a callback must not use the Filter whose call runs it",
          assertThrows(IllegalStateException.class, () -> filter.update(1, Scenes.frame(5, 0))).getMessage());
      before = () -> filter.predictWheels(1, 1, 1);
      assertThrows(IllegalStateException.class, () -> filter.update(1, Scenes.frame(5, 0)));
      before = () -> filter.map().size();
      assertThrows(IllegalStateException.class, () -> filter.update(1, Scenes.frame(5, 0)));
      before = filter::close;
      assertThrows(IllegalStateException.class, () -> filter.update(1, Scenes.frame(5, 0)));
      before = () -> {
        other.update(0, Scenes.frame(5, 0));
        assertThrows(CairnException.class, () -> other.predictWheels(-1, 0, 0));
      };
      filter.update(1, Scenes.frame(5, 0));
    }
  }

  @Test
  void functionsAreForgotten() {
    final int known = Registration.count();
    final Filter filter = withSensor();
    filter.setLog(line -> {});
    filter.setLog(line -> {});
    assertEquals(known + 2, Registration.count());
    filter.setLog(null);
    assertEquals(known + 1, Registration.count());
    assertThrows(CairnException.class, () -> filter.addCustom(new Custom().rows(0), Scenes.predict(), null));
    assertEquals(known + 1, Registration.count());
    filter.close();
    assertThrows(IllegalStateException.class, () -> filter.addCustom(new Custom(), Scenes.predict(), null));
    assertThrows(IllegalStateException.class, () -> filter.setLog(line -> {}));
    Filter.checkCustom(new Custom(), Scenes.predict(), Scenes.place(), Pose.identity(), 3, 1, 2);
    assertEquals(known, Registration.count());
  }
}
