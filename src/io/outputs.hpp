#pragma once
// All outputs or none. Files are written beside their targets as temporaries and renamed together by commit();
// whatever ends the run before (an error, a signal) removes them and leaves older outputs as they were. After
// kill -9 a temporary may stay; the next run that writes into that directory removes it.

#include "io/bytes.hpp"

namespace facetmill::io {

/// The outputs of a run.
class Outputs {
  public:
    Outputs() = default;
    Outputs(const Outputs&) = delete;
    Outputs& operator=(const Outputs&) = delete;
    ~Outputs(); ///< removes what was not committed, and directories made for it

    struct File {
        std::filesystem::path target;
        std::filesystem::path temporary; ///< empty for streams (-, devices, FIFOs), which are kept in memory
        Bytes stream;
        std::size_t bytes = 0;
        std::string sha256;
    };

    /// Stages a file; makes its directory when missing. Throws output (E-WRITE, E-SPACE, E-DIRECTORY). A target that
    /// was staged already is E-TWICE. "-" is standard output.
    const File& add(const std::filesystem::path& target, Span bytes);
    /// Bytes of a staged file, for reading back.
    Input staged(const File& file) const;
    /// Renames all, then streams the streams. On error everything not yet renamed is removed and it throws.
    void commit();
    /// Forgets everything staged (a failed run).
    void discard();
    const std::vector<std::unique_ptr<File>>& files() const { return files_; }

  private:
    std::vector<std::unique_ptr<File>> files_;
    std::vector<std::filesystem::path> made_directories_;
};

/// Writes one file at once, atomically (reports, --save, depfiles). "-" is standard output.
void write_now(const std::filesystem::path& target, Span bytes);

/// Installs handlers that remove staged temporaries and end the process by the signal: SIGINT, SIGTERM, SIGHUP.
void clean_up_on_signals();

} // namespace facetmill::io
