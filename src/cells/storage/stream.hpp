#pragma once
// Parts of a file, read into memory of a fixed size: what is mapped would count as the process's own.

#include "base/hash.hpp"
#include "io/bytes.hpp"
#include "platform/file_status.hpp"

namespace facetmill::cells {

/// A file that is open for reading.
class ReadFile {
  public:
    /// Throws missing.
    explicit ReadFile(const std::filesystem::path& path);
    /// Temporary data without a name, in that folder: it is closed here.
    ReadFile(Descriptor file, std::filesystem::path folder)
        : path_(std::move(folder)), file_(std::move(file)), temporary_(true) {}
    ReadFile(const ReadFile&) = delete;
    ReadFile& operator=(const ReadFile&) = delete;
    /// Any thread. Throws malformed (E-CHANGED) when the file ends before; output (E-SCRATCH) when it is
    /// temporary.
    void read(std::uint64_t offset, std::span<std::byte> to) const;
    /// Of the file that is open, whatever its path names since then: when it was opened. None of temporary
    /// data.
    const std::optional<FileStamp>& stamp() const { return stamp_; }
    /// Whether nothing of it is another than when it was opened. Any thread.
    bool is_as_opened() const { return !stamp_ || FileStamp::of(file_) == stamp_; }
    /// Whether its contents are those that it had when it was opened. Any thread.
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
    /// sum: gets all bytes that go by; may be null.
    Stream(const ReadFile& file, std::uint64_t begin, std::uint64_t end, Sha256* sum = nullptr);
    std::uint64_t left() const { return (end_ - read_) + (filled_ - at_); }
    /// The next n bytes, valid until the next call; n <= left().
    const std::byte* take(std::size_t n);
    /// Passes over n bytes; n <= left().
    void skip(std::uint64_t n);

  private:
    const ReadFile& file_;
    std::uint64_t read_, end_; ///< what follows in the file
    Sha256* sum_;
    io::Bytes buffer_;
    std::size_t at_ = 0, filled_ = 0;
};

/// Records of one size, looked up in any order: blocks of the file that were used last stay.
class RecordCache {
  public:
    RecordCache(const ReadFile& file, std::uint64_t begin, std::size_t size, std::uint64_t count,
                std::size_t memory);
    /// Whether there is room for all records, so that none is read twice.
    bool holds_all() const { return slots_ == slot_of_.size(); }
    /// Takes the next record, from the first on, from who has read it; holds_all().
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
    std::vector<std::uint32_t> slot_of_;  ///< [blocks]
    std::vector<std::uint64_t> block_in_; ///< [slots]
    std::vector<std::uint8_t> used_;      ///< [slots] since the hand went by
    std::size_t hand_ = 0;
    io::Bytes memory_;
};

/// The records of these numbers, ascending, one after another.
[[nodiscard]] io::Bytes read_records(const ReadFile& file, std::uint64_t begin, std::size_t size,
                                     std::span<const std::uint32_t> numbers);

} // namespace facetmill::cells
