#pragma once
// A folder of entries addressed by keys. Entries are written and replaced atomically. When the store is too
// large, the least recently used entries are removed first. Any number of processes may share it.

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

/// The kind of an entry, which is the suffix of its file.
enum class Kind { memory, scene, last_run };

struct StoreSettings {
    std::filesystem::path folder;
    std::uint64_t max_bytes = 0;
    bool everything = false; ///< also store results that are cheap to compute (tests)
    /// Is told what hinders the store: W-CACHE, once, when it cannot be written; notes of corrupt entries.
    /// May be empty.
    std::function<void(const Diagnostic&)> tell = {};
    double max_share = 1; ///< relative to the entries plus the free space of their disk
};

/// The size of the store.
struct Contents {
    std::uint64_t entries = 0, bytes = 0, scenes = 0;
};

/// Creates the folder of a store and its parents; returns whether it exists afterwards.
bool make_folders(const std::filesystem::path& folder);

/// Keys are 64 hexadecimal digits; other keys have no entry. Files of other users are ignored. Thread-safe.
/// Failures are reported, not thrown: a run works without its cache.
class Store {
  public:
    explicit Store(StoreSettings settings);
    /// Another for the same folder, which knows what this one knows: for one of many runs at a time, whose
    /// entries need not stay when it is over.
    explicit Store(const Store& other);
    Store& operator=(const Store&) = delete;
    ~Store();

    /// The bytes that were put, or nothing. An entry whose bytes are not what was written is removed, with a
    /// note. What was asked for counts as used, and stays as long as this object lives: as it does for the
    /// others of the process that know of it.
    std::optional<io::Bytes> get(const std::string& key, Kind kind);
    /// Whether an entry exists, which then counts as used.
    bool has(const std::string& key, Kind kind);
    /// Whether it is there afterwards: not when it cannot be written, there is no room beside what stays, or
    /// the disk has less free than twice the entry and 64 MiB. Replaces what is there, but for scenes, which
    /// are all that their keys say.
    bool put(const std::string& key, Kind kind, io::Span bytes);
    /// get() of bytes that turned out to mean nothing: removed, with the note.
    void reject(const std::string& key, Kind kind);

    /// Whether a put has not failed yet.
    bool is_usable() const;
    /// The time that the first put of a process needs to scan the store; 0 afterwards.
    double seconds_to_begin() const;
    /// How long a put of that many bytes takes, made ready before, as far as this object has seen.
    double seconds_for(std::size_t bytes) const;
    void took(std::size_t bytes, double seconds);

    Contents contents() const;
    /// How many bytes there may be beside so many that are there: max_bytes, or less on a disk that is full.
    std::uint64_t limit(std::uint64_t bytes) const;
    /// Why nothing can be put; empty: it can, as far as that is seen without doing it.
    std::string hindrance() const;
    /// Removes the remains of processes that ended early, and entries until all are within the limit.
    /// Returns the removed amount.
    Contents collect();
    /// Removes all entries. How much went.
    Contents clear();
    const StoreSettings& settings() const { return settings_; }

  private:
    std::filesystem::path path_of(const std::string& key, Kind kind) const;
    void use(const std::filesystem::path& path);
    bool write(const std::filesystem::path& path, io::Span head, io::Span bytes);
    bool make_room(std::uint64_t bytes, Kind kind);
    Contents shrink(std::uint64_t limit);
    /// Removes files of writers that ended early: no entry takes an hour to write.
    void remove_leftovers(std::int64_t older_than = 3600) const;
    void cannot_write(const std::string& why);
    void tell_of_full_disk();
    void drop(const std::filesystem::path& path, const char* why);

    /// The state shared by the stores of one folder in a process.
    struct Known {
        std::mutex guard;                          ///< of all that follows, and of used_ of each
        std::map<std::filesystem::path, int> used; ///< by how many of them
        std::optional<std::uint64_t> total;        ///< bytes there, as far as known
        std::uint64_t limit = 0;                   ///< ... and how many there may be
        std::optional<double> seconds_to_count;    ///< what is there, as long as it is not known
        std::uint64_t since_counted = 0;           ///< bytes put since then: other processes put some, too
        bool is_told_full = false;                 ///< that the disk is full, once
        bool broken = false;                       ///< it cannot be written: not tried again
        double bytes_per_second = 0;
    };

    const StoreSettings settings_;
    const std::shared_ptr<Known> known_;
    std::set<std::filesystem::path> used_;
};

} // namespace facetmill::cache
