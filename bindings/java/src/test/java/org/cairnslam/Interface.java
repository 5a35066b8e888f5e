// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

import java.io.IOException;
import java.lang.reflect.AnnotatedElement;
import java.lang.reflect.Executable;
import java.lang.reflect.Field;
import java.lang.reflect.Method;
import java.lang.reflect.Modifier;
import java.net.URI;
import java.nio.file.FileSystem;
import java.nio.file.FileSystems;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.TreeSet;
import java.util.stream.Stream;

/** The public interface of the package, by the names of C. */
final class Interface {
  /** Methods and constructors; not the setters and getters of fields. */
  final Map<String, Executable> functions = new HashMap<>();

  final Map<String, Method> getters = new HashMap<>();
  final Map<String, Method> setters = new HashMap<>();

  /** Constants of enums. */
  final Map<String, Enum<?>> constants = new HashMap<>();

  final Map<Enum<?>, String> constantNames = new HashMap<>();

  /** Functions, fields and constants: all that the package shows. */
  final TreeSet<String> names = new TreeSet<>();

  Interface() throws Exception {
    for (Class<?> javaClass : classes()) {
      for (Executable constructor : javaClass.getDeclaredConstructors()) {
        add(constructor, constructor);
      }
      for (Method method : javaClass.getDeclaredMethods()) {
        if (!method.isSynthetic()) {
          add(method, method);
        }
      }
      for (Field field : javaClass.getDeclaredFields()) {
        add(field);
      }
    }
  }

  private static List<Class<?>> classes() throws Exception {
    final URI where = CName.class.getProtectionDomain().getCodeSource().getLocation().toURI();
    final Path root = Path.of(where);
    if (Files.isDirectory(root)) {
      return classes(root);
    }
    try (FileSystem jar = FileSystems.newFileSystem(root)) {
      return classes(jar.getPath("/"));
    }
  }

  private static List<Class<?>> classes(Path root) throws IOException, ClassNotFoundException {
    final List<Class<?>> classes = new ArrayList<>();
    final Path folder = root.resolve(CName.class.getPackageName().replace('.', '/'));
    try (Stream<Path> files = Files.list(folder)) {
      for (Path file : (Iterable<Path>) files::iterator) {
        final String name = file.getFileName().toString();
        if (name.endsWith(".class")) {
          classes.add(Class.forName(CName.class.getPackageName() + "." + name.replace(".class", ""), false,
              CName.class.getClassLoader()));
        }
      }
    }
    return classes;
  }

  private static String[] namesOf(AnnotatedElement element) {
    final CName name = element.getAnnotation(CName.class);
    return name == null ? new String[0] : name.value();
  }

  private void add(AnnotatedElement element, Executable executable) {
    for (String name : namesOf(element)) {
      if (!Modifier.isPublic(executable.getModifiers())) {
        throw new AssertionError(name + " is not public: " + executable);
      }
      names.add(name);
      if (name.contains(".")) {
        final Method method = (Method) executable;
        (method.getParameterCount() == 0 ? getters : setters).put(name, method);
      } else if (functions.put(name, executable) != null) {
        throw new AssertionError(name + " is there twice: " + executable);
      }
    }
  }

  private void add(Field field) throws IllegalAccessException {
    for (String name : namesOf(field)) {
      names.add(name);
      if (field.isEnumConstant()) {
        final Enum<?> constant = (Enum<?>) field.get(null);
        constants.put(name, constant);
        constantNames.put(constant, name);
      }
    }
  }
}
