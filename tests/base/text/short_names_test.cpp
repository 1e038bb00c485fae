#include "base/text/short_names.hpp"
#include "support/catch.hpp"

using namespace facetmill;

TEST_CASE("short names tell files apart", "[base]") {
    using Names = std::pair<std::string, std::string>;
    CHECK(short_names("old/duck.glb", "new/duck-small.glb") == Names("duck.glb", "duck-small.glb"));
    CHECK(short_names("old/duck.glb", "new/duck.glb") == Names("old/duck.glb", "new/duck.glb"));
    CHECK(short_names("/w/old/props/a/duck.glb", "/w/new/props/a/duck.glb") ==
          Names("old/.../duck.glb", "new/.../duck.glb"));
    CHECK(short_names("duck.glb", "new/duck.glb") == Names("duck.glb", "new/duck.glb"));
    CHECK(short_names("new/a/duck.glb", "a/duck.glb") == Names("new/.../duck.glb", "duck.glb"));
    CHECK(short_names("/duck.glb", "new/duck.glb") == Names("/duck.glb", "new/duck.glb"));
    CHECK(short_names("./x/../duck.glb", "duck.glb") == Names("duck.glb", "duck.glb"));
    CHECK(short_names("assets.before/", "assets/") == Names("assets.before", "assets"));
    CHECK(short_names("-", "in/-") == Names("standard input", "-"));
    CHECK(short_name("pipelines/web.yaml") == "web.yaml");
    CHECK(short_name("assets/") == "assets");
    CHECK(short_name("quickstart") == "quickstart");
    CHECK(short_name("") == "");
}
