// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

import com.sun.jna.Native;
import com.sun.jna.Pointer;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.DoubleBuffer;
import java.nio.LongBuffer;

/** Bytes in native order, on the heap or, with an address, where C can reach them. */
final class Memory {
  final ByteBuffer bytes;

  /** 0: on the heap. */
  final long address;

  /** The same bytes; only of memory that C can reach. */
  final DoubleBuffer doubles;

  final LongBuffer longs;

  private Memory(ByteBuffer bytes) {
    this.bytes = bytes.order(ByteOrder.nativeOrder());
    if (bytes.isDirect()) {
      address = bytes.capacity() == 0 ? 0 : Pointer.nativeValue(Native.getDirectBufferPointer(bytes));
      doubles = this.bytes.asDoubleBuffer();
      longs = this.bytes.asLongBuffer();
    } else {
      address = 0;
      doubles = null;
      longs = null;
    }
  }

  static Memory heap(int size) {
    return new Memory(ByteBuffer.allocate(size));
  }

  static Memory direct(int size) {
    return new Memory(ByteBuffer.allocateDirect(size));
  }

  /** A copy of what lies at an address. */
  static Memory copyOf(long address, int size) {
    return new Memory(ByteBuffer.wrap(new Pointer(address).getByteArray(0, size)));
  }

  void copyFrom(int offset, Memory other, int otherOffset, int size) {
    bytes.put(offset, other.bytes, otherOffset, size);
  }
}
