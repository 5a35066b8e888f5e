// SPDX-License-Identifier: BSD-3-Clause
// Reading a command line: which variable each word sets, and which words are refused.
#include "program/options/parse.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "program/usage_error.hpp"

using namespace cairn::program;
using cairn::options::from_to;
using cairn::options::kFinite;
using cairn::options::kNotNegative;
using cairn::options::kPositive;
using cairn::options::kProbability;
using cairn::options::kProbabilityBelowOne;

namespace {

// Targets of one option of each kind.
struct Targets {
  bool quiet = false;
  double speed = 1.5;
  std::optional<double> gate;
  std::uint32_t runs = 1;
  std::optional<std::uint32_t> landmarks;
  std::int32_t course = 0;
  std::optional<std::int32_t> join;
  std::vector<std::string> words, order;

  std::vector<OptionGroup> groups() {
    OptionGroup first{"first", "First", {}};
    first.options = {flag({"--quiet", "", "", ""}, quiet), number({"--speed", "M_S", "", ""}, kPositive, speed),
                     number({"--gate", "P", "", ""}, kProbability, 0.99, gate)};
    first.options[0].alias = "-q";
    OptionGroup second{"second", "Second", {}};
    second.options = {whole({"--runs", "N", "", ""}, 1, 10, runs),
                      whole({"--landmarks", "N", "", ""}, 0, 4294967295u, 0, landmarks),
                      choice({"--course", "NAME", "", ""}, {"circle", "laps", "traverse"}, course),
                      choice({"--join", "WAY", "", ""}, {"dense", "sparse"}, {7, 9}, join),
                      custom({"--note", "TEXT", "", ""}, [this](const std::string& v) { order.push_back(v); })};
    return {first, second};
  }
  void read(const std::vector<std::string>& arguments, const char* first = nullptr) {
    parse(
        arguments, groups(), "run", [this](const std::string& word) { words.push_back(word); }, first);
  }
  std::string refusal(const std::vector<std::string>& arguments) {
    try {
      read(arguments);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  }
};

}  // namespace

TEST_CASE("options: each kind sets its variable, by the next word or behind an equals sign") {
  Targets t;
  t.read({"a", "--quiet", "--speed", "2.5", "--gate=1", "b", "--runs=10", "--landmarks", "4", "--course=traverse",
          "--join=sparse"});
  CHECK(t.quiet);
  CHECK(t.speed == 2.5);
  CHECK(t.gate == 1.0);
  CHECK(t.runs == 10);
  CHECK(t.landmarks == 4u);
  CHECK(t.course == 2);
  CHECK(t.join == 9);
  CHECK(t.words == std::vector<std::string>{"a", "b"});
}

TEST_CASE("options: what is not given keeps its value") {
  Targets t;
  t.read({});
  CHECK(!t.quiet);
  CHECK(t.speed == 1.5);
  CHECK(!t.gate.has_value());
  CHECK(!t.join.has_value());
}

TEST_CASE("options: two hyphens end them, a single hyphen is a word, an alias counts") {
  Targets t;
  t.read({"-q", "-", "--", "--speed", "-q"});
  CHECK(t.quiet);
  CHECK(t.words == std::vector<std::string>{"-", "--speed", "-q"});
}

TEST_CASE("options: the later one counts, but the first one of all is set before") {
  Targets t;
  t.read({"--runs=2", "--note=a", "--runs=3", "--note=b"}, "--note");
  CHECK(t.runs == 3);
  CHECK(t.order == std::vector<std::string>{"a", "b"});
}

TEST_CASE("options: a refusal names the option, the value and what is expected") {
  Targets t;
  CHECK(t.refusal({"--frob=1"}) == "unknown option '--frob' (see cairn run --help)");
  CHECK(t.refusal({"--quiet=1"}) == "option --quiet takes no value");
  CHECK(t.refusal({"--speed"}) == "option --speed needs a value");
  CHECK(t.refusal({"--speed=0"}) == "option --speed: '0' is not a number above 0");
  CHECK(t.refusal({"--speed=nan"}) == "option --speed: 'nan' is not a number above 0");
  CHECK(t.refusal({"--speed=inf"}) == "option --speed: 'inf' is not a number above 0");
  CHECK(t.refusal({"--speed=2x"}) == "option --speed: '2x' is not a number above 0");
  CHECK(t.refusal({"--gate=0"}) == "option --gate: '0' is not a probability above 0, up to 1");
  CHECK(t.refusal({"--gate", "1.1"}) == "option --gate: '1.1' is not a probability above 0, up to 1");
  CHECK(t.refusal({"--runs=11"}) == "option --runs: '11' is not a whole number from 1 to 10");
  CHECK(t.refusal({"--runs=-1"}) == "option --runs: '-1' is not a whole number from 1 to 10");
  CHECK(t.refusal({"--landmarks=1.5"}) == "option --landmarks: '1.5' is not a whole number of 0 or more");
  CHECK(t.refusal({"--course=square"}) == "option --course: 'square' is not circle, laps or traverse");
  CHECK(t.speed == 1.5);
}

TEST_CASE("options: words are told from values of options") {
  Targets t;
  const std::vector<OptionGroup> groups = t.groups();
  CHECK(words_of({"--speed", "1", "usv", "--quiet", "mars", "-q", "x"}, groups) ==
        std::vector<std::string>{"usv", "mars", "x"});
  CHECK(words_of({"--speed=1", "usv"}, groups) == std::vector<std::string>{"usv"});
  CHECK(words_of({"--unknown", "usv"}, groups).empty());
  CHECK(words_of({"--", "usv"}, groups) == std::vector<std::string>{"usv"});
}

TEST_CASE("options: bounds contain what they say, and never NaN") {
  CHECK((!kPositive.contain(0) && kPositive.contain(1e-300) && !kPositive.contain(cairn::options::kInfinity)));
  CHECK((kNotNegative.contain(0) && kNotNegative.contain(-0.0) && !kNotNegative.contain(-1e-300)));
  CHECK((kProbability.contain(1) && !kProbabilityBelowOne.contain(1) && !kProbabilityBelowOne.contain(0)));
  CHECK((from_to(1, 5).contain(1) && from_to(1, 5).contain(5) && !from_to(1, 5).contain(5.1)));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& bounds : {kPositive, kNotNegative, kProbability, kFinite, from_to(1, 5)})
    CHECK(!bounds.contain(nan));
}

TEST_CASE("options: the words between commas") {
  using Words = std::vector<std::string>;
  CHECK(split("1") == Words{"1"});
  CHECK(split("1,-2,x y") == Words{"1", "-2", "x y"});
  CHECK(split("") == Words{""});
  CHECK(split(",1,,2,") == Words{"", "1", "", "2", ""});
}
