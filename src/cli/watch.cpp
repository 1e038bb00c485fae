#include "cli/watch.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

namespace facetmill::cli {

namespace fs = std::filesystem;

Watch::Stamp Watch::stamp_of(const fs::path& file) {
    std::error_code error;
    const auto time = fs::last_write_time(file, error);
    if (error) return {};
    const auto size = fs::file_size(file, error); // a folder has none
    return std::pair(time, error ? 0 : size);
}

void Watch::add(const fs::path& file) { files_.try_emplace(file, stamp_of(file)); }

Watch::Stamps Watch::now() const {
    Stamps stamps;
    for (const auto& [file, stamp] : files_) stamps.emplace(file, stamp_of(file));
    return stamps;
}

fs::path Watch::wait() const {
    constexpr std::chrono::milliseconds between(200);
    Stamps found = now();
    while (found == files_) {
        std::this_thread::sleep_for(between);
        found = now();
    }
    const auto differs = std::mismatch(files_.begin(), files_.end(), found.begin());
    for (Stamps later; later != found;) {
        if (!later.empty()) found = std::move(later);
        std::this_thread::sleep_for(between);
        later = now();
    }
    return differs.first->first;
}

} // namespace facetmill::cli
