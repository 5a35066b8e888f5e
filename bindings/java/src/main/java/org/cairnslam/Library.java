// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

import com.sun.jna.Function;
import com.sun.jna.Native;
import com.sun.jna.NativeLibrary;
import com.sun.jna.Platform;

/** Loads a library, of the right version or not at all. */
final class Library {
  private static final int MINOR = 100;

  private Library() {}

  /**
   * Binds the native methods of a class to a library.
   *
   * @param tellsVersion the library has the functions that say its version; otherwise its name is all that says it
   * @return null, or why that is impossible. A static initialiser must not throw: the second use of its class would no
   *     longer say why
   */
  static String bind(Class<?> methods, String soname, boolean tellsVersion) {
    if (Native.POINTER_SIZE != Long.BYTES || Native.SIZE_T_SIZE != Long.BYTES) {
      return wants() + " a 64-bit Java, and this one is " + Platform.ARCH;
    }
    final NativeLibrary library;
    try {
      library = NativeLibrary.getInstance(fileName(soname));
    } catch (UnsatisfiedLinkError missing) {
      return wants() + " the library " + fileName(soname) + ", and " + (tellsVersion ? otherVersion(soname) : "does not find it")
          + ". Install Cairn " + Cairn.VERSION_TEXT + ", or give its folder by -Djna.library.path=FOLDER ("
          + missing.getMessage().lines().findFirst().orElse("") + ")";
    }
    final String found = tellsVersion ? wrongVersion(library) : null;
    if (found != null) {
      return wants() + " Cairn " + Cairn.VERSION_TEXT + ", and " + library.getFile() + " is " + found;
    }
    try {
      Native.register(methods, library);
    } catch (UnsatisfiedLinkError lacking) {
      return wants() + " Cairn " + Cairn.VERSION_TEXT + ", and " + library.getFile()
          + " lacks a function: " + lacking.getMessage();
    }
    return null;
  }

  /** Throws if a class could not be bound. */
  static void need(String problem) {
    if (problem != null) {
      throw new UnsatisfiedLinkError(problem);
    }
  }

  private static String wants() {
    return "Cairn for Java " + Cairn.VERSION_TEXT + " needs";
  }

  /** The name of the file that has the soname of Linux: libcairn.so.0.2 or libcairn.0.2.dylib, and cairn.dll. */
  private static String fileName(String soname) {
    final int so = soname.indexOf(".so");
    if (Platform.isMac()) {
      return soname.substring(0, so) + soname.substring(so + ".so".length()) + ".dylib";
    }
    return Platform.isWindows() ? plainName(soname) : soname;
  }

  /** libcairn.so.0.2: cairn. */
  private static String plainName(String soname) {
    return soname.substring("lib".length(), soname.indexOf(".so"));
  }

  /** The library without a version in its name may be there, and say which version it is. */
  private static String otherVersion(String soname) {
    try {
      final NativeLibrary library = NativeLibrary.getInstance(plainName(soname));
      final String found = wrongVersion(library);
      return found == null ? "does not find it" : library.getFile() + " is " + found;
    } catch (UnsatisfiedLinkError missing) {
      return "does not find it";
    }
  }

  /** The version of a library that is not this package's; null: it is. */
  private static String wrongVersion(NativeLibrary library) {
    try {
      final int number = function(library, "cairn_version_number").invokeInt(new Object[0]);
      if (number / MINOR == Cairn.VERSION / MINOR) {
        return null;
      }
    } catch (UnsatisfiedLinkError older) {
      // Before 0.2 there was only a text.
    }
    try {
      return "version " + function(library, "cairn_version").invokeString(new Object[0], false);
    } catch (UnsatisfiedLinkError notCairn) {
      return "of no known version";
    }
  }

  private static Function function(NativeLibrary library, String name) {
    return library.getFunction(name);
  }
}
