// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

import static org.junit.jupiter.api.Assertions.assertEquals;
import static org.junit.jupiter.api.Assertions.assertFalse;
import static org.junit.jupiter.api.Assertions.assertSame;
import static org.junit.jupiter.api.Assertions.assertTrue;
import static org.junit.jupiter.api.Assumptions.assumeFalse;

import com.google.gson.JsonArray;
import com.google.gson.JsonElement;
import com.google.gson.JsonObject;
import com.google.gson.JsonParser;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.stream.Stream;
import org.junit.jupiter.api.DynamicTest;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.TestFactory;

/** The same calls as in C, by the public interface: the same bits, statuses and messages. */
class ConformanceTest {
  private static final Path ROOT = Path.of(System.getProperty("cairn.root"));

  private static JsonObject read(Path file) throws Exception {
    return JsonParser.parseString(Files.readString(file)).getAsJsonObject();
  }

  private static Path replayed() {
    final String replayed = System.getProperty("cairn.replayed", "");
    assumeFalse(replayed.isEmpty(), "nobody said where the output of the C replayer is");
    return Path.of(replayed);
  }

  @TestFactory
  List<DynamicTest> scenarios() throws Exception {
    replayed();
    final JsonObject api = read(ROOT.resolve("src/api/api.json"));
    final Interface known = new Interface();
    final List<DynamicTest> tests = new ArrayList<>();
    try (Stream<Path> files = Files.list(ROOT.resolve("tests/conformance"))) {
      files.filter(file -> file.toString().endsWith(".json")).sorted().forEach(file -> tests.add(
          DynamicTest.dynamicTest(file.getFileName().toString(),
              () -> replay(new Replayer(api, known), file))));
    }
    assertTrue(tests.size() > 10, "there are only " + tests.size() + " scenarios");
    return tests;
  }

  private static void replay(Replayer replayer, Path scenario) throws Exception {
    final JsonArray calls = read(scenario).getAsJsonArray("calls");
    final JsonArray ofC = read(replayed().resolve(scenario.getFileName())).getAsJsonArray("calls");
    assertEquals(ofC.size(), calls.size());
    try (replayer) {
      for (int i = 0; i < calls.size(); ++i) {
        final JsonObject result = replayer.call(calls.get(i).getAsJsonObject());
        // Both from text, for integers of different Java types differ.
        final JsonElement own = JsonParser.parseString(result.toString());
        if (!own.equals(ofC.get(i))) {
          assertEquals(ofC.get(i).toString(), own.toString(), "call " + i + " of " + scenario);
        }
      }
    }
  }

  /** What a log throws goes to the thread's handler. The call goes on, with the bits of C. */
  @Test
  void logThatThrowsDisturbsNothing() throws Exception {
    final Thread thread = Thread.currentThread();
    final var handler = thread.getUncaughtExceptionHandler();
    final List<Throwable> caught = new ArrayList<>();
    final IllegalStateException thrown = new IllegalStateException("the disk is full");
    thread.setUncaughtExceptionHandler((which, exception) -> caught.add(exception));
    try {
      final Replayer replayer = new Replayer(read(ROOT.resolve("src/api/api.json")), new Interface());
      replayer.afterLine = () -> {
        throw thrown;
      };
      replay(replayer, ROOT.resolve("tests/conformance/slip.json"));
    } finally {
      thread.setUncaughtExceptionHandler(handler);
    }
    assertFalse(caught.isEmpty());
    assertSame(thrown, caught.get(0));
  }

  @Test
  void nothingIsMissing() throws Exception {
    final Process check = new ProcessBuilder("python3", "-B", ROOT.resolve("src/api/bindings_check.py").toString(),
        ROOT.resolve("src/api/api.json").toString(), "-").redirectErrorStream(true).start();
    try (var names = check.outputWriter()) {
      for (String name : new Interface().names) {
        names.write(name + "\n");
      }
    }
    final String said = new String(check.getInputStream().readAllBytes());
    assertEquals(0, check.waitFor(), said);
  }
}
