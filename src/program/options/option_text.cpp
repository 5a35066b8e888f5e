// SPDX-License-Identifier: BSD-3-Clause
#include "program/options/option_text.hpp"

#include <algorithm>
#include <cctype>

namespace cairn::program {
namespace {

constexpr std::size_t kHelpWidth = 110, kHelpIndent = 26, kManualWidth = 120;

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words(1);
  for (const char c : text) {
    if (c == ' ')
      words.emplace_back();
    else
      words.back() += c;
  }
  return words;
}

std::string without_marks(std::string text) {
  text.erase(std::remove(text.begin(), text.end(), '`'), text.end());
  return text;
}

// A word for a value, such as DIR, is replaced by the user; others, such as json, are typed as they are.
bool is_placeholder(const std::string& value) {
  return std::isupper(static_cast<unsigned char>(value[0])) != 0;
}

// Adds the escapes that roff needs: hyphens of options are minus signs.
std::string escaped(const std::string& text, bool literal) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-' && literal)
      out += "\\-";
    else
      out += c;
  }
  return out;
}

// The words of a text in roff: `words` in backquotes bold, the word for the value italic.
std::vector<std::string> roff_words(const std::string& text, const std::string& value) {
  std::vector<std::string> words;
  bool bold = false;
  for (const std::string& word : words_of(text)) {
    std::string out;
    if (bold) out += "\\fB";
    std::string part;
    const auto flush = [&] {
      const bool italic = !bold && !value.empty() && part == value;
      out += italic ? "\\fI" + part + "\\fP" : escaped(part, bold);
      part.clear();
    };
    for (const char c : word) {
      if (c == '`') {
        flush();
        bold = !bold;
        out += bold ? "\\fB" : "\\fP";
      } else if (!bold && !std::isalnum(static_cast<unsigned char>(c)) && c != '_') {
        flush();
        out += c == '\\' ? std::string("\\e") : std::string(1, c);
      } else {
        part += c;
      }
    }
    flush();
    if (bold) out += "\\fP";
    words.push_back(out);
  }
  return words;
}

// Each sentence begins on a new line; long sentences are broken.
std::string roff_lines(const std::string& text, const std::string& value) {
  std::string out, line;
  const auto end_line = [&] {
    if (!line.empty()) out += (line[0] == '.' || line[0] == '\'' ? "\\&" : "") + line + "\n";
    line.clear();
  };
  for (const std::string& word : roff_words(text, value)) {
    if (!line.empty() && line.size() + 1 + word.size() > kManualWidth) end_line();
    line += (line.empty() ? "" : " ") + word;
    if (word.back() == '.') end_line();
  }
  end_line();
  return out;
}

std::string roff_name(const Option& option) {
  const std::string name = escaped(option.name, true);
  if (!option.alias.empty()) return ".BR " + escaped(option.alias, true) + " \", \" " + name + "\n";
  if (!option.takes_value()) return ".B " + name + "\n";
  if (!is_placeholder(option.value)) return ".B " + name + " " + escaped(option.value, true) + "\n";
  return ".BI " + name + " \" " + option.value + "\"\n";
}

std::string help_lines(const std::string& head, const std::string& text) {
  std::string out, line = head;
  if (line.size() + 2 <= kHelpIndent) {
    line.resize(kHelpIndent, ' ');
  } else {
    out = line + "\n";
    line.assign(kHelpIndent, ' ');
  }
  for (const std::string& word : words_of(without_marks(text))) {
    const bool begun = line.size() > kHelpIndent;
    if (begun && line.size() + 1 + word.size() > kHelpWidth) {
      out += line + "\n";
      line = std::string(kHelpIndent, ' ') + word;
    } else {
      line += (begun ? " " : "") + word;
    }
  }
  return out + line + "\n";
}

}  // namespace

std::string help_text(const OptionGroup& group) {
  std::string out = group.title + ":\n";
  for (const Option& option : group.options) {
    const std::string alias = option.alias.empty() ? "" : option.alias + ", ";
    out += help_lines("  " + alias + option.name + (option.takes_value() ? " " : "") + option.value, option.text);
  }
  return out;
}

std::string manual_text(const OptionGroup& group) {
  std::string out;
  for (const Option& option : group.options) {
    out += ".TP\n" + roff_name(option) + roff_lines(option.text, option.value);
    if (!option.more.empty()) out += roff_lines(option.more, option.value);
  }
  return out;
}

}  // namespace cairn::program
