#pragma once
// Temporary data beside memory: blocks of bytes in a file that has no name, so that nothing is left of it
// however the process ends; or in one with a name, for cells that are kept.

#include "cells/storage/stream.hpp"

#include <atomic>

namespace facetmill::cells {

/// Where bytes stand in a BlockFile, and what they must be when they are read again.
struct Block {
    std::uint64_t offset = 0, size = 0, digest = 0;
};

/// Throws output (E-SCRATCH): what was written there is not what is read.
[[noreturn]] void unreadable_scratch(const std::filesystem::path& folder);

/// A file without a name, written from its beginning to its end and then read anywhere.
class ScratchFile {
  public:
    /// Throws output (E-WRITE, E-SPACE).
    explicit ScratchFile(const std::filesystem::path& folder);
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;

    /// Throws output (E-WRITE, E-SPACE).
    void append(io::Span bytes);
    /// What was written. Nothing can be appended afterwards.
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
    /// Throws output (E-WRITE, E-SPACE) when no file can be made in the folder.
    explicit BlockFile(const std::filesystem::path& folder);
    enum class Named { anew, as_it_is };
    /// A file with a name, which stays: an empty one, to be written; or one that is there, to be read. Throws
    /// output (E-WRITE, E-SPACE).
    BlockFile(const std::filesystem::path& file, Named how);
    BlockFile(const BlockFile&) = delete;
    BlockFile& operator=(const BlockFile&) = delete;

    /// Any thread. Throws output (E-WRITE, E-SPACE).
    Block put(io::Span bytes);
    /// Any thread. to: block.size bytes. Throws output (E-SCRATCH) when they are not as they were written.
    void get(const Block& block, std::byte* to) const;
    io::Bytes get(const Block& block) const;
    /// Throws output (E-SCRATCH): what was read is nothing that was written.
    [[noreturn]] void refuse() const { unreadable_scratch(folder_); }
    /// Whether get would return.
    bool is_as_written(const Block& block) const;
    /// Waits until all is on the disk. Throws output (E-WRITE, E-SPACE).
    void sync() const;

  private:
    bool read(const Block& block, std::byte* to) const;
    std::filesystem::path folder_; ///< or the file, where it has a name
    Descriptor file_;
    std::atomic<std::uint64_t> end_{0};
};

/// Records of several lists that are added in any order and read list by list: what a distribution by buckets
/// needs. Adding is for one thread; reading is for any number.
class SpillFile {
  public:
    enum class Records { bytes, numbers };
    /// memory: bytes for what is not written yet, of all lists together. records: numbers of 32 bits near
    /// those before them are written in fewer bytes.
    SpillFile(const std::filesystem::path& folder, std::size_t lists, std::size_t memory,
              Records records = Records::bytes);
    /// Lists that a file has, a block each.
    SpillFile(std::unique_ptr<BlockFile> file, const std::vector<Block>& lists);

    /// Makes so many lists more; memory as above, for all that are not flushed.
    void open_lists(std::size_t lists, std::size_t memory);
    std::size_t add_list();
    void add(std::size_t list, io::Span record);
    /// Writes all that is left. Nothing may be added afterwards, but to lists that are made later.
    void flush();
    std::size_t lists() const { return lists_.size(); }
    std::uint64_t size(std::size_t list) const { return lists_[list].size; }
    /// The list must be flushed.
    io::Bytes read(std::size_t list) const;
    /// A part of it.
    io::Bytes read(std::size_t list, std::uint64_t begin, std::uint64_t size) const;
    /// These lists, which must be flushed, in a file with a name, in this order; blocks: where they stand
    /// there. sync: waits until they are on the disk.
    SpillFile stored(const std::filesystem::path& file, const std::vector<std::size_t>& lists, bool sync,
                     std::vector<Block>& blocks) const;

  private:
    /// Of a list; there may be very many.
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
    std::size_t room_ = 0;             ///< bytes of a list that wait
    std::vector<List> lists_;
};

} // namespace facetmill::cells
