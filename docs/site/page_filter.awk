# SPDX-License-Identifier: BSD-3-Clause
# Doxygen reads every page through this filter. The pages are written for people who read them as files; Doxygen has
# other words for the same links:
# - a link to a page, or to a heading of a page, becomes a reference to a label; its words come into one line;
# - a heading gets its label: the name of the page, and the words of the heading;
# - in the pages that list others, an item becomes a child of the page in the tree of navigation;
# - a link to a file that is no page becomes the name of the file, because the site does not contain it;
# - the name of a function becomes a link to it. Doxygen by itself links only the names of structs and headers.
# The variable headers is the folder of the C headers, which tell the functions.

BEGIN {
  list = "cat '" headers "'/*.h"
  while ((list | getline line) > 0)
    while (match(line, /cairn_[a-z0-9_]+\(/)) {
      functions[substr(line, RSTART, RLENGTH - 1)] = 1
      line = substr(line, RSTART + RLENGTH)
    }
  close(list)
}

# From the text of a heading, as the usual viewers of Markdown do it.
function slug(text) {
  text = tolower(text)
  gsub(/[^a-z0-9 _-]/, "", text)
  gsub(/ /, "-", text)
  return text
}

# The references for all links of a line.
function referenced(line,    done, target, page_of, place) {
  done = ""
  while (match(line, /\]\([a-z_]*(\.md)?(#[a-z0-9_-]+)?\)/)) {
    target = substr(line, RSTART + 2, RLENGTH - 3)
    done = done substr(line, 1, RSTART)
    line = substr(line, RSTART + RLENGTH)
    place = target
    if (sub(/^[^#]*#/, "", place) == 0) place = ""
    page_of = target
    sub(/(\.md)?(#.*)?$/, "", page_of)
    if (page_of == "") page_of = page
    done = done "(@ref " page_of (place == "" ? "" : "_" place) ")"
  }
  return done line
}

# The names of files instead of links to them.
function named(line,    text, path) {
  while (match(line, /\[[^]]*\]\((\.\.\/[^)]*|cairn\.1)\)/)) {
    text = substr(line, RSTART + 1, RLENGTH - 2)
    path = text
    sub(/\].*/, "", text)
    sub(/.*\]\((\.\.\/)?/, "", path)
    line = substr(line, 1, RSTART - 1) text " (`" path "`)" substr(line, RSTART + RLENGTH)
  }
  return line
}

function linked(line,    done, name) {
  done = ""
  while (match(line, /`cairn_[a-z0-9_]+`/)) {
    name = substr(line, RSTART + 1, RLENGTH - 2)
    done = done substr(line, 1, RSTART - 1) (name in functions ? "<code>@ref " name "</code>" : "`" name "`")
    line = substr(line, RSTART + RLENGTH)
  }
  return done line
}

FNR == 1 {
  page = FILENAME
  sub(/.*\//, "", page)
  sub(/\.md$/, "", page)
  lists = page ~ /^(start|guides|theory|measurements|development)$/
}
{
  if (held != "") {
    sub(/^ +/, "")
    $0 = held " " $0
    held = ""
  }
}
/^ *```/ { in_code = !in_code }
in_code { print; next }
/\[[^]]*$/ { held = $0; next }
lists && sub(/^## /, "") {  # these pages are short: their headings need no places in the tree
  print "<h2>" $0 "</h2>"
  next
}
/^##/ && !/\{#/ {
  heading = $0
  sub(/^#+ */, "", heading)
  print $0 " {#" page "_" slug(heading) "}"
  next
}
lists && match($0, /^- \[[^]]*\]\([a-z_]+\.md\)/) {
  item = substr($0, 1, RLENGTH)
  rest = substr($0, RLENGTH + 1)
  text = item
  gsub(/^- \[|\].*/, "", text)
  sub(/.*\(/, "", item)
  sub(/\.md\)/, "", item)
  print "- @subpage " item " \"" text "\"" referenced(named(rest))
  next
}
# The rules stand in a header, as a page of their own.
lists && sub(/^- \[Rules for every function\]\([^)]*\)/, "- @subpage rules \"Rules for every function\"") { print; next }
{ print linked(referenced(named($0))) }
END { if (held != "") print linked(referenced(named(held))) }
