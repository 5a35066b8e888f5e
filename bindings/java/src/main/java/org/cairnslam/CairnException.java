// SPDX-License-Identifier: BSD-3-Clause
package org.cairnslam;

/**
 * The error of a call that the library refused. The call changed nothing. The message is the library's: what was wrong,
 * with which value, and what to do about it.
 */
public final class CairnException extends RuntimeException {
  private static final long serialVersionUID = 1L;

  /** The number of the status. */
  private final int code;

  CairnException(int code, String message) {
    super(message);
    this.code = code;
  }

  /**
   * Says of which kind the error is.
   *
   * @return the status; {@link Status#UNRECOGNISED} if the library is newer than this package and has a new one
   */
  @CName("cairn_error.status")
  public Status status() {
    return Status.of(code);
  }

  /**
   * The number of the status.
   *
   * @return the number, negative
   */
  public int code() {
    return code;
  }

  /**
   * The message of the library, one line. It came with the call, so it is never that of another thread.
   *
   * @return the message
   */
  @Override
  @CName({"cairn_error.message", "cairn_last_message", "cairn_sim_last_message"})
  public String getMessage() {
    return super.getMessage();
  }
}
