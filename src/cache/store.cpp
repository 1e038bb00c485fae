#include "cache/store.hpp"

#include "base/hash.hpp"
#include "base/text/readable_numbers.hpp"
#include "io/outputs/clean_up.hpp"
#include "io/outputs/output_files.hpp"
#include "platform/file_bytes.hpp"
#include "platform/file_names.hpp"
#include "platform/file_status.hpp"
#include "platform/free_space.hpp"
#include "platform/nearest_existing.hpp"
#include "platform/temporary_files.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <limits>

namespace facetmill::cache {

namespace fs = std::filesystem;

namespace {

// The format of an entry: these bytes, the hexadecimal SHA-256 of the rest, its name, a line end, its bytes.
constexpr std::string_view magic = "facetmill cache 1\n";
constexpr std::size_t digits = 64;
constexpr std::string_view suffixes[] = {".memory", ".scene", ".last"};
constexpr std::string_view temporary = ".part";

/// True for the digits of a SHA-256; no other text is used in a path.
bool is_key(const std::string& text) {
    return text.size() == digits && text.find_first_not_of("0123456789abcdef") == text.npos;
}

bool is_entry(const fs::path& path) {
    return is_key(path.stem().generic_string()) &&
           std::find(std::begin(suffixes), std::end(suffixes), path.extension().generic_string()) !=
               std::end(suffixes);
}

io::Span span_of(std::string_view text) { return std::as_bytes(std::span(text)); }

/// The bytes before the contents of an entry.
std::string head_of(const std::string& name, io::Span bytes) {
    const std::string sums = sha256(bytes) + name;
    return fmt::format("{}{}{}\n", magic, sha256(span_of(sums)), name);
}

/// Folders of the store have two-digit names; others are ignored.
template <class Take>
void for_each_file(const fs::path& folder, Take&& take) {
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        const std::string name = it->path().filename().generic_string();
        if (name.size() != 2 || name.find_first_not_of("0123456789abcdef") != name.npos) continue;
        std::error_code inner;
        for (fs::directory_iterator file(it->path(), inner), last; !inner && file != last;
             file.increment(inner)) {
            const auto about = status_of_link(file->path());
            if (about && about->kind == FileKind::regular) take(file->path(), about->stamp);
        }
    }
}

/// Estimates the time to list all entries from one of 256 folders, because keys are evenly distributed.
double seconds_to_count(const fs::path& folder) {
    constexpr double folders = 256, seconds_of_an_entry = 2e-6;
    std::error_code error;
    std::size_t entries = 0;
    for (fs::directory_iterator it(folder / "7f", error), end; !error && it != end; it.increment(error))
        ++entries;
    return static_cast<double>(entries) * folders * seconds_of_an_entry;
}

/// Decides at random whether to count an entry that is normally too small to count, so that small entries are
/// limited too.
bool is_one_in_many() {
    constexpr int many = 64;
    return nanoseconds_now() / 1000 % many == 0;
}

/// Trusts only regular files of this user, not links or pipes.
bool is_own_file(const std::optional<FileStatus>& about) {
    return about && about->kind == FileKind::regular && about->is_own();
}

/// Reads at most `more` additional bytes.
void read_more(const Descriptor& file, io::Bytes& bytes, std::size_t more) {
    const std::size_t at = bytes.size();
    bytes.resize(at + more);
    bytes.resize(at + read_whole(file, std::span(bytes).subspan(at)));
}

/// Reads an entry. Stops if the beginning is not an entry with this name, or the entry exceeds the limit;
/// the result is then shorter than a head. None without a file of this user. Reads instead of mapping,
/// because a file that is truncated while mapped would end the process.
std::optional<io::Bytes> read_entry(const fs::path& path, std::size_t head, std::uint64_t max_bytes) {
    const Descriptor file = open_file(path, {.follows_links = false, .waits = false});
    const auto about = file ? status_of(file) : std::nullopt;
    if (!is_own_file(about)) return {};
    const std::uint64_t size = about->stamp.bytes;
    io::Bytes bytes;
    if (size < head || size > max_bytes) return bytes;
    read_more(file, bytes, head);
    const std::string end = path.filename().generic_string() + "\n";
    if (!io::as_text(bytes).starts_with(magic) || !io::as_text(bytes).ends_with(end)) return io::Bytes();
    read_more(file, bytes, static_cast<std::size_t>(size) - head);
    return bytes;
}

constexpr unsigned of_the_user = 0700;

/// Creates the folder if it is missing, for this user only.
void make_own_folder(const fs::path& folder) {
    if (!make_folder(folder, of_the_user) && errno != EEXIST)
        throw fs::filesystem_error("mkdir", folder, std::error_code(errno, std::generic_category()));
}

/// Leaves space for other programs: twice the entry plus this amount must stay free.
constexpr std::uint64_t reserve = std::uint64_t{64} << 20;

bool has_space(const fs::path& folder, std::uint64_t bytes) {
    const auto space = free_space(folder);
    return !space || *space >= 2 * bytes + reserve; // if unknown, tries to write
}

/// Measured on slow machines. The store's own measurements replace it.
constexpr double usual_bytes_per_second = 150e6;
/// The time for any file: three system calls, and sometimes a folder.
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
    touch_file(path); // failure only means earlier eviction
    const std::lock_guard lock(known_->guard);
    if (used_.insert(path).second) ++known_->used[path];
}

