#include "cells/storage/block_file.hpp"

#include "cells/storage/packed_numbers.hpp"
#include "cells/storage/stream.hpp"
#include "platform/file_bytes.hpp"
#include "platform/free_space.hpp"
#include "platform/temporary_files.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <utility>

namespace facetmill::cells {

namespace fs = std::filesystem;

namespace {

/// Detects damaged data, but not deliberate changes.
std::uint64_t digest_of(io::Span bytes) {
    constexpr std::uint64_t factor = 0x9e3779b97f4a7c15ULL;
    std::uint64_t sum = bytes.size() * factor;
    const auto mix = [&](std::uint64_t word) {
        sum = (sum ^ word) * factor;
        sum ^= sum >> 32;
    };
    std::size_t i = 0;
    for (std::uint64_t word = 0; i + sizeof word <= bytes.size(); i += sizeof word) {
        std::memcpy(&word, bytes.data() + i, sizeof word);
        mix(word);
    }
    for (; i < bytes.size(); ++i) mix(static_cast<std::uint64_t>(bytes[i]));
    return sum;
}

/// Throws the errors of io::cannot_write, with a hint for scratch folders. error: an errno.
[[noreturn]] void cannot_write_there(const fs::path& folder, int error) {
    const bool full = means_no_space(error);
    throw Error(ErrorKind::output, full ? "E-SPACE" : "E-WRITE",
                fmt::format("temporary data cannot be written in '{}': {}", folder.generic_string(),
                            std::strerror(error)),
                "give another folder: --scratch DIR, or --keep-cells DIR if the cells are kept");
}

} // namespace

void unreadable_scratch(const fs::path& folder) {
    throw UnreadableScratch(
        ErrorKind::output, "E-SCRATCH",
        fmt::format("temporary data in '{}' differs from the data that was written", folder.generic_string()),
        "run it again with --scratch DIR on another disk");
}

ScratchFile::ScratchFile(const fs::path& folder) : folder_(folder.empty() ? "." : folder) {
    file_ = unnamed_file(folder_);
    if (!file_) cannot_write_there(folder_, errno);
}

void ScratchFile::append(io::Span bytes) {
    constexpr std::size_t usual = std::size_t{1} << 20;
    waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
    if (waiting_.size() >= usual) write();
}

void ScratchFile::write() {
    if (!write_at(file_, size_, waiting_)) cannot_write_there(folder_, errno);
    size_ += waiting_.size();
    waiting_.clear();
}

std::shared_ptr<const ReadFile> ScratchFile::finish() {
    write();
    waiting_ = {};
    return std::make_shared<const ReadFile>(std::move(file_), folder_);
}

BlockFile::BlockFile(const fs::path& folder) : folder_(folder.empty() ? "." : folder) {
    file_ = unnamed_file(folder_);
    if (!file_) cannot_write_there(folder_, errno);
}

BlockFile::BlockFile(const fs::path& file, Named how) : folder_(file) {
    file_ = how == Named::anew ? open_file(file, {.what = OpenFor::both,
                                                  .create = Create::if_missing,
                                                  .truncates = true,
                                                  .follows_links = false})
                               : open_file(file, {.follows_links = false});
    if (!file_) cannot_write_there(folder_, errno);
}

void BlockFile::sync() const {
    if (!synced(file_)) cannot_write_there(folder_, errno);
}

Block BlockFile::put(io::Span bytes) {
    const Block block{end_.fetch_add(bytes.size()), bytes.size(), digest_of(bytes)};
    if (!write_at(file_, block.offset, bytes)) cannot_write_there(folder_, errno);
    return block;
}

/// Returns false if the data changed after writing.
bool BlockFile::read(const Block& block, std::byte* to) const {
    return read_at(file_, block.offset, {to, block.size}) == block.size &&
           digest_of({to, block.size}) == block.digest;
}

void BlockFile::get(const Block& block, std::byte* to) const {
    if (!read(block, to)) unreadable_scratch(folder_);
}

bool BlockFile::is_as_written(const Block& block) const {
    const auto about = FileStamp::of(file_);
    if (!about || block.size > about->bytes) return false;
    io::Bytes bytes(block.size);
    return read(block, bytes.data());
}

io::Bytes BlockFile::get(const Block& block) const {
    io::Bytes bytes(block.size);
    get(block, bytes.data());
    return bytes;
}

SpillFile::SpillFile(const fs::path& folder, std::size_t lists, std::size_t memory, Records records)
    : file_(std::make_unique<BlockFile>(folder)), records_(records) {
    open_lists(lists, memory);
}

SpillFile::SpillFile(std::unique_ptr<BlockFile> file, const std::vector<Block>& lists)
    : file_(std::move(file)) {
    for (const Block& block : lists) {
        if (block.size > UINT32_MAX) file_->refuse();
        lists_.push_back({{}, {part_of(block, block.size)}, block.size});
    }
}

SpillFile SpillFile::stored(const fs::path& file, const std::vector<std::size_t>& lists, bool sync,
                            std::vector<Block>& blocks) const {
    auto to = std::make_unique<BlockFile>(file, BlockFile::Named::anew);
    for (const std::size_t list : lists) blocks.push_back(to->put(read(list)));
    if (sync) to->sync();
    return {std::move(to), blocks};
}

void SpillFile::open_lists(std::size_t lists, std::size_t memory) {
    lists_.resize(lists_.size() + lists);
    constexpr std::size_t least = 256, most = std::size_t{1} << 16;
    room_ = std::clamp(memory / std::max<std::size_t>(1, lists), least, most);
}

std::size_t SpillFile::add_list() {
    lists_.emplace_back();
    return lists_.size() - 1;
}

void SpillFile::add(std::size_t number, io::Span record) {
    List& list = lists_[number];
    if (list.waiting.size() + record.size() > room_ && !list.waiting.empty()) write(list);
    if (list.waiting.capacity() < room_) list.waiting.reserve(room_);
    list.waiting.insert(list.waiting.end(), record.begin(), record.end());
    list.size += record.size();
}

/// Both sizes fit in 32 bits: they come from a list's buffer, or from a checked block.
SpillFile::Part SpillFile::part_of(const Block& block, std::uint64_t size) {
    return {block.offset, block.digest, static_cast<std::uint32_t>(block.size),
            static_cast<std::uint32_t>(size)};
}

void SpillFile::write(List& list) {
    const Block block =
        file_->put(records_ == Records::numbers ? packed_numbers(list.waiting) : io::Span(list.waiting));
    list.parts.push_back(part_of(block, list.waiting.size()));
    list.waiting.clear();
}

io::Bytes SpillFile::read(const Part& part) const {
    io::Bytes bytes = file_->get(part.block());
    if (records_ == Records::bytes) return bytes;
    io::Bytes records;
    records.reserve(part.size);
    if (!unpack_numbers(bytes, records) || records.size() != part.size) file_->refuse();
    return records;
}

void SpillFile::flush() {
    for (List& list : lists_) {
        if (!list.waiting.empty()) write(list);
        list.waiting = {};
    }
}

io::Bytes SpillFile::read(std::size_t number) const { return read(number, 0, lists_[number].size); }

io::Bytes SpillFile::read(std::size_t number, std::uint64_t begin, std::uint64_t size) const {
    io::Bytes bytes;
    bytes.reserve(size);
    std::uint64_t at = 0;
    for (const Part& one : lists_[number].parts) {
        const std::uint64_t from = std::max(begin, at), to = std::min(begin + size, at + one.size);
        if (from < to) {
            const io::Bytes whole = read(one);
            const auto part = io::Span(whole).subspan(from - at, to - from);
            bytes.insert(bytes.end(), part.begin(), part.end());
        }
        at += one.size;
    }
    return bytes;
}

} // namespace facetmill::cells
