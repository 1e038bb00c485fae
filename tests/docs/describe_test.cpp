#include "docs/describe.hpp"

#include "support/catch.hpp"

using namespace facetmill;

TEST_CASE("text is broken at blanks, and long words stand alone", "[docs]") {
    CHECK(docs::wrapped("one two three", 2, 9) == "  one two\n  three\n");
    CHECK(docs::wrapped("unbreakable", 2, 5) == "  unbreakable\n");
    CHECK(docs::wrapped("a\nb", 0) == "a\nb\n");
    CHECK(docs::wrapped("", 4).empty());
}
