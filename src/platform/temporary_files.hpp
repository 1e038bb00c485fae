#pragma once
// Files that this process needs for a while: their names, and files without one.

#include "platform/descriptor.hpp"

#include <string>
#include <string_view>

namespace facetmill {

/// A hidden name beside the target, of this process.
std::string temporary_name(const std::filesystem::path& target, int attempt);
/// The process that wrote this temporary, or 0 when the name is not one of ours.
int writer_of(std::string_view name);
/// Removes what processes that are gone left in the directory (empty: the working one). A temporary that
/// somebody holds locked stays: a process in another container that shares the directory has no id here.
void remove_abandoned(const std::filesystem::path& directory);

/// A file for reading and writing that has no name, or has lost it.
Descriptor unnamed_file(const std::filesystem::path& folder);

/// Makes a folder of this user in the system's place for temporary files. Empty, with errno, when it cannot.
std::filesystem::path temporary_folder(const std::string& begin_of_name);

/// The number of this process.
int process_id();

} // namespace facetmill
