#pragma once
// Records completed runs in an output folder, so that the next batch skips unchanged assets.

#include "base/error.hpp"
#include "batch/batch.hpp"
#include "platform/descriptor.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace facetmill::batch {

/// The state of a file at some time.
struct Stamp {
    std::string path; ///< absolute; for an output, relative to the output folder
    std::uint64_t bytes = 0;
    std::int64_t time = 0; ///< nanoseconds; 0: unknown, compare the digest
    std::string sha256;
};

/// A successful run; or the reports of a failed run, with the outputs of earlier runs.
struct Done {
    std::string asset;
    std::string digest;      ///< digest of Work; empty: the run failed, so it never counts as unchanged
    std::string source;      ///< the asset's input, absolute; empty: a row without input
    std::string mount_point; ///< mount point of the source; empty: unknown
    bool of_table = false;
    std::vector<Stamp> inputs, outputs;
    std::vector<std::string> absent;                         ///< missing files that inputs refer to
    std::vector<std::pair<std::string, std::string>> former; ///< outputs of earlier runs with their digests
    Figures figures;
    std::string measured; ///< how the figures of the model were measured (Settings); empty: they were not
    std::vector<OutcomeFile> files;                            ///< the files as shown on the page
    std::optional<double> deviation;                           ///< see Outcome
    std::vector<std::string> written;                          ///< outputs without reports, for the summary
    std::vector<std::pair<std::string, std::string>> warnings; ///< ids and messages
    std::string picture;
    bool pictured = false; ///< the batch made pictures; a scene without surface has none
};

/// The current size and time of a file, without digest. Omits a time so recent that a later change could keep
/// it. None if the file does not exist.
[[nodiscard]] std::optional<Stamp> stamp_of(const std::filesystem::path& file);

/// A file of JSON lines, appended after each run. If a batch is killed, only its last line can be incomplete,
/// which is then ignored. The file is locked while it is open.
class Journal {
  public:
    /// name: the pipeline's name. Creates the folder. Throws an output error: E-BUSY when another batch
    /// holds the lock, E-WRITE.
    Journal(const std::filesystem::path& folder, const std::string& name);
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// The journal file in this folder. Its name contains the pipeline's name and a hash of its location, so
    /// that pipelines with the same name have separate journals.
    static std::filesystem::path path_in(const std::filesystem::path& folder, const std::string& name);

    /// The assets in a journal of this folder; works while another batch has it locked.
    static std::vector<std::string> assets_in(const std::filesystem::path& folder, const std::string& name);

    const std::map<std::string, Done>& all() const { return all_; }
    /// The files that batches of other pipelines have written in the folder.
    std::set<std::string> outputs_of_others() const;
    /// The record of the asset with these options, if its inputs and outputs are unchanged. Updates changed
    /// times of unchanged contents. Thread-safe while no records are added or removed.
    const Done* unchanged(const std::string& asset, const std::string& digest);
    /// Records a run. A full disk is not a failure; the returned diagnostic reports it once.
    std::optional<Diagnostic> add(Done done);
    /// Removes former outputs of the asset, if their contents are unchanged, and folders that become empty.
    /// Returns the removed files.
    std::vector<std::string> remove_former(const std::string& asset, const std::set<std::string>& current);
    /// Removes all outputs of an asset, and its record.
    std::vector<std::string> remove_all(const std::string& asset, const std::set<std::string>& current);
    /// Rewrites the file without superseded lines.
    std::optional<Diagnostic> compact();

  private:
    void open_locked();
    void read();
    std::optional<Diagnostic> unwritable(int error);
    bool remove_output(const std::string& path, const std::string& sha256);

    std::filesystem::path folder_, path_;
    Descriptor file_; ///< locked
    bool told_ = false;
    std::map<std::string, Done> all_;
};

} // namespace facetmill::batch
