#include "support/catch.hpp"

#include "report/contents.hpp"

#include <cmath>

using namespace facetmill;
using report::found_json;
using report::found_of;

TEST_CASE("what a check found goes into a baseline and back", "[report]") {
    for (const report::Found& found :
         {report::Found(), report::Found(true), report::Found(std::int64_t{-7}), report::Found(0.1),
          report::Found(2.0), report::Found("mm"),
          report::Found(report::Corners{{0, -1, 0.5}, {1, 1, 1e300}}),
          report::Found(std::vector<std::string>{"a", "b"}), report::Found(std::vector<std::string>())}) {
        const std::string text = found_json(found).dump();
        CAPTURE(text);
        CHECK(found_of(parse_json(text)) == found);
    }
    const double nan = std::nan("");
    const auto box = found_of(parse_json(found_json(report::Corners{{nan, 0, 0}, {1, 1, 1}}).dump()));
    CHECK(std::isnan(std::get<report::Corners>(box.value()).min.x)); // files have null instead
    for (const char* text : {R"({"min": [0, 0, 0]})", R"({"min": [0, 0], "max": [1, 1, 1]})",
                             R"({"min": [0, 0, "0"], "max": [1, 1, 1]})", R"([1])", R"(["a", null])"}) {
        CAPTURE(text);
        CHECK_FALSE(found_of(parse_json(text)));
    }
}

TEST_CASE("resolved lengths are told by option, the last of each", "[report]") {
    std::vector<report::ResolvedLength> lengths;
    set_resolved(lengths, {"depth", "1%", 0.5});
    set_resolved(lengths, {"width", "2mm", 2});
    set_resolved(lengths, {"depth", "2%", 1});
    CHECK(report::resolved_json(lengths).dump() ==
          R"({"depth":{"given":"2%","is":1.0},"width":{"given":"2mm","is":2.0}})");
}
