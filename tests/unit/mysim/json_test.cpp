// JSON: output in insertion order, exact round trips, and errors that name their position in the file.

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "mysim/base/json.h"
#include "tests/unit/helpers.h"
#include "tests/unit/temporary.h"

namespace crosscheck {
namespace {

using namespace testing_tools;
using JsonFile = InFolder;

TEST(Json, IsWrittenInTheOrderInWhichItWasBuilt) {
  Json json{{"b", 1}, {"a", {{"text", "x"}, {"none", nullptr}}}, {"null", {}}};
  json["list"].push_back(1.5);
  json["list"].push_back({{"k", true}});
  json["list"].push_back(Json::array());
  json["b"] = 2u;  // keeps its position
  EXPECT_EQ(dump(json), R"({"b":2,"a":{"text":"x","none":null},"null":null,"list":[1.5,{"k":true},[]]})");
  EXPECT_EQ(dump(json, 1),
            "{\n \"b\": 2,\n \"a\": {\n  \"text\": \"x\",\n  \"none\": null\n },\n \"null\": null,\n"
            " \"list\": [\n  1.5,\n  {\n   \"k\": true\n  },\n  []\n ]\n}");
  EXPECT_EQ(dump_in_lines(json),
            "{\n \"b\": 2,\n \"a\": {\"text\":\"x\",\"none\":null},\n \"null\": null,\n"
            " \"list\": [1.5,{\"k\":true},[]]\n}\n");
  json.erase("a");
  json.erase("nothing");
  json.update({{"list", "gone"}, {"c", Json::object()}});
  EXPECT_EQ(dump(json), R"({"b":2,"null":null,"list":"gone","c":{}})");
}

TEST(Json, TakesWhatFilesHold) {
  const std::vector<double> numbers{0.1, 1, -0.0, 1e-7, 1e22, std::nextafter(1.0, 2.0)};
  const std::pair<Json, const char*> cases[] = {
      {numbers, "[0.1,1.0,-0.0,1e-07,1e+22,1.0000000000000002]"},
      {std::span(numbers).first(2), "[0.1,1.0]"},
      {std::vector<std::array<int, 3>>{{0, 1, 2}, {2, 1, 3}}, "[[0,1,2],[2,1,3]]"},
      {std::vector<std::string>{"a", "b"}, R"(["a","b"])"},
      {Json::array({1, "two", 3.0, Json::array({4l})}), R"([1,"two",3.0,[4]])"},
      {std::numeric_limits<std::uint64_t>::max(), "18446744073709551615"},
      {std::numeric_limits<std::int64_t>::min(), "-9223372036854775808"},
      {char(1), "1"},
      {INFINITY, "null"},
      {std::string_view("tab\t, quote \", \xc3\xa9"), "\"tab\\t, quote \\\", \xc3\xa9\""},
      {std::string("\xff|"), "\"\xef\xbf\xbd|\""}};
  for (const auto& [json, text] : cases) EXPECT_EQ(dump(json), text);
}

TEST(JsonField, ReadsWhatWasWritten) {
  Random random(1);
  std::vector<double> numbers;
  for (int i = 0; i < 1000; ++i) numbers.push_back(std::ldexp(random.between(-1, 1), 40 * (i % 41) - 800));
  const Json json{{"numbers", numbers}, {"truth", true},          {"text", "\xe5\xbc\xb9"}, {"seed", ~0ull},
                  {"whole", -7},        {"three", Json::array()}, {"none", nullptr}};
  for (const int indent : {-1, 1, 2}) {
    const JsonField f = JsonField::parse(dump(json, indent), "f");
    EXPECT_EQ(f["numbers"].numbers(), numbers);
    EXPECT_TRUE(f["truth"].boolean());
    EXPECT_EQ(f["text"].text(), "\xe5\xbc\xb9");
    EXPECT_EQ(f["seed"].natural(), ~0ull);
    EXPECT_EQ(f["whole"].whole(), -7);
    EXPECT_EQ(f["whole"].number(), -7);
    EXPECT_TRUE(f["none"].is_null());
    EXPECT_FALSE(f.find("none"));
    EXPECT_FALSE(f.find("nothing"));
    EXPECT_EQ(f.size(), 7u);
    EXPECT_EQ(f.items()[2].first, "text");
    EXPECT_EQ(f.dump(indent), dump(json, indent));
  }
}

TEST(JsonField, OutlivesTheFileItStandsIn) {
  std::vector<JsonField> kept;
  for (const char* text : {R"({"a": ["first"]})", R"({"a": ["second"]})"})
    kept.push_back(JsonField::parse(text, "f")["a"][0]);
  EXPECT_EQ(kept[0].text(), "first");
  EXPECT_TRUE(contains(refusal_of([&] { kept[1].number(); }), "f: a[0]: expected a number, got \"second\""));
}

TEST(JsonField, OfKeysThatComeTwiceTheLastCounts) {
  EXPECT_EQ(JsonField::parse(R"({"a": 1, "b": 2, "a": 3})", "f").dump(), R"({"b":2,"a":3})");
  std::string many = "{";
  for (int i = 0; i < 100; ++i) many += fmt::format("\"k{}\": {}, ", i % 50, i);
  const JsonField f = JsonField::parse(many + "\"last\": 0}", "f");
  EXPECT_EQ(f.size(), 51u);
  for (int i = 0; i < 50; ++i) EXPECT_EQ(f[fmt::format("k{}", i)].whole(), i + 50);
}

TEST(JsonField, EveryErrorNamesFilePlaceAndWhatWasExpected) {
  const JsonField f =
      JsonField::parse(R"({"n": 1.5, "big": 18446744073709551615, "minus": -1, "text": "40", "yes": true,
    "none": null, "list": [1, [2, "x"], {"k": {"deep": [0, 0, false]}}], "x": [[1, 2, 3], [4, 5]], "y": [[1, 2, null]]})",
                       "dir/f.json");
  const struct {
    void (*look)(const JsonField&);
    const char* message;
  } cases[] = {
      {[](const JsonField& v) { v["m"]; }, "expected the key \"m\""},
      {[](const JsonField& v) { v["list"][2]["k"]["m"]; }, "list[2].k: expected the key \"m\""},
      {[](const JsonField& v) { v["n"]["m"]; }, "n: expected an object, got 1.5"},
      {[](const JsonField& v) { v["list"].find("m"); }, "list: expected an object, got a list of 3"},
      {[](const JsonField& v) { v["list"].items(); }, "list: expected an object, got a list of 3"},
      {[](const JsonField& v) { v.elements(); }, "expected a list, got an object"},
      {[](const JsonField& v) { v["list"][3]; }, "list: expected a list of 4 or more, got a list of 3"},
      {[](const JsonField& v) { v["n"][0]; }, "n: expected a list of 1 or more, got 1.5"},
      {[](const JsonField& v) { v["yes"].size(); }, "yes: expected a list or an object, got true"},
      {[](const JsonField& v) { v["text"].number(); }, "text: expected a number, got \"40\""},
      {[](const JsonField& v) { v["none"].number(); }, "none: expected a number, got null"},
      {[](const JsonField& v) { v["minus"].number_from(0); }, "minus: expected a number not below 0, got -1"},
      {[](const JsonField& v) { v["n"].whole_number(0, 9); }, "n: expected a whole number from 0 to 9, got 1.5"},
      {[](const JsonField& v) { v["minus"].whole_number(0, 9); }, "minus: expected a whole number from 0 to 9, got -1"},
      {[](const JsonField& v) { v["big"].whole_number(-9, -1); },
       "big: expected a whole number from -9 to -1, got 18446744073709551615"},
      {[](const JsonField& v) { v["big"].whole(); },
       "big: expected a whole number below 2^63, got 1844674407370955161"},
      {[](const JsonField& v) { v["n"].whole(); }, "n: expected a whole number below 2^63, got 1.5"},
      {[](const JsonField& v) { v["minus"].natural(); }, "minus: expected a whole number not below 0, got -1"},
      {[](const JsonField& v) { v["n"].boolean(); }, "n: expected true or false, got 1.5"},
      {[](const JsonField& v) { v["n"].text(); }, "n: expected a text, got 1.5"},
      {[](const JsonField& v) { v["n"].numbers(); }, "n: expected a list of numbers, got 1.5"},
      {[](const JsonField& v) { v["list"].numbers(); }, "list[1]: expected a number, got a list of 2"},
      {[](const JsonField& v) { v["list"][2]["k"]["deep"].numbers(); },
       "list[2].k.deep[2]: expected a number, got false"},
      {[](const JsonField& v) { v["list"][1].indices(2); }, "list[1][0]: expected a whole number from 0 to 1, got 2"},
      {[](const JsonField& v) { v["list"][1].texts(); }, "list[1][0]: expected a text, got 2"},
      {[](const JsonField& v) { v["x"].triples(3); }, "x: expected 3 triples of numbers, got a list of 2"},
      {[](const JsonField& v) { v["x"].triples(2); }, "x[1]: expected three numbers, got a list of 2"},
      {[](const JsonField& v) { v["y"].triples(1); }, "y[0][2]: expected a number, got null"},
      {[](const JsonField& v) { v["yes"].fail("a word"); }, "yes: expected a word, got true"},
  };
  for (const auto& [look, message] : cases)
    EXPECT_EQ(refusal_of([&] { look(f); }).substr(0, 12 + std::string_view(message).size()),
              fmt::format("dir/f.json: {}", message));
  // long texts are abbreviated
  const JsonField wordy = JsonField::parse(dump(std::string(1000, 'w')), "f");
  EXPECT_EQ(refusal_of([&] { wordy.number(); }), "f: expected a number, got \"" + std::string(60, 'w') + "\"...");
}

