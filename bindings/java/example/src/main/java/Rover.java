// SPDX-License-Identifier: BSD-3-Clause
import org.cairnslam.*;

/** A simulated rover maps what it sees: the first example of README.md as a program. */
public final class Rover {
  private Rover() {}

  /**
   * Runs.
   *
   * @param arguments none
   */
  public static void main(String[] arguments) {
    // README: from here
    try (var world = new World(new WorldOptions().seed(3));     // a simulated rover; or your own
        var rover = new Filter(new FilterOptions().submapLandmarks(60)
            .maxObservations(world.mostObservations()).initialPose(world.pose(0)))) {
      int camera = rover.addStereoHead(world.head());
      for (long i = 0; i < world.steps(); ++i) {
        WorldStep step = world.next();
        for (WorldMotion motion : world.motions()) {
          rover.predictTwist(motion.dt(), motion.velocity(), motion.rate());
        }
        rover.pointHead(camera, step.pan(), step.stick());
        rover.update(camera, world.observations());
      }
      PoseEstimate estimate = rover.pose();
      System.out.println(estimate.pose() + " in a map of " + rover.map().size() + " landmarks");
    }
    // README: to here
  }
}
