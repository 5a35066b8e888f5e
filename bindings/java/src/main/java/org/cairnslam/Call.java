// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

import com.sun.jna.Pointer;
import java.lang.ref.Reference;
import java.nio.charset.StandardCharsets;
import java.util.List;
import java.util.Objects;

/**
 * One call of the library: the locks of its handles, the memory of its arguments, and its error. Everything ends with
 * {@link #close}.
 */
final class Call implements AutoCloseable {
  /** Memory of one thread, in which the arguments of a call lie. Calls nest, for a callback may call the library. */
  private static final class Stack {
    static final ThreadLocal<Stack> OF_THREAD = ThreadLocal.withInitial(Stack::new);
    static final int SIZE = 65536;

    final Memory memory = Memory.direct(SIZE);
    int used;

    /** What the last callback of this thread threw. */
    Throwable thrown;
  }

  /** Where an argument lies. Blocks of a call are chained, so that the garbage collector leaves their memory. */
  static final class Block {
    final long address;
    private final Memory memory;
    private final int offset;
    private final Block before;

    Block(Memory memory, int offset, Block before) {
      this.address = memory == null ? 0 : memory.address + offset;
      this.memory = memory;
      this.offset = offset;
      this.before = before;
    }

    double getDouble() {
      return memory.bytes.getDouble(offset);
    }

    long getLong() {
      return memory.bytes.getLong(offset);
    }

    int getInt() {
      return memory.bytes.getInt(offset);
    }

    /** A number of elements that Java can address. */
    int getCount() {
      return Math.toIntExact(getLong());
    }

    double[] getDoubles(int length) {
      final double[] values = new double[length];
      memory.doubles.get(offset / Double.BYTES, values);
      return values;
    }

    long[] getLongs(int length) {
      final long[] values = new long[length];
      memory.longs.get(offset / Long.BYTES, values);
      return values;
    }

    byte[] getBytes(int length) {
      final byte[] values = new byte[length];
      memory.bytes.get(offset, values);
      return values;
    }

    /** Takes over what the library wrote, if that lies elsewhere. */
    <T extends Struct> T to(T struct) {
      if (struct.memory != memory) {
        struct.memory.copyFrom(struct.offset, memory, offset, struct.type().size());
      }
      return struct;
    }

    <T extends Struct> StructArray<T> to(StructArray<T> array) {
      if (array.memory != memory) {
        array.memory.copyFrom(array.offset, memory, offset, array.type.size() * array.size());
      }
      return array;
    }
  }

  private final Stack stack = Stack.OF_THREAD.get();
  private final int mark = stack.used;
  private Block last;
  private final Block error;
  private Handle first;
  private boolean firstChanges;
  private Handle second;
  private boolean secondChanges;

  Call() {
    stack.thrown = null;
    error = room(ErrorLayout.SIZE);
    error.memory.bytes.putInt(error.offset + ErrorLayout.STRUCT_SIZE, ErrorLayout.SIZE);
  }

  /** Locks the handle that the call uses. */
  void lock(Handle handle, boolean changes) {
    handle.lock(changes);
    first = handle;
    firstChanges = changes;
  }

  /** Locks two handles, always in the same order, so that two threads cannot wait for each other. */
  void lock(Handle one, boolean oneChanges, Handle other, boolean otherChanges) {
    if (one.sharesLock(other)) {
      lock(oneChanges ? one : other, oneChanges || otherChanges);
      return;
    }
    final boolean inOrder = one.isBefore(other);
    lock(inOrder ? one : other, inOrder ? oneChanges : otherChanges);
    final Handle later = inOrder ? other : one;
    final boolean laterChanges = inOrder ? otherChanges : oneChanges;
    later.lock(laterChanges);
    second = later;
    secondChanges = laterChanges;
  }

  long error() {
    return error.address;
  }

  Block room(long size) {
    final int bytes = Check.bytes(size, 1);
    final int aligned = bytes > Integer.MAX_VALUE - 7 ? bytes : (bytes + 7) & ~7;
    if (aligned > Stack.SIZE - stack.used) {
      last = new Block(Memory.direct(Math.max(bytes, 1)), 0, last);
    } else {
      last = new Block(stack.memory, stack.used, last);
      stack.used += aligned;
    }
    return last;
  }

