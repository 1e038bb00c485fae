#include "parallel/allocation_cap.hpp"

#include "platform/pages.hpp"

#include <cstdlib>
#include <limits>
#include <new>

namespace {

constinit thread_local std::size_t most_at_once = std::numeric_limits<std::size_t>::max();
constinit thread_local std::size_t requests = 0;

/// Like the C++ library's operator new, plus the cap and the page size. Returns null instead of throwing.
void* requested(std::size_t bytes) noexcept {
    ++requests;
    if (bytes > most_at_once) return nullptr;
    void* const memory = std::malloc(bytes == 0 ? 1 : bytes);
    if (memory) facetmill::ask_for_large_pages(memory, bytes);
    return memory;
}

void* requested_or_thrown(std::size_t bytes) {
    while (true) {
        if (void* const memory = requested(bytes)) return memory;
        const auto handler = bytes > most_at_once ? nullptr : std::get_new_handler();
        if (!handler) throw std::bad_alloc();
        handler();
    }
}

} // namespace

namespace facetmill {

AllocationCap::AllocationCap(std::size_t bytes) : outer_(most_at_once) { most_at_once = bytes; }
AllocationCap::~AllocationCap() { most_at_once = outer_; }

std::size_t allocations_of_thread() { return requests; }

} // namespace facetmill

// All forms except aligned memory, because AddressSanitizer replaces each form, and its forms must not be
// mixed with ours.
void* operator new(std::size_t bytes) { return requested_or_thrown(bytes); }
void* operator new[](std::size_t bytes) { return requested_or_thrown(bytes); }
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept { return requested(bytes); }
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept { return requested(bytes); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
