#include "platform/worker_process.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <new>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace facetmill {

namespace {

[[noreturn]] void serve_and_exit(const std::function<void(const Descriptor&)>& serve,
                                 const Descriptor& socket) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        std::signal(signal, SIG_IGN); // the worker ends with its parent
    const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nothing, stream);
    try {
        serve(socket);
    } catch (const std::bad_alloc&) { // the waiting side notices that no answer comes
    }
    ::_exit(0);
}

/// Repeats send or recv until all bytes are transferred.
template <class Byte, class Call>
bool all_pass(Byte* at, std::size_t size, Call&& call) {
    while (size > 0) {
        const ssize_t done = call(at, size);
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) return false;
        at += done;
        size -= static_cast<std::size_t>(done);
    }
    return true;
}

} // namespace

Descriptor start_worker(const std::function<void(const Descriptor&)>& serve) {
    std::array<int, 2> sockets{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets.data()) != 0) return {};
    Descriptor own(sockets[0]);
    const Descriptor other(sockets[1]);
    const pid_t process = ::fork();
    if (process == 0) {
        own.close();
        serve_and_exit(serve, other);
    }
    return process < 0 ? Descriptor() : std::move(own);
}

bool has_workers() { return true; }

bool is_readable(const Descriptor& socket, std::chrono::milliseconds time) {
    pollfd other{socket.number(), POLLIN, 0};
    return ::poll(&other, 1, static_cast<int>(time.count())) > 0;
}

bool send_all(const Descriptor& socket, const void* data, std::size_t size) {
    return all_pass(static_cast<const char*>(data), size, [&](const char* at, std::size_t left) {
        return ::send(socket.number(), at, left, MSG_NOSIGNAL);
    });
}

bool receive_all(const Descriptor& socket, void* data, std::size_t size) {
    return all_pass(static_cast<char*>(data), size,
                    [&](char* at, std::size_t left) { return ::recv(socket.number(), at, left, 0); });
}

} // namespace facetmill
