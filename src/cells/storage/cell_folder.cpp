#include "cells/storage/cell_folder.hpp"

#include "base/error.hpp"
#include "base/hash.hpp"
#include "cells/storage/block_file.hpp"
#include "platform/file_names.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>

namespace facetmill::cells {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view lock_name = "facetmill-cells.lock";

[[noreturn]] void cannot_keep(const fs::path& path, const std::string& why) {
    throw Error(ErrorKind::output, "E-WRITE",
                fmt::format("cells cannot be kept in '{}': {}", path.generic_string(), why),
                "give another folder with --keep-cells DIR");
}

/// The first line of a file: its name, its key and the digest of its contents.
std::string head_of(const std::string& name, const std::string& key, io::Span bytes) {
    return fmt::format("facetmill {} {} {}\n", name, key, sha256(bytes));
}

} // namespace

CellFolder::CellFolder(Settings settings) : settings_(std::move(settings)) {
    std::error_code error;
    fs::create_directories(settings_.path, error);
    if (error) cannot_keep(settings_.path, error.message());
    take_lock(std::string(lock_name), settings_.beside.empty() ? Lock::exclusive : Lock::shared);
    if (!settings_.beside.empty())
        take_lock(fmt::format("facetmill-{}.lock", settings_.beside), Lock::exclusive);
}

/// The file stays. If it were removed, a third run could lock a new file while a second run waits for this
/// one.
void CellFolder::take_lock(const std::string& name, Lock how) {
    const fs::path path = file(name);
    Descriptor lock =
        open_file(path, {.what = OpenFor::both, .create = Create::if_missing, .follows_links = false});
    if (lock && try_lock(lock, how)) return locks_.push_back(std::move(lock));
    const int why = errno;
    if (!lock || why != EWOULDBLOCK) cannot_keep(settings_.path, std::strerror(why));
    throw Error(ErrorKind::output, "E-BUSY",
                fmt::format("another run is using the cells in '{}'", settings_.path.generic_string()),
                "wait until it ends, or give another folder with --keep-cells");
}

void CellFolder::write(const std::string& name, std::initializer_list<io::Span> pieces) const {
    const fs::path part = file(name + ".part");
    {
        BlockFile written(part, BlockFile::Named::anew);
        for (const io::Span piece : pieces) written.put(piece);
        if (settings_.sync) written.sync();
    }
    // The folder is not synced, because a file lost in a power failure is made again.
    if (!rename_file(part, file(name))) cannot_keep(settings_.path, std::strerror(errno));
}

std::optional<io::Bytes> CellFolder::read(const std::string& name) const {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(file(name), error);
    if (error) return {};
    io::Bytes bytes(size);
    try {
        ReadFile(file(name)).read(0, bytes);
    } catch (const Error&) {
        return {};
    }
    return bytes;
}

void CellFolder::put(const std::string& name, const std::string& key, io::Span bytes) const {
    const std::string head = head_of(name, key, bytes);
    write(name, {std::as_bytes(std::span(head)), bytes});
}

std::optional<io::Bytes> CellFolder::get(const std::string& name, const std::string& key,
                                         Found& found) const {
    found = Found::nothing;
    std::optional<io::Bytes> bytes = read(name);
    if (!bytes) return {};
    found = Found::damaged;
    const std::size_t head = head_of(name, key, {}).size();
    if (bytes->size() < head) return {};
    const std::string line(io::as_text(io::Span(*bytes).first(head)));
    bytes->erase(bytes->begin(), bytes->begin() + static_cast<std::ptrdiff_t>(head));
    if (line != head_of(name, key, *bytes)) return {};
    found = Found::as_written;
    return bytes;
}

std::vector<std::string> CellFolder::names(const std::string& begin) const {
    std::vector<std::string> names;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(settings_.path, ignored)) {
        std::string name = entry.path().filename().generic_string();
        if (name.starts_with(begin)) names.push_back(std::move(name));
    }
    std::sort(names.begin(), names.end());
    return names;
}

void CellFolder::remove(const std::string& name) const {
    std::error_code ignored;
    fs::remove(file(name), ignored);
}

fs::file_time_type CellFolder::time_of(const std::string& name) const {
    std::error_code error;
    const fs::file_time_type time = fs::last_write_time(file(name), error);
    return error ? fs::file_time_type::min() : time;
}

void CellFolder::set_time(const std::string& name, fs::file_time_type time) const {
    std::error_code error;
    fs::last_write_time(file(name), time, error);
    if (error) cannot_keep(settings_.path, error.message());
}

void CellFolder::touch(const std::string& name) const {
    if (!touch_file(file(name))) cannot_keep(settings_.path, std::strerror(errno));
}

} // namespace facetmill::cells
