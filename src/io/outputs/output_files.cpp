#include "io/outputs/output_files.hpp"

#include "base/progress.hpp"
#include "platform/sandbox.hpp"

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace facetmill::io {

namespace fs = std::filesystem;

namespace {

// Commands without an output folder write files too: diff, render, info, new.
constexpr const char* write_elsewhere =
    "write elsewhere: under another path, or (run, batch, pipe) with another --output-dir";

} // namespace

std::string hint_to_write(const fs::path& target, int error) {
    const std::string hint = sandbox_hint(target, error);
    return hint.empty() ? write_elsewhere : hint;
}

void cannot_write(const fs::path& target, int error) {
    const std::string name = target == "-" ? "standard output" : fmt::format("'{}'", target.string());
    if (error == ENOSPC || error == EDQUOT || error == EFBIG)
        throw Error(ErrorKind::output, "E-SPACE", fmt::format("no space left to write {}", name),
                    fmt::format("free some there, or {}", write_elsewhere));
    if (error == EPIPE)
        throw Error(ErrorKind::output, "E-WRITE",
                    fmt::format("{} cannot be written: its reader went away", name));
    if (error == EISDIR)
        throw Error(ErrorKind::output, "E-DIRECTORY", fmt::format("{} is a directory, expected a file", name),
                    "give the name of a file in it");
    throw Error(ErrorKind::output, "E-WRITE",
                fmt::format("{} cannot be written: {}", name, std::strerror(error)),
                hint_to_write(target, error));
}

void write_all(int fd, Span bytes, const fs::path& target) {
    const auto all = static_cast<double>(bytes.size());
    while (!bytes.empty()) {
        ProgressScope::report(1 - static_cast<double>(bytes.size()) / all);
        const ssize_t n = ::write(fd, bytes.data(), std::min(bytes.size(), std::size_t{16} << 20));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) cannot_write(target, errno);
        bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
}

void begin_sync(int fd) {
#ifdef SYNC_FILE_RANGE_WRITE
    ::sync_file_range(fd, 0, 0, SYNC_FILE_RANGE_WRITE);
#else
    static_cast<void>(fd);
#endif
}

bool synced(int fd) {
    int done = 0;
    do done = ::fsync(fd);
    while (done != 0 && errno == EINTR);
    return done == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS;
}

bool is_stream(const fs::path& target) {
    const std::string text = target.string();
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
    return error ? fs::absolute(path).lexically_normal() : whole;
}

std::string temporary_name(const fs::path& target, int attempt) {
    const std::string tail =
        fmt::format(".facetmill-{}{}~", ::getpid(), attempt ? fmt::format("-{}", attempt) : "");
    constexpr std::size_t longest_name = 255;
    return fmt::format(".{}{}", target.filename().string().substr(0, longest_name - 1 - tail.size()), tail);
}

int writer_of(std::string_view name) {
    constexpr std::string_view mark = ".facetmill-";
    const auto at = name.rfind(mark);
    if (name.size() < 2 || name.front() != '.' || name.back() != '~' || at == std::string_view::npos ||
        at == 0)
        return 0;
    int pid = 0, attempt = 0;
    const char* const end = name.data() + name.size() - 1;
    auto read = std::from_chars(name.data() + at + mark.size(), end, pid);
    if (read.ec == std::errc{} && read.ptr != end && *read.ptr == '-')
        read = std::from_chars(read.ptr + 1, end, attempt);
    return read.ec == std::errc{} && read.ptr == end && pid > 0 ? pid : 0;
}

bool is_abandoned(const fs::path& temporary, int pid) {
    if (pid == ::getpid() || ::kill(pid, 0) == 0 || errno != ESRCH) return false;
    const int fd = ::open(temporary.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (fd < 0) return false;
    const bool free = ::flock(fd, LOCK_EX | LOCK_NB) == 0;
    ::close(fd);
    return free;
}

void remove_abandoned(const fs::path& directory) {
    std::error_code error;
    for (fs::directory_iterator it(directory.empty() ? "." : directory, error), end; !error && it != end;
         it.increment(error)) {
        const int pid = writer_of(it->path().filename().native());
        if (pid && is_abandoned(it->path(), pid)) ::unlink(it->path().c_str());
    }
}

void keep_permissions(int fd, const fs::path& target, const fs::path& given) {
    struct stat about {};
    if (::stat(target.c_str(), &about) != 0) return;
    if (S_ISDIR(about.st_mode)) cannot_write(given, EISDIR);
    if (::access(target.c_str(), W_OK) != 0) cannot_write(given, errno);
    const bool owned = (about.st_uid == ::geteuid() && about.st_gid == ::getegid()) ||
                       ::fchown(fd, about.st_uid, about.st_gid) == 0;
    ::fchmod(fd, about.st_mode & (owned ? 07777 : 0777));
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
