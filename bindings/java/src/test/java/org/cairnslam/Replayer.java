// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

import com.google.gson.JsonArray;
import com.google.gson.JsonElement;
import com.google.gson.JsonObject;
import com.google.gson.JsonPrimitive;
import java.lang.reflect.Constructor;
import java.lang.reflect.Executable;
import java.lang.reflect.InvocationTargetException;
import java.lang.reflect.Method;
import java.lang.reflect.Modifier;
import java.lang.reflect.Parameter;
import java.lang.reflect.ParameterizedType;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Collection;
import java.util.Deque;
import java.util.HashMap;
import java.util.HexFormat;
import java.util.List;
import java.util.Map;
import java.util.TreeSet;

/** Replays the calls of a scenario by the public interface, which it finds by the names of C. */
final class Replayer implements AutoCloseable {
  private final Map<String, JsonObject> functions = new HashMap<>();
  private final Map<String, JsonObject> structs = new HashMap<>();
  private final Interface known;
  private final Map<String, Object> names = new HashMap<>();
  private final Deque<Handle> created = new ArrayDeque<>();
  private final List<String> log = new ArrayList<>();

  /** What a log does after it has kept the line. */
  Runnable afterLine = () -> {};

  Replayer(JsonObject api, Interface known) {
    this.known = known;
    for (JsonElement function : api.getAsJsonArray("functions")) {
      functions.put(name(function.getAsJsonObject()), function.getAsJsonObject());
    }
    for (JsonElement struct : api.getAsJsonArray("structs")) {
      structs.put(name(struct.getAsJsonObject()), struct.getAsJsonObject());
    }
  }

  private static String name(JsonObject item) {
    return item.get("name").getAsString();
  }

  private static String role(JsonObject item) {
    return item.get("role").getAsString();
  }

  private static String text(JsonObject item, String key) {
    return item.get(key).isJsonNull() ? null : item.get(key).getAsString();
  }

  /** Makes one call; returns what the C replayer writes for it. */
  JsonObject call(JsonObject call) throws Exception {
    final String name = call.get("call").getAsString();
    final JsonObject function = functions.get(name);
    final JsonObject with = call.has("with") ? call.getAsJsonObject("with") : new JsonObject();
    final JsonObject gives = call.has("gives") ? call.getAsJsonObject("gives") : new JsonObject();
    final JsonObject result = new JsonObject();
    result.addProperty("call", name);
    log.clear();
    try {
      final JsonObject given = outputs(function, invoke(function, with), gives);
      if (given.size() > 0) {
        result.add("gives", given);
      }
    } catch (CairnException failure) {
      failed(result, failure);
    } catch (ConformanceCallbacks.Aborted aborted) {
      failed(result, (CairnException) aborted.getSuppressed()[0]);
    }
    if (!log.isEmpty()) {
      final JsonArray lines = new JsonArray();
      log.forEach(lines::add);
      result.add("log", lines);
    }
    return result;
  }

  private void failed(JsonObject result, CairnException failure) {
    result.addProperty("status", known.constantNames.get(failure.status()));
    result.addProperty("message", failure.getMessage());
  }

  /** Calls the method; the values of the outputs, by the names of C. */
  private Map<String, Object> invoke(JsonObject function, JsonObject with) throws Exception {
    final Map<String, JsonObject> parameters = new HashMap<>();
    final List<JsonObject> outputs = new ArrayList<>();
    String first = null;
    for (JsonElement element : function.getAsJsonArray("parameters")) {
      final JsonObject parameter = element.getAsJsonObject();
      parameters.put(java(name(parameter)), parameter);
      first = first == null ? name(parameter) : first;
      if (parameter.get("direction").getAsString().endsWith("out") && !role(parameter).equals("needed")
          && !role(parameter).equals("error")) {
        outputs.add(parameter);
      }
    }
    if (text(function, "destroys") != null) {
      ((Handle) names.get(with.get(first).getAsString())).close();
      return Map.of();
    }
    final Executable executable = known.functions.get(name(function));
    if (executable == null) {
      throw new AssertionError("no method for " + name(function));
    }
    final boolean hasReceiver = executable instanceof Method && !Modifier.isStatic(executable.getModifiers());
    final Object receiver = hasReceiver ? toJava(with.get(first), ((Method) executable).getDeclaringClass(), null) : null;
    final List<Object> arguments = new ArrayList<>();
    for (Parameter parameter : executable.getParameters()) {
      final JsonObject described = parameters.get(parameter.getName());
      if (described == null) {
        throw new AssertionError(name(function) + " has no parameter " + parameter.getName());
      }
      arguments.add(toJava(with.get(name(described)), parameter.getType(),
          parameter.getParameterizedType() instanceof ParameterizedType generic
              ? (Class<?>) generic.getActualTypeArguments()[0] : null));
    }
    final Object returned = invoke(executable, receiver, arguments.toArray());
    final Map<String, Object> values = new HashMap<>();
    if (!function.get("fallible").getAsBoolean()) {
      values.put("return", returned);
    }
    for (JsonObject output : outputs) {
      if (output.get("direction").getAsString().equals("inout")) {
        values.put(name(output), receiver);
      } else if (returned instanceof Record) {
        final Method component = returned.getClass().getMethod(java(name(output)));
        values.put(name(output), component.invoke(returned));
      } else {
        values.put(name(output), returned);
      }
    }
    return values;
  }

