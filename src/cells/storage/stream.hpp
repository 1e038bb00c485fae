#pragma once
// Reads parts of a file into memory of fixed size. Mapped pages would count as the process's memory.

#include "base/hash.hpp"
#include "io/bytes.hpp"
#include "platform/file_status.hpp"

namespace facetmill::cells {

/// A file that is open for reading.
class ReadFile {
  public:
    /// Throws a missing-file error.
    explicit ReadFile(const std::filesystem::path& path);
    /// Takes an unnamed temporary file in that folder.
    ReadFile(Descriptor file, std::filesystem::path folder)
        : path_(std::move(folder)), file_(std::move(file)), temporary_(true) {}
    ReadFile(const ReadFile&) = delete;
    ReadFile& operator=(const ReadFile&) = delete;
    /// Thread-safe. Throws a malformed-input error (E-CHANGED) if the file ends early, and an output error
    /// (E-SCRATCH) for temporary data.
    void read(std::uint64_t offset, std::span<std::byte> to) const;
    /// The stamp of the file at opening, even if the path now names another file. None for temporary data.
    const std::optional<FileStamp>& stamp() const { return stamp_; }
    /// Whether the stamp is the same as at opening. Thread-safe.
    bool is_as_opened() const { return !stamp_ || FileStamp::of(file_) == stamp_; }
    /// Whether the contents are the same as at opening. Thread-safe.
    bool has_same_contents() const;

  private:
    std::filesystem::path path_;
    std::optional<FileStamp> stamp_;
    Descriptor file_;
    bool temporary_ = false;
};

/// A range of a file from its beginning to its end.
class Stream {
  public:
    /// sum: hashes all bytes read; may be null.
    Stream(const ReadFile& file, std::uint64_t begin, std::uint64_t end, Sha256* sum = nullptr);
    std::uint64_t left() const { return (end_ - read_) + (filled_ - at_); }
    /// The next n bytes, valid until the next call; n <= left().
    const std::byte* take(std::size_t n);
    /// Skips n bytes; n <= left().
    void skip(std::uint64_t n);

  private:
    const ReadFile& file_;
    std::uint64_t read_, end_; ///< the unread range of the file
    Sha256* sum_;
    io::Bytes buffer_;
    std::size_t at_ = 0, filled_ = 0;
};

/// Caches records of equal size for random access. Recently used blocks stay in memory.
class RecordCache {
  public:
    RecordCache(const ReadFile& file, std::uint64_t begin, std::size_t size, std::uint64_t count,
                std::size_t memory);
    /// Whether all records fit, so that no record is read twice.
    bool holds_all() const { return slots_ == slot_of_.size(); }
    /// Adds the next record, which the caller has read, starting from the first. Requires holds_all().
    void append(const std::byte* record);
    /// Valid until the next call.
    const std::byte* at(std::uint64_t record) {
        const std::uint64_t block = record / per_block_;
        const std::uint32_t slot = slot_of_[block];
        if (slot == absent) return load(record);
        used_[slot] = 1;
        return memory_.data() + slot * block_size_ + (record % per_block_) * size_;
    }

  private:
    static constexpr std::uint32_t absent = UINT32_MAX;
    const std::byte* load(std::uint64_t record);

    const ReadFile& file_;
    std::uint64_t begin_, count_;
    std::size_t size_, per_block_, block_size_, slots_;
    std::vector<std::uint32_t> slot_of_;  ///< [blocks] slots
    std::vector<std::uint64_t> block_in_; ///< [slots] blocks
    std::vector<std::uint8_t> used_;      ///< [slots] whether used since the clock hand passed
    std::size_t hand_ = 0;
    io::Bytes memory_;
};

/// The records with these ascending numbers, concatenated.
[[nodiscard]] io::Bytes read_records(const ReadFile& file, std::uint64_t begin, std::size_t size,
                                     std::span<const std::uint32_t> numbers);

} // namespace facetmill::cells
