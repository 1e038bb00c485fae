#pragma once
// Watches files until any of them changes, for run --watch.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace facetmill::cli {

/// Polls time and size a few times a second, which works on every file system and for every writer.
class Watch {
  public:
    /// Ignores an output, as a file and as a match of a pattern, whether it is added before or after.
    void leave_out(const std::filesystem::path& file);
    /// Adds a file in its current state; a file that is already known keeps its recorded state. It need not
    /// exist.
    void add(const std::filesystem::path& file);
    /// A new match counts as a change.
    void add_pattern(const std::filesystem::path& pattern) { patterns_.push_back(pattern); }
    /// Adds the files of another Watch in their current state.
    void add_all(const Watch& other);
    std::size_t size() const { return files_.size(); }
    /// Waits until a file changes, appears or disappears, and then until all files are stable for a moment,
    /// so that writers finish. Returns the first changed file.
    std::filesystem::path wait() const;

  private:
    using Stamp = std::optional<std::pair<std::filesystem::file_time_type, std::uintmax_t>>;
    using Stamps = std::map<std::filesystem::path, Stamp>;
    static Stamp stamp_of(const std::filesystem::path& file);
    Stamps now() const;

    Stamps files_;
    std::vector<std::filesystem::path> patterns_;
    std::set<std::filesystem::path> left_out_; ///< by identity
};

} // namespace facetmill::cli
