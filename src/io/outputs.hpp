#pragma once
// All outputs or none. Files are written beside their targets as temporaries and renamed together by
// commit(); whatever ends the run before (an error, a signal) removes them and leaves older outputs as they
// were. After kill -9 a temporary may stay; the next run that writes into that directory removes it.

#include "io/bytes.hpp"

#include <set>

namespace facetmill::io {

struct CleanUp; // what a signal must undo; see io/clean_up.hpp

/// The outputs of a run.
class Outputs {
  public:
    Outputs() = default;
    Outputs(const Outputs&) = delete;
    Outputs& operator=(const Outputs&) = delete;
    ~Outputs(); ///< removes what was not committed, and directories made for it

    struct File {
        std::filesystem::path target; ///< as given
        std::filesystem::path
            resolved; ///< what is replaced: symbolic links followed, so that they stay links
        std::filesystem::path temporary; ///< empty for streams (-, devices, FIFOs), which are kept in memory
        Bytes stream;
        std::size_t bytes = 0;
        std::string sha256;
        Mark where;    ///< what asked for it, for messages
        int lock = -1; ///< the temporary, held open and locked while this process lives
        CleanUp* clean_up = nullptr;
    };

    /// Stages a file; makes its directory when missing. Throws output (E-WRITE, E-SPACE, E-DIRECTORY). A
    /// target that was staged already with other bytes is E-TWICE. "-" is standard output.
    const File& add(const std::filesystem::path& target, Span bytes, const Mark& where = {});
    /// Bytes of a staged file, for reading back.
    Input staged(const File& file) const;
    /// Renames all, then streams the streams. On error everything not yet renamed is removed, what was
    /// renamed is put back as it was, and it throws. A signal that arrives between the renames waits for the
    /// last.
    void commit();
    /// Forgets everything staged (a failed run).
    void discard();
    const std::vector<std::unique_ptr<File>>& files() const { return files_; }

  private:
    struct Directory {
        std::filesystem::path path;
        CleanUp* clean_up;
    };
    void make_directory(const std::filesystem::path& directory);
    void remove_stale(const std::filesystem::path& directory);
    void stage(File& file, Span bytes);
    void rename_all();
    void forget(bool remove);

    std::vector<std::unique_ptr<File>> files_;
    std::vector<Directory> made_directories_;
    std::set<std::filesystem::path> swept_;
};

/// Writes one file at once, atomically (reports, --save, depfiles). "-" is standard output.
void write_now(const std::filesystem::path& target, Span bytes);

/// Installs handlers that remove staged temporaries and end the process by the signal: SIGINT, SIGTERM,
/// SIGHUP and SIGBUS (a mapped input shrank). Signals that were ignored stay ignored (nohup). SIGPIPE and
/// SIGXFSZ are ignored from now on, so that writing fails with an error instead.
void clean_up_on_signals();

} // namespace facetmill::io
