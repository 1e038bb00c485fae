#include "parallel/memory.hpp"

#include "base/error.hpp"
#include "parallel/memory_limit.hpp"
#include "platform/pages.hpp"

#include <algorithm>
#include <atomic>
#include <fmt/format.h>

namespace facetmill {

namespace {

std::atomic<std::uint64_t> limit_of_run = 0;

constexpr std::uint64_t not_worth_asking = std::uint64_t{1} << 28;

} // namespace

void set_memory_limit(std::uint64_t bytes) { limit_of_run = bytes; }

std::uint64_t memory_limit() { return limit_of_run; }

std::optional<std::uint64_t> memory_left() {
    const auto there = available_memory();
    const std::uint64_t limit = limit_of_run;
    if (limit == 0) return there;
    give_back_freed_memory(); // freed memory is not in use
    const std::uint64_t left = limit - std::min(limit, resident_memory());
    return there ? std::min(*there, left) : left;
}

std::uint64_t memory_there() { return available_memory().value_or(std::uint64_t{4} << 30); }

std::uint64_t at_most_memory_there(std::uint64_t bytes) {
    return bytes < not_worth_asking ? bytes : std::min(bytes, memory_there());
}

bool is_much_memory(double bytes) { return bytes >= static_cast<double>(not_worth_asking); }

void require_memory(double bytes, const std::string& what, const std::string& hint) {
    if (!is_much_memory(bytes)) return;
    const auto there = available_memory();
    if (!there || bytes <= static_cast<double>(*there)) return;
    constexpr double gib = 1 << 30;
    throw out_of_memory(fmt::format("{} needs about {:.3g} GiB of memory, {:.3g} GiB are available", what,
                                    bytes / gib, static_cast<double>(*there) / gib),
                        hint);
}

} // namespace facetmill
