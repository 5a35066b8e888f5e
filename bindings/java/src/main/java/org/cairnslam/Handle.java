// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

import java.lang.ref.Cleaner;
import java.util.concurrent.atomic.AtomicLong;
import java.util.concurrent.locks.ReentrantReadWriteLock;
import java.util.function.LongConsumer;

/**
 * What the handles of the library have in common. A handle that is not closed is closed by the garbage collector after
 * its last use. A call on a closed handle throws {@link IllegalStateException}. Calls of several threads on one handle
 * wait for each other; queries run side by side. A callback must not use the handle whose call runs it: that throws
 * {@link IllegalStateException}, too.
 */
public abstract class Handle implements AutoCloseable {
  private static final Cleaner CLEANER = Cleaner.create();
  private static final AtomicLong NUMBERS = new AtomicLong();

  /** What is left when the handle is gone: must not know the handle. */
  private static final class Resource implements Runnable {
    final long address;
    final LongConsumer destroy;
    volatile boolean closed;

    Resource(long address, LongConsumer destroy) {
      this.address = address;
      this.destroy = destroy;
    }

    @Override
    public void run() {
      closed = true;
      destroy.accept(address);
    }
  }

  private final Handle owner;
  private final long lentAddress;
  private final Resource resource;
  private final Cleaner.Cleanable cleanable;
  private final ReentrantReadWriteLock lock;
  private final long number;

  /** A handle that this object destroys. */
  Handle(long address, LongConsumer destroy) {
    owner = null;
    lentAddress = 0;
    resource = new Resource(address, destroy);
    cleanable = CLEANER.register(this, resource);
    lock = new ReentrantReadWriteLock();
    number = NUMBERS.getAndIncrement();
  }

  /** A handle that another one lends: it has the owner's lock and life. */
  Handle(long address, Handle owner) {
    this.owner = owner;
    lentAddress = address;
    resource = owner.resource;
    cleanable = null;
    lock = owner.lock;
    number = owner.number;
  }

  final long address() {
    return owner == null ? resource.address : lentAddress;
  }

  final boolean isLent() {
    return owner != null;
  }

  final boolean sharesLock(Handle other) {
    return lock == other.lock;
  }

  final boolean isBefore(Handle other) {
    return number < other.number;
  }

  final void lock(boolean changes) {
    if (lock.isWriteLockedByCurrentThread() || lock.getReadHoldCount() > 0) {
      throw new IllegalStateException("a callback must not use the " + kind() + " whose call runs it");
    }
    if (changes) {
      lock.writeLock().lock();
    } else {
      lock.readLock().lock();
    }
    if (resource.closed) {
      unlock(changes);
      throw new IllegalStateException("the " + (owner == null ? this : owner).kind() + " is closed");
    }
  }

  final void unlock(boolean changes) {
    if (changes) {
      lock.writeLock().unlock();
    } else {
      lock.readLock().unlock();
    }
  }

  private String kind() {
    return getClass().getSimpleName();
  }

  /**
   * Says whether the handle was closed, or the one that lends it.
   *
   * @return true after {@link #close}
   */
  public final boolean isClosed() {
    return resource.closed;
  }

  /**
   * Frees the memory of the handle now. Waits for the calls of other threads. What is closed already stays closed. What
   * another handle lends (the map of a filter) is closed with that handle: here nothing happens.
   */
  @Override
  @CName({"cairn_filter_destroy", "cairn_map_destroy", "cairn_team_destroy", "cairn_world_destroy",
      "cairn_fleet_destroy"})
  public void close() {
    if (cleanable == null) {
      return;
    }
    if (lock.isWriteLockedByCurrentThread() || lock.getReadHoldCount() > 0) {
      throw new IllegalStateException("a callback must not close the " + kind() + " whose call runs it");
    }
    lock.writeLock().lock();
    try {
      cleanable.clean();
    } finally {
      lock.writeLock().unlock();
    }
  }
}
