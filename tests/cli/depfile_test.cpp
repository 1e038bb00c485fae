#include "cli/depfile.hpp"

#include "support/catch.hpp"

using namespace facetmill;
using namespace facetmill::cli;

TEST_CASE("a depfile names one target and the inputs, and each input alone", "[cli]") {
    CHECK(depfile_text("a.glb", {"p.yaml", "a.stl"}) == "a.glb: \\\n  p.yaml \\\n  a.stl\np.yaml:\na.stl:\n");
}

TEST_CASE("names in a depfile are escaped as Make wants it", "[cli]") {
    for (const bool target : {false, true}) {
        CHECK(make_escaped("a b.stl", target) == "a\\ b.stl");
        CHECK(make_escaped("cost$.stl", target) == "cost$$.stl");
        CHECK(make_escaped("no#1.stl", target) == "no\\#1.stl");
        CHECK(make_escaped("c:x.stl", target) == "c\\:x.stl");
        CHECK(make_escaped("back\\slash.stl", target) == "back\\slash.stl");
        CHECK(make_escaped("back\\ blank", target) == "back\\\\\\ blank");
        CHECK_THROWS_AS(make_escaped("two\nlines", target), Error);
    }
}

TEST_CASE("what a depfile cannot spell is refused before the run", "[cli]") {
    pipeline::Plan plan;
    CHECK_NOTHROW(require_spellable("a.glb", plan));
    CHECK_THROWS_AS(require_spellable("two\nlines.glb", plan), Error);
    plan.others.push_back({"two\nlines.yaml", {}, false, {}, true}); // an include
    CHECK_THROWS_AS(require_spellable("a.glb", plan), Error);
}

TEST_CASE("a percent sign makes no pattern", "[cli]") {
    CHECK(depfile_text("o-50%.glb", {"50%.stl"}) == "o-50\\%.glb: \\\n  50%.stl\n");
}
