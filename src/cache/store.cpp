#include "cache/store.hpp"

#include "base/hash.hpp"
#include "base/text/readable_numbers.hpp"
#include "io/outputs/clean_up.hpp"
#include "io/outputs/output_files.hpp"
#include "platform/nearest_existing.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <limits>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

namespace facetmill::cache {

namespace fs = std::filesystem;

namespace {

// An entry: these bytes, the SHA-256 of all that follows it as text, its name, a line's end, its bytes.
constexpr std::string_view magic = "facetmill cache 1\n";
constexpr std::size_t digits = 64;
constexpr std::string_view suffixes[] = {".memory", ".scene", ".last"};
constexpr std::string_view temporary = ".part";

/// Whether the text is the digits of a SHA-256: a path contains nothing else.
bool is_key(const std::string& text) {
    return text.size() == digits && text.find_first_not_of("0123456789abcdef") == text.npos;
}

bool is_entry(const fs::path& path) {
    return is_key(path.stem().string()) && std::find(std::begin(suffixes), std::end(suffixes),
                                                     path.extension().string()) != std::end(suffixes);
}

io::Span span_of(std::string_view text) { return std::as_bytes(std::span(text)); }

/// The header before the bytes of an entry.
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

/// The time to visit all entries, estimated from one folder of 256: keys are spread evenly.
double seconds_to_count(const fs::path& folder) {
    constexpr double folders = 256, seconds_of_an_entry = 2e-6;
    std::error_code error;
    std::size_t entries = 0;
    for (fs::directory_iterator it(folder / "7f", error), end; !error && it != end; it.increment(error))
        ++entries;
    return static_cast<double>(entries) * folders * seconds_of_an_entry;
}

/// Whether what is too small to count is counted this time: by chance, so that it has its limit, too.
bool is_one_in_many() {
    constexpr int many = 64;
    timespec now{};
    ::clock_gettime(CLOCK_REALTIME, &now);
    return now.tv_nsec / 1000 % many == 0;
}

/// Trusts only files of this user: a plain file, not a link or a pipe.
bool is_own_file(const struct stat& about) { return S_ISREG(about.st_mode) && about.st_uid == ::geteuid(); }

/// Reads at most `more` further bytes.
void read_more(int fd, io::Bytes& bytes, std::size_t more) {
    std::size_t at = bytes.size();
    bytes.resize(at + more);
    while (at < bytes.size()) {
        const ssize_t n = ::read(fd, bytes.data() + at, bytes.size() - at);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) break;
        at += static_cast<std::size_t>(n);
    }
    bytes.resize(at);
}

struct OpenFile {
    int fd;
    ~OpenFile() {
        if (fd >= 0) ::close(fd);
    }
};

/// Stops reading if the header is not of an entry of that name, or beyond the limit: the result is then
/// shorter than a header. None when this user has no such file. The file is read instead of mapped, because
/// a file that shrinks while mapped would end the process.
std::optional<io::Bytes> read_entry(const fs::path& path, std::size_t head, std::uint64_t max_bytes) {
    const OpenFile file{::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC)};
    struct stat about {};
    if (file.fd < 0 || ::fstat(file.fd, &about) != 0 || !is_own_file(about)) return {};
    const auto size = static_cast<std::uint64_t>(about.st_size);
    io::Bytes bytes;
    if (size < head || size > max_bytes) return bytes;
    read_more(file.fd, bytes, head);
    const std::string end = path.filename().string() + "\n";
    if (!io::as_text(bytes).starts_with(magic) || !io::as_text(bytes).ends_with(end)) return io::Bytes();
    read_more(file.fd, bytes, static_cast<std::size_t>(size) - head);
    return bytes;
}

/// Creates the missing folders, the last for this user alone.
void make_folder(const fs::path& folder) {
    constexpr mode_t of_the_user = 0700;
    if (::mkdir(folder.c_str(), of_the_user) != 0 && errno != EEXIST)
        throw fs::filesystem_error("mkdir", folder, std::error_code(errno, std::generic_category()));
}

/// Other programs need the disk more than the cache does: twice the entry plus this much stays free.
constexpr std::uint64_t reserve = std::uint64_t{64} << 20;

/// None if the system does not report it.
std::optional<std::uint64_t> free_space(const fs::path& folder) {
    struct statvfs about {};
    if (::statvfs(folder.c_str(), &about) != 0) return {};
    return static_cast<std::uint64_t>(about.f_bavail) * about.f_frsize;
}

bool has_space(const fs::path& folder, std::uint64_t bytes) {
    const auto space = free_space(folder);
    return !space || *space >= 2 * bytes + reserve; // writing will tell
}

/// Measured on slow machines; replaced by the measurements of a store.
constexpr double usual_bytes_per_second = 150e6;
/// The time for a file of any size: three system calls, and sometimes a folder.
constexpr double seconds_of_a_file = 0.0005;

} // namespace

