#include "batch/jobserver.hpp"

#include "base/math/numbers.hpp"
#include "platform/file_bytes.hpp"
#include "platform/file_status.hpp"

#include <fmt/format.h>
#include <sstream>

namespace facetmill::batch {

namespace {

/// The value of the last option of this kind, in make's syntax.
std::string auth_in(const std::string& makeflags) {
    std::istringstream words(makeflags);
    std::string value;
    for (std::string word; words >> word;)
        for (const std::string option : {"--jobserver-auth=", "--jobserver-fds="})
            if (word.starts_with(option)) value = word.substr(option.size());
    return value;
}

/// Reopens the descriptor, so that its non-blocking mode does not affect other processes.
Descriptor reopened(const std::string& descriptor, OpenFor what) {
    const auto number = parse_integer(descriptor);
    if (!number || *number < 0) return {};
    const auto about = status_of(Descriptor::borrowed(static_cast<int>(*number)));
    if (!about || about->kind != FileKind::pipe) return {};
    return open_file(fmt::format("/proc/self/fd/{}", *number), {.what = what, .waits = false});
}

void give_back(const Descriptor& out, char token) {
    [[maybe_unused]] const auto written = write_some(out, std::as_bytes(std::span(&token, 1)));
}

} // namespace

std::string jobserver_file(const std::string& makeflags) {
    const std::string auth = auth_in(makeflags);
    return auth.starts_with("fifo:") ? auth.substr(5) : "";
}

std::unique_ptr<Jobserver> Jobserver::offered(const std::string& makeflags) {
    const std::string auth = auth_in(makeflags), fifo = jobserver_file(makeflags);
    Descriptor in, out;
    if (!fifo.empty()) {
        // Opens the FIFO for both directions, because it cannot be opened for writing without a reader.
        in = open_file(fifo, {.what = OpenFor::both, .waits = false});
        if (in) out = duplicate(in);
    } else if (const auto comma = auth.find(','); comma != auth.npos) {
        in = reopened(auth.substr(0, comma), OpenFor::reading);
        out = reopened(auth.substr(comma + 1), OpenFor::writing);
    }
    if (!in || !out) return {};
    return std::unique_ptr<Jobserver>(new Jobserver(std::move(in), std::move(out)));
}

Jobserver::~Jobserver() { give_all(); }

bool Jobserver::take() {
    char token = 0;
    if (read_some(in_, std::as_writable_bytes(std::span(&token, 1))) != 1) return false;
    const std::lock_guard lock(guard_);
    tokens_ += token;
    return true;
}

void Jobserver::give() {
    const std::lock_guard lock(guard_);
    if (tokens_.empty()) return;
    give_back(out_, tokens_.back());
    tokens_.pop_back();
}

void Jobserver::give_all() {
    const std::lock_guard lock(guard_);
    while (!tokens_.empty()) {
        give_back(out_, tokens_.back());
        tokens_.pop_back();
    }
}

} // namespace facetmill::batch
