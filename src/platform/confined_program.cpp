#include "platform/confined_program.hpp"

#include "platform/address_sanitizer.hpp"
#include "platform/file_bytes.hpp"
#include "platform/sandbox.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace facetmill {

namespace {

using How = ProgramEnd::How;

struct Pipe {
    Descriptor from, to;

    static Pipe make() {
        std::array<int, 2> ends{-1, -1};
        if (::pipe2(ends.data(), O_CLOEXEC) != 0) return {};
        return {Descriptor(ends[0]), Descriptor(ends[1])};
    }
};

void set_limit(decltype(RLIMIT_AS) what, std::uint64_t most) {
    const rlimit limit{static_cast<rlim_t>(most), static_cast<rlim_t>(most)};
    ::setrlimit(what, &limit);
}

/// Marks descriptors that the caller of facetmill left open, so that the program does not get them.
void close_others_at_start() {
    constexpr unsigned first = STDERR_FILENO + 1, close_on_exec = 4; // CLOSE_RANGE_CLOEXEC, Linux 5.11
    if (::syscall(SYS_close_range, first, ~0U, close_on_exec) == 0) return;
    rlimit limit{};
    constexpr rlim_t most = 65536;
    const rlim_t end = ::getrlimit(RLIMIT_NOFILE, &limit) == 0 ? std::min(limit.rlim_cur, most) : most;
    for (int number = first; static_cast<rlim_t>(number) < end; ++number)
        ::fcntl(number, F_SETFD, FD_CLOEXEC);
}

/// The streams of the child process.
struct Streams {
    const Descriptor &input, &output, &messages;
};

/// Runs in the child process: becomes the program.
[[noreturn]] void become(const ConfinedProgram& settings, const Streams& streams) {
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_DFL);
    ::dup2(streams.input.number(), STDIN_FILENO);
    ::dup2(streams.output.number(), STDOUT_FILENO);
    ::dup2(streams.messages.number(), STDERR_FILENO);
    close_others_at_start();
    // Text, vectors of pointers, and the sandbox need memory, so limits follow them.
    std::vector<char*> texts;
    const std::string own = settings.program.string();
    texts.push_back(const_cast<char*>(own.c_str()));
    for (const auto& argument : settings.arguments) texts.push_back(const_cast<char*>(argument.c_str()));
    texts.push_back(nullptr);
    // The environment could change how numbers are read, or load other libraries.
    std::string locale = "LC_ALL=C";
    const std::array<char*, 2> environment{locale.data(), nullptr};
    AllowedFiles allowed;
    allowed.read = settings.read;
    allowed.read.push_back(settings.program);
    allowed.run_all = true;
    confine_files(allowed);
    constexpr std::uint64_t open_files = 64;
    set_limit(RLIMIT_CORE, 0);
    set_limit(RLIMIT_FSIZE, 0);
    set_limit(RLIMIT_NOFILE, open_files);
    if (!has_address_sanitizer) set_limit(RLIMIT_AS, settings.memory);
    ::execve(own.c_str(), texts.data(), environment.data());
    constexpr int not_started = 127;
    ::_exit(not_started);
}

/// Reads what the program writes until it closes its streams, or has to be ended.
class Listener {
  public:
    Listener(const ConfinedProgram& settings, const Descriptor& socket)
        : settings_(settings), socket_(socket), deadline_(std::chrono::steady_clock::now() + settings.limit) {
    }

    How listen(Descriptor output, Descriptor messages, ConfinedEnd& end,
               const Function<void(std::span<const std::byte>)>& on_output) {
        std::vector<std::byte> room(std::size_t{1} << 20);
        while (output || messages) {
            std::array<pollfd, 3> ready{{{output.number(), POLLIN, 0},
                                         {messages.number(), POLLIN, 0},
                                         {socket_.number(), POLLIN, 0}}};
            constexpr int pause = 100; // milliseconds
            ::poll(ready.data(), ready.size(), pause);
            if (ready[2].revents != 0) return How::deserted;
            if (std::chrono::steady_clock::now() > deadline_) return How::late;
            if (ready[0].revents != 0) {
                const std::size_t got = read_some(output, room).value_or(0);
                if (got == 0) output.close();
                written_ += got;
                if ((end.too_much = written_ > settings_.most_output)) return How::exited;
                if (got > 0) on_output({room.data(), got});
            }
            if (ready[1].revents != 0) keep_end(messages, room, end.said);
        }
        return How::exited;
    }

    /// Whether the program ends by itself before the deadline, while the client waits.
    bool ends(pid_t process, int& status) const {
        for (;;) {
            const pid_t ended = ::waitpid(process, &status, WNOHANG);
            if (ended == process || (ended < 0 && errno != EINTR)) return ended == process;
            pollfd client{socket_.number(), POLLIN, 0};
            constexpr int pause = 2; // milliseconds
            ::poll(&client, 1, pause);
            if (client.revents != 0 || std::chrono::steady_clock::now() > deadline_) return false;
        }
    }

  private:
    static void keep_end(Descriptor& messages, std::span<std::byte> room, std::string& said) {
        constexpr std::size_t most = 4000;
        const std::size_t got = read_some(messages, room).value_or(0);
        if (got == 0) messages.close();
        said.append(reinterpret_cast<const char*>(room.data()), got);
        if (said.size() > most) said.erase(0, said.size() - most);
    }

    const ConfinedProgram& settings_;
    const Descriptor& socket_;
    std::chrono::steady_clock::time_point deadline_;
    std::uint64_t written_ = 0;
};

} // namespace

ConfinedEnd run_confined(const ConfinedProgram& settings, const Descriptor& input, const Descriptor& socket,
                         const Function<void(std::span<const std::byte>)>& on_output) {
    ConfinedEnd end;
    Pipe output = Pipe::make(), messages = Pipe::make();
    if (!output.to || !messages.to) return {{How::not_started, errno}};
    std::signal(SIGCHLD, SIG_DFL); // a caller may have it ignored, and then no exit code could be read
    const pid_t process = ::fork();
    if (process == 0) become(settings, {input, output.to, messages.to});
    if (process < 0) return {{How::not_started, errno}};
    output.to.close();
    messages.to.close();
    Listener listener(settings, socket);
    end.how = listener.listen(std::move(output.from), std::move(messages.from), end, on_output);
    int status = 0;
    if (end.how == How::exited && !end.too_much && listener.ends(process, status)) {
        if (WIFSIGNALED(status)) end.how = How::by_signal;
        end.number = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
        return end;
    }
    if (end.how == How::exited && !end.too_much) end.how = How::late;
    ::kill(-process, SIGKILL);
    ::kill(process, SIGKILL); // the program may not have created its process group yet
    ::waitpid(process, &status, 0);
    return end;
}

Descriptor file_in_memory(std::span<const std::byte> bytes) {
    Descriptor file(::memfd_create("input", MFD_CLOEXEC));
    std::uint64_t at = 0;
    if (file && !write_at(file, at, bytes)) return {};
    return file;
}

std::filesystem::path executable() {
    std::error_code failed;
    return std::filesystem::read_symlink("/proc/self/exe", failed); // empty on failure
}

} // namespace facetmill
