#pragma once
// What a process gives up before it reads files of strangers: files that it does not need (Landlock), and
// calls of the system that no mesh asks for (seccomp). There is no way back. Linux only, and as far as its
// kernel has them; elsewhere nothing is given up. Call it before threads start: a thread that runs already
// keeps its access to files.

#include <filesystem>
#include <string>
#include <vector>

namespace facetmill {

/// What the kernel offers, or what is on.
struct Protections {
    int files = 0;      ///< the version of Landlock; 0: none
    bool calls = false; ///< seccomp
    bool any() const { return files > 0 || calls; }
};

/// Of this kernel. Neither with AddressSanitizer: its search for leaks traces the process from another one.
Protections offered_protections();
/// Of this process so far.
Protections active_protections();

/// What may be used from now on, besides what is open already, libraries, and what the system tells of
/// itself. A folder stands for all below it. Links are followed.
struct AllowedFiles {
    std::vector<std::filesystem::path> read = {};
    /// Files are written, made, renamed and removed below these folders, and read. Of a folder that is not
    /// there yet the nearest one above it counts; of a file, itself alone.
    std::vector<std::filesystem::path> written = {};
    std::vector<std::filesystem::path> folders_made =
        {};                ///< below these, folders are made and removed, but no files
    bool read_all = false; ///< any file may be read
    bool run_all = false;  ///< any program may be run
};

/// Gives up all other files; whether the kernel did it.
bool confine_files(const AllowedFiles& allowed);

/// Gives up new processes, networks, tracing, mounts, and whatever changes the system: such calls fail
/// (EPERM). Whether the kernel did it. For all threads.
bool confine_calls();

/// What to do when the sandbox, and not the file's permissions, refused the file; else empty. error: an
/// errno.
std::string sandbox_hint(const std::filesystem::path& file, int error);

} // namespace facetmill
