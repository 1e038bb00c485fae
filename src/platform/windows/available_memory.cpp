#include "platform/available_memory.hpp"

#include <algorithm>
#include <windows.h>

#include <psapi.h>

namespace facetmill {

namespace {

PROCESS_MEMORY_COUNTERS counters() {
    PROCESS_MEMORY_COUNTERS all{};
    all.cb = sizeof all;
    ::K32GetProcessMemoryInfo(::GetCurrentProcess(), &all, sizeof all);
    return all;
}

/// The remaining memory of the job object of this process, for example of a container.
std::optional<std::uint64_t> of_job() {
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION job{};
    if (!::QueryInformationJobObject(nullptr, JobObjectExtendedLimitInformation, &job, sizeof job, nullptr))
        return {};
    const DWORD flags = job.BasicLimitInformation.LimitFlags;
    std::optional<std::uint64_t> limit;
    if (flags & JOB_OBJECT_LIMIT_PROCESS_MEMORY) limit = job.ProcessMemoryLimit;
    if (flags & JOB_OBJECT_LIMIT_JOB_MEMORY)
        limit = std::min<std::uint64_t>(limit.value_or(job.JobMemoryLimit), job.JobMemoryLimit);
    if (!limit) return {};
    return *limit - std::min<std::uint64_t>(*limit, counters().PagefileUsage);
}

} // namespace

std::optional<std::uint64_t> available_memory() {
    MEMORYSTATUSEX machine{};
    machine.dwLength = sizeof machine;
    std::optional<std::uint64_t> least = of_job();
    if (!::GlobalMemoryStatusEx(&machine)) return least;
    const std::uint64_t there = std::min(machine.ullAvailPhys, machine.ullAvailPageFile);
    return least ? std::min(*least, there) : there;
}

std::uint64_t resident_memory() { return counters().WorkingSetSize; }

std::size_t peak_memory() { return counters().PeakWorkingSetSize; }

} // namespace facetmill