  private static Object invoke(Executable executable, Object receiver, Object[] arguments) throws Exception {
    try {
      return executable instanceof Method method ? method.invoke(receiver, arguments)
          : ((Constructor<?>) executable).newInstance(arguments);
    } catch (InvocationTargetException thrown) {
      if (thrown.getCause() instanceof Error error) {
        throw error;
      }
      throw (Exception) thrown.getCause();
    }
  }

  /** The name of a parameter in Java. */
  private static String java(String name) {
    final String[] parts = name.split("_");
    final StringBuilder java = new StringBuilder(parts[0].toLowerCase());
    for (int i = 1; i < parts.length; ++i) {
      java.append(parts[i].substring(0, 1).toUpperCase()).append(parts[i].substring(1));
    }
    return java.toString();
  }

  private Object named(String path) throws Exception {
    final String[] parts = path.split("\\.");
    Object value = names.get(parts[0]);
    if (value == null) {
      throw new AssertionError("nothing has the name " + path);
    }
    for (int i = 1; i < parts.length; ++i) {
      value = value instanceof List<?> list ? list.get(Integer.parseInt(parts[i])) : field(value, parts[i]);
    }
    return value;
  }

  private Object field(Object struct, String field) throws Exception {
    return known.getters.get(struct.getClass().getAnnotation(CName.class).value()[0] + "." + field).invoke(struct);
  }

  private static double number(JsonElement value) {
    final String text = value.getAsString();
    if (text.startsWith("x")) {
      return Double.longBitsToDouble(Long.parseUnsignedLong(text.substring(1), 16));
    }
    return switch (text) {
      case "nan" -> Double.NaN;
      case "inf" -> Double.POSITIVE_INFINITY;
      case "-inf" -> Double.NEGATIVE_INFINITY;
      default -> Double.parseDouble(text);
    };
  }

  private Object toJava(JsonElement value, Class<?> type, Class<?> element) throws Exception {
    if (value == null) {
      return null;
    }
    if (value.isJsonPrimitive() && value.getAsString().startsWith("$")) {
      return named(value.getAsString());
    }
    if (type == double.class) {
      return number(value);
    } else if (type == long.class) {
      return Long.parseUnsignedLong(value.getAsString());
    } else if (type == int.class) {
      return value.getAsInt();
    } else if (type == boolean.class) {
      return value.getAsBoolean();
    } else if (type == String.class) {
      return value.getAsString();
    } else if (type.isEnum()) {
      return known.constants.get((value.isJsonArray() ? value.getAsJsonArray().get(0) : value).getAsString());
    } else if (type == CustomPredict.class) {
      return ConformanceCallbacks.PREDICT.get(value.getAsString());
    } else if (type == CustomPlace.class) {
      return ConformanceCallbacks.PLACE.get(value.getAsString());
    } else if (type == Log.class) {
      return (Log) line -> {
        log.add(line);
        afterLine.run();
      };
    } else if (type == byte[].class) {
      return HexFormat.of().parseHex(value.getAsString().substring("bytes:".length()));
    } else if (Struct.class.isAssignableFrom(type)) {
      return fill(type.getConstructor().newInstance(), value.getAsJsonObject());
    }
    return array(value.getAsJsonArray(), type, element);
  }

