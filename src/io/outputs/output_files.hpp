#pragma once
// What is done to one file of the system while it is written: names of temporaries, links, permissions.

#include "io/bytes.hpp"

#include <filesystem>
#include <string_view>

namespace facetmill::io {

/// The way out where a target cannot be written: what the sandbox says of it, else another folder. error: an
/// errno.
std::string hint_to_write(const std::filesystem::path& target, int error);

/// Throws output in words for people: E-SPACE, E-DIRECTORY, else E-WRITE. error: an errno.
[[noreturn]] void cannot_write(const std::filesystem::path& target, int error);

/// Begins to write what the system keeps of a file, without waiting; a hint.
void begin_sync(int fd);
/// Waits until the bytes of a file, or the names in a folder, are on the disk. False, with errno, when they
/// cannot get there; what a file system cannot be asked is true.
bool synced(int fd);

/// Throws as cannot_write, naming the target.
void write_all(int fd, Span bytes, const std::filesystem::path& target);

/// Whether the target takes bytes one after another and cannot be replaced by a rename.
bool is_stream(const std::filesystem::path& target);

/// The file that is replaced: symbolic links at the end are followed, also when they lead nowhere yet.
std::filesystem::path followed(std::filesystem::path path);

/// One name for a file, however it is spelled; "-" stays. Where a folder cannot be looked into, links there
/// are not followed.
std::filesystem::path identity(const std::filesystem::path& path);

/// A hidden name beside the target, of this process.
std::string temporary_name(const std::filesystem::path& target, int attempt);
/// The process that wrote this temporary, or 0 when the name is not one of ours.
int writer_of(std::string_view name);
/// Whether nobody is at work on the temporary: its process is gone, and nobody holds its lock (a process in
/// another container that shares the directory has no id here).
bool is_abandoned(const std::filesystem::path& temporary, int pid);
/// Removes what processes that are gone left in the directory (empty: the working one).
void remove_abandoned(const std::filesystem::path& directory);

/// Gives the temporary the permissions, and as far as allowed the owner, of the file it will replace.
void keep_permissions(int fd, const std::filesystem::path& target, const std::filesystem::path& given);

/// A second name (or, where there are no hard links, a copy) of the file at target; empty when there is none.
std::filesystem::path set_aside(const std::filesystem::path& target);

} // namespace facetmill::io
