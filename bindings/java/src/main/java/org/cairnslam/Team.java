// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

/** The part of one vehicle in a team of planar vehicles that exchange packets of measurements and map together. */
@CName("cairn_team")
public final class Team extends TeamCalls {
  /**
   * Makes the team's handle of one vehicle.
   *
   * @param options of the team; copied
   * @param filter of the vehicle's filter; copied
   * @param radar the vehicle's sensor; copied
   */
  @CName("cairn_team_create")
  public Team(TeamOptions options, FilterOptions filter, RangeBearing radar) {
    super(create(options, filter, radar));
  }
}