TEST(JsonField, WhatIsNoJsonIsToldWithLineAndColumn) {
  const std::pair<std::string, const char*> cases[] = {
      {"", "f: expected JSON; line 1, column 1: unexpected end of input"},
      {"{\n \"a\": inf\n}", "f: expected JSON; line 2, column 7: invalid literal; a: expected a finite number"},
      {"{\"steps\": NaN}", "f: expected JSON; line 1, column 11: invalid literal; steps: expected a finite number"},
      {"{\"a\": [1, {\"b\": -inf}]}",
       "f: expected JSON; line 1, column 18: invalid number; expected digit after '-'; a[1].b: expected a finite "
       "number"},
      {"{\"a\": {\"b\": [1, 1e999]}}",
       "f: expected JSON; line 1, column 21: number overflow parsing '1e999'; a.b[1]: expected a finite number"},
      {"{\"a\": tru}", "f: expected JSON; line 1, column 10: invalid literal"},
      {"{\"a\" 1}", "f: expected JSON; line 1, column 6: unexpected number literal; expected ':'"},
      {"[1, 2", "f: expected JSON; line 1, column 6: unexpected end of input; expected ']'"},
      {"[1]\n]", "f: expected JSON; line 2, column 1: unexpected ']'; expected end of input"},
      {"[1e999]", "f: expected JSON; line 1, column 6: number overflow parsing '1e999'; [0]: expected a finite number"},
      {"\"\xff\"", "f: expected JSON; line 1, column 2: invalid string: ill-formed UTF-8 byte"},
      {std::string(501, '['), "f: expected JSON; nested more than 500 levels deep"},
      {std::string(1 << 20, '['), "f: expected JSON; nested more than 500 levels deep"}};
  for (const auto& [text, message] : cases) {
    const std::string said = refusal_of([&] { JsonField::parse(text, "f"); });
    EXPECT_TRUE(begins(said, message)) << said;
    EXPECT_EQ(said.find("json.exception"), std::string::npos) << said;
  }
  EXPECT_NO_THROW(JsonField::parse(std::string(500, '[') + std::string(500, ']'), "f"));
}

TEST_F(JsonFile, IsOneObject) {
  EXPECT_EQ(JsonField::parse_file(write("f.json", R"({"a": 1})"))["a"].whole(), 1);
  const std::string file = (folder_ / "f.json").string();
  const std::pair<const char*, const char*> cases[] = {
      {"", "one JSON object; line 1, column 1: unexpected end of input"}, {"[1]", "one JSON object, got a list of 1"}};
  for (const auto& [text, message] : cases)
    EXPECT_TRUE(begins(refusal_of([&] { JsonField::parse_file(write("f.json", text)); }),
                       fmt::format("{}: expected {}", file, message)));
  for (const auto& missing : {folder_ / "none.json", folder_})
    EXPECT_EQ(refusal_of([&] { JsonField::parse_file(missing); }),
              fmt::format("{}: cannot be read; expected a JSON file", missing.string()));
}

}  // namespace
}  // namespace crosscheck
