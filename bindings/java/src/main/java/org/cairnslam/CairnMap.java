// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

/**
 * Landmarks in one frame with their joint uncertainty. The map of a filter or team follows it, and is closed with it. A
 * {@link #copy} is a handle of its own, into which other maps can be merged.
 */
@CName("cairn_map")
public final class CairnMap extends CairnMapCalls {
  CairnMap(long address) {
    super(address);
  }

  CairnMap(long address, Handle owner) {
    super(address, owner);
  }
}
