#include "support/catch.hpp"

#include "io/outputs/output_files.hpp"
#include "io/outputs/outputs.hpp"
#include "support/failure.hpp"
#include "support/temporary.hpp"

#include <atomic>
#include <chrono>
#include <csignal>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>

using namespace facetmill;
using namespace facetmill::test;
using io::Outputs;
namespace fs = std::filesystem;
using Names = std::vector<std::string>;

TEST_CASE("outputs appear together at the commit", "[io]") {
    const TemporaryDirectory dir;
    put(dir / "a", "old");
    Outputs outputs;
    outputs.add(dir / "a", bytes_of("new"));
    outputs.add(dir / "sub/deep/b", bytes_of("second"));
    CHECK(get(dir / "a") == "old");
    CHECK_FALSE(fs::exists(dir / "sub/deep/b"));
    outputs.commit();
    CHECK(get(dir / "a") == "new");
    CHECK(get(dir / "sub/deep/b") == "second");
    CHECK(dir.names() == Names{"a", "sub", "sub/deep", "sub/deep/b"});
}

TEST_CASE("a staged file can be read back before the commit", "[io]") {
    const TemporaryDirectory dir;
    Outputs outputs;
    const auto& file = outputs.add(dir / "a.ply", bytes_of("text"));
    CHECK(file.bytes == 4);
    CHECK(file.sha256 == "982d9e3eb996f559e633f4d194def3761d909f5a3b647d1a851fead67c32c9d1");
    const io::Input input = outputs.staged(file);
    CHECK(io::as_text(input.bytes()) == "text");
    CHECK(input.name() == (dir / "a.ply").string());
}

TEST_CASE("an input that is an output with the same bytes is left alone", "[io]") {
    const TemporaryDirectory dir;
    put(dir / "texture", "pixels");
    const auto old = fs::last_write_time(dir / "texture") - std::chrono::hours(1);
    fs::last_write_time(dir / "texture", old);
    Outputs outputs;
    outputs.add(dir / "first", bytes_of("x"));
    outputs.protect(dir / "texture", outputs.add(dir / "copy", bytes_of("pixels")).sha256);
    const auto& file = outputs.add(dir / "texture", bytes_of("pixels"));
    CHECK(file.bytes == 6);
    CHECK(io::as_text(outputs.staged(file).bytes()) == "pixels");
    CHECK(&outputs.add(dir / "./texture", bytes_of("pixels")) == &file);
    outputs.commit();
    CHECK(dir.names() == Names{"copy", "first", "texture"});
    CHECK(fs::last_write_time(dir / "texture") == old);
}

TEST_CASE("a discarded run leaves older outputs and no directories of its own", "[io]") {
    const TemporaryDirectory dir;
    put(dir / "a", "old");
    {
        Outputs outputs;
        outputs.add(dir / "a", bytes_of("new"));
        outputs.add(dir / "made/b", bytes_of("new"));
    }
    CHECK(get(dir / "a") == "old");
    CHECK(dir.names() == Names{"a"});
}

TEST_CASE("a rename that fails puts back what was renamed before it", "[io]") {
    const TemporaryDirectory dir;
    put(dir / "a", "old");
    Outputs outputs;
    outputs.add(dir / "a", bytes_of("new"));
    outputs.add(dir / "b", bytes_of("new"));
    outputs.add(dir / "c", bytes_of("new"));
    fs::create_directories(dir / "c/in-the-way");
    CHECK(failure([&] { outputs.commit(); }) ==
          fmt::format(
              "output [E-DIRECTORY] '{}' is a directory, expected a file | give the name of a file in it",
              (dir / "c").string()));
    CHECK(get(dir / "a") == "old");
    CHECK(dir.names() == Names{"a", "c", "c/in-the-way"});
}

TEST_CASE("targets that cannot be written are refused before anything is", "[io]") {
    const TemporaryDirectory dir;
    put(dir / "file", "x");
    fs::create_directory(dir / "folder");
    Outputs outputs;
    CHECK(failure([&] { outputs.add(dir / "folder", bytes_of("x")); }) ==
          fmt::format(
              "output [E-DIRECTORY] '{}' is a directory, expected a file | give the name of a file in it",
              (dir / "folder").string()));
    CHECK(failure([&] { outputs.add(dir / "file/below", bytes_of("x")); }) ==
          fmt::format("output [E-DIRECTORY] the directory '{}' cannot be made: a file has this name | write "
                      "elsewhere: under another path, or (run, batch, pipe) with another --output-dir",
                      (dir / "file").string()));
    const std::string long_name(300, 'n');
    CHECK(failure([&] { outputs.add(dir / long_name / "x", bytes_of("x")); }) ==
          fmt::format(
              "output [E-DIRECTORY] the directory '{}' cannot be made: File name too long | give a shorter "
              "path: each name in it may have 255 bytes, and all of it 4095",
              (dir / long_name).string()));
    outputs.add(dir / "once", bytes_of("x"));
    CHECK(failure([&] { outputs.add(dir / "folder/../once", bytes_of("y")); }) ==
          fmt::format("output [E-DUPLICATE-OUTPUT] '{}' is written twice in one run, with different contents "
                      "| give the second output another name or folder",
                      (dir / "folder/../once").string()));
    CHECK(outputs.add(dir / "folder/../once", bytes_of("x")).target == dir / "once"); // a shared texture
}

