// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

import java.util.Arrays;

/**
 * A struct of the C interface: an object of its own, or a view of a struct in another one or in a
 * {@link StructArray}. Writing to a view changes what it is a view of. Two structs are equal if their bytes are equal.
 */
public abstract class Struct {
  final Memory memory;
  final int offset;

  Struct(Memory memory, int offset) {
    this.memory = memory;
    this.offset = offset;
  }

  abstract StructType<?> type();

  /** Copies the values of another struct of this type. */
  final void set(Struct other) {
    memory.copyFrom(offset, other.memory, other.offset, type().size());
  }

  final double getDouble(int at) {
    return memory.bytes.getDouble(offset + at);
  }

  final void putDouble(int at, double value) {
    memory.bytes.putDouble(offset + at, value);
  }

  final long getLong(int at) {
    return memory.bytes.getLong(offset + at);
  }

  final void putLong(int at, long value) {
    memory.bytes.putLong(offset + at, value);
  }

  final int getInt(int at) {
    return memory.bytes.getInt(offset + at);
  }

  final void putInt(int at, int value) {
    memory.bytes.putInt(offset + at, value);
  }

  final double[] getDoubles(int at, int length) {
    final double[] values = new double[length];
    for (int i = 0; i < length; ++i) {
      values[i] = getDouble(at + Double.BYTES * i);
    }
    return values;
  }

  final void putDoubles(int at, double[] values, int length, String name) {
    Check.length(values.length, length, name);
    for (int i = 0; i < length; ++i) {
      putDouble(at + Double.BYTES * i, values[i]);
    }
  }

  final double getDoubleOf(int at, int length, int index) {
    return getDouble(at + Double.BYTES * java.util.Objects.checkIndex(index, length));
  }

  /** Names and values, in turns. */
  final String text(Object... fields) {
    final StringBuilder text = new StringBuilder(getClass().getSimpleName()).append('[');
    for (int i = 0; i < fields.length; i += 2) {
      final Object value = fields[i + 1];
      text.append(i == 0 ? "" : ", ").append(fields[i]).append('=');
      text.append(value instanceof double[] ? Arrays.toString((double[]) value) : value);
    }
    return text.append(']').toString();
  }

  private byte[] content() {
    final byte[] content = new byte[type().size()];
    memory.bytes.get(offset, content);
    return content;
  }

  @Override
  public final boolean equals(Object other) {
    return other instanceof Struct && ((Struct) other).type() == type()
        && Arrays.equals(content(), ((Struct) other).content());
  }

  @Override
  public final int hashCode() {
    return Arrays.hashCode(content());
  }
}
