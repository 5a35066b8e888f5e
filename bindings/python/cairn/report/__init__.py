# SPDX-License-Identifier: BSD-3-Clause
"""Reports of a run: one HTML page, or the figures of the Mars paper. See `python -m cairn.report --help`.

The report reads the CSV files that `cairn run` and `cairn simulate` write. It needs neither the library nor cffi.
"""
