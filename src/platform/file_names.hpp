#pragma once
// Operations on names of files and folders, and access checks. All return false, with errno, on failure.
// Signal handlers may call the noexcept functions.

#include <filesystem>

namespace facetmill {

/// Renames a file, replacing an existing `to`.
bool rename_file(const std::filesystem::path& from, const std::filesystem::path& to) noexcept;
bool remove_file(const std::filesystem::path& path) noexcept;
/// Removes a folder. Fails if it is not empty.
bool remove_folder(const std::filesystem::path& path) noexcept;
/// Makes a folder; its parent must exist.
bool make_folder(const std::filesystem::path& path, unsigned permissions = 0777);
/// Sets the file's time to now; for a link, the link's own time.
bool touch_file(const std::filesystem::path& path);

/// The name in a form that is equal for all spellings of it: without case on Windows.
[[nodiscard]] std::filesystem::path comparable_name(std::filesystem::path path);
/// True if no file can have this name on this system. Windows reserves the names of devices (NUL, aux.glb),
/// some characters, and a dot or blank at the end.
[[nodiscard]] bool is_reserved_name(const std::filesystem::path& path);

bool may_read(const std::filesystem::path& path);
bool may_write(const std::filesystem::path& path);
bool may_run(const std::filesystem::path& path);
/// True if this process may create files in the folder.
bool may_write_in(const std::filesystem::path& folder);

} // namespace facetmill
