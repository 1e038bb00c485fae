#include "platform/file_lock.hpp"
#include "platform/file_names.hpp"
#include "platform/temporary_files.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace facetmill {

namespace fs = std::filesystem;

namespace {

bool is_abandoned(const fs::path& temporary, int pid) {
    if (pid == process_id() || is_running(pid)) return false;
    const Descriptor file = open_file(temporary, {.follows_links = false, .waits = false});
    return file && try_lock(file);
}

} // namespace

std::string temporary_name(const fs::path& target, int attempt) {
    const std::string tail =
        fmt::format(".facetmill-{}{}~", process_id(), attempt ? fmt::format("-{}", attempt) : "");
    constexpr std::size_t longest_name = 255;
    std::string name = target.filename().generic_string();
    std::size_t end = std::min(name.size(), longest_name - 1 - tail.size()); // avoids cutting a character
    while (end < name.size() && end > 0 && (static_cast<unsigned char>(name[end]) & 0xc0) == 0x80) --end;
    return fmt::format(".{}{}", name.substr(0, end), tail);
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
        const int pid = writer_of(it->path().filename().generic_string());
        if (pid && is_abandoned(it->path(), pid)) remove_file(it->path());
    }
}

} // namespace facetmill