Store::Store(StoreSettings settings) : settings_(std::move(settings)), known_(std::make_shared<Known>()) {
    known_->bytes_per_second = usual_bytes_per_second;
}

Store::Store(const Store& other) : settings_(other.settings_), known_(other.known_) {}

Store::~Store() {
    const std::lock_guard lock(known_->guard);
    for (const auto& path : used_)
        if (const auto found = known_->used.find(path); --found->second == 0) known_->used.erase(found);
}

fs::path Store::path_of(const std::string& key, Kind kind) const {
    return settings_.folder / key.substr(0, 2) /
           (key + std::string(suffixes[static_cast<std::size_t>(kind)]));
}

void Store::use(const fs::path& path) {
    ::utimensat(AT_FDCWD, path.c_str(), nullptr,
                AT_SYMLINK_NOFOLLOW); // one that is not ours to touch is only removed earlier
    const std::lock_guard lock(known_->guard);
    if (used_.insert(path).second) ++known_->used[path];
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
    if (!is_key(key)) return {};
    const fs::path path = path_of(key, kind);
    const std::string name = path.filename().string();
    const std::size_t head = magic.size() + digits + name.size() + 1;
    auto file = read_entry(path, head, settings_.max_bytes);
    if (!file) return {};
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
    if (!is_key(key)) return false;
    const fs::path path = path_of(key, kind);
    struct stat about {};
    if (::lstat(path.c_str(), &about) != 0 || !is_own_file(about)) return false;
    use(path);
    return true;
}

void Store::cannot_write(const std::string& why) {
    {
        const std::lock_guard lock(known_->guard);
        if (std::exchange(known_->broken, true)) return;
    }
    if (settings_.tell)
        settings_.tell({Severity::warning,
                        "W-CACHE",
                        fmt::format("the cache cannot be written: {}", why),
                        {},
                        "the run goes on without the cache; FACETMILL_CACHE names another folder, --no-cache "
                        "uses none"});
}

void Store::tell_of_full_disk() {
    {
        const std::lock_guard lock(known_->guard);
        if (std::exchange(known_->is_told_full, true)) return;
    }
    if (settings_.tell)
        settings_.tell(
            {Severity::warning,
             "W-CACHE",
             fmt::format("the disk of the cache '{}' has too little space left: {} of it stay free, "
                         "and results that do not fit beside that are not stored",
                         settings_.folder.string(), sized(reserve)),
             {},
             "make space, name a folder on another disk by FACETMILL_CACHE, or use --no-cache"});
}

namespace {

/// A temporary file in the entry's folder until it is renamed; a signal also removes it.
struct PartFile {
    fs::path path;
    io::CleanUp* clean_up = nullptr;
    int fd = -1;

    explicit PartFile(const fs::path& folder) {
        static std::atomic<std::uint64_t> number{0}; // stores of one process may share a folder
        constexpr int max_attempts = 1000;           // leftovers of a process of the same id
        for (int attempt = 0;; ++attempt) {
            path = folder / fmt::format(".{}-{}{}", ::getpid(), number++, temporary);
            clean_up = io::clean_up_file(path);
            fd = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
            if (fd >= 0) return;
            const int why = errno;
            io::keep(clean_up);
            if (why != EEXIST || attempt >= max_attempts) io::cannot_write(path, why);
        }
    }
    PartFile(const PartFile&) = delete;
    PartFile& operator=(const PartFile&) = delete;
    ~PartFile() {
        if (fd >= 0) ::close(fd);
        ::unlink(path.c_str());
        io::keep(clean_up);
    }
    /// Whether the file took the name: not when somebody has cleared the cache. Throws output.
    bool take_name(const fs::path& name) {
        const bool renamed = ::close(std::exchange(fd, -1)) == 0 && ::rename(path.c_str(), name.c_str()) == 0;
        if (!renamed && errno != ENOENT) io::cannot_write(path, errno);
        return renamed;
    }
};

} // namespace

bool make_folders(const fs::path& folder) {
    std::error_code error;
    if (fs::is_directory(folder, error)) return true;
    if (!folder.parent_path().empty()) fs::create_directories(folder.parent_path(), error);
    constexpr mode_t of_the_user = 0700;
    return ::mkdir(folder.c_str(), of_the_user) == 0 || fs::is_directory(folder, error);
}

bool Store::write(const fs::path& path, io::Span head, io::Span bytes) {
    if (!settings_.folder.parent_path().empty()) fs::create_directories(settings_.folder.parent_path());
    make_folder(settings_.folder);
    if (!has_space(settings_.folder, head.size() + bytes.size())) {
        tell_of_full_disk();
        return false;
    }
    make_folder(path.parent_path());
    PartFile part(path.parent_path());
    io::write_all(part.fd, head, part.path);
    io::write_all(part.fd, bytes, part.path);
    return part.take_name(path);
}

