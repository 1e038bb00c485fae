#include "platform/run_program.hpp"

#include "platform/file_names.hpp"
#include "platform/sandbox.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

namespace facetmill {

std::optional<std::filesystem::path> program_in_path(const std::string& name) {
    const auto runs = [](const std::filesystem::path& file) {
        std::error_code ignored;
        return file.is_absolute() && std::filesystem::is_regular_file(file, ignored) && may_run(file);
    };
    if (name.find('/') != name.npos)
        return runs(name) ? std::optional(std::filesystem::path(name)) : std::nullopt;
    const char* path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (const auto file = std::filesystem::path(folder) / name; runs(file)) return file;
    return {};
}

namespace {

/// Runs in the child process: becomes the program.
[[noreturn]] void become(const ProgramSettings& settings) {
    ::setpgid(0, 0);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_DFL);
    const int log = ::open(settings.log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    if (log >= 0) {
        ::dup2(log, STDOUT_FILENO);
        ::dup2(log, STDERR_FILENO);
    }
    AllowedFiles allowed;
    allowed.written = {"."};
    allowed.read_all = allowed.run_all = true;
    confine_files(allowed);
    std::vector<char*> texts;
    const std::string own = settings.program.string();
    texts.push_back(const_cast<char*>(own.c_str()));
    for (const auto& argument : settings.arguments) texts.push_back(const_cast<char*>(argument.c_str()));
    texts.push_back(nullptr);
    ::execv(own.c_str(), texts.data());
    constexpr int not_started = 127;
    ::_exit(not_started);
}

using How = ProgramEnd::How;

/// Waits for the program. Kills it with its children after the time limit, or when the parent no longer
/// waits.
How wait_for(pid_t process, const Descriptor& socket, std::chrono::seconds limit, int& status) {
    const auto deadline = std::chrono::steady_clock::now() + limit;
    constexpr int first_pause = 2, longest_pause = 50; // pauses in milliseconds
    for (int pause = first_pause;; pause = std::min(2 * pause, longest_pause)) {
        const pid_t ended = ::waitpid(process, &status, WNOHANG);
        if (ended == process || (ended < 0 && errno != EINTR)) return How::exited;
        pollfd other{socket.number(), POLLIN, 0};
        const bool deserted = ::poll(&other, 1, pause) > 0;
        const bool late = std::chrono::steady_clock::now() > deadline;
        if (!deserted && !late) continue;
        ::kill(-process, SIGKILL);
        ::kill(process, SIGKILL); // the program may not have created its process group yet
        ::waitpid(process, &status, 0);
        return deserted ? How::deserted : How::late;
    }
}

} // namespace

ProgramEnd run_program(const ProgramSettings& settings, const Descriptor& socket) {
    const pid_t process = ::fork();
    if (process == 0) become(settings);
    if (process < 0) return {How::not_started, errno};
    int status = 0;
    const How how = wait_for(process, socket, settings.limit, status);
    if (how != How::exited) return {how, 0};
    if (WIFSIGNALED(status)) return {How::by_signal, WTERMSIG(status)};
    return {How::exited, WEXITSTATUS(status)};
}

} // namespace facetmill
