// SPDX-License-Identifier: BSD-3-Clause
/**
 * Cairn in Java: landmark SLAM by the C library of that name. {@link org.cairnslam.Filter} is where to begin. Errors of
 * the library are {@link org.cairnslam.CairnException}; ids are {@code long} values of which all 64 bits count
 * ({@link org.cairnslam.CairnId}); handles close themselves, or earlier by {@code close()}
 * ({@link org.cairnslam.Handle}).
 */
package org.cairnslam;