void Store::drop(const fs::path& path, const char* why) {
    remove_file(path);
    if (settings_.tell)
        settings_.tell({Severity::note,
                        "W-CACHE",
                        fmt::format("'{}' in the cache {}: it is computed again", path.generic_string(), why),
                        {},
                        {}});
}

void Store::reject(const std::string& key, Kind kind) { drop(path_of(key, kind), "is corrupt"); }

std::optional<io::Bytes> Store::get(const std::string& key, Kind kind) {
    if (!is_key(key)) return {};
    const fs::path path = path_of(key, kind);
    const std::string name = path.filename().generic_string();
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
    if (!is_own_file(status_of_link(path))) return false;
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
                        "the run continues without the cache; set FACETMILL_CACHE to another folder, or use "
                        "--no-cache"});
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
             fmt::format("the disk of the cache '{}' is nearly full: the cache keeps {} free, and does not "
                         "store results that need more space",
                         settings_.folder.generic_string(), sized(reserve)),
             {},
             "free some space, set FACETMILL_CACHE to a folder on another disk, or use --no-cache"});
}

namespace {

/// A temporary file next to an entry, until it is renamed; a signal removes it.
struct PartFile {
    fs::path path;
    io::CleanUp* clean_up = nullptr;
    Descriptor file;

    explicit PartFile(const fs::path& folder) {
        static std::atomic<std::uint64_t> number{0}; // stores of the same process may share a folder
        constexpr int max_attempts = 1000; // tries further names if a process with the same id left files
        for (int attempt = 0;; ++attempt) {
            path = folder / fmt::format(".{}-{}{}", process_id(), number++, temporary);
            clean_up = io::clean_up_file(path);
            file = open_file(path, {.what = OpenFor::writing, .create = Create::always, .permissions = 0600});
            if (file) return;
            const int why = errno;
            io::keep(clean_up);
            if (why != EEXIST || attempt >= max_attempts) io::cannot_write(path, why);
        }
    }
    PartFile(const PartFile&) = delete;
    PartFile& operator=(const PartFile&) = delete;
    ~PartFile() {
        file.close();
        remove_file(path);
        io::keep(clean_up);
    }
    /// Renames the file to its final name. False if the cache was cleared meanwhile. Throws an output error.
    bool take_name(const fs::path& name) {
        const bool renamed = file.close() && rename_file(path, name);
        if (!renamed && errno != ENOENT) io::cannot_write(path, errno);
        return renamed;
    }
};

} // namespace

bool make_folders(const fs::path& folder) {
    std::error_code error;
    if (fs::is_directory(folder, error)) return true;
    if (!folder.parent_path().empty()) fs::create_directories(folder.parent_path(), error);
    return make_folder(folder, of_the_user) || fs::is_directory(folder, error);
}

