#include "support/catch.hpp"

#include "io/bytes.hpp"
#include "platform/sandbox.hpp"
#include "support/failure.hpp"
#include "support/temporary.hpp"

#include <cerrno>
#include <fcntl.h>
#include <functional>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>

using namespace facetmill;

namespace {

/// The number, from 1, of the first condition that fails; 0 if all hold. Runs in a separate process, because
/// the sandbox cannot be undone.
int first_that_fails(const std::function<bool()>& close_it, const std::vector<std::function<bool()>>& all) {
    const pid_t child = ::fork();
    if (child == 0) {
        int failed = close_it() ? 0 : 100;
        for (std::size_t i = 0; i < all.size() && failed == 0; ++i)
            if (!all[i]()) failed = static_cast<int>(i) + 1;
        ::_exit(failed);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// The error of opening it; 0 when it opens.
int error_of(const std::filesystem::path& path, int flags) {
    const int fd = ::open(path.c_str(), flags | O_CLOEXEC, 0600);
    if (fd < 0) return errno;
    ::close(fd);
    return 0;
}

} // namespace

TEST_CASE("files that are not allowed are refused, in threads that start later too", "[base]") {
    if (offered_protections().files == 0) return;
    const test::TemporaryDirectory folder;
    std::filesystem::create_directories(folder / "in/deep");
    std::filesystem::create_directories(folder / "out");
    for (const char* name : {"in/deep/a", "one", "other", "out/old"}) test::put(folder / name, "text");
    const AllowedFiles allowed{{folder / "in", folder / "one", folder / "not there"},
                               {folder / "out/new/deeper"}};
    const auto is = [&](const char* name, int flags, int error) {
        return [path = folder / name, flags, error] { return error_of(path, flags) == error; };
    };
    CHECK(
        first_that_fails(
            [&] { return confine_files(allowed); },
            {is("in/deep/a", O_RDONLY, 0), is("one", O_RDONLY, 0), is("other", O_RDONLY, EACCES),
             is("in/deep/a", O_WRONLY, EACCES), is("in/b", O_WRONLY | O_CREAT, EACCES),
             is("out/old", O_RDWR, 0), is("out/b", O_WRONLY | O_CREAT, 0),
             [&] { return std::filesystem::create_directories(folder / "out/new/deeper"); },
             is("out/new/deeper/c", O_WRONLY | O_CREAT, 0),
             [] { return error_of("/etc/passwd", O_RDONLY) == EACCES; },
             [] { return error_of("/dev/null", O_RDWR) == 0; },
             [] { return error_of("/proc/self/statm", O_RDONLY) == 0; },
             [&] {
                 int error = 0;
                 std::thread([&] { error = error_of(folder / "other", O_RDONLY); }).join();
                 return error == EACCES;
             },
             [&] { return sandbox_hint(folder / "other", EACCES).find("--no-sandbox") != std::string::npos; },
             [&] { return sandbox_hint(folder / "other", ENOENT).empty(); },
             [] { return active_protections().files > 0; }}) == 0);
    CHECK(sandbox_hint(folder / "other", EACCES).empty()); // no sandbox is active in this process
}

TEST_CASE("processes and sockets are refused, threads are not", "[base]") {
    if (!offered_protections().calls) return;
    const auto is_refused = [](long result) { return result == -1 && errno == EPERM; };
    CHECK(first_that_fails([] { return confine_calls(); },
                           {[&] { return is_refused(::socket(AF_UNIX, SOCK_STREAM, 0)); },
                            [&] {
                                const pid_t child = ::fork();
                                if (child == 0) ::_exit(0);
                                return is_refused(child);
                            },
                            [&] {
                                char* const nothing[] = {nullptr};
                                return is_refused(::execve("/bin/true", nothing, nothing));
                            },
                            [] {
                                bool ran = false;
                                std::thread([&] { ran = true; }).join();
                                return ran;
                            },
                            [] { return confine_calls() && active_protections().calls; }}) == 0);
}
