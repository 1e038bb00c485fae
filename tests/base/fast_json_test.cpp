#include "base/fast_json.hpp"

#include "base/math/random.hpp"
#include "parallel/allocation_cap.hpp"

#include "support/catch.hpp"

#include <array>
#include <bit>
#include <fmt/format.h>
#include <limits>

using namespace facetmill;

namespace {

/// Whether both are the same to their types: numbers of different types are equal for the library.
bool same(const Json& a, const Json& b) {
    if (a.type() != b.type() || a.size() != b.size()) return false;
    if (a.is_object())
        return std::equal(
            a.items().begin(), a.items().end(), b.items().begin(),
            [](const auto& x, const auto& y) { return x.key() == y.key() && same(x.value(), y.value()); });
    if (a.is_array()) return std::equal(a.begin(), a.end(), b.begin(), same);
    return a == b && a.dump() == b.dump();
}

Json by_library(std::string_view text) { return Json::parse(text.begin(), text.end(), nullptr, false); }

std::string nested(int levels) {
    return std::string(static_cast<std::size_t>(levels), '[') +
           std::string(static_cast<std::size_t>(levels), ']');
}

constexpr const char* document =
    R"({"asset": {"version": "2.0"}, "scene": 0, "nodes": [{"name": "a\"\u00fc\n\\", "mesh": 0,)"
    R"( "translation": [0.1, -2.5e-3, 1E+7]}, {"extras": {"x": null, "y": [true, false, -12, "é"]}}],)"
    R"( "bufferViews": [], "big": [18446744073709551615, -9223372036854775808, 1e308], "empty": {} })";

} // namespace

TEST_CASE("JSON is read as the library reads it", "[base]") {
    for (const std::string text : {document,
                                   "{}",
                                   "[]",
                                   " [ ] \n",
                                   "0",
                                   "-0",
                                   "-0.0",
                                   "1.5",
                                   "12345678901234567890",
                                   "18446744073709551616",
                                   "-9223372036854775809",
                                   "9007199254740993.0",
                                   "0.1",
                                   "5e-324",
                                   "1e5",
                                   "null",
                                   " true\t",
                                   "\"\"",
                                   R"("\ud83d\ude00 \/")",
                                   "\"\xc3\xa9\"",
                                   R"({"a": 1, "b": {"c": 2}, "a": {"b": 3}, "b": 4, "a": []})",
                                   R"({"": {"a": [[], {}, [{}]]}})"}) {
        INFO(text);
        const auto read = fast_json(text);
        REQUIRE(read);
        CHECK(same(*read, by_library(text)));
    }
    CHECK(fast_json(nested(256)));
    CHECK_FALSE(fast_json(nested(257)));
    CHECK_FALSE(fast_json("[[]]", 1));
}

TEST_CASE("unread members are as strict and come out empty", "[base]") {
    constexpr std::array<std::string_view, 2> unread{"u", "w"};
    const auto read = fast_json(
        R"({"a": [1], "u": [{"u": [2]}, "\u00e9"], "v": {"u": [3]}, "w": {"x": 1}, "u": [4]})", 256, unread);
    REQUIRE(read);
    CHECK(same(*read, by_library(R"({"a": [1], "u": [], "v": {"u": [3]}, "w": {}})")));
    CHECK(same(fast_json(R"({"u": 1.5, "w": "x"})", 256, unread).value(),
               by_library(R"({"u": 1.5, "w": "x"})")));
    CHECK(fast_json("{\"u\": " + nested(255) + "}", 256, unread));
    CHECK_FALSE(fast_json("{\"u\": " + nested(256) + "}", 256, unread));
    for (const std::string text :
         {"[1,]", "[1 2]", "{\"a\" 1}", "{\"a\": 1,}", "{1: 1}", "[01]", "[1e400]", "[\"\xff\"]",
          "[\"a\nb\"]", "{\"\\x\": 1}", "[nul]", "[}", "{\"a\": 1]", "["}) {
        INFO(text);
        CHECK_FALSE(fast_json("{\"u\": " + text + "}", 256, unread));
    }
}

TEST_CASE("what only the library reads is left to it", "[base]") {
    const std::string marked = "\xef\xbb\xbf{}";
    CHECK_FALSE(fast_json(marked));
    CHECK_FALSE(by_library(marked).is_discarded());
    CHECK(same(parse_json(marked), by_library(marked)));
    CHECK(same(parse_json("1e-400"), by_library("1e-400"))); // left to it by some standard libraries only
}

TEST_CASE("a key that is there again gives its value to the first, also of many", "[base]") {
    for (const std::size_t count : {std::size_t{31}, std::size_t{32}, std::size_t{33}, std::size_t{200}}) {
        std::string text;
        for (std::size_t i = 0; i < count; ++i) // two thirds of the keys are different ones
            text += fmt::format("{}\"a key that is long {}\": {}", i ? "," : "{",
                                hashed(i, 5) % (count * 2 / 3), i);
        const auto read = fast_json(text + "}");
        REQUIRE(read);
        CHECK(read->size() < count);
        CHECK(same(*read, by_library(text + "}")));
    }
}

