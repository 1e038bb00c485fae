#pragma once
// The actions to undo when a signal ends the process. A signal handler may walk the list at any time.

#include <filesystem>
#include <string_view>

namespace facetmill::io {

/// An entry of the list: a file to remove or restore, or a directory to remove if empty. Entries are never
/// freed, because a handler may be reading them. Each output has one entry.
struct CleanUp;

[[nodiscard]] CleanUp* clean_up_file(const std::filesystem::path& path);
/// Restores the old name of a file that was set aside.
[[nodiscard]] CleanUp* clean_up_restore(const std::filesystem::path& aside,
                                        const std::filesystem::path& path);
[[nodiscard]] CleanUp* clean_up_directory(const std::filesystem::path& path);
/// Disables the entry, so that signals ignore it.
void keep(CleanUp* entry);

/// Ends the process as a signal does, from code that must not throw or allocate. Removes staged files and
/// writes the message to standard error. Waits while another thread renames outputs. Returns only if the
/// calling thread is renaming outputs, because that thread will end or throw itself.
void end_at_once(int exit_code, std::string_view message);

/// Delays signals during the renames of a commit. The process ends when this object is destroyed. A second
/// thread waits for the first; a thread has at most one such object.
class HoldSignals {
  public:
    HoldSignals();
    ~HoldSignals();
    HoldSignals(const HoldSignals&) = delete;
    HoldSignals& operator=(const HoldSignals&) = delete;
};

} // namespace facetmill::io
