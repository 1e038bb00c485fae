#include "support/catch.hpp"

#include <fmt/format.h>

#include "pipeline/document.hpp"

using namespace facetmill;
using pipeline::emit_yaml;
using pipeline::parse_yaml;

namespace {

/// All that is wrong with the text, rendered, one after the other.
std::string problems_of(const std::string& text) {
    Problems problems;
    parse_yaml(std::make_shared<const SourceText>(SourceText{"p.yaml", text}), problems);
    std::string all;
    for (const auto& d : problems.all()) all += (all.empty() ? "" : "\n") + render(d);
    return all;
}

Value parsed(const std::string& text) {
    Problems problems;
    Value value = parse_yaml(std::make_shared<const SourceText>(SourceText{"p.yaml", text}), problems);
    for (const auto& d : problems.all()) FAIL(render(d));
    return value;
}

/// The tree on a single line for comparison: quoted scalars in quotes, without positions.
std::string shown(const Value& value) {
    std::string out;
    switch (value.kind) {
    case Value::Kind::null:
        return "null";
    case Value::Kind::scalar:
        return value.quoted ? fmt::format("\"{}\"", value.text) : value.text;
    case Value::Kind::list:
        for (const auto& item : value.items) out += (out.empty() ? "" : ", ") + shown(item);
        return fmt::format("[{}]", out);
    case Value::Kind::map:
        for (const auto& e : value.entries) out += (out.empty() ? "" : ", ") + e.key + ": " + shown(e.value);
        return fmt::format("{{{}}}", out);
    }
    return out;
}

std::string place(const Value* value) {
    REQUIRE(value);
    return to_string(value->mark) + "+" + std::to_string(value->mark.length);
}

} // namespace

TEST_CASE("scalars, lists and maps keep their order and quotes", "[pipeline]") {
    CHECK(shown(parsed("b: 1\na: [x, 'y', \"z\", null, ~]\nc:\n")) ==
          R"({b: 1, a: [x, "y", "z", null, null], c: null})");
    CHECK(shown(parsed("")) == "null");
    CHECK(shown(parsed("# only a comment\n")) == "null");
    CHECK(shown(parsed("text: |\n  one\n  two\n")) == "{text: \"one\ntwo\n\"}");
    CHECK(parsed("a: 010").find("a")->as_integer() == 10);
    CHECK(parsed("a: yes").find("a")->as_bool() == std::nullopt);
}

TEST_CASE("marks are in characters and underline what was written", "[pipeline]") {
    const Value v = parsed("é: {a: 'x y', ü: 12}\r\nlist:\n  - one # comment\n  - &n two\nempty:\n");
    CHECK(place(v.find("é")) == "p.yaml:1:4+1");
    CHECK(place(v.find("é")->find("a")) == "p.yaml:1:8+5");
    CHECK(place(v.find("é")->find("ü")) == "p.yaml:1:18+2");
    CHECK(place(&v.find("list")->items[0]) == "p.yaml:3:5+3");
    CHECK(place(&v.find("list")->items[1]) == "p.yaml:4:8+3");
    CHECK(place(v.find("empty")) == "p.yaml:5:1+5");
    CHECK(place(parsed("\xEF\xBB\xBF"
                       "a: b")
                    .find("a")) == "p.yaml:1:5+1");
}

TEST_CASE("an alias has its own place and its content's", "[pipeline]") {
    const Value v = parsed("x: &cut {cap: true}\ny: *cut\n");
    CHECK(shown(v) == "{x: {cap: true}, y: {cap: true}}");
    CHECK(place(v.find("y")) == "p.yaml:2:4+4");
    CHECK(to_string(v.find("y")->anchor) == "p.yaml:1:9");
    CHECK_FALSE(v.find("x")->anchor.known());
}

