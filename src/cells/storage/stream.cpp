#include "cells/storage/stream.hpp"

#include "cells/storage/block_file.hpp"
#include "io/text.hpp"
#include "platform/file_bytes.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>

namespace facetmill::cells {

ReadFile::ReadFile(const std::filesystem::path& path) : path_(path) {
    file_ = open_file(path);
    if (!file_)
        throw Error(ErrorKind::missing, "E-FILE",
                    fmt::format("'{}' cannot be read: {}", path.generic_string(), std::strerror(errno)));
    stamp_ = FileStamp::of(file_);
}

void ReadFile::read(std::uint64_t offset, std::span<std::byte> to) const {
    const std::size_t done = read_at(file_, offset, to);
    if (done == to.size()) return;
    if (temporary_) unreadable_scratch(path_);
    io::malformed(path_.generic_string(), 0, "E-CHANGED",
                  fmt::format("byte {} cannot be read any more", offset + done),
                  "run it again while no other program writes to the file");
}

bool ReadFile::has_same_contents() const {
    if (!stamp_) return true;
    const std::optional<FileStamp> now = FileStamp::of(file_);
    return now && now->has_contents_of(*stamp_);
}

Stream::Stream(const ReadFile& file, std::uint64_t begin, std::uint64_t end, Sha256* sum)
    : file_(file), read_(begin), end_(end), sum_(sum) {}

const std::byte* Stream::take(std::size_t n) {
    constexpr std::size_t usual = std::size_t{1} << 20;
    if (filled_ - at_ < n) {
        const std::size_t kept = filled_ - at_;
        if (kept > 0) std::memmove(buffer_.data(), buffer_.data() + at_, kept);
        buffer_.resize(std::max({n, usual, buffer_.size()}));
        const std::size_t more =
            static_cast<std::size_t>(std::min<std::uint64_t>(buffer_.size() - kept, end_ - read_));
        const std::span<std::byte> fresh(buffer_.data() + kept, more);
        file_.read(read_, fresh);
        if (sum_) sum_->add(fresh);
        read_ += more;
        at_ = 0;
        filled_ = kept + more;
    }
    const std::byte* const taken = buffer_.data() + at_;
    at_ += n;
    return taken;
}

void Stream::skip(std::uint64_t n) {
    constexpr std::uint64_t at_once = 1 << 16;
    for (; n > 0; n -= std::min(n, at_once)) take(static_cast<std::size_t>(std::min(n, at_once)));
}

RecordCache::RecordCache(const ReadFile& file, std::uint64_t begin, std::size_t size, std::uint64_t count,
                         std::size_t memory)
    : file_(file), begin_(begin), count_(count), size_(size) {
    constexpr std::size_t usual = std::size_t{1} << 15;
    per_block_ = std::max<std::size_t>(1, usual / size);
    block_size_ = per_block_ * size;
    const std::uint64_t blocks = (count + per_block_ - 1) / per_block_;
    slots_ = static_cast<std::size_t>(
        std::min<std::uint64_t>(std::max<std::size_t>(8, memory / block_size_), blocks));
    slot_of_.assign(blocks, absent);
    block_in_.reserve(slots_);
    used_.reserve(slots_);
    memory_.reserve(
        slots_ *
        block_size_); // reserving is cheap, because the system counts pages only when they are written
}

void RecordCache::append(const std::byte* record) {
    if (memory_.size() % block_size_ == 0) { // start the next block
        slot_of_[block_in_.size()] = static_cast<std::uint32_t>(block_in_.size());
        block_in_.push_back(block_in_.size());
        used_.push_back(1);
    }
    memory_.insert(memory_.end(), record, record + size_);
}

const std::byte* RecordCache::load(std::uint64_t record) {
    const std::uint64_t block = record / per_block_;
    std::size_t slot = block_in_.size();
    if (slot < slots_) {
        block_in_.push_back(block);
        used_.push_back(1);
        memory_.resize(block_in_.size() * block_size_);
    } else { // the first slot unused since the clock hand passed
        while (used_[hand_]) {
            used_[hand_] = 0;
            hand_ = (hand_ + 1) % slots_;
        }
        slot = hand_;
        hand_ = (hand_ + 1) % slots_;
        slot_of_[block_in_[slot]] = absent;
        block_in_[slot] = block;
        used_[slot] = 1;
    }
    slot_of_[block] = static_cast<std::uint32_t>(slot);
    const std::uint64_t first = block * per_block_;
    const auto n = static_cast<std::size_t>(std::min<std::uint64_t>(per_block_, count_ - first));
    file_.read(begin_ + first * size_, std::span(memory_.data() + slot * block_size_, n * size_));
    return memory_.data() + slot * block_size_ + (record - first) * size_;
}

io::Bytes read_records(const ReadFile& file, std::uint64_t begin, std::size_t size,
                       std::span<const std::uint32_t> numbers) {
    constexpr std::uint64_t bridged = 4096; // gaps up to this many bytes are read too
    constexpr std::size_t most = std::size_t{1} << 20;
    io::Bytes all(numbers.size() * size), some;
    for (std::size_t i = 0; i < numbers.size();) {
        const std::uint64_t from = std::uint64_t{numbers[i]} * size;
        std::size_t end = i + 1;
        const auto reach = [&](std::size_t k) { return (std::uint64_t{numbers[k]} + 1) * size; };
        while (end < numbers.size() && reach(end) <= reach(end - 1) + size + bridged &&
               reach(end) - from <= most)
            ++end;
        some.resize(static_cast<std::size_t>(reach(end - 1) - from));
        file.read(begin + from, some);
        for (; i < end; ++i)
            std::memcpy(all.data() + i * size, some.data() + (std::uint64_t{numbers[i]} * size - from), size);
    }
    return all;
}

} // namespace facetmill::cells
