#pragma once
// Temporary files of this process, with and without names.

#include "platform/descriptor.hpp"

#include <string>
#include <string_view>

namespace facetmill {

/// A hidden name in the target's folder, unique to this process.
[[nodiscard]] std::string temporary_name(const std::filesystem::path& target, int attempt);
/// The process that wrote this temporary file, or 0 for other names.
[[nodiscard]] int writer_of(std::string_view name);
/// Removes files that ended processes left in the directory (empty: the working directory). A locked file
/// stays, because it may belong to a process in another container that shares the directory, whose id is
/// unknown here.
void remove_abandoned(const std::filesystem::path& directory);

/// A file for reading and writing without a name, or whose name was removed.
[[nodiscard]] Descriptor unnamed_file(const std::filesystem::path& folder);

/// Makes a folder of this user in the system's temporary directory. Empty, with errno, on failure.
[[nodiscard]] std::filesystem::path temporary_folder(const std::string& begin_of_name);

/// The id of this process.
[[nodiscard]] int process_id();
/// True if a process with this id exists, or may exist.
[[nodiscard]] bool is_running(int process);

} // namespace facetmill
