// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

import static org.junit.jupiter.api.Assertions.assertArrayEquals;
import static org.junit.jupiter.api.Assertions.assertEquals;
import static org.junit.jupiter.api.Assertions.assertFalse;
import static org.junit.jupiter.api.Assertions.assertNotEquals;
import static org.junit.jupiter.api.Assertions.assertSame;
import static org.junit.jupiter.api.Assertions.assertThrows;
import static org.junit.jupiter.api.Assertions.assertTrue;

import java.util.List;
import java.util.Set;
import org.junit.jupiter.api.Test;

/** What is Java's: arguments, ids, arrays, structs, closed handles, errors. */
class BindingTest {
  @Test
  void errorHasStatusAndMessage() {
    try (Filter filter = Scenes.filter()) {
      final CairnException failure = assertThrows(CairnException.class, () -> filter.predictWheels(-1, 1, 1));
      assertEquals(Status.ERROR_ARGUMENT, failure.status());
      assertEquals(Status.ERROR_ARGUMENT.code(), failure.code());
      assertEquals("dt must be > 0, and is -1", failure.getMessage());
    }
  }

  @Test
  void closedHandleIsRefused() {
    final Filter filter = Scenes.filter();
    final CairnMap map = filter.map();
    final CairnMap copy = map.copy();
    map.close();
    assertEquals(5, map.size(), "closing what is lent does nothing");
    filter.close();
    filter.close();
    assertTrue(filter.isClosed() && map.isClosed() && !copy.isClosed());
    assertEquals("the Filter is closed", assertThrows(IllegalStateException.class, filter::pose).getMessage());
    assertEquals("the Filter is closed", assertThrows(IllegalStateException.class, map::size).getMessage());
    assertThrows(IllegalStateException.class, () -> copy.merge(map));
    assertEquals(5, copy.size());
    copy.close();
    assertThrows(IllegalStateException.class, copy::size);
  }

  @Test
  void idsUseAllBits() {
    final long[] ids = {(1L << 53) + 1, Long.MIN_VALUE, CairnId.parse("18446744073709551614")};
    try (Filter filter = new Filter()) {
      final int sensor = filter.addCartesian(new Cartesian());
      final StructArray<Observation> frame = Observation.array(ids.length);
      for (int i = 0; i < ids.length; ++i) {
        frame.get(i).id(ids[i]).z(5, i - 1, 0);
      }
      final StructArray<Match> matches = filter.update(sensor, frame);
      for (int i = 0; i < ids.length; ++i) {
        assertEquals(ids[i], matches.get(i).landmark());
        assertEquals(ids[i], filter.map().landmark(ids[i]).id());
      }
      final CairnException unknown = assertThrows(CairnException.class, () -> filter.removeLandmark(1L << 53));
      assertEquals(Status.ERROR_NOT_FOUND, unknown.status());
      assertTrue(matches.get(2).toString().contains("18446744073709551614"), matches.get(2).toString());
    }
    assertEquals(-1L, CairnId.NONE);
    assertEquals(CairnId.NONE, Cairn.idNone());
    assertEquals("18446744073709551615", CairnId.toString(CairnId.NONE));
    assertTrue(CairnId.compare(CairnId.NONE, 1) > 0);
  }

  @Test
  void arrayOfWrongShapeIsRefused() {
    try (Filter filter = Scenes.filter()) {
      final List<Object> before = Scenes.state(filter);
      final var centre = assertThrows(IllegalArgumentException.class, () -> filter.map().within(new double[2], 1));
      assertEquals("centre takes 3 values, and gets 2", centre.getMessage());
      final var residual = assertThrows(IllegalArgumentException.class,
          () -> filter.updateLinear(new double[2], new double[3], null, new long[] {1}, new double[6]));
      assertEquals("covariance takes 4 values, and gets 3", residual.getMessage());
      assertThrows(IllegalArgumentException.class, () -> new Pose().position(1, 2));
      assertThrows(IllegalArgumentException.class,
          () -> filter.update(0, Scenes.frame(3, 0), Match.array(2)));
      assertThrows(NullPointerException.class, () -> filter.update(0, null));
      assertThrows(NullPointerException.class, () -> filter.predictTwist(1, null, new double[3]));
      assertThrows(IllegalArgumentException.class, () -> new FilterOptions().maxLandmarks(-1));
      assertThrows(IllegalArgumentException.class, () -> filter.map().nearest(new double[3], -1));
      assertThrows(IllegalArgumentException.class, () -> filter.setLoss(0, Loss.UNRECOGNISED, 1));
      assertThrows(IndexOutOfBoundsException.class, () -> Match.array(2).get(2));
      assertThrows(IllegalArgumentException.class, () -> Match.array(Integer.MAX_VALUE));
      assertThrows(IllegalArgumentException.class, () -> Cairn.has("errors\0"));
      assertEquals(before, Scenes.state(filter));
    }
  }

