#include "cache/store.hpp"

#include "base/hash.hpp"
#include "io/output_files.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace facetmill::cache {

namespace fs = std::filesystem;

namespace {

// An entry: these bytes, the SHA-256 of all that follows it as text, its name, a line's end, its bytes.
constexpr std::string_view magic = "facetmill cache 1\n";
constexpr std::size_t digits = 64;
constexpr std::string_view suffixes[] = {".memory", ".scene", ".last"};
constexpr std::string_view temporary = ".part";

bool is_entry(const fs::path& path) {
    return std::find(std::begin(suffixes), std::end(suffixes), path.extension().string()) !=
           std::end(suffixes);
}

io::Span span_of(std::string_view text) { return std::as_bytes(std::span(text)); }

/// What stands before the bytes of an entry.
std::string head_of(const std::string& name, io::Span bytes) {
    const std::string sums = sha256(bytes) + name;
    return fmt::format("{}{}{}\n", magic, sha256(span_of(sums)), name);
}

/// Folders of the store have names of two digits; others are not looked into.
template <class Take>
void for_each_file(const fs::path& folder, Take&& take) {
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        const std::string name = it->path().filename().string();
        if (name.size() != 2 || name.find_first_not_of("0123456789abcdef") != name.npos) continue;
        std::error_code inner;
        for (fs::directory_iterator file(it->path(), inner), last; !inner && file != last;
             file.increment(inner)) {
            struct stat about {};
            if (::lstat(file->path().c_str(), &about) == 0 && S_ISREG(about.st_mode))
                take(file->path(), about);
        }
    }
}

std::int64_t nanoseconds_of(const timespec& time) {
    constexpr std::int64_t in_a_second = 1'000'000'000;
    return time.tv_sec * in_a_second + time.tv_nsec;
}

/// The whole file; none when it cannot be read. Read rather than mapped: a file that shrinks while it is
/// mapped would end the process.
std::optional<io::Bytes> read_file(const fs::path& path) {
    const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0) return {};
    struct stat about {};
    io::Bytes bytes;
    if (::fstat(fd, &about) == 0 && S_ISREG(about.st_mode))
        bytes.resize(static_cast<std::size_t>(about.st_size));
    std::size_t at = 0;
    while (at < bytes.size()) {
        const ssize_t n = ::read(fd, bytes.data() + at, bytes.size() - at);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) break;
        at += static_cast<std::size_t>(n);
    }
    ::close(fd);
    bytes.resize(at);
    return bytes;
}

/// Measured on slow machines; what a store has seen takes its place.
constexpr double usual_bytes_per_second = 150e6;
/// Of a file, however small: three calls of the system, and a folder at times.
constexpr double seconds_of_a_file = 0.0005;

} // namespace

Store::Store(StoreSettings settings)
    : settings_(std::move(settings)), bytes_per_second_(usual_bytes_per_second) {}

fs::path Store::path_of(const std::string& key, Kind kind) const {
    return settings_.folder / key.substr(0, 2) /
           (key + std::string(suffixes[static_cast<std::size_t>(kind)]));
}

void Store::use(const fs::path& path) {
    ::utimensat(AT_FDCWD, path.c_str(), nullptr, 0); // one that is not ours to touch is only removed earlier
    const std::lock_guard lock(guard_);
    used_.insert(path);
}

void Store::drop(const fs::path& path, const char* why) {
    ::unlink(path.c_str());
    if (settings_.tell)
        settings_.tell({Severity::note,
                        "W-CACHE",
                        fmt::format("'{}' in the cache {}: it is computed again", path.string(), why),
                        {},
                        {}});
}

void Store::reject(const std::string& key, Kind kind) { drop(path_of(key, kind), "is corrupt"); }

std::optional<io::Bytes> Store::get(const std::string& key, Kind kind) {
    const fs::path path = path_of(key, kind);
    auto file = read_file(path);
    if (!file) return {};
    const std::string name = path.filename().string();
    const std::size_t head = magic.size() + digits + name.size() + 1;
    const bool whole = file->size() >= head && io::as_text(io::Span(*file).first(head)) ==
                                                   head_of(name, io::Span(*file).subspan(head));
    if (!whole) {
        drop(path, "is corrupt");
        return {};
    }
    use(path);
    file->erase(file->begin(), file->begin() + static_cast<std::ptrdiff_t>(head));
    return file;
}

bool Store::has(const std::string& key, Kind kind) {
    const fs::path path = path_of(key, kind);
    if (::access(path.c_str(), R_OK) != 0) return false;
    use(path);
    return true;
}

void Store::cannot_write(const std::string& why) {
    {
        const std::lock_guard lock(guard_);
        if (std::exchange(broken_, true)) return;
    }
    if (settings_.tell)
        settings_.tell(
            {Severity::warning,
             "W-CACHE",
             fmt::format("the cache cannot be written: {}", why),
             {},
             "the run goes on without; FACETMILL_CACHE names another folder, --no-cache uses none"});
}

