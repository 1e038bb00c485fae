#pragma once
// Data on disk: blocks of bytes in an unnamed file, which disappears however the process ends. Kept cells
// use a named file.

#include "base/error.hpp"
#include "cells/storage/stream.hpp"

#include <atomic>

namespace facetmill::cells {

/// The position of bytes in a BlockFile, and their digest.
struct Block {
    std::uint64_t offset = 0, size = 0, digest = 0;
};

/// Data of a folder changed after writing.
struct UnreadableScratch : Error {
    using Error::Error;
};

/// Throws an output error (E-SCRATCH) because data in the folder changed after writing.
[[noreturn]] void unreadable_scratch(const std::filesystem::path& folder);

/// An unnamed file, written sequentially and then read at any position.
class ScratchFile {
  public:
    /// Throws an output error (E-WRITE, E-SPACE).
    explicit ScratchFile(const std::filesystem::path& folder);
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;

    /// Throws an output error (E-WRITE, E-SPACE).
    void append(io::Span bytes);
    /// Returns the written data. No data can be appended afterwards.
    std::shared_ptr<const ReadFile> finish();

  private:
    void write();
    std::filesystem::path folder_;
    Descriptor file_;
    io::Bytes waiting_;
    std::uint64_t size_ = 0;
};

class BlockFile {
  public:
    /// Throws an output error (E-WRITE, E-SPACE) if no file can be created in the folder.
    explicit BlockFile(const std::filesystem::path& folder);
    enum class Named { anew, as_it_is };
    /// A named file, which stays: a new empty file for writing, or an existing file for reading. Throws an
    /// output error (E-WRITE, E-SPACE).
    BlockFile(const std::filesystem::path& file, Named how);
    BlockFile(const BlockFile&) = delete;
    BlockFile& operator=(const BlockFile&) = delete;

    /// Thread-safe. Throws an output error (E-WRITE, E-SPACE).
    Block put(io::Span bytes);
    /// Thread-safe. to: block.size bytes. Throws an output error (E-SCRATCH) if the data changed after
    /// writing.
    void get(const Block& block, std::byte* to) const;
    io::Bytes get(const Block& block) const;
    /// Throws an output error (E-SCRATCH) because data changed after writing.
    [[noreturn]] void refuse() const { unreadable_scratch(folder_); }
    /// Whether get would succeed.
    bool is_as_written(const Block& block) const;
    /// Waits until all data is on disk. Throws an output error (E-WRITE, E-SPACE).
    void sync() const;

  private:
    bool read(const Block& block, std::byte* to) const;
    std::filesystem::path folder_; ///< the folder, or the named file
    Descriptor file_;
    std::atomic<std::uint64_t> end_{0};
};

/// Records of several lists, added in any order and read list by list, as a distribution into buckets needs.
/// Adding is for a single thread; reading is thread-safe.
class SpillFile {
  public:
    enum class Records { bytes, numbers };
    /// memory: bytes for unwritten records of all lists together. records: numbers stores 32-bit numbers in
    /// fewer bytes if they are close to their predecessors.
    SpillFile(const std::filesystem::path& folder, std::size_t lists, std::size_t memory,
              Records records = Records::bytes);
    /// Lists stored in a file, one block each.
    SpillFile(std::unique_ptr<BlockFile> file, const std::vector<Block>& lists);

    /// Adds this many lists. memory: bytes for all unflushed lists.
    void open_lists(std::size_t lists, std::size_t memory);
    std::size_t add_list();
    void add(std::size_t list, io::Span record);
    /// Writes all remaining records. Afterwards, records may only be added to lists opened later.
    void flush();
    std::size_t lists() const { return lists_.size(); }
    std::uint64_t size(std::size_t list) const { return lists_[list].size; }
    /// The list must be flushed.
    io::Bytes read(std::size_t list) const;
    /// Reads a part of the list.
    io::Bytes read(std::size_t list, std::uint64_t begin, std::uint64_t size) const;
    /// Copies these flushed lists into a named file, in this order. blocks: their positions in it. sync:
    /// waits until they are on disk.
    SpillFile stored(const std::filesystem::path& file, const std::vector<std::size_t>& lists, bool sync,
                     std::vector<Block>& blocks) const;

  private:
    /// A written piece of a list. Compact, because many may exist.
    struct Part {
        std::uint64_t offset, digest;
        std::uint32_t stored, size; ///< bytes in the file; bytes of the records
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
    Records records_ = Records::bytes; ///< the encoding in the file
    std::size_t room_ = 0;             ///< number of bytes that a list may buffer
    std::vector<List> lists_;
};

} // namespace facetmill::cells
