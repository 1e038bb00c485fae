#include "base/text/words.hpp"

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

TEST_CASE("blanks at the ends of a text are cut off", "[base]") {
    CHECK(trimmed("  a b\t ") == "a b");
    CHECK(trimmed("a") == "a");
    CHECK(trimmed(" \t").empty());
    CHECK(trimmed("").empty());
}

TEST_CASE("commas separate items, blanks around them do not count", "[base]") {
    using Items = std::vector<std::string_view>;
    CHECK(split_at_commas("a,b c , d") == Items{"a", "b c", "d"});
    CHECK(split_at_commas(" a ") == Items{"a"});
    CHECK(split_at_commas("a,,b") == Items{"a", "", "b"});
    CHECK(split_at_commas(",a,") == Items{"", "a", ""});
    CHECK(split_at_commas(",") == Items{"", ""});
    CHECK(split_at_commas("").empty());
    CHECK(split_at_commas("  ").empty());
}

TEST_CASE("items are joined, empty ones left out", "[base]") {
    CHECK(join_texts({"a", "", "b"}) == "a, b");
    CHECK(join_texts({"", "a"}, "; ") == "a");
    CHECK(join_texts({}).empty());
    std::string list;
    append_item(list, "");
    append_item(list, "a");
    append_item(list, "b", ",");
    CHECK(list == "a,b");
}
