#include "io/outputs/early_folders.hpp"

#include "io/outputs/clean_up.hpp"
#include "platform/file_lock.hpp"
#include "platform/file_names.hpp"

#include <cerrno>

namespace facetmill::io {

namespace fs = std::filesystem;

namespace {

/// The limit for folders held open. Beyond it, two runs that fail at the same time may disturb each other.
constexpr std::size_t max_open_folders = 128;

} // namespace

void EarlyFolders::use(const fs::path& folder, bool made) {
    Folder& own =
        folders_.emplace_back(Folder{folder, {}, made, made ? clean_up_directory(folder) : nullptr});
    if (folders_.size() > max_open_folders) return;
    own.lock = open_file(folder, {.is_folder = true});
    if (own.lock) try_lock(own.lock, Lock::shared);
}

void EarlyFolders::make(const fs::path& folder) {
    std::error_code error;
    constexpr int max_attempts = 100; // another run may remove a folder that it had made
    for (int attempt = 0; attempt < max_attempts && !folder.empty(); ++attempt) {
        if (fs::is_directory(folder, error)) {
            use(folder, false);
            if (fs::is_directory(folder, error)) return; // this object holds the folder locked, so it stays
        } else {
            make(folder.parent_path());
            if (make_folder(folder)) return use(folder, true);
            if (errno != ENOENT && errno != EEXIST) return;
            if (fs::exists(fs::symlink_status(folder, error)) && !fs::is_directory(folder, error)) return;
        }
    }
}

std::vector<fs::path> EarlyFolders::made_in() const {
    std::vector<fs::path> all;
    for (const auto& folder : folders_)
        if (folder.made) all.push_back(folder.path.has_parent_path() ? folder.path.parent_path() : ".");
    return all;
}

EarlyFolders::~EarlyFolders() {
    for (auto folder = folders_.rbegin(); folder != folders_.rend(); ++folder) {
        const bool free = !folder->lock || try_lock(folder->lock);
        if (folder->made && free) remove_folder(folder->path); // fails if the folder is not empty
        if (folder->made) keep(folder->clean_up);
        folder->lock.close();
    }
}

} // namespace facetmill::io
