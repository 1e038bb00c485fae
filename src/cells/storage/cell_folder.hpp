#pragma once
// A named folder in which cells outlive their run (docs/large-meshes.md describes its files).

#include "io/bytes.hpp"
#include "platform/file_lock.hpp"

#include <functional>
#include <optional>

namespace facetmill::cells {

/// Locked while open: against all other runs, or against runs outside its group.
class CellFolder {
  public:
    struct Settings {
        std::filesystem::path path;
        bool sync = true; ///< writing kept files waits until they are on disk
        /// Receives messages about reused results, and about unusable ones with the reason; reports omit
        /// them.
        std::function<void(const std::string&)> tell = {};
        /// The name of this process's work in a group of processes; empty: no other process works in the
        /// folder.
        std::string beside = {};
    };
    /// Creates the folder. Throws an output error: E-BUSY if another run holds it, E-WRITE, E-SPACE.
    explicit CellFolder(Settings settings);
    CellFolder(const CellFolder&) = delete;
    CellFolder& operator=(const CellFolder&) = delete;

    const std::filesystem::path& path() const { return settings_.path; }
    std::filesystem::path file(const std::string& name) const { return settings_.path / name; }
    bool syncs() const { return settings_.sync; }
    void tell(const std::string& what) const {
        if (settings_.tell) settings_.tell(what);
    }

    /// Writes a file atomically. Thread-safe for distinct names. Throws an output error (E-WRITE, E-SPACE).
    void write(const std::string& name, std::initializer_list<io::Span> pieces) const;
    /// The contents; none if the file is missing or unreadable.
    std::optional<io::Bytes> read(const std::string& name) const;
    /// Writes a file with a key of 64 digits, which get() checks.
    void put(const std::string& name, const std::string& key, io::Span bytes) const;
    enum class Found { as_written, nothing, damaged };
    /// The bytes put with this key. found: the reason if no bytes are returned. Thread-safe.
    std::optional<io::Bytes> get(const std::string& name, const std::string& key, Found& found) const;
    /// The names of files in the folder that start with `begin`.
    std::vector<std::string> names(const std::string& begin) const;
    void remove(const std::string& name) const;
    /// Sets the file's time to now. Throws an output error (E-WRITE).
    void touch(const std::string& name) const;
    /// The time of the file's last write; the minimum if it is missing.
    std::filesystem::file_time_type time_of(const std::string& name) const;
    /// Throws an output error (E-WRITE).
    void set_time(const std::string& name, std::filesystem::file_time_type time) const;
    /// Whether no other process of a group works in the folder.
    bool is_alone() const { return settings_.beside.empty(); }

  private:
    void take_lock(const std::string& name, Lock how);

    Settings settings_;
    std::vector<Descriptor> locks_;
};

} // namespace facetmill::cells
