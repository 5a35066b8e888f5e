# SPDX-License-Identifier: BSD-3-Clause
"""Reports of a run: one HTML page to look at, or the Mars paper's figures. `python -m cairn.report --help`.

It reads the CSV files that `cairn run` and `cairn simulate` write, and needs neither the library nor cffi.
"""
