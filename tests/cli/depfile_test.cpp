#include "cli/depfile.hpp"

#include "support/catch.hpp"

using namespace facetmill;
using namespace facetmill::cli;

TEST_CASE("a depfile names outputs and inputs, and each input alone", "[cli]") {
    CHECK(depfile_text({"a.glb", "a.json"}, {"p.yaml", "a.stl"}) == "a.glb a.json: \\\n  p.yaml \\\n  a.stl\n"
                                                                    "p.yaml:\na.stl:\n");
}

TEST_CASE("names in a depfile are escaped as Make wants it", "[cli]") {
    CHECK(make_spelling("a b.stl") == "a\\ b.stl");
    CHECK(make_spelling("cost$.stl") == "cost$$.stl");
    CHECK(make_spelling("no#1.stl") == "no\\#1.stl");
    CHECK(make_spelling("back\\slash.stl") == "back\\slash.stl");
    CHECK(make_spelling("back\\ blank") == "back\\\\\\ blank");
    CHECK_THROWS_AS(make_spelling("two\nlines"), Error);
}

TEST_CASE("an input with a percent sign gets no rule of its own, which would be a pattern", "[cli]") {
    CHECK(depfile_text({"o"}, {"50%.stl"}) == "o: \\\n  50%.stl\n");
}
