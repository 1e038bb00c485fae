#include "io/images/ktx_workers.hpp"

#include "platform/cores.hpp"
#include "platform/sandbox.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <condition_variable>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <mutex>
#include <poll.h>
#include <sstream>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace facetmill::io {

namespace fs = std::filesystem;

namespace {

// --- what goes between the two processes

constexpr std::uint64_t most_bytes = std::uint64_t{1} << 30; // of an image, either way

struct OrderMessage {
    std::uint8_t uastc, srgb, alpha, quality;
    std::uint32_t seconds;
    std::uint64_t bytes; ///< of the PNG that follows
};
struct AnswerMessage {
    std::uint64_t good;  ///< 1: what follows is a file; 0: it says what went wrong
    std::uint64_t bytes; ///< that follow
};

bool give(int socket, const void* data, std::size_t size) {
    const auto* at = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t done = ::send(socket, at, size, MSG_NOSIGNAL);
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) return false;
        at += done;
        size -= static_cast<std::size_t>(done);
    }
    return true;
}

bool take(int socket, void* data, std::size_t size) {
    auto* at = static_cast<char*>(data);
    while (size > 0) {
        const ssize_t done = ::recv(socket, at, size, 0);
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) return false;
        at += done;
        size -= static_cast<std::size_t>(done);
    }
    return true;
}

// --- the process that runs the program

bool is_toktx(const fs::path& program) { return program.filename().string().starts_with("toktx"); }

std::vector<std::string> common_arguments(const OrderMessage& order, const char* quality_option,
                                          const char* uastc_option) {
    constexpr int best = 255;
    if (order.uastc != 0) return {"--encode", "uastc", uastc_option, "2"};
    return {"--encode", "etc1s",        "--clevel",
            "2",        quality_option, std::to_string(std::max(1, order.quality * best / 100))};
}

std::vector<std::string> arguments_of_toktx(const OrderMessage& order) {
    std::vector<std::string> all{"--t2", "--genmipmap", "--threads", "1"};
    for (auto& argument : common_arguments(order, "--qlevel", "--uastc_quality")) all.push_back(argument);
    if (order.uastc != 0) all.insert(all.end(), {"--zcmp", "18"});
    all.insert(all.end(), {"--assign_oetf", order.srgb != 0 ? "srgb" : "linear", "--assign_primaries",
                           order.srgb != 0 ? "bt709" : "none", "--target_type",
                           order.alpha != 0 ? "RGBA" : "RGB", "out.ktx2", "in.png"});
    return all;
}

/// Before 4.4 ktx calls the transfer function by another name.
std::vector<std::string> arguments_of_ktx(const OrderMessage& order, bool is_old) {
    std::vector<std::string> all{"create", "--generate-mipmap", "--threads", "1"};
    for (auto& argument : common_arguments(order, "--qlevel", "--uastc-quality"))
        all.push_back(argument == "etc1s" ? "basis-lz" : argument);
    if (order.uastc != 0) all.insert(all.end(), {"--zstd", "18"});
    all.insert(all.end(),
               {"--format",
                fmt::format("R8G8B8{}_{}", order.alpha != 0 ? "A8" : "", order.srgb != 0 ? "SRGB" : "UNORM"),
                is_old ? "--assign-oetf" : "--assign-tf", order.srgb != 0 ? "srgb" : "linear",
                "--assign-primaries", order.srgb != 0 ? "bt709" : "none", "in.png", "out.ktx2"});
    return all;
}

/// What becomes of the process that was made for the program: it may write in the working directory only.
[[noreturn]] void become(const fs::path& program, const std::vector<std::string>& arguments) {
    ::setpgid(0, 0);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_DFL);
    const int log = ::open("log", O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    if (log >= 0) {
        ::dup2(log, STDOUT_FILENO);
        ::dup2(log, STDERR_FILENO);
    }
    AllowedFiles allowed;
    allowed.written = {"."};
    allowed.read_all = allowed.run_all = true;
    confine_files(allowed);
    std::vector<char*> texts;
    const std::string own = program.string();
    texts.push_back(const_cast<char*>(own.c_str()));
    for (const auto& argument : arguments) texts.push_back(const_cast<char*>(argument.c_str()));
    texts.push_back(nullptr);
    ::execv(own.c_str(), texts.data());
    constexpr int not_started = 127;
    ::_exit(not_started);
}

enum class End { done, late, deserted };