TEST_CASE("a directory that may not be written to is refused", "[io]") {
    if (::geteuid() == 0) return; // root may write anywhere
    const TemporaryDirectory dir;
    fs::create_directory(dir / "locked");
    ::chmod((dir / "locked").c_str(), 0555);
    Outputs outputs;
    CHECK(failure([&] { outputs.add(dir / "locked/a", bytes_of("x")); }) ==
          fmt::format("output [E-WRITE] '{}' cannot be written: Permission denied",
                      (dir / "locked/a").string()));
}

TEST_CASE("a full device is told from other failures", "[io]") {
    if (!fs::exists("/dev/full")) return;
    Outputs outputs;
    outputs.add("/dev/full", bytes_of("x"));
    CHECK(failure([&] { outputs.commit(); }) ==
          "output [E-SPACE] no space left to write '/dev/full' | free some space there, or "
          "write elsewhere: under another path, or (run, batch, pipe) with another --output-dir");
}

TEST_CASE("links stay links and permissions stay", "[io]") {
    const TemporaryDirectory dir;
    put(dir / "target", "old");
    ::chmod((dir / "target").c_str(), 0640);
    fs::create_symlink("target", dir / "link");
    fs::create_symlink("nowhere-yet", dir / "dangling");
    Outputs outputs;
    outputs.add(dir / "link", bytes_of("new"));
    outputs.add(dir / "dangling", bytes_of("new"));
    outputs.commit();
    CHECK(fs::is_symlink(dir / "link"));
    CHECK(get(dir / "target") == "new");
    CHECK(get(dir / "nowhere-yet") == "new");
    CHECK((fs::status(dir / "target").permissions() & fs::perms::all) == static_cast<fs::perms>(0640));
}

TEST_CASE("temporaries of a dead process go, those of living ones stay", "[io]") {
    const TemporaryDirectory dir;
    const pid_t dead = ::fork();
    if (dead == 0) ::_exit(0);
    ::waitpid(dead, nullptr, 0);
    const std::string stale = fmt::format(".a.facetmill-{}~", dead),
                      again = fmt::format(".b.facetmill-{}-2~", dead);
    const std::string alive = fmt::format(".a.facetmill-{}~", ::getppid());
    for (const auto& name :
         {stale, again, alive, std::string(".a.facetmill-x~"), std::string("a.facetmill-1~")})
        put(dir / name, "x");
    Outputs outputs;
    outputs.add(dir / "a", bytes_of("new"));
    outputs.commit();
    CHECK(dir.names() == Names{alive, ".a.facetmill-x~", "a", "a.facetmill-1~"});
}

TEST_CASE("a signal removes temporaries and ends the process by that signal", "[io]") {
    const TemporaryDirectory dir;
    put(dir / "a", "old");
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        const pid_t child = ::fork();
        if (child == 0) {
            std::signal(number, SIG_DFL);
            io::clean_up_on_signals();
            Outputs outputs;
            outputs.add(dir / "a", bytes_of("new"));
            outputs.add(dir / "made/below/b", bytes_of("new"));
            ::raise(number);
            ::_exit(99);
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        CHECK(WIFSIGNALED(status));
        CHECK(WTERMSIG(status) == number);
        CHECK(get(dir / "a") == "old");
        CHECK(dir.names() == Names{"a"});
    }
}

TEST_CASE("one file at once", "[io]") {
    const TemporaryDirectory dir;
    io::write_now(dir / "reports/r.json", bytes_of("{}"));
    CHECK(get(dir / "reports/r.json") == "{}");
}

TEST_CASE("runs on several threads share folders that failing ones remove", "[io]") {
    const TemporaryDirectory dir;
    constexpr int rounds = 300;
    std::atomic<int> failures{0};
    const auto fail = [&] {
        for (int i = 0; i < rounds; ++i) {
            try {
                Outputs outputs;
                outputs.add(dir / "made/below/failed", bytes_of("new"));
            } catch (const Error&) {
                ++failures;
            }
        }
    };
    const auto succeed = [&](const std::string& name) {
        for (int i = 0; i < rounds; ++i) {
            try {
                Outputs outputs;
                outputs.add(dir / ("made/below/" + name), bytes_of("new"));
                outputs.commit();
                fs::remove(dir / ("made/below/" + name));
                std::error_code ignored;
                fs::remove(dir / "made/below", ignored);
                fs::remove(dir / "made", ignored);
            } catch (const Error&) {
                ++failures;
            }
        }
    };
    std::thread first(fail), second(succeed, "a"), third(succeed, "b");
    first.join();
    second.join();
    third.join();
    CHECK(failures == 0);
}

TEST_CASE("a file has one name, however it is spelled", "[io]") {
    test::TemporaryDirectory directory;
    const auto folder = std::filesystem::canonical(directory.path());
    std::filesystem::create_directory(folder / "real");
    std::filesystem::create_directory_symlink(folder / "real", folder / "link");
    CHECK(io::identity(folder / "link" / "a.ply") == folder / "real" / "a.ply");
    CHECK(io::identity(folder / "real" / "." / ".." / "real" / "a.ply") == folder / "real" / "a.ply");
    CHECK(io::identity("-") == "-");
    // A name too long for the file system stays as written.
    const std::string longest(300, 'x');
    CHECK(io::identity(folder / "real" / ".." / longest) == folder / longest);
}
