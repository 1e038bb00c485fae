#include "platform/temporary_files.hpp"

#include "platform/file_lock.hpp"
#include "platform/file_names.hpp"

#include <cerrno>
#include <charconv>
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

namespace facetmill {

namespace fs = std::filesystem;

namespace {

bool is_abandoned(const fs::path& temporary, int pid) {
    if (pid == ::getpid() || ::kill(pid, 0) == 0 || errno != ESRCH) return false;
    const Descriptor file = open_file(temporary, {.follows_links = false, .waits = false});
    return file && try_lock(file);
}

} // namespace

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

void remove_abandoned(const fs::path& directory) {
    std::error_code error;
    for (fs::directory_iterator it(directory.empty() ? "." : directory, error), end; !error && it != end;
         it.increment(error)) {
        const int pid = writer_of(it->path().filename().native());
        if (pid && is_abandoned(it->path(), pid)) remove_file(it->path());
    }
}

Descriptor unnamed_file(const fs::path& folder) {
    Descriptor nameless(::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600));
    if (nameless || (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL)) return nameless;
    for (int attempt = 0;; ++attempt) { // fallback for file systems without unnamed files
        const fs::path path = folder / temporary_name("cells", attempt);
        Descriptor named =
            open_file(path, {.what = OpenFor::both, .create = Create::always, .permissions = 0600});
        if (!named && errno == EEXIST) continue;
        if (named) remove_file(path);
        return named;
    }
}

fs::path temporary_folder(const std::string& begin_of_name) {
    std::error_code failed;
    const fs::path above = fs::temp_directory_path(failed);
    std::string name = ((failed ? fs::path("/tmp") : above) / (begin_of_name + "XXXXXX")).string();
    return ::mkdtemp(name.data()) ? fs::path(name) : fs::path();
}

int process_id() { return ::getpid(); }

} // namespace facetmill
