#include "support/catch.hpp"

#include "base/error.hpp"
#include "io/csv.hpp"
#include "io/rows.hpp"

#include <limits>

using namespace facetmill;
using namespace facetmill::io;

TEST_CASE("rows are flat, in the C locale, and quoted as in RFC 4180", "[rows]") {
    const Json object = {{"name", "a \"b\", c"}, {"size", 1.5}, {"count", 1234567},   {"missing", nullptr},
                         {"ok", true},           {"list", {1}}, {"box", {{"min", 1}}}};
    const Json row = flat_row(object);
    CHECK(row_heading(row, RowFormat::csv) == "name,size,count,missing,ok\n");
    CHECK(row_line(row, RowFormat::csv) == "\"a \"\"b\"\", c\",1.5,1234567,,true\n");
    CHECK(row_heading(row, RowFormat::json_lines).empty());
    CHECK(parse_json(row_line(row, RowFormat::json_lines)) == row);
    CHECK(row_line({{"a", std::numeric_limits<double>::infinity()}, {"b", -0.25}}, RowFormat::csv) ==
          ",-0.25\n");
}

TEST_CASE("a text is never a formula of a spreadsheet", "[rows]") {
    for (const char* text : {"=1+1", "+1", "-1", "@x", "\tx"})
        CHECK(csv_text(text) == "'" + std::string(text));
    CHECK(csv_text("=a,b") == "\"'=a,b\"");
    CHECK(csv_text("\rx") == "\"'\rx\"");
    CHECK(csv_text("a=b") == "a=b");
    CHECK(row_line({{"a", "=x"}}, RowFormat::json_lines) == "{\"a\":\"=x\"}\n");
}

TEST_CASE("the suffix selects the format of rows", "[rows]") {
    CHECK(row_format("a.csv") == RowFormat::csv);
    CHECK(row_format("a.jsonl") == RowFormat::json_lines);
    CHECK_THROWS_AS(row_format("a.parquet"), Error);
}
