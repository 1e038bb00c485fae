#include "support/catch.hpp"

#include "base/error.hpp"
#include "base/text/spelling.hpp"

using namespace facetmill;

TEST_CASE("a diagnostic is rendered with its source line, a caret and the hint", "[base]") {
    auto source =
        std::make_shared<const SourceText>(SourceText{"a.yaml", "facetmill: 1\nstages:\n  - clop: 3\n"});
    const Diagnostic d{Severity::error, "E-STAGE", "there is no stage 'clop'", Mark{source, 3, 5, 4},
                       "did you mean 'clip'?"};
    CHECK(render(d) == "a.yaml:3:5: error[E-STAGE]: there is no stage 'clop'\n"
                       "    - clop: 3\n"
                       "      ^~~~\n"
                       "  hint: did you mean 'clip'?");
}

TEST_CASE("a diagnostic without a place says who speaks", "[base]") {
    CHECK(render({Severity::warning, "W-UNITS", "unknown unit", {}, {}}) ==
          "facetmill: warning[W-UNITS]: unknown unit");
}

TEST_CASE("a want of memory is known by its field, and a warning that is allowed by its id", "[base]") {
    const Error error = out_of_memory("no memory for it", "take less");
    CHECK(error.kind() == ErrorKind::limit);
    CHECK(error.diagnostics().front().out_of_memory);
    CHECK_FALSE(Error(ErrorKind::limit, "E-LIMIT", "too many").diagnostics().front().out_of_memory);
    const Diagnostic warning{Severity::warning, "W-UNITS", "unknown unit", {}, {}};
    CHECK(is_allowed(warning, {"W-ONLY", "W-UNITS"}));
    CHECK_FALSE(is_allowed(warning, {"W-UNIT"}));
}

TEST_CASE("nearest names", "[base]") {
    CHECK(nearest("clop", {"clip", "crop", "split"}) == "clip");
    CHECK(nearest("simpilfy", {"clip", "simplify"}) == "simplify");
    CHECK(nearest("iter", {"factor", "iterations"}) == "iterations");
    CHECK(nearest("zzz", {"clip", "crop"}).empty());
    CHECK(nearest("RELAX", {"crop", "relax"}) == "relax");
    CHECK(nearest("ID", {"in", "id"}) == "id");
    CHECK(nearest("input", {"output", "Input"}) == "Input");
    CHECK(nearest("SIMPILFY", {"clip", "simplify"}) == "simplify");
    CHECK(edit_distance("ab", "ba") == 1);
}

TEST_CASE("a diagnostic passes no control characters of a file on to the terminal", "[base]") {
    const auto source = std::make_shared<const SourceText>(SourceText{"a.yaml", "load: \x1b[31mred"});
    Mark where;
    where.source = source;
    where.line = 1;
    where.column = 7;
    const std::string text = render({Severity::error, "E-X", "part '\x1b]0;t\x07'", where, "as \x1b"}, true);
    CHECK(text.find("part '?]0;t?'\n  load: ?[31mred\n") != std::string::npos);
    CHECK(text.ends_with("hint: as ?"));
    CHECK(text.find("\033[1;31m") != std::string::npos); // its own
}