TEST_CASE("many members are read in their number, not in its square", "[base]") {
    std::string text; // a million: as a square, an hour
    for (std::size_t i = 0; i < 1'000'000; ++i) text += fmt::format("{}\"{}\":0", i ? "," : "{", i);
    const auto read = fast_json(text + "}");
    REQUIRE(read);
    CHECK(read->size() == 1'000'000);
    CHECK(parse_json(text, Broken::discarded).is_discarded()); // truncated, which the parser reports
    CHECK_THROWS_AS(parse_json(text + "]"), Json::parse_error);
}

TEST_CASE("what is no JSON is refused", "[base]") {
    for (const std::string text :
         {"",         " ",       "{",           "}",           "[1,]",     "[1 2]",    "{\"a\" 1}",
          "{\"a\":}", "{a: 1}",  "{\"a\": 1,}", "01",          "-",        "+1",       "1.",
          ".5",       "1e",      "1e+",         "nul",         "nullx",    "tru",      "\"a",
          "\"a\nb\"", "\"\\x\"", "\"\\\"",      "\"\\ud83d\"", "\"\xc3\"", "\"\xff\"", "[1] 2",
          "1e400",    "NaN",     "{} // no"}) {
        INFO(text);
        CHECK_FALSE(fast_json(text));
        CHECK(by_library(text).is_discarded());
    }
    CHECK_FALSE(fast_json(std::string("[]") + '\0'));
}

TEST_CASE("damaged JSON is read as the library reads it, or left to it", "[base]") {
    constexpr std::string_view bytes("{}[]\",:\\ue0-.19t\n\x80\xc3", 20);
    constexpr std::array<std::string_view, 1> unread{"u"};
    std::size_t accepted = 0;
    for (std::uint64_t round = 0; round < 2000; ++round) {
        std::string text(document);
        for (std::uint64_t change = 0; change <= round % 3; ++change) {
            const std::size_t at = hashed(2 * change + 1, round) % text.size();
            text[at] = bytes[hashed(2 * change + 2, round) % bytes.size()];
        }
        INFO(text);
        const auto read = fast_json(text);
        const Json wanted = by_library(text);
        if (read) CHECK(same(*read, wanted));
        const std::string within = "{\"u\": " + text + "}";
        CHECK(fast_json(within, 256, unread).has_value() == fast_json(within).has_value());
        accepted += read.has_value();
    }
    CHECK(accepted > 100);
}

TEST_CASE("JSON is written as the library writes it", "[base]") {
    const auto by_library_too = [](const Json& json) {
        INFO(json.dump(-1, ' ', true, Json::error_handler_t::replace));
        CHECK(fast_text(json) == json.dump(-1, ' ', false, Json::error_handler_t::replace));
    };
    by_library_too(by_library(document));
    for (const Json& json :
         {Json(),
          Json(true),
          Json(false),
          Json(0),
          Json(-1),
          Json(INT64_MIN),
          Json(UINT64_MAX),
          Json(0.0),
          Json(-0.0),
          Json(1.0),
          Json(0.1f),
          Json(1e15),
          Json(1e16),
          Json(1e-5),
          Json(5e-324),
          Json(1.7976931348623157e308),
          Json(std::numeric_limits<double>::infinity()),
          Json(std::numeric_limits<double>::quiet_NaN()),
          Json(""),
          Json("plain ~"),
          Json("a\"b\\c/d\n\t\x01\x7f"),
          Json("\xc3\xa9 \xf0\x9f\x98\x80"),
          Json("\xff \xc3"),
          Json::array(),
          Json::object(),
          Json::array({Json::array({Json::object()}), nullptr}),
          Json::object({{"a \"key\"", 1}, {"\xc3", Json::array()}, {"", Json::object({{"x", 0.5}})}})})
        by_library_too(json);
    for (std::uint64_t i = 0; i < 20000; ++i) // of all sizes, and such as float32 has
        by_library_too(Json::array({std::bit_cast<double>(hashed(i, 1)),
                                    std::bit_cast<float>(static_cast<std::uint32_t>(hashed(i, 2))),
                                    static_cast<double>(hashed(i, 3) % 1000000) / 1000}));
}

TEST_CASE("reading, writing and giving up JSON asks for memory as often as there are values that need it",
          "[base]") {
    constexpr std::size_t count = 1000;
    std::string text = "[";
    for (std::size_t i = 0; i < count; ++i)
        text += fmt::format(R"({}{{"bufferView":{},"type":"VEC3","min":[0.5,1.5,2.5]}})", i ? "," : "", i);
    text += "]";
    std::size_t before = allocations_of_thread();
    auto read = fast_json(text);
    REQUIRE(read);
    // An object and its members, an array and its items, a string.
    CHECK(allocations_of_thread() - before < 5 * count + 100);
    before = allocations_of_thread();
    CHECK(fast_text(*read) == text);
    CHECK(allocations_of_thread() - before < 40);
    before = allocations_of_thread();
    destroy(*read);
    CHECK(allocations_of_thread() == before); // the library: a list for each object and array
    CHECK(read->is_null());
    Json other = by_library(document);
    { const ScopedDestroy at_end(other); }
    CHECK(other.is_null());
}
