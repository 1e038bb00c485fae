#include "support/catch.hpp"

#include "platform/cores.hpp"
#include "support/failure.hpp"

#include <cstdlib>

using namespace facetmill;

TEST_CASE("FACETMILL_JOBS is the number of threads where none is given", "[base]") {
    const char* before = std::getenv("FACETMILL_JOBS");
    const std::string kept = before ? before : "";
    ::setenv("FACETMILL_JOBS", "3", 1);
    CHECK(default_threads() == 3);
    for (const char* wrong : {"0", "many", "-1", "5000", "2.5"}) {
        ::setenv("FACETMILL_JOBS", wrong, 1);
        CHECK(test::failure([] { default_threads(); }).starts_with("usage [E-ARGUMENT]"));
    }
    ::unsetenv("FACETMILL_JOBS");
    CHECK(default_threads() == allowed_cores());
    CHECK(allowed_cores() >= 1);
    if (before) ::setenv("FACETMILL_JOBS", kept.c_str(), 1);
}
