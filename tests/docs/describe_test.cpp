#include "docs/describe.hpp"
#include "docs/schema.hpp"

#include "support/catch.hpp"

using namespace facetmill;

TEST_CASE("text is broken at blanks, and long words stand alone", "[docs]") {
    CHECK(docs::wrapped("one two three", 2, 9) == "  one two\n  three\n");
    CHECK(docs::wrapped("unbreakable", 2, 5) == "  unbreakable\n");
    CHECK(docs::wrapped("a\nb", 0) == "a\nb\n");
    CHECK(docs::wrapped("", 4).empty());
}

TEST_CASE("a schema of several types becomes forms of one type each", "[docs]") {
    const Json two = {
        {"type", {"array", "null"}}, {"description", "d"}, {"items", {{"type", {"number", "string"}}}}};
    CHECK(docs::with_single_types(two) == Json::parse(R"({"description": "d", "anyOf": [
              {"items": {"anyOf": [{"type": "number"}, {"type": "string"}]}, "type": "array"}, {"type": "null"}]})"));
    const Json names = {{"properties", {{"type", {{"enum", {"type", "a"}}}}}}};
    CHECK(docs::with_single_types(names) == names);
}
