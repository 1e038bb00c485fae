#include "io/outputs/output_files.hpp"

#include "base/progress.hpp"
#include "platform/file_bytes.hpp"
#include "platform/file_names.hpp"
#include "platform/file_status.hpp"
#include "platform/free_space.hpp"
#include "platform/sandbox.hpp"
#include "platform/temporary_files.hpp"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>

namespace facetmill::io {

namespace fs = std::filesystem;

namespace {

// The hint for commands without an output folder: diff, render, info, new.
constexpr const char* write_elsewhere =
    "write elsewhere: under another path, or (run, batch, pipe) with another --output-dir";

} // namespace

std::string hint_to_write(const fs::path& target, int error) {
    if (error == ENAMETOOLONG)
        return "give a shorter path: each name in it may have 255 bytes, and all of it 4095";
    const std::string hint = sandbox_hint(target, error);
    return hint.empty() ? write_elsewhere : hint;
}

void cannot_write(const fs::path& target, int error) {
    const std::string name = target == "-" ? "standard output" : fmt::format("'{}'", target.generic_string());
    if (means_no_space(error))
        throw Error(ErrorKind::output, "E-SPACE", fmt::format("no space left to write {}", name),
                    fmt::format("free some space there, or {}", write_elsewhere));
    if (error == EPIPE)
        throw Error(ErrorKind::output, "E-WRITE",
                    fmt::format("{} cannot be written: the program that reads it has ended", name));
    if (error == EISDIR)
        throw Error(ErrorKind::output, "E-DIRECTORY", fmt::format("{} is a directory, expected a file", name),
                    "give the name of a file in it");
    throw Error(ErrorKind::output, "E-WRITE",
                fmt::format("{} cannot be written: {}", name, std::strerror(error)),
                hint_to_write(target, error));
}

void write_all(const Descriptor& file, Span bytes, const fs::path& target) {
    const auto all = static_cast<double>(bytes.size());
    while (!bytes.empty()) {
        ProgressScope::report(1 - static_cast<double>(bytes.size()) / all);
        const auto n = write_some(file, bytes.first(std::min(bytes.size(), std::size_t{16} << 20)));
        if (!n) cannot_write(target, errno);
        bytes = bytes.subspan(*n);
    }
}

bool is_stream(const fs::path& target) {
    const std::string text = target.generic_string();
    if (text == "-" || text.starts_with("/dev/fd/") || text.starts_with("/proc/") || text == "/dev/stdout" ||
        text == "/dev/stderr")
        return true;
    std::error_code ignored;
    const auto status = fs::status(target, ignored);
    return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

fs::path followed(fs::path path) {
    std::error_code error;
    const fs::path given = path;
    for (int links = 0; fs::is_symlink(fs::symlink_status(path, error)); ++links) {
        if (links == 40) cannot_write(given, ELOOP);
        const fs::path to = fs::read_symlink(path, error);
        if (error) cannot_write(given, error.value());
        path = to.is_absolute() ? to : path.parent_path() / to;
    }
    return path;
}

fs::path identity(const fs::path& path) {
    if (path == "-") return path;
    std::error_code error;
    const fs::path whole = fs::weakly_canonical(fs::absolute(path), error);
    return comparable_name(error ? fs::absolute(path).lexically_normal() : whole);
}

void keep_permissions(const Descriptor& file, const fs::path& target, const fs::path& given) {
    const auto about = status_of(target);
    if (!about) return;
    if (about->kind == FileKind::folder) cannot_write(given, EISDIR);
    if (!may_write(target)) cannot_write(given, errno);
    take_permissions(file, *about);
}

fs::path set_aside(const fs::path& target) {
    std::error_code error;
    const auto status = fs::symlink_status(target, error);
    if (!fs::exists(status)) return {};
    if (fs::is_directory(status)) cannot_write(target, EISDIR);
    for (int attempt = 1;; ++attempt) {
        fs::path aside = target.parent_path() / temporary_name(target, attempt);
        fs::create_hard_link(target, aside, error);
        if (error == std::errc::file_exists) continue;
        if (error) fs::copy_file(target, aside, error);
        if (error) cannot_write(target, error.value());
        return aside;
    }
}

} // namespace facetmill::io
