#include "parallel/storage.hpp"
#include "platform/pages.hpp"

#include "support/catch.hpp"
#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <sstream>
#include <string>

using namespace facetmill;

TEST_CASE("a large array grows as resize grows it: what was there stays, what is new is zero", "[base]") {
    for (const std::size_t n : {std::size_t{0}, std::size_t{5}, std::size_t{3} << 20}) {
        std::vector<int> v(4);
        std::iota(v.begin(), v.end(), 1);
        resize_large(v, n);
        REQUIRE(v.size() == n);
        for (std::size_t i = 0; i < n; ++i)
            if (v[i] != (i < 4 ? static_cast<int>(i) + 1 : 0)) FAIL("element " << i << " is " << v[i]);
    }
}

TEST_CASE("asking for pages changes no contents", "[base]") {
    std::vector<int> v((std::size_t{3} << 20) + 7);
    std::iota(v.begin(), v.end(), 0);
    prefault(v.data() + 3, (v.size() - 3) * sizeof(int)); // not at a page's beginning
    for (std::size_t i = 0; i < v.size(); ++i)
        if (v[i] != static_cast<int>(i)) FAIL("element " << i << " is " << v[i]);
}

namespace {

/// The kernel's flags for the memory at this address: the line VmFlags of its mapping.
std::string flags_of_memory_at(const void* place) {
    std::ifstream maps("/proc/self/smaps");
    const auto wanted = reinterpret_cast<std::uintptr_t>(place);
    bool here = false;
    for (std::string line; std::getline(maps, line);) {
        std::uintptr_t begin = 0, end = 0;
        char dash = 0;
        std::istringstream words(line);
        if (words >> std::hex >> begin >> dash >> end && dash == '-') here = begin <= wanted && wanted < end;
        if (here && line.rfind("VmFlags:", 0) == 0) return line + " ";
    }
    return "";
}

} // namespace

TEST_CASE("large arrays may have large pages, small ones have not asked", "[base]") {
    if (!std::filesystem::exists("/sys/kernel/mm/transparent_hugepage")) {
        WARN("the kernel has none");
        return;
    }
    const std::vector<char> large(std::size_t{64} << 20, 'x');
    CHECK(flags_of_memory_at(large.data() + large.size() / 2).find(" hg ") != std::string::npos);
    CHECK(std::count(large.begin(), large.end(), 'x') == std::ptrdiff_t{64} << 20);
    errno = 7;
    ask_for_large_pages(const_cast<char*>(large.data()) + 1, 5000); // too little, and at no page's beginning
    ask_for_large_pages(reinterpret_cast<void*>(std::uintptr_t{4096}), std::size_t{8} << 20); // not ours
    CHECK(errno == 7);
}