void Store::write(const fs::path& path, io::Span head, io::Span bytes) {
    fs::create_directories(path.parent_path());
    static std::atomic<std::uint64_t> number{0}; // stores of one process may share a folder
    const fs::path part = path.parent_path() / fmt::format(".{}-{}{}", ::getpid(), number++, temporary);
    const int fd = ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (fd < 0) io::cannot_write(part, errno);
    try {
        io::write_all(fd, head, part);
        io::write_all(fd, bytes, part);
    } catch (...) {
        ::close(fd);
        ::unlink(part.c_str());
        throw;
    }
    if (::close(fd) == 0 && ::rename(part.c_str(), path.c_str()) == 0) return;
    const int why = errno;
    ::unlink(part.c_str());
    io::cannot_write(part, why);
}

bool Store::is_usable() const {
    const std::lock_guard lock(guard_);
    return !broken_;
}

bool Store::put(const std::string& key, Kind kind, io::Span bytes) {
    const fs::path path = path_of(key, kind);
    if (!is_usable()) return false;
    if (kind != Kind::last_run && has(key, kind)) return true;
    try {
        const std::string head = head_of(path.filename().string(), bytes);
        if (!make_room(head.size() + bytes.size())) return false;
        write(path, span_of(head), bytes);
    } catch (const Error& e) {
        cannot_write(e.diagnostics().front().message);
        return false;
    } catch (const fs::filesystem_error& e) {
        cannot_write(fmt::format("'{}': {}", settings_.folder.string(), e.code().message()));
        return false;
    }
    use(path);
    return true;
}

double Store::seconds_for(std::size_t bytes) const {
    const std::lock_guard lock(guard_);
    return seconds_of_a_file + static_cast<double>(bytes) / bytes_per_second_;
}

void Store::took(std::size_t bytes, double seconds) {
    constexpr std::size_t enough = 1 << 20; // less says nothing of the rate
    if (bytes < enough || !(seconds > 0)) return;
    const std::lock_guard lock(guard_);
    bytes_per_second_ = (bytes_per_second_ + static_cast<double>(bytes) / seconds) / 2;
}

bool Store::make_room(std::uint64_t bytes) {
    const std::lock_guard lock(guard_);
    if (bytes > settings_.max_bytes) return false;
    constexpr std::uint64_t parts = 20;
    if (!total_ || since_counted_ > settings_.max_bytes / parts) {
        total_ = contents().bytes;
        since_counted_ = 0;
    }
    if (*total_ + bytes > settings_.max_bytes) {
        // More than needed at a time, so that not every put looks at all entries.
        const std::uint64_t room = std::max(bytes, settings_.max_bytes / 10);
        shrink(settings_.max_bytes - std::min(room, settings_.max_bytes));
        total_ = contents().bytes;
    }
    if (*total_ + bytes > settings_.max_bytes) return false;
    *total_ += bytes;
    since_counted_ += bytes;
    return true;
}

Contents Store::contents() const {
    Contents all;
    for_each_file(settings_.folder, [&](const fs::path& path, const struct stat& about) {
        all.bytes += static_cast<std::uint64_t>(about.st_size);
        all.entries += is_entry(path);
        all.scenes += path.extension() == suffixes[static_cast<std::size_t>(Kind::scene)];
    });
    return all;
}

/// With the lock held.
Contents Store::shrink(std::uint64_t limit) {
    struct Entry {
        std::int64_t used;
        fs::path path;
        std::uint64_t bytes;
    };
    std::vector<Entry> entries;
    std::uint64_t total = 0;
    for_each_file(settings_.folder, [&](const fs::path& path, const struct stat& about) {
        const auto bytes = static_cast<std::uint64_t>(about.st_size);
        total += bytes;
        if (is_entry(path)) entries.push_back({nanoseconds_of(about.st_mtim), path, bytes});
    });
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
        return std::tie(a.used, a.path) < std::tie(b.used, b.path);
    });
    Contents gone;
    for (const auto& entry : entries) {
        if (total <= limit) break;
        if (used_.contains(entry.path) || ::unlink(entry.path.c_str()) != 0) continue;
        total -= entry.bytes;
        gone.bytes += entry.bytes;
        ++gone.entries;
    }
    return gone;
}

void Store::remove_leftovers() const {
    timespec now{};
    ::clock_gettime(CLOCK_REALTIME, &now);
    constexpr std::int64_t an_hour = 3600; // no entry takes that long to write
    for_each_file(settings_.folder, [&](const fs::path& path, const struct stat& about) {
        if (path.extension() == temporary && now.tv_sec - about.st_mtim.tv_sec > an_hour)
            ::unlink(path.c_str());
    });
}

Contents Store::collect() {
    remove_leftovers();
    const std::lock_guard lock(guard_);
    return shrink(settings_.max_bytes);
}

Contents Store::clear() {
    remove_leftovers();
    Contents gone;
    for_each_file(settings_.folder, [&](const fs::path& path, const struct stat& about) {
        if (!is_entry(path) || ::unlink(path.c_str()) != 0) return;
        ++gone.entries;
        gone.bytes += static_cast<std::uint64_t>(about.st_size);
    });
    return gone;
}

} // namespace facetmill::cache
