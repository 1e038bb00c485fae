#include "io/bytes.hpp"

#include "io/other_formats.hpp"
#include "io/packing.hpp"
#include "parallel/memory.hpp"
#include "parallel/storage.hpp"
#include "platform/sandbox.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <functional>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace facetmill::io {

namespace {

/// Smaller files are read, not mapped, unless max_stream is lower: another process cannot truncate a copy.
constexpr std::size_t map_from = std::size_t{16} << 20;

struct Descriptor {
    int fd;
    bool own;
    ~Descriptor() {
        if (own) ::close(fd);
    }
};

[[noreturn]] void cannot_read(const std::string& name, int error) {
    if (error == ENOENT || error == ENOTDIR)
        throw Error(ErrorKind::missing, "E-FILE", fmt::format("there is no file '{}'", name),
                    hint_for_reading(name));
    if (error == EACCES || error == EPERM)
        throw Error(ErrorKind::missing, "E-PERMISSION", fmt::format("'{}' may not be read", name),
                    sandbox_hint(name, error));
    if (error == EISDIR)
        throw Error(ErrorKind::missing, "E-DIRECTORY",
                    fmt::format("'{}' is a directory, expected a file", name),
                    fmt::format("name a file in it, or (load, batch --input) many by a pattern: '{}'",
                                (std::filesystem::path(name) / "*.ply").string()));
    throw Error(ErrorKind::missing, "E-FILE",
                fmt::format("'{}' cannot be read: {}", name, std::strerror(error)));
}

/// The limit for streams of unknown size: an eighth of the memory still available to this process.
std::size_t stream_limit() {
    const auto there = available_memory();
    return there ? static_cast<std::size_t>(*there / 8) : SIZE_MAX;
}

/// A device may be endless (/dev/zero) or a terminal.
constexpr std::size_t max_device_bytes = std::size_t{64} << 20;

/// Reads up to room bytes; 0 at the end.
std::size_t read_some(int fd, std::byte* to, std::size_t room, const std::string& name) {
    while (true) {
        const ssize_t got = ::read(fd, to, std::min(room, std::size_t{1} << 30));
        if (got >= 0) return static_cast<std::size_t>(got);
        if (errno != EINTR) cannot_read(name, errno);
    }
}

/// Memory to be filled from a file, so it is not zeroed first.
struct Piece {
    std::unique_ptr<std::byte[]> bytes;
    std::size_t size = 0;

    explicit Piece(std::size_t room) : bytes(new std::byte[room]) {}
};

/// Joins the pieces in order. Each is freed after its copy, so that the peak is little more than the total.
Piece joined(std::vector<Piece> pieces, std::size_t size) {
    if (pieces.size() == 1) return std::move(pieces.front());
    Piece all(size);
    for (Piece& piece : pieces) {
        std::copy_n(piece.bytes.get(), piece.size, all.bytes.get() + all.size);
        all.size += piece.size;
        piece.bytes.reset();
    }
    return all;
}

/// Reads everything from the descriptor. `expected` is only a hint, because files grow and shrink. Reading
/// in pieces avoids a growing buffer, which would need twice the limit for an endless stream.
Piece read_all(int fd, std::size_t expected, std::size_t limit, const std::string& name) {
    constexpr std::size_t least = std::size_t{64} << 10, most = std::size_t{64} << 20;
    limit = std::min(limit, SIZE_MAX - 1);
    std::vector<Piece> pieces;
    std::size_t size = 0;
    for (std::size_t wanted = expected + 1;; wanted = std::clamp(size, least, most)) {
        const std::size_t room = std::min(wanted, std::max(limit, expected) + 1 - size);
        Piece piece(room);
        std::size_t got = 0;
        while (piece.size < room &&
               (got = read_some(fd, piece.bytes.get() + piece.size, room - piece.size, name)) > 0)
            piece.size += got;
        size += piece.size;
        if (size > limit) too_large(name, limit);
        const bool ended = piece.size < room;
        pieces.push_back(std::move(piece));
        if (ended) return joined(std::move(pieces), size);
    }
}

std::shared_ptr<const void> map_file(int fd, std::size_t size) {
    void* at = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, fd, 0);
    if (at == MAP_FAILED) return nullptr;
    ::madvise(at, size, MADV_SEQUENTIAL);
    return {at, [size](const void* p) { ::munmap(const_cast<void*>(p), size); }};
}

} // namespace

template <class Stat>
Input::Stamp Input::stamp_of(const Stat& about) {
    return {about.st_dev,         about.st_ino,          static_cast<std::uint64_t>(about.st_size),
            about.st_mtim.tv_sec, about.st_mtim.tv_nsec, about.st_ctim.tv_sec,
            about.st_ctim.tv_nsec};
}

