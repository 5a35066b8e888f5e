#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The options in docs/cairn.1 are those of the program's option tables, to the letter.

    CAIRN_PROGRAM=build/bin/cairn python3 tests/program/manual_options_test.py            checks the page
    CAIRN_PROGRAM=build/bin/cairn python3 tests/program/manual_options_test.py --update   writes them into the page
"""
import os
import re
import subprocess
import sys

PAGE = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../docs/cairn.1"))
PART = re.compile(r'^\.\\" options: (\w+)\n(.*?)^\.\\" end of options\n', re.MULTILINE | re.DOTALL)


def with_options(page, parts):
    """The page with each of its parts replaced by the program's."""
    missing = set(parts) ^ {name for name, _ in PART.findall(page)}
    if missing:
        sys.exit(f"{PAGE}: the page and the program differ in these groups of options: {', '.join(sorted(missing))}; "
                 'each needs a line .\\" options: GROUP and a line .\\" end of options')
    return PART.sub(lambda part: f'.\\" options: {part[1]}\n{parts[part[1]]}.\\" end of options\n', page)


def main():
    program = os.environ["CAIRN_PROGRAM"]
    told = subprocess.run([program, "--manual-options"], stdout=subprocess.PIPE, text=True, check=True).stdout
    with open(PAGE) as file:
        page = file.read()
    wanted = with_options(page, dict(PART.findall(told)))
    if "--update" in sys.argv[1:]:
        with open(PAGE, "w") as file:
            file.write(wanted)
    elif page != wanted:
        for number, (has, want) in enumerate(zip(page.splitlines(), wanted.splitlines()), 1):
            if has != want:
                print(f"{PAGE}:{number}: '{has}'\n  the option table has: '{want}'")
                break
        sys.exit(f"{PAGE} differs from the option tables. To write them into the page:\n"
                 f"  CAIRN_PROGRAM={program} python3 {os.path.abspath(__file__)} --update")


if __name__ == "__main__":
    main()