/// Waits for the program; ends it, and what it has started, when it takes too long, or nobody waits for it
/// any more.
End wait_for(pid_t process, int socket, std::chrono::seconds limit, int& status) {
    const auto deadline = std::chrono::steady_clock::now() + limit;
    constexpr int first_pause = 2, longest_pause = 50; // milliseconds
    for (int pause = first_pause;; pause = std::min(2 * pause, longest_pause)) {
        const pid_t ended = ::waitpid(process, &status, WNOHANG);
        if (ended == process || (ended < 0 && errno != EINTR)) return End::done;
        pollfd other{socket, 0, 0};
        const bool deserted = ::poll(&other, 1, pause) > 0 && (other.revents & (POLLHUP | POLLERR)) != 0;
        const bool late = std::chrono::steady_clock::now() > deadline;
        if (!deserted && !late) continue;
        ::kill(-process, SIGKILL);
        ::kill(process, SIGKILL); // before it has made its group
        ::waitpid(process, &status, 0);
        return deserted ? End::deserted : End::late;
    }
}

std::string contents_of(const char* file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

/// The last line that says anything, for a message.
std::string last_line(const std::string& log) {
    constexpr std::size_t most = 300;
    std::string line, last;
    std::istringstream lines(log);
    while (std::getline(lines, line))
        if (line.find_first_not_of(" \t\r") != line.npos) last = line;
    std::replace_if(
        last.begin(), last.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
    return last.substr(0, most);
}

/// Runs the program in the working directory; empty, or what went wrong.
std::string run_program(const fs::path& program, const std::vector<std::string>& arguments, int socket,
                        std::chrono::seconds limit) {
    const pid_t process = ::fork();
    if (process == 0) become(program, arguments);
    if (process < 0) return fmt::format("cannot be started: {}", std::strerror(errno));
    int status = 0;
    const End end = wait_for(process, socket, limit, status);
    if (end == End::late) return fmt::format("took longer than {} s and was ended", limit.count());
    if (end == End::deserted) return "was ended";
    const std::string said = last_line(contents_of("log"));
    const std::string tail = said.empty() ? "" : ": " + said;
    if (WIFSIGNALED(status)) return fmt::format("was ended by signal {}{}", WTERMSIG(status), tail);
    if (WEXITSTATUS(status) != 0) return fmt::format("failed with exit code {}{}", WEXITSTATUS(status), tail);
    return {};
}

/// "ktx version: v4.3.2".
bool is_before_4_4(const std::string& version) {
    const auto at = version.find_first_of("0123456789");
    int major = 0, minor = 0;
    return at != version.npos && std::sscanf(version.c_str() + at, "%d.%d", &major, &minor) == 2 &&
           (major < 4 || (major == 4 && minor < 4));
}

/// Waits for orders until nobody can give any more.
class Worker {
  public:
    Worker(fs::path program, int socket) : program_(std::move(program)), socket_(socket) {}

    void run() {
        OrderMessage order{};
        while (take(socket_, &order, sizeof order) && order.bytes <= most_bytes) {
            Bytes png(order.bytes);
            if (!take(socket_, png.data(), png.size())) break;
            std::string problem =
                prepared() ? "" : "has no folder to work in: " + std::string(std::strerror(errno));
            std::string file;
            if (problem.empty()) problem = encode(order, png, file);
            const std::string& text = problem.empty() ? file : problem;
            const AnswerMessage answer{problem.empty() ? 1U : 0U, text.size()};
            if (!give(socket_, &answer, sizeof answer) || !give(socket_, text.data(), text.size())) break;
        }
        std::error_code ignored;
        if (!folder_.empty()) fs::remove_all(folder_, ignored);
    }

  private:
    /// Makes the folder that the program works in.
    bool prepared() {
        if (!folder_.empty()) return true;
        std::error_code failed;
        const fs::path above = fs::temp_directory_path(failed);
        std::string name = ((failed ? fs::path("/tmp") : above) / "facetmill-ktx-XXXXXX").string();
        if (!::mkdtemp(name.data())) return false;
        folder_ = name;
        if (::chdir(name.c_str()) != 0) return false;
        return true;
    }

    std::string encode(const OrderMessage& order, const Bytes& png, std::string& file) {
        ::unlink("out.ktx2");
        std::ofstream in("in.png", std::ios::binary);
        in.write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
        in.close();
        if (!in) return "cannot be given the image: the temporary folder cannot be written";
        const std::chrono::seconds limit(order.seconds);
        if (!is_toktx(program_) && !is_old_) {
            run_program(program_, {"--version"}, socket_, limit);
            is_old_ = is_before_4_4(contents_of("log"));
        }
        const std::string problem = run_program(
            program_, is_toktx(program_) ? arguments_of_toktx(order) : arguments_of_ktx(order, *is_old_),
            socket_, limit);
        if (!problem.empty()) return problem;
        std::error_code failed;
        if (!(fs::file_size("out.ktx2", failed) <= most_bytes) || failed)
            return "wrote no file of a size that is read";
        file = contents_of("out.ktx2");
        return {};
    }

    fs::path program_, folder_;
    int socket_;
    std::optional<bool> is_old_;
};

[[noreturn]] void serve(const fs::path& program, int socket) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_IGN); // it ends with the other
    const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nothing, stream);
    try {
        Worker(program, socket).run();
    } catch (...) { // no memory: whoever waits sees that nothing comes
    }
    ::_exit(0);
}

