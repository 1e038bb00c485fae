#pragma once
// Zip archives in memory (PKWARE's APPNOTE 6.3): stored and deflated entries, also with the sizes of Zip64.
// The library libzip would load TLS with every start of the program, for encryption that a 3MF may not have.

#include "io/bytes.hpp"

#include <map>

namespace facetmill::io::threemf {

/// An archive that is read. It keeps no copy of the bytes.
class Archive {
  public:
    /// Reads the directory. Throws malformed (E-ZIP) with the offset.
    Archive(Span bytes, std::string name);
    /// The contents of an entry, whose path is absolute ("/3D/3dmodel.model") and compared without case; none
    /// when there is no such entry. Throws malformed (E-ZIP) for what is damaged, encrypted or compressed in
    /// another way, limit (E-SIZE) when all that was asked for is more than a mesh comes to (see unpacked()).
    std::optional<Bytes> file(const std::string& path);

  private:
    struct Entry {
        std::uint64_t at = 0, packed = 0, size = 0;
        std::uint32_t crc = 0;
        unsigned method = 0, flags = 0;
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
    std::size_t unpacked_ = 0; ///< bytes so far
};

struct ArchiveFile {
    std::string path; ///< relative: "3D/3dmodel.model"
    Bytes bytes;
};

/// An archive of deflated files without their times, so that the same files give the same bytes.
Bytes make_archive(const std::vector<ArchiveFile>& files);

} // namespace facetmill::io::threemf
