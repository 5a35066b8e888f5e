// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

/** A simulated fleet of boats, and the truth. It needs the library cairn_sim. */
@CName("cairn_fleet")
public final class Fleet extends FleetCalls {
  /**
   * Makes a fleet.
   *
   * @param options copied
   */
  @CName("cairn_fleet_create")
  public Fleet(FleetOptions options) {
    super(create(options));
  }
}
