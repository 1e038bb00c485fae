#include "support/catch.hpp"

#include "options/synonyms.hpp"
#include "stage/stage.hpp"

using namespace facetmill;

TEST_CASE("options are found by what other programs call them, where the option is known", "[options]") {
    const auto validate = stage_named("validate")->options->known_names();
    const auto simplify = stage_named("simplify")->options->known_names();
    CHECK(hint_for_option("watertight", validate) == "'watertight' is called 'closed' here");
    CHECK(hint_for_option("Manifold", validate) ==
          "'Manifold' is called 'edge_manifold' or 'vertex_manifold' here");
    CHECK(hint_for_option("target-faces", simplify) == "'target-faces' is called 'faces' here");
    CHECK(hint_for_option("reduction", simplify) ==
          "here it is ratio, the share that remains, not the share that is removed");
    CHECK(hint_for_option("preserve_border", simplify) == "here it is lock: {boundary: true}");
    CHECK(hint_for_option("inside_out", validate) ==
          "here it is (outward_oriented: true), which means the opposite");
    CHECK(hint_for_option("keep_largest", stage_named("clean")->options->known_names()) ==
          "here it is components: {keep: 1}");
    CHECK(hint_for_option("keep_largest", validate).find("keep: 1") == std::string::npos);
    CHECK(options_of_same_value("reduction", simplify).empty());
    CHECK(options_called("reduction", simplify) ==
          std::vector<std::string>{"ratio"}); // by name, whatever its values
    CHECK(hint_for_option("junit", validate).starts_with("a report is written by the command: --report"));
    CHECK(hint_for_option("unti", validate) == "did you mean 'unit'?");
    CHECK(options_called("watertight", simplify).empty());
    CHECK(options_called("holes", validate) == std::vector<std::string>{"boundary_loops"});
}

TEST_CASE("a word that no other program uses is answered with the nearest option", "[options]") {
    const std::vector<KnownName> known{{"ratio"}, {"faces"}};
    CHECK(hint_for_option("rato", known) == "did you mean 'ratio'?");
    CHECK(hint_for_option("qqqqq", known) == "expected one of: ratio, faces");
    CHECK(hint_for_option("qqqqq", known, "see the help") == "see the help");
}