TEST_CASE("merge keys: the map's own keys win, then the earlier of several", "[pipeline]") {
    const std::string base = "a: &a {p: 1, q: 2}\nb: &b {q: 3, r: 4}\n";
    CHECK(shown(*parsed(base + "c: {<<: *a, q: 9}").find("c")) == "{q: 9, p: 1}");
    CHECK(shown(*parsed(base + "c: {<<: [*a, *b]}").find("c")) == "{p: 1, q: 2, r: 4}");
    CHECK(problems_of(base + "c:\n  <<: *a\n  <<: *b\n") ==
          "p.yaml:5:3: error[E-DUPLICATE]: the key '<<' occurs twice\n"
          "    <<: *b\n"
          "    ^~\n"
          "  hint: several maps are merged by <<: [*a, *b]");
    CHECK(shown(*parsed("c: {'<<': 1}").find("c")) == "{<<: 1}");
}

TEST_CASE("core tags are understood", "[pipeline]") {
    CHECK(shown(parsed("a: !!str 12\nb: !!int '12'\nc: !!map {d: 1}\ne: ! 3\n")) ==
          R"({a: "12", b: 12, c: {d: 1}, e: "3"})");
}

TEST_CASE("what is wrong with a text is said with its place and a hint", "[pipeline]") {
    struct Case {
        std::string text, problem;
    };
    const Case cases[] = {
        {"a: 1\nb: 2\na: 3\n", "p.yaml:3:1: error[E-DUPLICATE]: the key 'a' occurs twice\n"
                               "  a: 3\n"
                               "  ^\n"
                               "  hint: the first is at p.yaml:1:1"},
        {"s: {a: 1, a: 2}\n", "p.yaml:1:11: error[E-DUPLICATE]: the key 'a' occurs twice\n"
                              "  s: {a: 1, a: 2}\n"
                              "            ^\n"
                              "  hint: the first is at p.yaml:1:5"},
        {"- clip: {grid: ${n}, cap: true}\n",
         "p.yaml:1:16: error[E-UNQUOTED]: inside {} and [] an expression must be quoted, found ${n}\n"
         "  - clip: {grid: ${n}, cap: true}\n"
         "                 ^~~~\n"
         "  hint: write \"${n}\""},
        {"lods: [${a}, 3]\n",
         "p.yaml:1:8: error[E-UNQUOTED]: inside {} and [] an expression must be quoted, found ${a}\n"
         "  lods: [${a}, 3]\n"
         "         ^~~~\n"
         "  hint: write \"${a}\""},
        {"w: {path: out/${x.stem}.glb}\n", "p.yaml:1:11: error[E-UNQUOTED]: inside {} and [] an expression "
                                           "must be quoted, found out/${x.stem}.glb\n"
                                           "  w: {path: out/${x.stem}.glb}\n"
                                           "            ^~~~~~~~~~~~~~~~~\n"
                                           "  hint: write \"out/${x.stem}.glb\""},
        {"a: {b: ${c}, d: 1}\ne: [${f}]\ng: 1\ng: 2\n",
         "p.yaml:1:8: error[E-UNQUOTED]: inside {} and [] an expression must be quoted, found ${c}\n"
         "  a: {b: ${c}, d: 1}\n"
         "         ^~~~\n"
         "  hint: write \"${c}\"\n"
         "p.yaml:2:5: error[E-UNQUOTED]: inside {} and [] an expression must be quoted, found ${f}\n"
         "  e: [${f}]\n"
         "      ^~~~\n"
         "  hint: write \"${f}\"\n"
         "p.yaml:4:1: error[E-DUPLICATE]: the key 'g' occurs twice\n"
         "  g: 2\n"
         "  ^\n"
         "  hint: the first is at p.yaml:3:1"},
        {"a: 1\n---\nb: 2\n", "p.yaml:2:1: error[E-YAML]: a second document begins here\n"
                              "  ---\n"
                              "  ^\n"
                              "  hint: one file holds one pipeline; remove the '---' or make two files"},
        {"a: !thing 3\n", "p.yaml:1:4: error[E-YAML]: the tag !thing is not supported here\n"
                          "  a: !thing 3\n"
                          "     ^~~~~~\n"
                          "  hint: leave it out; a text that begins with ! is quoted: \"!thing\""},
        {"a: 1\nonly: !eye*\nb: 2\n", "p.yaml:2:7: error[E-YAML]: the tag !eye* is not supported here\n"
                                      "  only: !eye*\n"
                                      "        ^~~~~\n"
                                      "  hint: leave it out; a text that begins with ! is quoted: \"!eye*\""},
        {"<<: 3\n", "p.yaml:1:1: error[E-YAML]: '<<' merges a map or a list of maps, found '3'\n"
                    "  <<: 3\n"
                    "  ^~\n"
                    "  hint: write it as <<: *name, with &name at the map to merge"},
        {"? [a, b]\n: 1\n", "p.yaml:1:3: error[E-YAML]: a key must be a text, found a list of 2\n"
                            "  ? [a, b]\n"
                            "    ^"},
        {"a: &x [*x]\n", "p.yaml:1:8: error[E-YAML]: an alias inside its own content\n"
                         "  a: &x [*x]\n"
                         "         ^~"},
        {"a: {b: 1\nc: 2\n", "p.yaml:2:2: error[E-YAML]: expected ',' or '}' here\n"
                             "  c: 2\n"
                             "   ^\n"
                             "  hint: the bracket at line 1, column 4 is not closed"},
        {"a: {b: 1 c: 2}\n", "p.yaml:1:11: error[E-YAML]: expected ',' or '}' here\n"
                             "  a: {b: 1 c: 2}\n"
                             "            ^\n"
                             "  hint: a text with special characters must be quoted"},
        {"a: b: c\n", "p.yaml:1:5: error[E-YAML]: unexpected ':'\n"
                      "  a: b: c\n"
                      "      ^\n"
                      "  hint: quote texts that contain ': ', and check the indentation"},
        {"- relax\n  when: true\n",
         "p.yaml:2:7: error[E-YAML]: unexpected ':'\n"
         "    when: true\n"
         "        ^\n"
         "  hint: a stage with more keys needs a colon: write '- relax:' in the line above"},
        {"s:\n- a: \"scan.ply\n- b: 1\n", "p.yaml:2:6: error[E-YAML]: the quote is never closed\n"
                                          "  - a: \"scan.ply\n"
                                          "       ^\n"
                                          "  hint: close the quote on the same line"},
        {"s:\n- a: 'it''s\n- b: 1\n", "p.yaml:2:6: error[E-YAML]: the quote is never closed\n"
                                      "  - a: 'it''s\n"
                                      "       ^\n"
                                      "  hint: close the quote on the same line"},
        {"s:\n- a: \"x\n- b: \"y\"\n",
         "p.yaml:3:7: error[E-YAML]: expected a key of the map here\n"
         "  - b: \"y\"\n"
         "        ^\n"
         "  hint: this quote closes the quote that opens in line 2: close that quote in its own line"},
        {"a: 'it's.glb'\n", "p.yaml:1:8: error[E-YAML]: expected a key of the map here\n"
                            "  a: 'it's.glb'\n"
                            "         ^\n"
                            "  hint: inside '...' a ' is written '', or take \"...\""},
        {"s:\n\t- a: 1\n", "p.yaml:2:2: error[E-YAML]: unexpected list item ('- ...')\n"
                           "  \t- a: 1\n"
                           "  \t^\n"
                           "  hint: indent with spaces: YAML does not allow tabs there"},
        {"a: %10\n", "p.yaml:1:4: error[E-YAML]: a value cannot begin with '%'\n"
                     "  a: %10\n"
                     "     ^\n"
                     "  hint: write 10%"},
        {"a: {b: *.ply, c: 1}\n", "p.yaml:1:8: error[E-YAML]: no anchor is named by '*.ply'\n"
                                  "  a: {b: *.ply, c: 1}\n"
                                  "         ^\n"
                                  "  hint: in quotes it is a text: \"*.ply\""},
        {"a: **/*.ply # all\n", "p.yaml:1:4: error[E-YAML]: no anchor is named by '**/*.ply'\n"
                                "  a: **/*.ply # all\n"
                                "     ^\n"
                                "  hint: in quotes it is a text: \"**/*.ply\""},
        {"a: @x\n", "p.yaml:1:4: error[E-YAML]: a value cannot begin with '@'\n"
                    "  a: @x\n"
                    "     ^\n"
                    "  hint: in quotes it is a text: \"@x\""},
        {std::string("a: \0", 4),
         "p.yaml:1:4: error[E-YAML]: a pipeline cannot contain the control character 0x00\n"
         "  hint: a pipeline is a text in UTF-8"},
        {"a: b\xFFz\n", "p.yaml:1:5: error[E-YAML]: the byte 0xff is not UTF-8\n"
                        "  hint: a pipeline is a text in UTF-8"},
    };
    for (const auto& c : cases) {
        const std::string found = problems_of(c.text);
        if (c.text.find('\0') == std::string::npos && c.text.find('\xFF') == std::string::npos)
            CHECK(found == c.problem);
        else
            CHECK(found.substr(0, found.find('\n')) == c.problem.substr(0, c.problem.find('\n')));
    }
}

