#pragma once
// Drops rights before a process reads untrusted files: access to unneeded files (Landlock), and system calls
// that meshes do not need (seccomp). This cannot be undone. On Linux it depends on the kernel. On Windows,
// access to files stays, but mitigation policies forbid new code and new processes. Call it before starting
// threads: a running thread keeps its access to files.

#include <filesystem>
#include <string>
#include <vector>

namespace facetmill {

/// The protections that the kernel supports, or that are active.
struct Protections {
    int files = 0;            ///< the version of Landlock; 0: not available
    bool calls = false;       ///< seccomp
    bool mitigations = false; ///< mitigation policies of Windows
    bool any() const { return files > 0 || calls || mitigations; }
};

/// The protections that this kernel supports. None with AddressSanitizer, because its leak detection traces
/// the process from another process.
[[nodiscard]] Protections offered_protections();
/// The protections that are active in this process.
[[nodiscard]] Protections active_protections();

/// Files that stay accessible, besides open files, libraries and system information. A folder includes
/// everything below it. Links are followed.
struct AllowedFiles {
    std::vector<std::filesystem::path> read = {};
    /// Files below these folders may be read, written, created, renamed and removed. A missing folder is
    /// replaced by its nearest existing ancestor; a file allows only itself.
    std::vector<std::filesystem::path> written = {};
    std::vector<std::filesystem::path> folders_made =
        {};                ///< folders may be created and removed below these, but no files
    bool read_all = false; ///< any file may be read
    bool run_all = false;  ///< any program may be run
};

/// Drops access to all other files; true if the kernel supports it.
bool confine_files(const AllowedFiles& allowed);

/// Forbids new processes, networks, tracing, mounts and other changes to the system, for all threads: such
/// calls fail (EPERM). True if the kernel supports it.
bool confine_calls();

/// A hint if the sandbox refused the file, not the file's permissions; otherwise empty. error: an errno.
[[nodiscard]] std::string sandbox_hint(const std::filesystem::path& file, int error);

} // namespace facetmill
