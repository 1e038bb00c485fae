#pragma once
// What is done to one file of the system while it is written: links, permissions.

#include "io/bytes.hpp"
#include "platform/descriptor.hpp"

#include <filesystem>

namespace facetmill::io {

/// The way out where a target cannot be written: what the sandbox says of it, else another folder. error: an
/// errno.
[[nodiscard]] std::string hint_to_write(const std::filesystem::path& target, int error);

/// Throws output in words for people: E-SPACE, E-DIRECTORY, else E-WRITE. error: an errno.
[[noreturn]] void cannot_write(const std::filesystem::path& target, int error);

/// Throws as cannot_write, naming the target.
void write_all(const Descriptor& file, Span bytes, const std::filesystem::path& target);

/// Whether the target takes bytes one after another and cannot be replaced by a rename.
bool is_stream(const std::filesystem::path& target);

/// The file that is replaced: symbolic links at the end are followed, also when they lead nowhere yet.
[[nodiscard]] std::filesystem::path followed(std::filesystem::path path);

/// One name for a file, however it is spelled; "-" stays. Where a folder cannot be looked into, links there
/// are not followed.
[[nodiscard]] std::filesystem::path identity(const std::filesystem::path& path);

/// Gives the temporary the permissions, and as far as allowed the owner, of the file it will replace.
void keep_permissions(const Descriptor& file, const std::filesystem::path& target,
                      const std::filesystem::path& given);

/// A second name (or, where there are no hard links, a copy) of the file at target; empty when there is none.
[[nodiscard]] std::filesystem::path set_aside(const std::filesystem::path& target);

} // namespace facetmill::io
