#include "platform/page_opener.hpp"

#include "platform/run_program.hpp"
#include "platform/worker_process.hpp"

#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <unistd.h>

namespace facetmill {

namespace fs = std::filesystem;

namespace {

/// The program that opens a page here, or empty.
fs::path opening_program() {
    const auto is_set = [](const char* name) {
        const char* value = std::getenv(name);
        return value && *value;
    };
    if (is_set("BROWSER"))
        if (auto browser = program_in_path(std::getenv("BROWSER"))) return *browser;
    if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY")) return {};
    return program_in_path("xdg-open").value_or(fs::path());
}

constexpr std::uint32_t longest_name = 1 << 16;

/// Waits for a name, and becomes the program. Returns if no name comes.
void serve(const Descriptor& socket, const fs::path& program) {
    std::uint32_t size = 0;
    if (!receive_all(socket, &size, sizeof size) || size > longest_name) return;
    std::string page(size, '\0'), name = program.string();
    if (!receive_all(socket, page.data(), page.size())) return;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
    ::setsid(); // the browser outlives the terminal
    char* const arguments[] = {name.data(), page.data(), nullptr};
    ::execv(name.c_str(), arguments);
}

} // namespace

PageOpener::PageOpener() {
    if (const fs::path program = opening_program(); !program.empty())
        helper_ = start_worker([&](const Descriptor& socket) { serve(socket, program); });
}

bool PageOpener::open(const fs::path& page) const {
    const std::string name = fs::absolute(page).lexically_normal().string();
    const auto size = static_cast<std::uint32_t>(name.size());
    return helper_ && size <= longest_name && send_all(helper_, &size, sizeof size) &&
           send_all(helper_, name.data(), name.size());
}

} // namespace facetmill
