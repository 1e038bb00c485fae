#include "platform/cores.hpp"

#include "base/math/numbers.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <sched.h>
#include <thread>

namespace facetmill {

namespace {

int of_affinity() {
    cpu_set_t set;
    CPU_ZERO(&set);
    if (::sched_getaffinity(0, sizeof set, &set) == 0 && CPU_COUNT(&set) > 0) return CPU_COUNT(&set);
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// A quota of time per period, in cores; none without a limit.
std::optional<double> quota_of(const std::string& folder) {
    std::ifstream both(folder + "/cpu.max");
    std::string quota, period;
    if (!(both >> quota >> period)) {
        std::ifstream(folder + "/cpu.cfs_quota_us") >> quota;
        std::ifstream(folder + "/cpu.cfs_period_us") >> period;
    }
    const auto time = parse_real(quota), of = parse_real(period); // "max" and -1 mean no limit
    if (!time || !of || *time <= 0 || *of <= 0) return {};
    return *time / *of;
}

/// The smallest quota of a group and its ancestors.
std::optional<double> of_groups(const std::string& root, std::string path) {
    std::optional<double> least;
    while (true) {
        if (const auto quota = quota_of(root + path)) least = std::min(least.value_or(*quota), *quota);
        if (path.empty() || path == "/") return least;
        path.resize(path.rfind('/'));
    }
}

} // namespace

int allowed_cores() {
    double cores = of_affinity();
    std::ifstream groups("/proc/self/cgroup"); // lines look like "0::/a/b" or "4:cpu,cpuacct:/a/b"
    for (std::string line; std::getline(groups, line);) {
        const auto first = line.find(':'), second = line.find(':', first + 1);
        if (second == line.npos) continue;
        const std::string controllers = line.substr(first + 1, second - first - 1);
        if (!controllers.empty() && controllers.find("cpu") == controllers.npos) continue;
        const std::string root = controllers.empty() ? "/sys/fs/cgroup" : "/sys/fs/cgroup/cpu";
        const std::string path = line.substr(second + 1);
        if (path.starts_with('/'))
            if (const auto quota = of_groups(root, path)) cores = std::min(cores, std::ceil(*quota));
    }
    return std::max(1, static_cast<int>(cores));
}

} // namespace facetmill
