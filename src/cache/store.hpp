#pragma once
// A folder of entries with keys. Entries are written and replaced atomically. If there are too many, the
// least recently used are removed first. Any number of processes may share the folder.

#include "base/error.hpp"
#include "io/bytes.hpp"

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>

namespace facetmill::cache {

/// The kind of an entry, which is also its file's suffix.
enum class Kind { memory, scene, last_run };

struct StoreSettings {
    std::filesystem::path folder;
    std::uint64_t max_bytes = 0;
    bool everything = false; ///< also stores results that are cheap to compute, for tests
    /// Receives problems: W-CACHE once if the store cannot be written, and notes about corrupt entries. May
    /// be empty.
    std::function<void(const Diagnostic&)> tell = {};
    double max_share = 1; ///< share of the entries' size plus the free space of their disk
};

/// The number and size of entries.
struct Contents {
    std::uint64_t entries = 0, bytes = 0, scenes = 0;
};

/// Creates the folder of a store and its ancestors; returns true if it exists then.
bool make_folders(const std::filesystem::path& folder);

/// A cache folder. Keys are 64 hexadecimal digits; other keys, and files of other users, count as missing.
/// Thread-safe. Problems are reported and not thrown, because a run also works without its cache.
class Store {
  public:
    explicit Store(StoreSettings settings);
    /// A store for the same folder with shared state: for one of many concurrent runs, whose entries need not
    /// stay after it.
    explicit Store(const Store& other);
    Store& operator=(const Store&) = delete;
    ~Store();

    /// The stored bytes, or none. An entry with changed bytes is removed, with a note. A requested entry
    /// counts as used, and stays as long as this object or another user of it in the process exists.
    std::optional<io::Bytes> get(const std::string& key, Kind kind);
    /// True if the entry exists. It then counts as used.
    bool has(const std::string& key, Kind kind);
    /// Stores bytes; returns true if the entry exists afterwards. Fails if it cannot be written, the
    /// remaining entries leave no room, or less than twice its size plus 64 MiB is free on disk. Replaces an
    /// existing entry, except scenes, which are determined by their keys.
    bool put(const std::string& key, Kind kind, io::Span bytes);
    /// Removes an entry whose bytes from get() were invalid, with the note.
    void reject(const std::string& key, Kind kind);

    /// True until a put fails.
    bool is_usable() const;
    /// The time that the first put of a process needs to list the entries; 0 afterwards.
    double seconds_to_begin() const;
    /// The expected time of a put of this size, with encoded bytes, by the measurements of this object.
    double seconds_for(std::size_t bytes) const;
    void took(std::size_t bytes, double seconds);

    Contents contents() const;
    /// The size limit if the entries have this size: max_bytes, or less on a full disk.
    std::uint64_t limit(std::uint64_t bytes) const;
    /// The reason why put would fail; empty if none is known without trying.
    std::string hindrance() const;
    /// Removes leftovers of processes that ended early, and entries until the limit is met. Returns the
    /// removed contents.
    Contents collect();
    /// Removes all entries. Returns the removed contents.
    Contents clear();
    const StoreSettings& settings() const { return settings_; }

  private:
    std::filesystem::path path_of(const std::string& key, Kind kind) const;
    void use(const std::filesystem::path& path);
    bool write(const std::filesystem::path& path, io::Span head, io::Span bytes);
    bool make_room(std::uint64_t bytes, Kind kind);
    Contents shrink(std::uint64_t limit);
    /// Removes leftovers of writers that ended early: no entry takes an hour to write.
    void remove_leftovers(std::int64_t older_than = 3600) const;
    void cannot_write(const std::string& why);
    void tell_of_full_disk();
    void drop(const std::filesystem::path& path, const char* why);

    /// State shared by stores of the same folder and process.
    struct Known {
        std::mutex guard;                          ///< protects the following members, and used_
        std::map<std::filesystem::path, int> used; ///< number of stores that use the entry
        std::optional<std::uint64_t> total;        ///< current size, if known
        std::uint64_t limit = 0;                   ///< current limit
        std::optional<double> seconds_to_count;    ///< the expected listing time, until the size is known
        std::uint64_t since_counted = 0; ///< bytes put since counting, because other processes also write
        bool is_told_full = false;       ///< the full disk was reported
        bool broken = false;             ///< writing failed and is not tried again
        double bytes_per_second = 0;
    };

    const StoreSettings settings_;
    const std::shared_ptr<Known> known_;
    std::set<std::filesystem::path> used_;
};

} // namespace facetmill::cache
