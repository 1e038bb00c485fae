// Runs random meshes through random chains of stages for a given time: fuzz_stages SECONDS [FIRST_SEED
// [STAGE]]. Prints the seed and the chain of each fault and each slow run, and how often each stage ran.
// Exits with 1 after a fault. STAGE: all chains begin with it. tests/property/stage_chains_test.cpp runs
// some of the seeds.

#include "support/stage_chains.hpp"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <sys/resource.h>
#include <sys/time.h>

#if defined(__SANITIZE_ADDRESS__) // GCC
#define WITH_SANITIZER 1
#elif defined(__has_feature) // Clang
#define WITH_SANITIZER __has_feature(address_sanitizer)
#else
#define WITH_SANITIZER 0
#endif
#if WITH_SANITIZER
#include <sanitizer/common_interface_defs.h>
#endif

using namespace facetmill;

namespace {

/// Processor time for a chain with one and three threads and its file. A longer run counts as hanging.
constexpr int most_seconds = WITH_SANITIZER ? 1200 : 300; // which make some chains thirty times as long
constexpr double slow_seconds = 10;
constexpr std::size_t most_mib = 3000;

char current[1 << 14]; ///< the chain that runs, for whoever ends the program

void tell_current() {
    [[maybe_unused]] const auto ignored = ::write(STDERR_FILENO, current, std::strlen(current));
}

void on_signal(int number) {
    tell_current();
    std::signal(number, SIG_DFL);
    std::raise(number);
}

rusage used() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage;
}

double spent() {
    const rusage usage = used();
    return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

std::size_t peak_mib() { return static_cast<std::size_t>(used().ru_maxrss) >> 10; }

/// Ends a hanging chain by SIGPROF; 0: no limit.
void allow_seconds(int seconds) {
    itimerval timer{};
    timer.it_value.tv_sec = seconds;
    ::setitimer(ITIMER_PROF, &timer, nullptr);
}

/// Reports chains that were slow or used much memory.
test::Verdict watched(const test::Chain& chain, const std::string& told, test::Draw& draw,
                      const std::filesystem::path& folder) {
    fmt::format_to_n(current, sizeof current - 1, "ended in {}\n{}", told, '\0');
    const double start = spent();
    const std::size_t before = peak_mib();
    allow_seconds(most_seconds);
    test::Verdict verdict = test::judge(chain, folder, draw.word({"glb", "ply", "obj", "off", "stl"}));
    allow_seconds(0);
    if (spent() - start > slow_seconds) std::printf("%.0f s: %s\n", spent() - start, told.c_str());
    if (verdict.wrong.empty() && peak_mib() > std::max(before, most_mib))
        verdict.wrong = fmt::format("{} MiB of memory", peak_mib());
    return verdict;
}

} // namespace

int main(int count, char** arguments) {
    if (count < 2) {
        std::fprintf(stderr, "fuzz_stages SECONDS [FIRST_SEED [STAGE]]\n");
        return 2;
    }
    for (const int number : {SIGPROF, SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL})
        std::signal(number, on_signal);
#if WITH_SANITIZER
    __sanitizer_set_death_callback(tell_current);
#endif
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(std::atoi(arguments[1]));
    const std::uint64_t first = count > 2 ? std::strtoull(arguments[2], nullptr, 10) : 1;
    const std::string only = count > 3 ? arguments[3] : "";
    const test::TemporaryDirectory folder;
    test::put_files(folder.path());
    std::map<std::string, std::size_t> stage_runs;
    std::size_t troubles = 0, stages = 0, done = 0;
    std::uint64_t seed = first;
    for (; std::chrono::steady_clock::now() < end; ++seed) {
        test::Draw draw(seed);
        const test::Chain chain = test::random_chain(draw, only);
        const std::string told = fmt::format("seed {}: {}", seed, chain.described());
        for (const auto& link : chain.links) ++stage_runs[link.stage->name];
        const auto [wrong, stages_done] = watched(chain, told, draw, folder.path());
        stages += chain.links.size();
        done += stages_done;
        if (wrong.empty()) continue;
        ++troubles;
        std::printf("WRONG %s\n    %s\n", told.c_str(), wrong.c_str());
    }
    const std::string summary = fmt::format(
        "seeds {} to {}, {} of {} stages done, {} troubles, {:.0f} s of the processor, at most {} MiB", first,
        seed - 1, done, stages, troubles, spent(), peak_mib());
    std::puts(summary.c_str());
    for (const auto& [name, runs] : stage_runs) std::printf("%s %zu\n", name.c_str(), runs);
    return troubles > 0;
}
