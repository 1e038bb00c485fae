#pragma once
// Temporary data on disk: blocks of bytes in a file without a name, so that nothing remains however the
// process ends. Kept cells use a file with a name.

#include "cells/storage/stream.hpp"

#include <atomic>

namespace facetmill::cells {

/// The location of bytes in a BlockFile, and the digest expected on reading.
struct Block {
    std::uint64_t offset = 0, size = 0, digest = 0;
};

/// Throws output (E-SCRATCH): the bytes read differ from the bytes written.
[[noreturn]] void unreadable_scratch(const std::filesystem::path& folder);

/// A file without a name, written sequentially and then read anywhere.
class ScratchFile {
  public:
    /// Throws output (E-WRITE, E-SPACE).
    explicit ScratchFile(const std::filesystem::path& folder);
    ~ScratchFile();
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;

    /// Throws output (E-WRITE, E-SPACE).
    void append(io::Span bytes);
    /// Returns the written file. Nothing can be appended afterwards.
    std::shared_ptr<const ReadFile> finish();

  private:
    void write();
    std::filesystem::path folder_;
    int file_ = -1;
    io::Bytes waiting_;
    std::uint64_t size_ = 0;
};

class BlockFile {
  public:
    /// Throws output (E-WRITE, E-SPACE) if the folder cannot hold a file.
    explicit BlockFile(const std::filesystem::path& folder);
    enum class Named { anew, as_it_is };
    /// A persistent file with a name: new and empty for writing, or existing for reading. Throws output
    /// (E-WRITE, E-SPACE).
    BlockFile(const std::filesystem::path& file, Named how);
    ~BlockFile();
    BlockFile(const BlockFile&) = delete;
    BlockFile& operator=(const BlockFile&) = delete;

    /// Thread-safe. Throws output (E-WRITE, E-SPACE).
    Block put(io::Span bytes);
    /// Thread-safe. to: block.size bytes. Throws output (E-SCRATCH) if the bytes changed.
    void get(const Block& block, std::byte* to) const;
    io::Bytes get(const Block& block) const;
    /// Throws output (E-SCRATCH): the bytes were not written by this program.
    [[noreturn]] void refuse() const { unreadable_scratch(folder_); }
    /// Whether get would succeed.
    bool is_as_written(const Block& block) const;
    /// Waits until all data is on disk. Throws output (E-WRITE, E-SPACE).
    void sync() const;

  private:
    bool read(const Block& block, std::byte* to) const;
    std::filesystem::path folder_; ///< or the file, if it has a name
    int file_ = -1;
    std::atomic<std::uint64_t> end_{0};
};

/// Records of several lists, added in any order and read list by list, for distribution into buckets. A
/// single thread adds; any number of threads read.
class SpillFile {
  public:
    enum class Records { bytes, numbers };
    /// memory: bytes for unwritten records of all lists together. records: `numbers` packs 32-bit numbers
    /// that are close to their predecessors.
    SpillFile(const std::filesystem::path& folder, std::size_t lists, std::size_t memory,
              Records records = Records::bytes);
    /// The lists of an existing file, a block each.
    SpillFile(std::unique_ptr<BlockFile> file, const std::vector<Block>& lists);

    /// Adds `lists` lists; memory as above, for all unflushed lists.
    void open_lists(std::size_t lists, std::size_t memory);
    std::size_t add_list();
    void add(std::size_t list, io::Span record);
    /// Writes all waiting records. Afterwards records may only be added to new lists.
    void flush();
    std::size_t lists() const { return lists_.size(); }
    std::uint64_t size(std::size_t list) const { return lists_[list].size; }
    /// The list must be flushed.
    io::Bytes read(std::size_t list) const;
    /// A part of it.
    io::Bytes read(std::size_t list, std::uint64_t begin, std::uint64_t size) const;
    /// Copies these flushed lists, in this order, to a named file; blocks: their locations. sync: wait until
    /// they are on disk.
    SpillFile stored(const std::filesystem::path& file, const std::vector<std::size_t>& lists, bool sync,
                     std::vector<Block>& blocks) const;

  private:
    /// A part of a list; parts may be very many.
    struct Part {
        std::uint64_t offset, digest;
        std::uint32_t stored, size; ///< bytes in the file, and of the records
        Block block() const { return {offset, stored, digest}; }
    };
    static Part part_of(const Block& block, std::uint64_t size);
    struct List {
        io::Bytes waiting;
        std::vector<Part> parts;
        std::uint64_t size = 0;
    };
    void write(List& list);
    io::Bytes read(const Part& part) const;

    std::unique_ptr<BlockFile> file_;
    Records records_ = Records::bytes; ///< in the file
    std::size_t room_ = 0;             ///< waiting bytes per list
    std::vector<List> lists_;
};

} // namespace facetmill::cells