// --- the process that asks

struct Workers {
    std::mutex mutex;
    std::condition_variable freed;
    std::vector<int> all, free; ///< sockets
};

Workers& workers() {
    static Workers all;
    return all;
}

/// A socket while it is used; it comes back unless what came from it was broken.
class Loan {
  public:
    Loan() {
        Workers& w = workers();
        std::unique_lock lock(w.mutex);
        w.freed.wait(lock, [&] { return !w.free.empty() || w.all.empty(); });
        if (w.free.empty()) return;
        socket_ = w.free.back();
        w.free.pop_back();
    }
    ~Loan() {
        if (socket_ < 0) return;
        Workers& w = workers();
        {
            const std::lock_guard lock(w.mutex);
            if (broken_)
                std::erase(w.all, socket_);
            else
                w.free.push_back(socket_);
        }
        if (broken_) ::close(socket_);
        w.freed.notify_all();
    }
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;

    int socket() const { return socket_; }
    [[noreturn]] void fail() {
        broken_ = true;
        throw Error(ErrorKind::stage, "E-KTX", "the process that runs ktx was ended",
                    "it may want for memory; textures: {format: webp} needs no other program");
    }

  private:
    int socket_ = -1;
    bool broken_ = false;
};

std::optional<fs::path> in_path(const char* name) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const fs::path file = fs::path(folder) / name;
        std::error_code ignored;
        if (file.is_absolute() && fs::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0)
            return file;
    }
    return {};
}

} // namespace

std::optional<fs::path> ktx_program() {
    if (const char* named = std::getenv("FACETMILL_KTX"); named && *named) {
        std::error_code failed;
        const fs::path file = fs::absolute(named, failed);
        const bool runs = !failed && fs::is_regular_file(file, failed) && ::access(file.c_str(), X_OK) == 0;
        return runs ? std::optional(file) : std::nullopt;
    }
    if (auto ktx = in_path("ktx")) return ktx;
    return in_path("toktx");
}

void start_ktx_workers() {
    constexpr int most = 8;
    Workers& w = workers();
    const std::lock_guard lock(w.mutex);
    const auto program = w.all.empty() ? ktx_program() : std::nullopt;
    if (!program) return;
    for (int n = std::min(most, default_threads()); n > 0; --n) {
        std::array<int, 2> sockets{};
        if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets.data()) != 0) return;
        const pid_t process = ::fork();
        if (process == 0) {
            ::close(sockets[0]);
            for (const int other : w.all)
                ::close(other); // else these would not see that nobody asks any more
            serve(*program, sockets[1]);
        }
        ::close(sockets[1]);
        if (process < 0) {
            ::close(sockets[0]);
            return;
        }
        w.all.push_back(sockets[0]);
        w.free.push_back(sockets[0]);
    }
}

Bytes run_ktx(Span png, const KtxOrder& order) {
    if (!active_protections().calls) start_ktx_workers();
    Loan loan;
    if (loan.socket() < 0)
        throw Error(ErrorKind::stage, "E-KTX",
                    "KTX2 needs the program ktx or toktx, which cannot be started");
    const OrderMessage message{order.uastc,
                               order.srgb,
                               order.alpha,
                               static_cast<std::uint8_t>(order.quality),
                               static_cast<std::uint32_t>(order.limit.count()),
                               png.size()};
    AnswerMessage answer{};
    if (!give(loan.socket(), &message, sizeof message) || !give(loan.socket(), png.data(), png.size()) ||
        !take(loan.socket(), &answer, sizeof answer) || answer.bytes > most_bytes)
        loan.fail();
    Bytes bytes(answer.bytes);
    if (!take(loan.socket(), bytes.data(), bytes.size())) loan.fail();
    if (answer.good == 1) return bytes;
    throw Error(ErrorKind::stage, "E-KTX", std::string(as_text(bytes)));
}

} // namespace facetmill::io