  @Test
  @SuppressWarnings({"unchecked", "rawtypes"})
  void arrayOfWrongTypeIsRefused() {
    try (Filter filter = Scenes.filter()) {
      final List<Object> before = Scenes.state(filter);
      final List wrong = Match.array(3);
      final var failure = assertThrows(ClassCastException.class, () -> filter.update(0, wrong));
      assertEquals("observations takes an array of Observation, and gets one of Match", failure.getMessage());
      assertThrows(ClassCastException.class, () -> filter.update(0, (List) List.of(new Match())));
      assertThrows(ClassCastException.class, () -> ((StructArray) wrong).set(0, new Pose()));
      assertThrows(NullPointerException.class, () -> filter.update(0, java.util.Arrays.asList(new Observation(), null)));
      assertEquals(before, Scenes.state(filter));
    }
  }

  @Test
  void arraysAndListsGiveTheSame() {
    try (Filter one = Scenes.filter(); Filter other = Scenes.filter()) {
      final StructArray<Observation> direct = Observation.array(40);
      for (int i = 0; i < 5; ++i) {
        direct.set(i + 3, Scenes.frame(5, 0.1).get(i));
      }
      final StructArray<Match> matches = Match.array(40);
      one.update(0, direct.subList(3, 8), matches.subList(2, 7));
      assertEquals(other.update(0, Scenes.frame(5, 0.1)), matches.subList(2, 7));
      assertEquals(new Match(), matches.get(7));
      assertEquals(Result.MATCHED, matches.get(2).result());
      assertEquals(Result.MATCHED.code(), matches.get(2).resultCode());
      assertEquals(Scenes.state(one), Scenes.state(other));
      assertNotEquals(Scenes.state(one), Scenes.state(Scenes.filter()));
    }
    final StructArray<Match> large = StructArray.forResult(Match.TYPE, 10000);
    assertTrue(large.bytes().isDirect());
    assertFalse(StructArray.forResult(Match.TYPE, 10).bytes().isDirect());
  }

  @Test
  void manyLandmarksFitNoScratchMemory() {
    try (Filter filter = new Filter(new FilterOptions().maxLandmarks(2000).maxObservations(1000))) {
      filter.addCartesian(new Cartesian());
      final List<Match> matches = filter.update(0, Scenes.frame(1000, 0));
      assertEquals(1000, filter.map().landmarks().size());
      assertEquals(1000, matches.get(999).landmark());
      assertEquals(9, filter.map().jointCovariance(7).length);
    }
  }

  @Test
  void structsAreViewsAndValues() {
    final FilterOptions options = new FilterOptions().submapLandmarks(60).vehicle(Vehicle.PLANAR);
    options.initialPose().position(1, 2, 0);
    assertArrayEquals(new double[] {1, 2, 0}, options.initialPose().position());
    assertEquals(2.0, options.initialPose().positionAt(1));
    final FilterOptions copy = options.copy();
    assertEquals(options, copy);
    assertEquals(options.hashCode(), copy.hashCode());
    copy.initialPose(Pose.identity());
    assertNotEquals(options, copy);
    assertEquals(Vehicle.PLANAR, copy.vehicle());
    assertEquals(1000, copy.maxLandmarks(), "the library's default");
    assertTrue(options.toString().contains("submapLandmarks=60"), options.toString());
  }

  @Test
  void numberOfANewerLibraryIsKept() {
    final Match match = new Match();
    match.putInt(8, 77);
    assertEquals(Result.UNRECOGNISED, match.result());
    assertEquals(77, match.resultCode());
    assertEquals(Set.of(Doubt.BIAS, Doubt.UNRECOGNISED), Doubt.setOf(Doubt.BIAS.code() | 1 << 30));
  }

  @Test
  void versionIsKnown() {
    assertEquals(Cairn.VERSION / 100, Cairn.versionNumber() / 100);
    assertTrue(Cairn.version().startsWith(Cairn.VERSION_MAJOR + "." + Cairn.VERSION_MINOR + "."));
    assertSame(true, Cairn.has("errors"));
  }

  @Test
  void filterRunsInASimulatedWorld() {
    try (World world = new World(new WorldOptions().seed(3).landmarks(50));
        Filter rover = new Filter(new FilterOptions().maxObservations(world.mostObservations())
            .initialPose(world.pose(0)))) {
      final int camera = rover.addStereoHead(world.head());
      for (int i = 0; i < 20; ++i) {
        final WorldStep step = world.next();
        for (WorldMotion motion : world.motions()) {
          rover.predictTwist(motion.dt(), motion.velocity(), motion.rate());
        }
        rover.update(camera, world.observations());
        final double[] difference = step.truth().error(rover.pose().pose());
        assertTrue(Math.hypot(difference[0], difference[1]) < 1, step.toString());
      }
    }
  }
}
