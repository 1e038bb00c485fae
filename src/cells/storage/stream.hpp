#pragma once
// Reads parts of a file into memory of a fixed size, because mapped memory would count as the process's own.

#include "base/hash.hpp"
#include "io/bytes.hpp"

#include <optional>

namespace facetmill::cells {

/// Reads a file from this offset. Returns the number of bytes, which is smaller at the end of the file or on
/// an error.
std::size_t read_at(int file, std::uint64_t offset, std::span<std::byte> to);

/// The status of a file from the system.
struct FileStamp {
    std::uint64_t bytes = 0, device = 0, inode = 0;
    std::int64_t modified = 0, changed = 0; ///< nanoseconds since 1970: of the contents, and of any change
    bool operator==(const FileStamp&) const = default;

    /// None if the file does not exist.
    static std::optional<FileStamp> of(const std::filesystem::path& path);
    static std::optional<FileStamp> of(int file);
    /// Whether the contents are the same; the name, owner and number of links may differ.
    bool has_contents_of(const FileStamp& other) const;
    /// Whether a write at time `now` or later changes the file's times, even if the system counts in
    /// seconds.
    bool is_settled(std::int64_t now) const;
};

/// A file that is open for reading.
class ReadFile {
  public:
    /// Throws missing.
    explicit ReadFile(const std::filesystem::path& path);
    /// Temporary data without a name, in that folder; closes the file.
    ReadFile(int file, std::filesystem::path folder)
        : path_(std::move(folder)), file_(file), temporary_(true) {}
    ~ReadFile();
    ReadFile(const ReadFile&) = delete;
    ReadFile& operator=(const ReadFile&) = delete;
    /// Thread-safe. Throws malformed (E-CHANGED) if the file ends too early; output (E-SCRATCH) if it is
    /// temporary.
    void read(std::uint64_t offset, std::span<std::byte> to) const;
    /// The status of the file when it was opened, whatever its path names now. None for temporary data.
    const std::optional<FileStamp>& stamp() const { return stamp_; }
    /// Whether the file is unchanged since it was opened. Thread-safe.
    bool is_as_opened() const { return !stamp_ || FileStamp::of(file_) == stamp_; }
    /// Whether the contents are unchanged since the file was opened. Thread-safe.
    bool has_same_contents() const;

  private:
    std::filesystem::path path_;
    std::optional<FileStamp> stamp_;
    int file_ = -1;
    bool temporary_ = false;
};

/// Reads a range of a file sequentially.
class Stream {
  public:
    /// sum: receives all bytes read; may be null.
    Stream(const ReadFile& file, std::uint64_t begin, std::uint64_t end, Sha256* sum = nullptr);
    std::uint64_t left() const { return (end_ - read_) + (filled_ - at_); }
    /// The next n bytes, valid until the next call; n <= left().
    const std::byte* take(std::size_t n);
    /// Skips n bytes; n <= left().
    void skip(std::uint64_t n);

  private:
    const ReadFile& file_;
    std::uint64_t read_, end_; ///< the part still in the file
    Sha256* sum_;
    io::Bytes buffer_;
    std::size_t at_ = 0, filled_ = 0;
};

/// Random access to records of equal size, with a cache of recently used blocks.
class RecordCache {
  public:
    RecordCache(const ReadFile& file, std::uint64_t begin, std::size_t size, std::uint64_t count,
                std::size_t memory);
    /// Whether all records fit, so that none is read twice.
    bool holds_all() const { return slots_ == slot_of_.size(); }
    /// Adds the next record, from the first on, when the caller has already read it. Requires holds_all().
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
    std::vector<std::uint8_t> used_;      ///< [slots] used since the clock hand passed
    std::size_t hand_ = 0;
    io::Bytes memory_;
};

/// The records with these numbers, ascending, concatenated.
io::Bytes read_records(const ReadFile& file, std::uint64_t begin, std::size_t size,
                       std::span<const std::uint32_t> numbers);

} // namespace facetmill::cells
