// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

/** A simulated world with a rover, and the truth. It needs the library cairn_sim. */
@CName("cairn_world")
public final class World extends WorldCalls {
  /**
   * Makes a world.
   *
   * @param options copied
   */
  @CName("cairn_world_create")
  public World(WorldOptions options) {
    super(create(options));
  }
}
