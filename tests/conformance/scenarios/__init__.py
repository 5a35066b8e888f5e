# SPDX-License-Identifier: BSD-3-Clause
"""The calls of the conformance scenarios, without values: one file for a group of functions."""
