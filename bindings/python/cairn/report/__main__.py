# SPDX-License-Identifier: BSD-3-Clause
"""python -m cairn.report DIR [-o FILE]: one HTML page; --figures OUT: the figures of the paper."""
from __future__ import annotations

import argparse
import os
import sys
from typing import Any

from . import page, run, team, team_page


def pictures_of(runs: Any) -> Any:
    """The paper's figures for the page of a comparison. Without matplotlib it prints a message and returns none."""
    from . import figures
    try:
        return figures.for_page(runs)
    except ImportError as error:
        print(f"cairn.report: the page is made without the paper's figures: {error}: pip install 'cairn[figures]'",
              file=sys.stderr)
        return ()


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(
        prog="python -m cairn.report",
        description="Makes one self-contained HTML page of a run's results, or pictures of them.")
    parser.add_argument("folder", metavar="DIR", help="what 'cairn run --output DIR' or 'cairn simulate --output DIR' wrote")
    parser.add_argument("-o", "--output", metavar="FILE", help="the page (default: DIR/report.html)")
    parser.add_argument("--figures", metavar="OUT",
                        help="write pictures into this folder instead: Figures 5 to 13 of the Mars paper or, of a team, "
                             "Figures 2 to 7 of the cooperative paper")
    parser.add_argument("--format", choices=("png", "svg"), default="png", help="format of the figures (default: png)")
    options = parser.parse_args(arguments)
    try:
        cooperation = team.read_folder(options.folder)
        runs: Any = run.read_folder(options.folder) if cooperation is None else ()
        if options.figures:
            from . import figures, team_figures
            paths = (figures.write(runs, options.figures, options.format) if cooperation is None
                     else team_figures.write(cooperation, options.figures, options.format))
            for path in paths:
                print(path)
            return 0
        if cooperation is not None:
            text = team_page.build(cooperation)
        else:
            text = page.build(options.folder, runs, pictures_of(runs) if len(runs) > 1 else ())
        path = options.output or os.path.join(options.folder, "report.html")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        print(f"{path}: {len(text.encode()) / 1e6:.1f} MB")
        return 0
    except run.ReportError as error:
        print(f"cairn.report: {error}", file=sys.stderr)
    except ImportError as error:
        print(f"cairn.report: the figures need matplotlib ({error}): pip install 'cairn[figures]'", file=sys.stderr)
    except OSError as error:
        print(f"cairn.report: {error}", file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main())
