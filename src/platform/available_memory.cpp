#include "platform/available_memory.hpp"

#include "platform/pages.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <sys/resource.h>

namespace facetmill {

namespace {

/// The number at the beginning of a file; none for other text ("max").
std::optional<std::uint64_t> number_in(const std::string& path) {
    std::ifstream file(path);
    std::uint64_t n = 0;
    if (file >> n) return n;
    return {};
}

/// Memory available on the machine, in bytes.
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

/// The remaining memory of a cgroup folder: its limit minus the memory in use that cannot be reclaimed.
std::optional<std::uint64_t> of_group(const std::string& folder) {
    auto limit = number_in(folder + "/memory.max"), used = number_in(folder + "/memory.current");
    if (!limit || !used) {
        limit = number_in(folder + "/memory.limit_in_bytes");
        used = number_in(folder + "/memory.usage_in_bytes");
    }
    if (!limit || !used) return {};
    std::uint64_t cached = 0; // the kernel drops file pages when it needs memory
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

} // namespace

std::optional<std::uint64_t> available_memory() {
    std::optional<std::uint64_t> least = of_machine();
    for (const auto& bound : {of_group("/sys/fs/cgroup"), of_group("/sys/fs/cgroup/memory"), of_process()})
        if (bound) least = least ? std::min(*least, *bound) : *bound;
    return least;
}

std::uint64_t resident_memory() {
    std::ifstream file("/proc/self/statm");
    std::uint64_t all = 0, pages = 0;
    return file >> all >> pages ? pages * std::uint64_t{page_size()} : 0;
}

std::size_t peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

} // namespace facetmill
