#pragma once
// The record of batches in an output folder, so that the next batch skips unchanged assets.

#include "base/error.hpp"
#include "batch/figures.hpp"
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

/// A file as it was.
struct Stamp {
    std::string path; ///< absolute; of an output from the output folder
    std::uint64_t bytes = 0;
    std::int64_t time = 0; ///< nanoseconds; 0: compare only the digest
    std::string sha256;
};

/// A run that went well; or the reports of one that did not, beside what was there before it.
struct Done {
    std::string asset;
    std::string digest;      ///< of Work; empty: it failed, and is never unchanged
    std::string source;      ///< the asset's input, absolute; empty: a row without one
    std::string mount_point; ///< of the source; empty: not known
    bool of_table = false;
    std::vector<Stamp> inputs, outputs;
    std::vector<std::string> absent; ///< files that inputs name and that did not exist
    std::vector<std::pair<std::string, std::string>> former; ///< outputs of runs before, and their digests
    Figures figures;
    std::vector<std::string> written; ///< outputs without reports, as a summary has them
    std::vector<std::pair<std::string, std::string>> warnings; ///< ids and messages
    std::string picture;
};

/// The file's size and time now, and no digest. A time so recent that a change could follow unseen is left
/// out. None when there is no such file.
std::optional<Stamp> stamp_of(const std::filesystem::path& file);

/// A file of JSON lines, appended to as runs end: what a killed batch leaves is whole but for its last line,
/// which is then left out. It is locked while it is open.
class Journal {
  public:
    /// name: of the pipeline. Makes the folder. Throws output: E-BUSY when another batch holds it, E-WRITE.
    Journal(const std::filesystem::path& folder, const std::string& name);
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// The file in this folder: named after the pipeline, and by where that is, so that two of one name have
    /// two.
    static std::filesystem::path path_in(const std::filesystem::path& folder, const std::string& name);

    /// The assets that a journal in this folder has, also while another batch holds it.
    static std::vector<std::string> assets_in(const std::filesystem::path& folder, const std::string& name);

    const std::map<std::string, Done>& all() const { return all_; }
    /// The outputs of batches of other pipelines in the folder.
    std::set<std::string> outputs_of_others() const;
    /// What was done for the asset with these options, if its inputs and outputs are as they were then. Times
    /// that changed without the content are noted. For several threads, as long as nothing is added or
    /// removed.
    const Done* unchanged(const std::string& asset, const std::string& digest);
    /// Notes a run. A full disk is no failure; it is told once, by what is returned.
    std::optional<Diagnostic> add(Done done);
    /// Removes outputs that the asset no longer has, where they still are what was written, and empty folders
    /// above them. Returns those removed.
    std::vector<std::string> remove_former(const std::string& asset, const std::set<std::string>& current);
    /// ... all outputs of an asset, which is then forgotten.
    std::vector<std::string> remove_all(const std::string& asset, const std::set<std::string>& current);
    /// Rewrites the file without lines that later lines replace.
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
