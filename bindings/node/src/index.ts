// SPDX-License-Identifier: BSD-3-Clause
// Landmark SLAM: libcairn and libcairn_sim for Node.
export * from './api.js';
export { CairnError } from './call.js';
export * from './facts.js';
export type { BigInts, Bytes, Numbers } from './values.js';
