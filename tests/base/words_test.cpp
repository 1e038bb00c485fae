#include "base/words.hpp"

#include "support/catch.hpp"

using namespace facetmill;

TEST_CASE("nouns are counted", "[base]") {
    CHECK(counted(1, "face") == "1 face");
    CHECK(counted(0, "face") == "0 faces");
    CHECK(counted(2, "vertex", "vertices") == "2 vertices");
    CHECK(counted(1, "vertex", "vertices") == "1 vertex");
}

TEST_CASE("a byte order mark is cut off where a text begins", "[base]") {
    CHECK(without_byte_order_mark("\xEF\xBB\xBF"
                                  "x,y") == "x,y");
    CHECK(without_byte_order_mark("x\xEF\xBB\xBF") == "x\xEF\xBB\xBF");
    CHECK(without_byte_order_mark("\xEF\xBB") == "\xEF\xBB");
    CHECK(without_byte_order_mark("").empty());
}