TEST_CASE("expansion is bounded", "[pipeline]") {
    std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
    for (int i = 1; i < 12; ++i) {
        const std::string before = "*a" + std::to_string(i - 1);
        bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + before;
        for (int k = 0; k < 9; ++k) bomb += ", " + before;
        bomb += "]\n";
    }
    CHECK(problems_of(bomb).starts_with(
        "p.yaml:5:45: error[E-EXPANSION]: with all aliases expanded, the file has more than 100000 values"));
    CHECK(problems_of(std::string(5000, '[')).find("nested more than 64 levels deep") != std::string::npos);
    std::string deep = "a0: &a0 [x]\n";
    for (int i = 1; i < 80; ++i)
        deep += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [*a" + std::to_string(i - 1) + "]\n";
    CHECK(problems_of(deep).find("nested more than 64 levels deep") != std::string::npos);
    CHECK(problems_of(std::string(5 << 20, 'x')).find("a pipeline of 5242880 bytes is too large") !=
          std::string::npos);
}

TEST_CASE("emitted YAML reads back to the same content", "[pipeline]") {
    const std::string text = "facetmill: 1\n"
                             "about: \"A: it's \\\"odd\\\", #1\"\n"
                             "params:\n"
                             "  keep: {type: ratio, default: 10%}\n"
                             "stages:\n"
                             "  - load: \"${input}\"\n"
                             "  - clip: {plane: {normal: [0, 0, 1], through: centre}, cap: true}\n"
                             "    name: cut\n"
                             "  - orient\n"
                             "  - foreach: {lod: [50%, 25%]}\n"
                             "    do:\n"
                             "      - simplify: \"${lod}\"\n"
                             "      - write: \"${input.stem}.${lod.index}.glb\"\n";
    const Value value = parsed(text);
    CHECK(emit_yaml(value) == text);
    Value odd = Value::map({});
    for (const char* key : {"",    "null", "true",  "- a",    "a: b",       "a #b",  "@x",   "%y", "*z",
                            "[1]", "{a}",  " lead", "trail ", "two\nlines", "tab\t", "é",    "<<", "-",
                            "...", "---",  "?",     "'",      "\"",         "\\",    "0x1F", "1e5"})
        odd.set(key, Value::scalar(key));
    odd.set("empty list", Value::list({}));
    odd.set("empty map", Value::map({}));
    odd.set("nothing", Value{});
    odd.set("nested", Value::list({Value::list({Value::map({{"a", {}, Value::scalar("1")}})}), Value::map({}),
                                   Value{}}));
    CHECK(same_content(parsed(emit_yaml(odd)), odd));
}