  Block nothing() {
    return new Block(null, 0, null);
  }

  Block doubles(int length) {
    return room((long) Double.BYTES * length);
  }

  Block longs(int length) {
    return room((long) Long.BYTES * length);
  }

  Block in(double[] values) {
    if (values == null) {
      return nothing();
    }
    final Block block = doubles(values.length);
    block.memory.doubles.put(block.offset / Double.BYTES, values);
    return block;
  }

  Block in(long[] values) {
    if (values == null) {
      return nothing();
    }
    final Block block = longs(values.length);
    block.memory.longs.put(block.offset / Long.BYTES, values);
    return block;
  }

  Block in(byte[] values) {
    if (values == null) {
      return nothing();
    }
    final Block block = room(values.length);
    block.memory.bytes.put(block.offset, values);
    return block;
  }

  Block in(String text) {
    if (text == null) {
      return nothing();
    }
    if (text.indexOf('\0') >= 0) {
      throw new IllegalArgumentException("a text must not contain a zero");
    }
    return in((text + '\0').getBytes(StandardCharsets.UTF_8));
  }

  Block in(Struct struct) {
    if (struct == null) {
      return nothing();
    }
    final Block block = out(struct);
    if (block.memory != struct.memory) {
      block.memory.copyFrom(block.offset, struct.memory, struct.offset, struct.type().size());
    }
    return block;
  }

  /** The list may be any; one that another thread changes must not end in memory that is not its own. */
  <T extends Struct> Block in(List<T> list, StructType<T> type, int count, String name) {
    if (list instanceof StructArray<T> array) {
      final Block block = out(array, type, name);
      if (block.memory != array.memory) {
        block.memory.copyFrom(block.offset, array.memory, array.offset, type.size() * array.size());
      }
      return block;
    }
    final Object[] structs = list.toArray();
    Check.length(structs.length, count, name);
    final Block block = room((long) type.size() * count);
    int at = block.offset;
    for (Object struct : structs) {
      final T element = type.javaClass().cast(Objects.requireNonNull(struct, name));
      block.memory.copyFrom(at, element.memory, element.offset, type.size());
      at += type.size();
    }
    return block;
  }

  /** Room for a struct that the library writes. {@link Block#to} brings it home. */
  Block out(Struct struct) {
    if (struct.memory.address != 0) {
      return last = new Block(struct.memory, struct.offset, last);
    }
    final Block block = room(struct.type().size());
    block.memory.copyFrom(block.offset, struct.memory, struct.offset, struct.type().size());
    return block;
  }

  <T extends Struct> Block out(StructArray<T> array, StructType<T> type, String name) {
    if (array == null) {
      return nothing();
    }
    Check.type(array, type, name);
    if (array.memory.address != 0) {
      return last = new Block(array.memory, array.offset, last);
    }
    return room((long) type.size() * array.size());
  }

  static String text(long address) {
    return new Pointer(address).getString(0, "UTF-8");
  }

  /** Makes the exception of a call that failed. */
  void check(int status) {
    if (status != Status.OK.code()) {
      throw failure(status);
    }
  }

  private RuntimeException failure(int status) {
    final String message = text(error.address + ErrorLayout.MESSAGE);
    final CairnException failure = new CairnException(status, message);
    final Throwable thrown = stack.thrown;
    stack.thrown = null;
    if (thrown == null || status != Status.ERROR_CALLBACK.code()) {
      return failure;
    }
    thrown.addSuppressed(failure);
    return Call.<RuntimeException>unchecked(thrown);
  }

  /** A callback's own exception comes out of the call as it is, checked or not. */
  @SuppressWarnings("unchecked")
  private static <E extends Throwable> RuntimeException unchecked(Throwable thrown) throws E {
    throw (E) thrown;
  }

  /** Keeps what a callback of this thread threw until its call comes back. */
  static void thrown(Throwable thrown) {
    Stack.OF_THREAD.get().thrown = thrown;
  }

  @Override
  public void close() {
    Reference.reachabilityFence(last);
    stack.used = mark;
    if (second != null) {
      second.unlock(secondChanges);
    }
    if (first != null) {
      first.unlock(firstChanges);
    }
    Reference.reachabilityFence(second);
    Reference.reachabilityFence(first);
  }
}
