#pragma once
// Names of files and folders, and what this process may do with them. All return false, with errno, when the
// system refuses; a handler of signals may call those that end in noexcept.

#include <filesystem>

namespace facetmill {

/// Replaces what has the name `to`.
bool rename_file(const std::filesystem::path& from, const std::filesystem::path& to) noexcept;
bool remove_file(const std::filesystem::path& path) noexcept;
/// Unless something is in it.
bool remove_folder(const std::filesystem::path& path) noexcept;
/// One folder, in one that is there.
bool make_folder(const std::filesystem::path& path, unsigned permissions = 0777);
/// Gives it the time of now; of a link, the link itself.
bool touch_file(const std::filesystem::path& path);

bool may_read(const std::filesystem::path& path);
bool may_write(const std::filesystem::path& path);
bool may_run(const std::filesystem::path& path);
/// Whether files may be made in the folder.
bool may_write_in(const std::filesystem::path& folder);

} // namespace facetmill
