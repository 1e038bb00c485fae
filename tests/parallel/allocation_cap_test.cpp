#include "parallel/allocation_cap.hpp"
#include "support/catch.hpp"

#include <limits>
#include <new>
#include <thread>
#include <vector>

using namespace facetmill;

namespace {

bool is_given(std::size_t bytes) {
    try {
        const std::vector<char> memory(bytes);
        return memory.size() == bytes;
    } catch (const std::bad_alloc&) {
        return false;
    }
}

} // namespace

TEST_CASE("an allocation cap refuses larger requests of its thread while it lives", "[base]") {
    CHECK(is_given(2000));
    {
        const AllocationCap cap(1000);
        CHECK(is_given(1000));
        CHECK(!is_given(1001));
        CHECK(!::operator new(1001, std::nothrow));
        {
            const AllocationCap inner(std::numeric_limits<std::size_t>::max());
            CHECK(is_given(2000));
        }
        CHECK(!is_given(2000));
        bool other = false;
        std::jthread([&] { other = is_given(2000); }).join();
        CHECK(other);
    }
    CHECK(is_given(2000));
}

TEST_CASE("requests for memory are counted by thread", "[base]") {
    const std::size_t before = allocations_of_thread();
    CHECK(is_given(10));
    CHECK(allocations_of_thread() > before);
    std::size_t other = 1;
    std::jthread([&] { other = allocations_of_thread(); }).join();
    CHECK(other == 0);
}
