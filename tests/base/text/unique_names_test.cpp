#include "support/catch.hpp"

#include "base/text/unique_names.hpp"

using namespace facetmill;

TEST_CASE("names that are taken are numbered from 2, past numbers that are taken, too", "[base]") {
    UniqueNames names;
    names.take("arm_2");
    CHECK(names.add("arm") == "arm");
    CHECK(names.add("arm") == "arm_3");
    CHECK(names.add("arm") == "arm_4");
    CHECK(names.add("arm_2") == "arm_2_2");
    CHECK(names.add("leg") == "leg");
    UniqueNames dashed('-');
    CHECK(dashed.add("arm") == "arm");
    CHECK(dashed.add("arm") == "arm-2");
    const std::set<std::string> taken{"arm", "arm_2"};
    CHECK(free_name("arm", [&](const std::string& name) { return taken.contains(name); }) == "arm_3");
    CHECK(free_name("leg", [&](const std::string& name) { return taken.contains(name); }) == "leg");
}
