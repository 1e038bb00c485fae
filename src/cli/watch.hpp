#pragma once
// Files that are looked at until one of them changes: for run --watch.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace facetmill::cli {

/// By time and size, a few times a second: that works on every file system, and whatever writes the file.
class Watch {
  public:
    /// A file that is written: it is looked at neither as a file, were it added before or after, nor as a
    /// match of a pattern.
    void leave_out(const std::filesystem::path& file);
    /// As it is now; a file that is known already stays as it was. It need not be there.
    void add(const std::filesystem::path& file);
    /// A match that was not added is a change.
    void add_pattern(const std::filesystem::path& pattern) { patterns_.push_back(pattern); }
    /// What another looks at, as it is now.
    void add_all(const Watch& other);
    std::size_t size() const { return files_.size(); }
    /// Waits until a file has changed, come or gone since it was added, and then until all stay as they are
    /// for a moment, so that what is being written is whole. Returns the first that has.
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
