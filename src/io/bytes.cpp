#include "io/bytes.hpp"

#include "io/other_formats.hpp"
#include "io/packing.hpp"
#include "parallel/memory.hpp"
#include "platform/file_bytes.hpp"
#include "platform/pages.hpp"
#include "platform/sandbox.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <functional>
#include <utility>

namespace facetmill::io {

namespace {

/// Smaller files are read, not mapped, unless the caller asks for a lower limit: another process cannot
/// truncate memory.
constexpr std::size_t map_from = std::size_t{16} << 20;

[[noreturn]] void cannot_read(const std::string& name, int error) {
    if (error == ENOENT || error == ENOTDIR)
        throw Error(ErrorKind::missing, "E-FILE", fmt::format("there is no file '{}'", name),
                    hint_for_reading(name));
    if (error == EACCES || error == EPERM)
        throw Error(ErrorKind::missing, "E-PERMISSION",
                    fmt::format("'{}' cannot be read: permission denied", name), sandbox_hint(name, error));
    if (error == EISDIR)
        throw Error(ErrorKind::missing, "E-DIRECTORY",
                    fmt::format("'{}' is a directory, expected a file", name),
                    fmt::format("give a file in it, or (load, batch --input) a pattern for many files: '{}'",
                                (std::filesystem::path(name) / "*.ply").generic_string()));
    throw Error(ErrorKind::missing, "E-FILE",
                fmt::format("'{}' cannot be read: {}", name, std::strerror(error)));
}

/// The maximum size of a stream of unknown length: an eighth of the memory that this process may still
/// allocate.
std::size_t stream_limit() {
    const auto there = available_memory();
    return there ? static_cast<std::size_t>(*there / 8) : SIZE_MAX;
}

/// The limit for devices, which may never end (/dev/zero) or be a terminal.
constexpr std::size_t max_device_bytes = std::size_t{64} << 20;

/// Reads up to room bytes; 0 at the end.
std::size_t read_piece(const Descriptor& file, std::span<std::byte> to, const std::string& name) {
    const auto got = read_some(file, to);
    if (!got) cannot_read(name, errno);
    return *got;
}

/// Memory that is filled from a file, and is therefore not zeroed first.
struct Piece {
    std::unique_ptr<std::byte[]> bytes;
    std::size_t size = 0;

    explicit Piece(std::size_t room) : bytes(new std::byte[room]) {}
};

/// Joins pieces in order. Each piece is freed as soon as it is copied, so that memory holds little data
/// twice.
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

/// Reads the descriptor to its end. expected: an estimate, because files grow and shrink. It reads in
/// pieces, because a growing buffer would exist twice and need twice the limit.
Piece read_all(const Descriptor& file, std::size_t expected, std::size_t limit, const std::string& name) {
    constexpr std::size_t least = std::size_t{64} << 10, most = std::size_t{64} << 20;
    limit = std::min(limit, SIZE_MAX - 1);
    std::vector<Piece> pieces;
    std::size_t size = 0;
    for (std::size_t wanted = expected + 1;; wanted = std::clamp(size, least, most)) {
        const std::size_t room = std::min(wanted, std::max(limit, expected) + 1 - size);
        Piece piece(room);
        std::size_t got = 0;
        while (piece.size < room &&
               (got = read_piece(file, {piece.bytes.get() + piece.size, room - piece.size}, name)) > 0)
            piece.size += got;
        size += piece.size;
        if (size > limit) too_large(name, limit);
        const bool ended = piece.size < room;
        pieces.push_back(std::move(piece));
        if (ended) return joined(std::move(pieces), size);
    }
}

} // namespace

void Input::release(Span part) const {
    const auto before = [](const std::byte* a, const std::byte* b) { return std::less<>()(a, b); };
    const std::byte *const begin = part.data(), *const end = begin + part.size();
    if (!mapped_ || before(begin, stored_.data()) || before(stored_.data() + stored_.size(), end)) return;
    release_pages(part);
}

bool Input::is_as_opened() const { return !mapped_ || FileStamp::of(path_) == mapped_; }

Input Input::open(const std::filesystem::path& path, std::size_t max_stream) {
    Input input;
    const bool standard = path == "-";
    input.name_ = standard ? "standard input" : path.generic_string();
    const Descriptor file = standard ? Descriptor::standard_input() : open_file(path);
    if (!file) cannot_read(input.name_, errno);
    const auto about = status_of(file);
    if (!about) cannot_read(input.name_, errno);
    if (about->kind == FileKind::folder) cannot_read(input.name_, EISDIR);

    const bool regular = about->kind == FileKind::regular && !standard;
    const auto size = static_cast<std::size_t>(regular ? about->stamp.bytes : 0);
    if (regular) input.path_ = path;
    if (size >= std::min(map_from, max_stream)) input.owner_ = map_file(file, size);
    if (input.owner_) {
        input.bytes_ = {static_cast<const std::byte*>(input.owner_.get()), size};
        input.mapped_ = about->stamp;
    } else {
        const bool device = about->kind == FileKind::device;
        const std::size_t limit = regular  ? SIZE_MAX - 1
                                  : device ? std::min(max_stream, max_device_bytes)
                                           : std::min(max_stream, stream_limit());
        Piece all = read_all(file, size, limit, input.name_);
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
    other.name_ = target.generic_string();
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
                        fmt::format("the asset root '{}' is not a folder", folder.generic_string()),
                        "give the folder with all files that the mesh file refers to");
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
