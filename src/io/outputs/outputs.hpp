#pragma once
// Writes all outputs or none. Files are written as temporaries in the target's folder, and commit() renames
// them together. If an error or a signal ends the run earlier, temporaries are removed and older outputs
// stay unchanged. After kill -9 a temporary may remain; the next run that writes to the directory removes
// it.

#include "io/bytes.hpp"
#include "platform/descriptor.hpp"

#include <functional>
#include <map>
#include <set>

namespace facetmill::io {

struct CleanUp; // an action to undo on a signal; see io/outputs/clean_up.hpp

struct CommitSettings {
    bool keep_unchanged = false; ///< leave files that already have the right bytes unchanged, with their time
    bool sync = true;            ///< sync the contents of a file before its rename, and folders at the end
    bool names_only = false;     ///< only list the files, without writing or committing
};

/// The outputs of a run.
class Outputs {
  public:
    Outputs() = default;
    Outputs(const Outputs&) = delete;
    Outputs& operator=(const Outputs&) = delete;
    ~Outputs(); ///< removes uncommitted files, and directories made for them

    struct File {
        std::filesystem::path target; ///< the path as given
        std::filesystem::path
            resolved; ///< the file to replace, with symbolic links followed, so that links stay links
        std::filesystem::path temporary; ///< empty for streams (-, devices, FIFOs), which are kept in memory
        bool is_input = false; ///< an input that already has these bytes: it stays unchanged, with its time
        Bytes stream;
        std::size_t bytes = 0;
        std::string sha256;
        Mark where;      ///< the stage or option that requested it, for messages
        Descriptor lock; ///< the temporary, held open and locked while this process lives
        CleanUp* clean_up = nullptr;
    };

    /// Protects an input with its SHA-256: from now on, only the same bytes may be written to this path.
    void protect(const std::filesystem::path& input, std::string sum);
    /// Stages a file; makes its directory when missing. Throws an output error (E-WRITE, E-SPACE,
    /// E-DIRECTORY, E-OVERWRITE, E-DUPLICATE-OUTPUT). E-OVERWRITE: a protected input has other bytes.
    /// E-DUPLICATE-OUTPUT: the target is already staged with other bytes. "-" is standard output.
    const File& add(const std::filesystem::path& target, Span bytes, const Mark& where = {});
    /// Stages data that is not in memory: `produce` passes it piece by piece. The target must not be a
    /// stream. Inputs and already staged files are refused, whatever their bytes.
    using Put = std::function<void(Span)>;
    const File& add(const std::filesystem::path& target, const std::function<void(const Put&)>& produce,
                    const Mark& where = {});
    /// Call it before anything is staged.
    void set(const CommitSettings& settings) { settings_ = settings; }
    /// Bytes of a staged file, for reading back.
    Input staged(const File& file) const;
    /// Renames all files, then writes the streams. On an error it removes all remaining temporaries,
    /// restores replaced files, and throws. Data that a stream's reader received cannot be taken back. A
    /// signal during the renames waits for the last rename. A signal during streaming also restores the
    /// files. With sync, a power failure leaves each file either unchanged or complete, but some files may
    /// be new and others old.
    void commit();
    /// Discards all staged files, after a failed run.
    void discard();
    const std::vector<std::unique_ptr<File>>& files() const { return files_; }

  private:
    struct Directory {
        std::filesystem::path path;
        CleanUp* clean_up;
    };
    void make_directory(const std::filesystem::path& directory);
    void remove_stale(const std::filesystem::path& directory);
    /// A renamed file, and the old file that was set aside (empty: none).
    struct Renamed {
        const File* file;
        std::filesystem::path aside;
        CleanUp* clean_up = nullptr; ///< needed while streams may fail
    };
    std::unique_ptr<File> file_for(const std::filesystem::path& target, const Mark& where) const;
    void make_place(const File& file);
    void stage(File& file, const std::function<void(const Put&)>& produce);
    const File& hold(std::unique_ptr<File> file, const std::filesystem::path& self);
    void leave_unchanged();
    void sync_contents() const;
    void sync_names() const;
    std::vector<Renamed> rename_all(bool streams_follow);
    void settle(const std::vector<Renamed>& all); ///< makes the commit final
    void forget(bool remove);

    CommitSettings settings_;
    std::vector<std::unique_ptr<File>> files_;
    std::map<std::filesystem::path, const File*>
        by_identity_; ///< the key is the replaced file or, for streams, the name
    std::vector<Directory> made_directories_;
    std::set<std::filesystem::path> swept_;
    std::map<std::filesystem::path, std::string> inputs_; ///< SHA-256 by identity
};

/// Writes a single file atomically (reports, --save, depfiles). "-" is standard output.
void write_now(const std::filesystem::path& target, Span bytes, const CommitSettings& settings = {});

/// Installs handlers that remove staged temporaries and end the process by the signal: SIGINT, SIGTERM,
/// SIGHUP and SIGBUS (a mapped input shrank). Signals that were ignored stay ignored (nohup). SIGPIPE and
/// SIGXFSZ are ignored from now on, so that writing fails with an error instead.
void clean_up_on_signals();

} // namespace facetmill::io
