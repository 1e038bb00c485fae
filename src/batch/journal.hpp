#pragma once
// Records the finished work in an output folder, so that the next batch skips unchanged assets.

#include "base/error.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace facetmill::batch {

/// The recorded state of a file.
struct Stamp {
    std::string path; ///< absolute; for outputs, relative to the output folder
    std::uint64_t bytes = 0;
    std::int64_t time = 0; ///< nanoseconds; 0: only the digest decides
    std::string sha256;
};

/// A successful run; or the reports of a failed run, with the outputs of the run before it.
struct Done {
    std::string asset;
    std::string digest;      ///< of Work; empty: the run failed, so it is never unchanged
    std::string source;      ///< the asset's input, absolute; empty: a row without one
    std::string mount_point; ///< of the source; empty: unknown
    bool of_table = false;
    std::vector<Stamp> inputs, outputs;
    std::vector<std::string> absent;                         ///< missing files that inputs name
    std::vector<std::pair<std::string, std::string>> former; ///< outputs of earlier runs, and their digests
    std::uint64_t faces_in = 0, faces_out = 0, bytes = 0;
    std::vector<std::string> written;                          ///< outputs without reports, as in a summary
    std::vector<std::pair<std::string, std::string>> warnings; ///< ids and messages
    std::string picture;
};

/// The file's current size and time, without a digest. The time is omitted if it is so recent that a later
/// change could have the same time. None if the file does not exist.
std::optional<Stamp> stamp_of(const std::filesystem::path& file);

/// A file of JSON lines, with a line appended at the end of each run. After a kill only the last line may be
/// truncated, and readers skip it. The file is locked while open.
class Journal {
  public:
    /// name: of the pipeline. Creates the folder. Throws output: E-BUSY if another batch holds it, E-WRITE.
    Journal(const std::filesystem::path& folder, const std::string& name);
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// The journal's path in this folder. It contains the pipeline's name and a hash of its location, so
    /// that pipelines with the same name have separate journals.
    static std::filesystem::path path_in(const std::filesystem::path& folder, const std::string& name);

    /// The assets in the folder's journal, even while another batch holds it.
    static std::vector<std::string> assets_in(const std::filesystem::path& folder, const std::string& name);

    const std::map<std::string, Done>& all() const { return all_; }
    /// The outputs in the folder that batches of other pipelines wrote.
    std::set<std::string> outputs_of_others() const;
    /// The record of the asset with these options, if its inputs and outputs are unchanged. Records new
    /// times of files with the same content. Thread-safe while no thread adds or removes records.
    const Done* unchanged(const std::string& asset, const std::string& digest);
    /// Records a run. A full disk is not an error; the first such failure returns a warning.
    std::optional<Diagnostic> add(Done done);
    /// Removes outputs that the asset no longer has, if they are unchanged since they were written, and
    /// their empty parent folders. Returns the removed outputs.
    std::vector<std::string> remove_former(const std::string& asset, const std::set<std::string>& current);
    /// The same for all outputs of an asset; then removes its record.
    std::vector<std::string> remove_all(const std::string& asset, const std::set<std::string>& current);
    /// Rewrites the file without superseded lines.
    std::optional<Diagnostic> compact();

  private:
    void open_locked();
    void read();
    std::optional<Diagnostic> unwritable(int error);
    bool remove_output(const std::string& path, const std::string& sha256);

    std::filesystem::path folder_, path_;
    int fd_ = -1;
    bool told_ = false;
    std::map<std::string, Done> all_;
};

} // namespace facetmill::batch
