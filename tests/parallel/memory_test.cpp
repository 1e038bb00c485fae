#include "parallel/memory.hpp"

#include "base/error.hpp"
#include "support/catch.hpp"

using namespace facetmill;

TEST_CASE("a gigabyte more than there is is refused with both numbers", "[base]") {
    const auto there = available_memory();
    REQUIRE(there);
    CHECK(*there > (1U << 20));
    CHECK_NOTHROW(require_memory(1e6, "it", ""));
    try {
        require_memory(1e18, "it", "less");
        FAIL("not refused");
    } catch (const Error& e) {
        CHECK(e.kind() == ErrorKind::limit);
        CHECK(e.diagnostics().front().id == "E-MEMORY");
        CHECK(e.diagnostics().front().message.starts_with("it needs about 9.31e+08 GiB of memory, "));
        CHECK(e.diagnostics().front().hint == "less");
    }
}

TEST_CASE("what is asked for is cut to what there is", "[base]") {
    CHECK(at_most_memory_there(1000) == 1000);
    CHECK(at_most_memory_there(std::uint64_t{1} << 62) < (std::uint64_t{1} << 62));
}

TEST_CASE("what is left of the memory for a run is less than its limit", "[base]") {
    CHECK(memory_left().has_value());
    set_memory_limit(1);
    CHECK(memory_left() == std::optional<std::uint64_t>(0));
    std::uint64_t limit = 1;
    for (; *memory_left() == 0; set_memory_limit(limit)) limit *= 2;
    CHECK(*memory_left() <= limit / 2); // half of the limit was below the memory in use
    set_memory_limit(0);
}
