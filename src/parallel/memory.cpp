#include "parallel/memory.hpp"

#include "base/error.hpp"
#include "parallel/storage.hpp"

#include <algorithm>
#include <atomic>
#include <fmt/format.h>
#include <fstream>
#include <sstream>
#include <sys/resource.h>

namespace facetmill {

namespace {

/// The number at the start of a file; none for other contents ("max").
std::optional<std::uint64_t> number_in(const std::string& path) {
    std::ifstream file(path);
    std::uint64_t n = 0;
    if (file >> n) return n;
    return {};
}

/// Available to the machine, in bytes.
std::optional<std::uint64_t> of_machine() {
    std::ifstream file("/proc/meminfo");
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string key;
        std::uint64_t kib = 0;
        if (words >> key >> kib && key == "MemAvailable:") return kib * 1024;
    }
    return {};
}

/// The memory that a cgroup folder leaves: its limit less the memory in use that cannot be reclaimed.
std::optional<std::uint64_t> of_group(const std::string& folder) {
    auto limit = number_in(folder + "/memory.max"), used = number_in(folder + "/memory.current");
    if (!limit || !used) {
        limit = number_in(folder + "/memory.limit_in_bytes");
        used = number_in(folder + "/memory.usage_in_bytes");
    }
    if (!limit || !used) return {};
    std::uint64_t cached = 0; // pages of files are dropped when room is needed
    std::ifstream file(folder + "/memory.stat");
    std::string key;
    for (std::uint64_t n = 0; file >> key >> n;)
        if (key == "inactive_file" || key == "total_inactive_file") cached = n;
    const std::uint64_t kept = *used - std::min(cached, *used);
    return *limit - std::min(*limit, kept);
}

std::optional<std::uint64_t> of_process() {
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return {};
    const std::uint64_t used = number_in("/proc/self/statm").value_or(0) * std::uint64_t{page_size()};
    return limit.rlim_cur - std::min<std::uint64_t>(limit.rlim_cur, used);
}

/// In use, of the memory of the machine.
std::uint64_t resident() {
    std::ifstream file("/proc/self/statm");
    std::uint64_t all = 0, pages = 0;
    return file >> all >> pages ? pages * std::uint64_t{page_size()} : 0;
}

std::atomic<std::uint64_t> limit_of_run = 0;

constexpr std::uint64_t not_worth_asking = std::uint64_t{1} << 28;

} // namespace

std::optional<std::uint64_t> available_memory() {
    std::optional<std::uint64_t> least = of_machine();
    for (const auto& bound : {of_group("/sys/fs/cgroup"), of_group("/sys/fs/cgroup/memory"), of_process()})
        if (bound) least = least ? std::min(*least, *bound) : *bound;
    return least;
}

void set_memory_limit(std::uint64_t bytes) { limit_of_run = bytes; }

std::optional<std::uint64_t> memory_left() {
    const auto there = available_memory();
    const std::uint64_t limit = limit_of_run;
    if (limit == 0) return there;
    give_back_freed_memory(); // which is not in use
    const std::uint64_t left = limit - std::min(limit, resident());
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