bool Store::is_usable() const {
    const std::lock_guard lock(known_->guard);
    return !known_->broken;
}

bool Store::put(const std::string& key, Kind kind, io::Span bytes) {
    const fs::path path = path_of(key, kind);
    if (!is_key(key) || !is_usable()) return false;
    // A scene is all that its key says. What is told of a load depends on the files at its paths, too.
    if (kind == Kind::scene && has(key, kind)) return true;
    try {
        const std::string head = head_of(path.filename().string(), bytes);
        if (!make_room(head.size() + bytes.size(), kind)) return false;
        if (!write(path, span_of(head), bytes)) return false;
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

double Store::seconds_to_begin() const {
    const std::lock_guard lock(known_->guard);
    if (known_->total) return 0;
    if (!known_->seconds_to_count) known_->seconds_to_count = seconds_to_count(settings_.folder);
    return *known_->seconds_to_count;
}

double Store::seconds_for(std::size_t bytes) const {
    const std::lock_guard lock(known_->guard);
    return seconds_of_a_file + static_cast<double>(bytes) / known_->bytes_per_second;
}

void Store::took(std::size_t bytes, double seconds) {
    constexpr std::size_t enough = 1 << 20; // less is too small to measure the rate
    if (bytes < enough || !(seconds > 0)) return;
    const std::lock_guard lock(known_->guard);
    known_->bytes_per_second = (known_->bytes_per_second + static_cast<double>(bytes) / seconds) / 2;
}

std::uint64_t Store::limit(std::uint64_t bytes) const {
    if (settings_.max_share >= 1) return settings_.max_bytes;
    const auto space = free_space(nearest_existing(settings_.folder));
    if (!space) return settings_.max_bytes;
    const double share = settings_.max_share * static_cast<double>(*space + bytes);
    return std::min(settings_.max_bytes, static_cast<std::uint64_t>(share));
}

std::string Store::hindrance() const {
    const fs::path there = nearest_existing(settings_.folder);
    return ::access(there.c_str(), W_OK | X_OK) == 0
               ? ""
               : fmt::format("'{}': {}", there.string(), std::strerror(errno));
}

bool Store::make_room(std::uint64_t bytes, Kind kind) {
    const std::lock_guard lock(known_->guard);
    if (bytes > settings_.max_bytes) return false;
    constexpr std::uint64_t parts = 20;
    auto& total = known_->total;
    auto& limit = known_->limit;
    if (!total && kind == Kind::last_run && !is_one_in_many()) return true;
    if (!total || known_->since_counted > limit / parts) {
        remove_leftovers();
        total = contents().bytes;
        limit = this->limit(*total);
        known_->since_counted = 0;
    }
    if (bytes > limit) return false;
    if (*total + bytes > limit) {
        // More than needed at a time, so that not every put looks at all entries.
        const std::uint64_t room = std::max(bytes, limit / 10);
        shrink(limit - std::min(room, limit));
        total = contents().bytes;
    }
    if (*total + bytes > limit) return false;
    *total += bytes;
    known_->since_counted += bytes;
    return true;
}

Contents Store::contents() const {
    Contents all;
    for_each_file(settings_.folder, [&](const fs::path& path, const struct stat& about) {
        if (!is_entry(path)) return;
        all.bytes += static_cast<std::uint64_t>(about.st_size);
        ++all.entries;
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
        if (!is_entry(path)) return;
        total += bytes;
        entries.push_back({nanoseconds_of(about.st_mtim), path, bytes});
    });
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
        return std::tie(a.used, a.path) < std::tie(b.used, b.path);
    });
    Contents gone;
    for (const auto& entry : entries) {
        if (total <= limit) break;
        if (known_->used.contains(entry.path) || ::unlink(entry.path.c_str()) != 0) continue;
        total -= entry.bytes;
        gone.bytes += entry.bytes;
        ++gone.entries;
    }
    return gone;
}

void Store::remove_leftovers(std::int64_t older_than) const {
    timespec now{};
    ::clock_gettime(CLOCK_REALTIME, &now);
    for_each_file(settings_.folder, [&](const fs::path& path, const struct stat& about) {
        if (path.extension() == temporary && path.filename().string().starts_with('.') &&
            now.tv_sec - about.st_mtim.tv_sec >= older_than)
            ::unlink(path.c_str());
    });
}

Contents Store::collect() {
    remove_leftovers();
    const std::lock_guard lock(known_->guard);
    return shrink(limit(contents().bytes));
}

Contents Store::clear() {
    remove_leftovers(std::numeric_limits<std::int64_t>::min()); // who is writing one finds that it is gone
    Contents gone;
    for_each_file(settings_.folder, [&](const fs::path& path, const struct stat& about) {
        if (!is_entry(path) || ::unlink(path.c_str()) != 0) return;
        ++gone.entries;
        gone.bytes += static_cast<std::uint64_t>(about.st_size);
    });
    return gone;
}

} // namespace facetmill::cache
