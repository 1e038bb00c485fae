#include "cli/watch.hpp"

#include "base/text/glob.hpp"
#include "io/outputs/output_files.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

namespace facetmill::cli {

namespace fs = std::filesystem;

Watch::Stamp Watch::stamp_of(const fs::path& file) {
    std::error_code error;
    const auto time = fs::last_write_time(file, error);
    if (error) return {};
    const auto size = fs::file_size(file, error); // folders have no size
    return std::pair(time, error ? 0 : size);
}

void Watch::leave_out(const fs::path& file) {
    const fs::path self = io::identity(file);
    if (!left_out_.insert(self).second) return;
    std::erase_if(files_, [&](const auto& one) { return io::identity(one.first) == self; });
}

void Watch::add(const fs::path& file) {
    if (!files_.contains(file) && !left_out_.contains(io::identity(file)))
        files_.emplace(file, stamp_of(file));
}

void Watch::add_all(const Watch& other) {
    left_out_.insert(other.left_out_.begin(), other.left_out_.end());
    for (const auto& [file, stamp] : other.files_) add(file);
    for (const auto& pattern : other.patterns_) {
        for (const auto& match : expand_glob(pattern)) add(match);
        add_pattern(pattern);
    }
}

Watch::Stamps Watch::now() const {
    Stamps stamps;
    for (const auto& [file, stamp] : files_) stamps.emplace(file, stamp_of(file));
    for (const auto& pattern : patterns_)
        for (const auto& match : expand_glob(pattern))
            if (!stamps.contains(match) && !left_out_.contains(io::identity(match)))
                stamps.emplace(match, stamp_of(match));
    return stamps;
}

fs::path Watch::wait() const {
    constexpr std::chrono::milliseconds between(200);
    Stamps found = now();
    while (found == files_) {
        std::this_thread::sleep_for(between);
        found = now();
    }
    const auto differs =
        std::find_if(found.begin(), found.end(), [this](const auto& one) { // `found` has all of files_
            const auto known = files_.find(one.first);
            return known == files_.end() || known->second != one.second;
        });
    const fs::path changed = differs->first;
    for (Stamps later; later != found;) {
        if (!later.empty()) found = std::move(later);
        std::this_thread::sleep_for(between);
        later = now();
    }
    return changed;
}

} // namespace facetmill::cli