bool Store::write(const fs::path& path, io::Span head, io::Span bytes) {
    if (!settings_.folder.parent_path().empty()) fs::create_directories(settings_.folder.parent_path());
    make_own_folder(settings_.folder);
    if (!has_space(settings_.folder, head.size() + bytes.size())) {
        tell_of_full_disk();
        return false;
    }
    make_own_folder(path.parent_path());
    PartFile part(path.parent_path());
    io::write_all(part.file, head, part.path);
    io::write_all(part.file, bytes, part.path);
    return part.take_name(path);
}

bool Store::is_usable() const {
    const std::lock_guard lock(known_->guard);
    return !known_->broken;
}

bool Store::put(const std::string& key, Kind kind, io::Span bytes) {
    const fs::path path = path_of(key, kind);
    if (!is_key(key) || !is_usable()) return false;
    // A scene is determined by its key. The report of a load also depends on the files at its paths.
    if (kind == Kind::scene && has(key, kind)) return true;
    try {
        const std::string head = head_of(path.filename().generic_string(), bytes);
        if (!make_room(head.size() + bytes.size(), kind)) return false;
        if (!write(path, span_of(head), bytes)) return false;
    } catch (const Error& e) {
        cannot_write(e.diagnostics().front().message);
        return false;
    } catch (const fs::filesystem_error& e) {
        cannot_write(fmt::format("'{}': {}", settings_.folder.generic_string(), e.code().message()));
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
    constexpr std::size_t enough = 1 << 20; // smaller amounts do not show the rate
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
    return may_write_in(there) ? "" : fmt::format("'{}': {}", there.generic_string(), std::strerror(errno));
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
        // Frees more than necessary, so that not every put lists all entries.
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
    for_each_file(settings_.folder, [&](const fs::path& path, const FileStamp& about) {
        if (!is_entry(path)) return;
        all.bytes += about.bytes;
        ++all.entries;
        all.scenes += path.extension() == suffixes[static_cast<std::size_t>(Kind::scene)];
    });
    return all;
}

/// The caller must hold the lock.
Contents Store::shrink(std::uint64_t limit) {
    struct Entry {
        std::int64_t used;
        fs::path path;
        std::uint64_t bytes;
    };
    std::vector<Entry> entries;
    std::uint64_t total = 0;
    for_each_file(settings_.folder, [&](const fs::path& path, const FileStamp& about) {
        if (!is_entry(path)) return;
        total += about.bytes;
        entries.push_back({about.modified, path, about.bytes});
    });
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
        return std::tie(a.used, a.path) < std::tie(b.used, b.path);
    });
    Contents gone;
    for (const auto& entry : entries) {
        if (total <= limit) break;
        if (known_->used.contains(entry.path) || !remove_file(entry.path)) continue;
        total -= entry.bytes;
        gone.bytes += entry.bytes;
        ++gone.entries;
    }
    return gone;
}

void Store::remove_leftovers(std::int64_t older_than) const {
    constexpr std::int64_t in_a_second = 1'000'000'000;
    const std::int64_t now = nanoseconds_now() / in_a_second;
    for_each_file(settings_.folder, [&](const fs::path& path, const FileStamp& about) {
        if (path.extension() == temporary && path.filename().generic_string().starts_with('.') &&
            now - about.modified / in_a_second >= older_than)
            remove_file(path);
    });
}

Contents Store::collect() {
    remove_leftovers();
    const std::lock_guard lock(known_->guard);
    return shrink(limit(contents().bytes));
}

Contents Store::clear() {
    remove_leftovers(std::numeric_limits<std::int64_t>::min()); // a current writer notices the missing file
    Contents gone;
    for_each_file(settings_.folder, [&](const fs::path& path, const FileStamp& about) {
        if (!is_entry(path) || !remove_file(path)) return;
        ++gone.entries;
        gone.bytes += about.bytes;
    });
    return gone;
}

} // namespace facetmill::cache