void Input::release(Span part) const {
    const auto before = [](const std::byte* a, const std::byte* b) { return std::less<>()(a, b); };
    const std::byte *const begin = part.data(), *const end = begin + part.size();
    if (!mapped_ || before(begin, stored_.data()) || before(stored_.data() + stored_.size(), end)) return;
    const std::size_t page = page_size();
    const auto first = (reinterpret_cast<std::uintptr_t>(begin) + page - 1) / page * page,
               last = reinterpret_cast<std::uintptr_t>(end) / page * page;
    if (first < last) (void)::madvise(reinterpret_cast<void*>(first), last - first, MADV_DONTNEED);
}

bool Input::is_as_opened() const {
    struct stat about {};
    return !mapped_ || (::stat(path_.c_str(), &about) == 0 && stamp_of(about) == *mapped_);
}

Input Input::open(const std::filesystem::path& path, std::size_t max_stream) {
    Input input;
    const bool standard = path == "-";
    input.name_ = standard ? "standard input" : path.string();
    const Descriptor file{standard ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC), !standard};
    if (file.fd < 0) cannot_read(input.name_, errno);
    struct stat about {};
    if (::fstat(file.fd, &about) != 0) cannot_read(input.name_, errno);
    if (S_ISDIR(about.st_mode)) cannot_read(input.name_, EISDIR);

    const bool regular = S_ISREG(about.st_mode) && !standard;
    const auto size = static_cast<std::size_t>(regular ? about.st_size : 0);
    if (regular) input.path_ = path;
    if (size >= std::min(map_from, max_stream)) input.owner_ = map_file(file.fd, size);
    if (input.owner_) {
        input.bytes_ = {static_cast<const std::byte*>(input.owner_.get()), size};
        input.mapped_ = stamp_of(about);
    } else {
        const bool device = S_ISCHR(about.st_mode) || S_ISBLK(about.st_mode);
        const std::size_t limit = regular  ? SIZE_MAX - 1
                                  : device ? std::min(max_stream, max_device_bytes)
                                           : std::min(max_stream, stream_limit());
        Piece all = read_all(file.fd, size, limit, input.name_);
        input.bytes_ = {all.bytes.get(), all.size};
        input.owner_ = std::shared_ptr<const std::byte[]>(std::move(all.bytes));
    }
    input.unpack(max_stream);
    return input;
}

Input Input::of(std::string name, Bytes bytes) {
    Input input;
    input.name_ = std::move(name);
    auto shared = std::make_shared<const Bytes>(std::move(bytes));
    input.bytes_ = *shared;
    input.owner_ = std::move(shared);
    input.unpack(SIZE_MAX);
    return input;
}

Input Input::staged_as(const std::filesystem::path& target, std::shared_ptr<const Instead> instead) const {
    Input other = *this;
    other.name_ = target.string();
    other.path_ = target;
    other.instead_ = std::move(instead);
    return other;
}

Input Input::with_asset_roots(const std::vector<std::filesystem::path>& folders) const {
    Input other = *this;
    for (const auto& folder : folders) {
        std::error_code failed;
        const bool is_folder = std::filesystem::is_directory(folder, failed);
        if (is_folder) other.asset_roots_.push_back(std::filesystem::canonical(folder, failed));
        if (!is_folder || failed)
            throw Error(ErrorKind::missing, "E-ASSET-ROOT",
                        fmt::format("the asset root '{}' is not a folder", folder.string()),
                        "name the folder that holds all files that the mesh file refers to");
    }
    return other;
}

std::filesystem::path Input::path_beside(const std::filesystem::path& relative) const {
    std::filesystem::path path = path_.parent_path() / relative;
    if (instead_)
        if (const auto staged = instead_->find(path.lexically_normal()); staged != instead_->end())
            return staged->second;
    return path;
}

Input Input::beside(const std::filesystem::path& relative) const {
    return open(path_beside(relative)).staged_as(path_.parent_path() / relative, instead_);
}

void Input::unpack(std::size_t max_bytes) {
    stored_ = bytes_;
    stored_owner_ = owner_;
    const Packing packing = packing_of(bytes_);
    if (packing == Packing::none) return;
    *this = with(unpacked(bytes_, packing, std::min(max_bytes, stream_limit()), name_));
}

Input Input::from(std::size_t offset) const {
    Input other = *this;
    other.bytes_ = bytes_.subspan(offset);
    return other;
}

Input Input::with(Bytes bytes) const {
    Input other = *this;
    auto shared = std::make_shared<const Bytes>(std::move(bytes));
    other.bytes_ = *shared;
    other.owner_ = std::move(shared);
    return other;
}

} // namespace facetmill::io
