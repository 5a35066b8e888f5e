// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.util.AbstractList;
import java.util.Objects;
import java.util.RandomAccess;

/**
 * An array of structs that lie side by side, as in C. Its elements are views: {@code array.get(3).id(7)} writes into
 * the array. An array that was made by {@code Observation.array(n)} and the like lies outside the Java heap, and the
 * library reads and writes it without a copy. Such memory is freed with the array by the garbage collector, which is
 * slow to make and free: make an array once, and use a {@link #subList} of it in each step.
 *
 * @param <T> the struct
 */
public final class StructArray<T extends Struct> extends AbstractList<T> implements RandomAccess {
  /** Results that are larger than this lie outside the heap. A copy of less costs less than such memory. */
  private static final int LARGE = 16384;

  final StructType<T> type;
  final Memory memory;
  final int offset;
  private final int size;

  private StructArray(StructType<T> type, Memory memory, int offset, int size) {
    this.type = type;
    this.memory = memory;
    this.offset = offset;
    this.size = size;
  }

  static <T extends Struct> StructArray<T> direct(StructType<T> type, int size) {
    return new StructArray<>(type, Memory.direct(Check.bytes(size, type.size())), 0, size);
  }

  static <T extends Struct> StructArray<T> forResult(StructType<T> type, int size) {
    final int bytes = Check.bytes(size, type.size());
    return new StructArray<>(type, bytes > LARGE ? Memory.direct(bytes) : Memory.heap(bytes), 0, size);
  }

  @Override
  public int size() {
    return size;
  }

  /**
   * A view of one struct.
   *
   * @param index from 0 on
   * @return the struct, which shares its memory with the array
   */
  @Override
  public T get(int index) {
    return type.view().of(memory, offset + type.size() * Objects.checkIndex(index, size));
  }

  /**
   * Copies a struct into the array.
   *
   * @param index from 0 on
   * @param struct what is copied
   * @return a view of the element, which holds the new values
   */
  @Override
  public T set(int index, T struct) {
    final T element = get(index);
    element.set(type.javaClass().cast(struct));
    return element;
  }

  /**
   * A view of some of the structs.
   *
   * @param from the first one
   * @param to one after the last one
   * @return an array that shares its memory with this one
   */
  @Override
  public StructArray<T> subList(int from, int to) {
    Objects.checkFromToIndex(from, to, size);
    return new StructArray<>(type, memory, offset + type.size() * from, to - from);
  }

  /**
   * The bytes of the array, in native order, for programs that fill or read it in bulk.
   *
   * @return a buffer that shares its memory with this array
   */
  public ByteBuffer bytes() {
    return memory.bytes.slice(offset, type.size() * size).order(ByteOrder.nativeOrder());
  }
}
