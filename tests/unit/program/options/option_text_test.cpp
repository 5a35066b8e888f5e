// SPDX-License-Identifier: BSD-3-Clause
// The texts of an option in --help and on the manual page.
#include "program/options/option_text.hpp"

#include <doctest/doctest.h>

using namespace cairn::program;
using namespace cairn::options;

namespace {

OptionGroup group_of(Option option) {
  return {"key", "Title", {std::move(option)}};
}

}  // namespace

TEST_CASE("option text: values of the option stand for the words in braces") {
  std::uint32_t runs = 3;
  double angle = 3.14159265358979323846 / 3, speed = 0.25;
  std::optional<double> gate;
  CHECK(whole({"--runs", "N", "{lower} {upper} {default}", "{default}"}, 1, 10000000, runs).text == "1 10000000 3");
  CHECK(whole({"--runs", "N", "", "{default}"}, 1, 9, runs).more == "3");
  CHECK(number({"--angle", "RAD", "{default_degrees}", ""}, kPositive, angle).text == "60 degrees");
  CHECK(number({"--speed", "M_S", "{default}", ""}, kPositive, speed).text == "0.25");
  CHECK(number({"--gate", "P", "{default}", ""}, kProbability, 0.9999, gate).text == "0.9999");
}

TEST_CASE("option text: help has the name, then the text without marks") {
  std::uint32_t runs = 1;
  bool quiet = false;
  CHECK(help_text(group_of(whole({"--runs", "N", "Run `N` worlds.", "More."}, 1, 9, runs))) ==
        "Title:\n  --runs N                Run N worlds.\n");
  Option help = flag({"--help", "", "Print.", ""}, quiet);
  help.alias = "-h";
  CHECK(help_text(group_of(help)) == "Title:\n  -h, --help              Print.\n");
  const std::string indent(26, ' ');
  CHECK(help_text(group_of(whole({"--a-name-that-is-long", "NUMBER", "Text.", ""}, 1, 9, runs))) ==
        "Title:\n  --a-name-that-is-long NUMBER\n" + indent + "Text.\n");
}

TEST_CASE("option text: help breaks long texts between words") {
  bool quiet = false;
  std::string text;
  for (int i = 0; i < 40; ++i) text += (i > 0 ? " word" : "word");
  const std::string help = help_text(group_of(flag({"--quiet", "", text.c_str(), ""}, quiet)));
  std::size_t begin = help.find('\n') + 1, words = 0;
  while (begin < help.size()) {
    const std::size_t end = help.find('\n', begin);
    CHECK(end - begin <= 110);
    for (std::size_t at = help.find("word", begin); at < end; at = help.find("word", at + 1)) ++words;
    begin = end + 1;
  }
  CHECK(words == 40);
}

TEST_CASE("option text: the manual page has a sentence a line, bold and italic words, and escapes") {
  std::uint32_t runs = 1;
  bool quiet = false;
  CHECK(manual_text(group_of(
            whole({"--runs-of", "N", "Run N worlds, not (N). See `--seed-of N` and a-b.", "More."}, 1, 9, runs))) ==
        ".TP\n.BI \\-\\-runs\\-of \" N\"\nRun \\fIN\\fP worlds, not (\\fIN\\fP).\n"
        "See \\fB\\-\\-seed\\-of\\fP \\fBN\\fP and a-b.\nMore.\n");
  CHECK(manual_text(group_of(flag({"--quiet", "", ".5 \\ no", ""}, quiet))) == ".TP\n.B \\-\\-quiet\n\\&.5 \\e no\n");
  CHECK(manual_text(group_of(custom({"--summary", "json", "Text", ""}, [](const std::string&) {}))) ==
        ".TP\n.B \\-\\-summary json\nText\n");
}
