#pragma once
// A named folder in which cells outlive the run that made them (docs/large-meshes.md describes its files).

#include "io/bytes.hpp"
#include "platform/file_lock.hpp"

#include <functional>
#include <optional>

namespace facetmill::cells {

/// Locked as long as it is open, for all others or for those that are not beside.
class CellFolder {
  public:
    struct Settings {
        std::filesystem::path path;
        bool sync = true; ///< what is kept waits until it is on the disk
        /// Is told in words what is taken up, and what is not and why; such things are in no report.
        std::function<void(const std::string&)> tell = {};
        /// Names what is done in it beside other processes, which have other names; empty: nobody else is
        /// at work in it.
        std::string beside = {};
    };
    /// Makes it. Throws output: E-BUSY when another run holds it, E-WRITE, E-SPACE.
    explicit CellFolder(Settings settings);
    CellFolder(const CellFolder&) = delete;
    CellFolder& operator=(const CellFolder&) = delete;

    const std::filesystem::path& path() const { return settings_.path; }
    std::filesystem::path file(const std::string& name) const { return settings_.path / name; }
    bool syncs() const { return settings_.sync; }
    void tell(const std::string& what) const {
        if (settings_.tell) settings_.tell(what);
    }

    /// A file that is there whole or not at all. Any thread, each its own names. Throws output (E-WRITE,
    /// E-SPACE).
    void write(const std::string& name, std::initializer_list<io::Span> pieces) const;
    /// Nothing: it is not there, or cannot be read.
    std::optional<io::Bytes> read(const std::string& name) const;
    /// ... that is known again by its key, 64 digits.
    void put(const std::string& name, const std::string& key, io::Span bytes) const;
    enum class Found { as_written, nothing, damaged };
    /// What was put with this key; Found tells why nothing is returned. Any thread.
    std::optional<io::Bytes> get(const std::string& name, const std::string& key, Found& found) const;
    /// The names of the files in it that begin so.
    std::vector<std::string> names(const std::string& begin) const;
    void remove(const std::string& name) const;
    /// Makes it as new as one that is written now. Throws output (E-WRITE).
    void touch(const std::string& name) const;
    /// When it was written; the least time where it is not there.
    std::filesystem::file_time_type time_of(const std::string& name) const;
    /// Throws output (E-WRITE).
    void set_time(const std::string& name, std::filesystem::file_time_type time) const;
    /// Whether no other run is at work in it.
    bool is_alone() const { return settings_.beside.empty(); }

  private:
    void take_lock(const std::string& name, Lock how);

    Settings settings_;
    std::vector<Descriptor> locks_;
};

} // namespace facetmill::cells
