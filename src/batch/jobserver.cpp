#include "batch/jobserver.hpp"

#include "base/math/numbers.hpp"

#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <sstream>
#include <sys/stat.h>
#include <unistd.h>

namespace facetmill::batch {

namespace {

/// The value of the last such option, in make's notation.
std::string auth_in(const std::string& makeflags) {
    std::istringstream words(makeflags);
    std::string value;
    for (std::string word; words >> word;)
        for (const std::string option : {"--jobserver-auth=", "--jobserver-fds="})
            if (word.starts_with(option)) value = word.substr(option.size());
    return value;
}

/// A separate file description, so that nonblocking reads do not affect other processes.
int reopened(const std::string& descriptor, int mode) {
    const auto number = parse_integer(descriptor);
    if (!number || *number < 0) return -1;
    struct stat about {};
    if (::fstat(static_cast<int>(*number), &about) != 0 || !S_ISFIFO(about.st_mode)) return -1;
    return ::open(fmt::format("/proc/self/fd/{}", *number).c_str(), mode | O_NONBLOCK | O_CLOEXEC);
}

} // namespace

std::string jobserver_file(const std::string& makeflags) {
    const std::string auth = auth_in(makeflags);
    return auth.starts_with("fifo:") ? auth.substr(5) : "";
}

std::unique_ptr<Jobserver> Jobserver::offered(const std::string& makeflags) {
    const std::string auth = auth_in(makeflags), fifo = jobserver_file(makeflags);
    int in = -1, out = -1;
    if (!fifo.empty()) {
        // Opened for both directions, because a FIFO without a reader cannot be opened for writing.
        in = ::open(fifo.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
        out = in < 0 ? -1 : ::dup(in);
    } else if (const auto comma = auth.find(','); comma != auth.npos) {
        in = reopened(auth.substr(0, comma), O_RDONLY);
        out = reopened(auth.substr(comma + 1), O_WRONLY);
    }
    if (in >= 0 && out >= 0) return std::unique_ptr<Jobserver>(new Jobserver(in, out));
    if (in >= 0) ::close(in);
    if (out >= 0) ::close(out);
    return {};
}

Jobserver::~Jobserver() {
    give_all();
    ::close(in_);
    ::close(out_);
}

bool Jobserver::take() {
    char token = 0;
    ssize_t n = 0;
    do n = ::read(in_, &token, 1);
    while (n < 0 && errno == EINTR);
    if (n != 1) return false;
    const std::lock_guard lock(guard_);
    tokens_ += token;
    return true;
}

void Jobserver::give() {
    const std::lock_guard lock(guard_);
    if (tokens_.empty()) return;
    while (::write(out_, &tokens_.back(), 1) < 0 && errno == EINTR) {
    }
    tokens_.pop_back();
}

void Jobserver::give_all() {
    const std::lock_guard lock(guard_);
    while (!tokens_.empty()) {
        while (::write(out_, &tokens_.back(), 1) < 0 && errno == EINTR) {
        }
        tokens_.pop_back();
    }
}

} // namespace facetmill::batch