  private Object array(JsonArray values, Class<?> type, Class<?> element) throws Exception {
    if (type == double[].class) {
      final double[] array = new double[values.size()];
      for (int i = 0; i < array.length; ++i) {
        array[i] = (double) toJava(values.get(i), double.class, null);
      }
      return array;
    } else if (type == long[].class) {
      return values.asList().stream().mapToLong(v -> Long.parseUnsignedLong(v.getAsString())).toArray();
    }
    final StructArray<?> array = (StructArray<?>) element.getMethod("array", int.class).invoke(null, values.size());
    for (int i = 0; i < array.size(); ++i) {
      fill(array.get(i), values.get(i).getAsJsonObject());
    }
    return array;
  }

  private Object fill(Object struct, JsonObject fields) throws Exception {
    final String type = struct.getClass().getAnnotation(CName.class).value()[0];
    for (String field : fields.keySet()) {
      final Method setter = known.setters.get(type + "." + field);
      if (setter == null) {
        throw new AssertionError("no setter for " + type + "." + field);
      }
      setter.invoke(struct, toJava(fields.get(field), setter.getParameterTypes()[0], null));
    }
    return struct;
  }

  private JsonObject outputs(JsonObject function, Map<String, Object> values, JsonObject gives) throws Exception {
    final JsonObject result = new JsonObject();
    final Map<String, JsonObject> described = new HashMap<>();
    described.put("return", function.getAsJsonObject("returns"));
    for (JsonElement parameter : function.getAsJsonArray("parameters")) {
      described.put(name(parameter.getAsJsonObject()), parameter.getAsJsonObject());
    }
    for (String output : new TreeSet<>(values.keySet())) {
      final Object value = values.get(output);
      final String type = described.get(output).get("type").getAsString();
      if (type.equals("void")) {
        continue;
      }
      final JsonElement name = gives.get(output);
      if (name != null && name.isJsonPrimitive() && name.getAsString().startsWith("$")) {
        names.put(name.getAsString(), value);
      }
      if (value instanceof Handle handle) {
        if (!handle.isLent()) {
          created.addFirst(handle);
        }
        result.add(output, name);
      } else {
        result.add(output, toJson(value, described.get(output)));
      }
    }
    return result;
  }

  /** A value in the form of the C replayer. */
  private JsonElement toJson(Object value, JsonObject type) throws Exception {
    if (value instanceof Double number) {
      return new JsonPrimitive(number.isNaN() ? "nan"
          : "x" + HexFormat.of().toHexDigits(Double.doubleToRawLongBits(number)));
    } else if (value instanceof Long number) {
      return type.get("base").getAsString().equals("uint64_t") ? new JsonPrimitive(Long.toUnsignedString(number))
          : new JsonPrimitive(number);
    } else if (value instanceof Integer number) {
      return new JsonPrimitive(number);
    } else if (value instanceof Boolean flag) {
      return new JsonPrimitive(flag);
    } else if (value instanceof String text) {
      return new JsonPrimitive(text);
    } else if (value instanceof Enum<?> constant) {
      return new JsonPrimitive(known.constantNames.get(constant));
    } else if (value instanceof byte[] bytes) {
      return new JsonPrimitive("bytes:" + HexFormat.of().formatHex(bytes));
    } else if (value instanceof Struct) {
      return struct(value);
    }
    final JsonArray array = new JsonArray();
    if (value instanceof double[] numbers) {
      for (double number : numbers) {
        array.add(toJson(number, type));
      }
    } else if (value instanceof long[] numbers) {
      for (long number : numbers) {
        array.add(toJson(number, type));
      }
    } else {
      for (Object element : (Collection<?>) value) {
        array.add(toJson(element, type));
      }
    }
    return array;
  }

  private JsonObject struct(Object value) throws Exception {
    final JsonObject object = new JsonObject();
    for (JsonElement element : structs.get(value.getClass().getAnnotation(CName.class).value()[0])
        .getAsJsonArray("fields")) {
      final JsonObject field = element.getAsJsonObject();
      if (!role(field).equals("struct_size") && !role(field).equals("reserved")
          && field.get("repeatable").getAsBoolean()) {
        object.add(name(field), toJson(field(value, name(field)), field));
      }
    }
    return object;
  }

  @Override
  public void close() {
    created.forEach(Handle::close);
  }
}
