#pragma once
// Times of files, which some systems count in steps.

#include "support/temporary.hpp"

#include <chrono>
#include <thread>

namespace facetmill::test {

/// Waits until new files in the folder get a later time than existing files. This takes up to 10 ms before
/// Linux 6.13, and more on some file systems.
inline void let_file_time_pass(const std::filesystem::path& folder) {
    const auto probe = folder / "probe";
    const auto time_of_now = [&] {
        put(probe, "");
        return std::filesystem::last_write_time(probe);
    };
    for (const auto before = time_of_now(); time_of_now() == before;)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::filesystem::remove(probe);
}

} // namespace facetmill::test
