# SPDX-License-Identifier: BSD-3-Clause
# Doxygen reads every header through this filter: the name of a page in docs becomes a link with the title of the page,
# and thread rule, errors and complexity of a function get a paragraph each.
{
  $0 = with_links($0)
  gsub(/Threads: /, "\n * \\par Threads\n * ")
  gsub(/Errors: /, "\n * \\par Errors\n * ")
  gsub(/Complexity: /, "\n * \\par Complexity\n * ")
  print
}

function with_links(line,    done) {
  done = ""
  while (match(line, /docs\/[a-z_]+\.md/)) {
    done = done substr(line, 1, RSTART - 1) "\\ref " substr(line, RSTART + 5, RLENGTH - 8)
    line = substr(line, RSTART + RLENGTH)
  }
  return done line
}
