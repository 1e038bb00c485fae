#include "support/catch.hpp"

#include "stage/stage.hpp"

#include <fmt/format.h>

using namespace facetmill;

TEST_CASE("stages are found by what other programs call them", "[stage]") {
    CHECK(hint_for_stage("Decimate", stage_names()) ==
          "'Decimate' is done by simplify here: facetmill stages simplify");
    CHECK(hint_for_stage("simplfy", stage_names()) == "did you mean 'simplify'?");
    CHECK(hint_for_stage("qqqqq", stage_names()) == "facetmill stages lists all stages");
    for (const char* word : {"weld", "smooth", "boolean", "subdivide", "hollow", "decimate"}) {
        INFO(word);
        CHECK(stage_called(word) != nullptr);
        CHECK(stage_named(word) == nullptr);
    }
    for (const char* word : {"Remeshing", "isotropic-remeshing"})
        CHECK(hint_for_stage(word, stage_names()) ==
              fmt::format("'{}' is done by remesh here: facetmill stages remesh", word));
}
