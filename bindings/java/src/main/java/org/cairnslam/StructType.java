// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

/**
 * What an array must know of the structs in it.
 *
 * @param <T> the class of the struct
 * @param javaClass the same
 * @param size in bytes
 * @param view makes a view of the bytes at an offset
 */
record StructType<T extends Struct>(Class<T> javaClass, int size, View<T> view) {
  /** Makes a view of the bytes at an offset. */
  interface View<T> {
    T of(Memory memory, int offset);
  }
}
