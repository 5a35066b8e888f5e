// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

/** A program that needs the library: prints why it does not get it, twice, for the second try must say the same. */
final class LoadMain {
  private LoadMain() {}

  private static void tryTo(Runnable use) {
    try {
      use.run();
      System.out.println("loaded");
    } catch (UnsatisfiedLinkError missing) {
      System.out.println(missing.getMessage());
    }
  }

  /**
   * Runs.
   *
   * @param arguments none
   */
  public static void main(String[] arguments) {
    tryTo(Filter::new);
    tryTo(Cairn::version);
    tryTo(WorldOptions::new);
  }
}
