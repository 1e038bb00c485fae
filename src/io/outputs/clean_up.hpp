#pragma once
// What must be undone when a signal ends the process: a list that a signal handler may walk at any time.

#include <filesystem>
#include <string_view>

namespace facetmill::io {

/// An entry of the list: a file to unlink or to put back, or a directory to remove when it is empty. Entries
/// are never freed, since a handler may be reading them; there is one per output.
struct CleanUp;

[[nodiscard]] CleanUp* clean_up_file(const std::filesystem::path& path);
/// The file that was set aside takes its old name again.
[[nodiscard]] CleanUp* clean_up_restore(const std::filesystem::path& aside,
                                        const std::filesystem::path& path);
[[nodiscard]] CleanUp* clean_up_directory(const std::filesystem::path& path);
/// The entry is done with: a signal leaves it alone from now on.
void keep(CleanUp* entry);

/// Ends the process as a signal does, from where nothing can be thrown or allocated: removes what is staged,
/// writes the message to standard error. Waits while another thread gives outputs their names. Returns only
/// to the thread that does so: it will end by itself, or throws.
void end_at_once(int exit_code, std::string_view message);

/// While one lives, a signal waits: the process ends when it goes. For the renames of a commit. A second
/// thread that makes one waits for the first; a thread has one at a time.
class HoldSignals {
  public:
    HoldSignals();
    ~HoldSignals();
    HoldSignals(const HoldSignals&) = delete;
    HoldSignals& operator=(const HoldSignals&) = delete;
};

} // namespace facetmill::io
