# SPDX-License-Identifier: BSD-3-Clause
"""Comments of the C headers as Javadoc."""
import html
import re
import textwrap

from names import camel

LINKED = re.compile(r"\b(?:cairn_[a-z0-9_]+|CAIRN_[A-Z0-9_]+)\b")


class Docs:
    def __init__(self, names):
        self.names = names
        self.receiver = None  # the parameter that is `this` in Java

    def code(self, words):
        if self.names.link(words):
            return "{@link " + self.names.link(words) + "}"
        if words == self.receiver:
            return "<code>this</code>"
        if words == "NULL":
            return "{@code null}"
        if "_" in words and words in self.names.fields | self.names.parameters:
            words = camel(words)
        return "<code>" + html.escape(words, quote=False).replace("@", "&#64;") + "</code>"

    def plain(self, text):
        result, end = "", 0
        for found in LINKED.finditer(text):
            link = self.names.link(found.group())
            result += html.escape(text[end:found.start()], quote=False)
            result += "{@link " + link + "}" if link else html.escape(found.group())
            end = found.end()
        result += html.escape(text[end:], quote=False)
        return re.sub(r"\bNULL\b", "{@code null}", result).replace("@ ", "&#64; ")

    def inline(self, text):
        pieces = re.split(r"`([^`]*)`", text.replace("\\ref ", ""))
        return "".join(self.code(p) if i % 2 else self.plain(p) for i, p in enumerate(pieces))

    def comment(self, text, tags=(), indent=0):
        """A whole comment: paragraphs of text, then tags (`@param x ...`), which are Javadoc already."""
        space = " " * indent
        lines = []
        for i, paragraph in enumerate(text if isinstance(text, list) else self.inline(text).split("\n\n")):
            if i:
                lines += ["", "<p>" + paragraph.replace("\n", " ")]
            else:
                lines.append(paragraph.replace("\n", " "))
        if tags:
            lines += ["", *tags]
        out = [space + "/**"]
        for line in lines:
            wrapped = textwrap.wrap(line, 116 - indent, break_long_words=False, break_on_hyphens=False,
                                    subsequent_indent="    " if line.startswith("@") else "") or [""]
            out += [f"{space} * {part}".rstrip() for part in wrapped]
        return "\n".join(out + [space + " */"]) + "\n"

    def measure(self, item):
        """Unit, range and default of a field or parameter."""
        parts = []
        if item.get("unit") and item["unit"] != "1":
            parts.append(f"in {self.unit(item['unit'])}")
        if item.get("range"):
            parts.append(f"range {self.inline(item['range'])}")
        if item.get("default") is not None:
            parts.append(f"default {self.inline(item['default'])}")
        return parts

    def unit(self, unit):
        return {"pose": "m and rad", "pose^2": "the squares and products of m and rad", "sensor": "units of the sensor",
                "sensor^2": "squares of the sensor's units", "kind": "the unit of its kind"}.get(unit, self.inline(unit))

    def sentence(self, text):
        """A sentence: Javadoc's summary ends with a full stop."""
        text = text.strip()
        return text[:1].upper() + text[1:] + ("" if text.endswith((".", "!", "?")) else ".") if text else ""
