// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

import static org.junit.jupiter.api.Assertions.assertEquals;
import static org.junit.jupiter.api.Assertions.assertTrue;
import static org.junit.jupiter.api.Assumptions.assumeFalse;

import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;

/** A library that is missing or has another version: one clear message, as often as one asks. */
class LoadTest {
  private static String message(String folder) throws Exception {
    final String fixtures = System.getProperty("cairn.fixtures", "");
    assumeFalse(fixtures.isEmpty(), "nobody said where the compiled fixtures are");
    final ProcessBuilder builder = new ProcessBuilder(Path.of(System.getProperty("java.home"), "bin", "java").toString(),
        "-Djna.library.path=" + Path.of(fixtures, folder), "-cp", System.getProperty("java.class.path"),
        LoadMain.class.getName()).redirectErrorStream(true);
    builder.environment().remove("LD_LIBRARY_PATH");
    final Process java = builder.start();
    final List<String> lines = new String(java.getInputStream().readAllBytes()).lines().toList();
    assertEquals(0, java.waitFor(), lines.toString());
    assumeFalse(lines.contains("loaded"), "the system has a library of its own");
    assertEquals(3, lines.size(), lines.toString());
    assertEquals(lines.get(0), lines.get(1));
    assertEquals(lines.get(0), lines.get(2));
    return lines.get(0);
  }

  private static void names(String message, String... parts) {
    for (String part : parts) {
      assertTrue(message.contains(part), message);
    }
  }

  @Test
  void missing() throws Exception {
    names(message("none"), "Cairn for Java " + Cairn.VERSION_TEXT + " needs the library libcairn.so.",
        "does not find it", "-Djna.library.path");
  }

  @Test
  void olderWithoutANumber() throws Exception {
    names(message("older"), "Cairn for Java " + Cairn.VERSION_TEXT + " needs the library libcairn.so.",
        "libcairn.so is version 0.1.0");
  }

  @Test
  void otherVersionUnderTheName() throws Exception {
    names(message("other"), "needs Cairn " + Cairn.VERSION_TEXT + ", and ", " is version 0.9.3");
  }

  @Test
  void lackingFunctions() throws Exception {
    names(message("lacking"), "needs Cairn " + Cairn.VERSION_TEXT + ", and ", "lacks a function", "cairn_");
  }
}
