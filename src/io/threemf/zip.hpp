#pragma once
// Zip archives in memory (PKWARE's APPNOTE 6.3): stored and deflated entries, also with Zip64 sizes. The
// library libzip would load TLS at every start of the program, for encryption that 3MF forbids.

#include "io/bytes.hpp"

#include <map>

namespace facetmill::io::threemf {

/// Reads an archive, without copying the bytes.
class Archive {
  public:
    /// Reads the directory. Throws a malformed-input error (E-ZIP) with the offset.
    Archive(Span bytes, std::string name);
    /// The contents of an entry, or none if it does not exist. The path is absolute ("/3D/3dmodel.model")
    /// and compared without case. Throws a malformed-input error (E-ZIP) for damaged or encrypted entries
    /// and other compression methods. Throws a limit error (E-SIZE) if the total unpacked size is
    /// implausible for a mesh (see unpacked()).
    std::optional<Bytes> file(const std::string& path);
    /// Whether there is an entry; compared as for file().
    [[nodiscard]] bool has(const std::string& path) const;
    /// The paths of all entries as stored, sorted without case.
    [[nodiscard]] std::vector<std::string> paths() const;

  private:
    struct Entry {
        std::uint64_t at = 0, packed = 0, size = 0;
        std::uint32_t crc = 0;
        unsigned method = 0, flags = 0;
        std::string path;
    };
    std::uint64_t number(std::uint64_t at, int bytes) const;
    [[noreturn]] void fail(std::uint64_t at, const std::string& message) const;
    std::uint64_t find_end() const;
    void read_directory(std::uint64_t end);
    std::uint64_t read_entry(std::uint64_t at);
    void take_zip64(Entry& entry, std::uint64_t at, std::uint64_t end) const;

    Span bytes_;
    std::string name_;
    std::map<std::string, Entry> entries_;
    std::size_t unpacked_ = 0; ///< unpacked bytes so far
};

struct ArchiveFile {
    std::string path; ///< a relative path: "3D/3dmodel.model"
    Bytes bytes;
};

/// Makes an archive. It stores no times, so that equal files give equal bytes. alignment: 0 deflates the
/// files; otherwise they are stored, and the bytes of each begin at a multiple of it.
[[nodiscard]] Bytes make_archive(const std::vector<ArchiveFile>& files, std::size_t alignment = 0);

} // namespace facetmill::io::threemf
