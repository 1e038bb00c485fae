#include "support/catch.hpp"

#include "batch/jobserver.hpp"
#include "batch/pool.hpp"
#include "support/temporary.hpp"

#include <atomic>
#include <chrono>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

using namespace facetmill::batch;
using facetmill::test::TemporaryDirectory;

TEST_CASE("tokens of a jobserver are taken and given back as they were", "[batch]") {
    int ends[2];
    REQUIRE(::pipe(ends) == 0);
    REQUIRE(::write(ends[1], "ab", 2) == 2);
    {
        const auto server = Jobserver::offered(fmt::format(" -j3 --jobserver-fds={},{}", ends[0], ends[1]));
        REQUIRE(server);
        CHECK(server->take());
        CHECK(server->take());
        CHECK_FALSE(server->take());
        server->give();
        CHECK(server->take());
    }
    char back[3] = {};
    CHECK(::read(ends[0], back, 2) == 2);
    CHECK((std::string(back) == "ab" || std::string(back) == "ba"));
    ::close(ends[0]);
    ::close(ends[1]);
}

TEST_CASE("a jobserver may be a FIFO, or absent", "[batch]") {
    const TemporaryDirectory dir;
    const std::string fifo = (dir / "fifo").string();
    REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);
    const auto server = Jobserver::offered("k -j4 --jobserver-auth=fifo:" + fifo);
    REQUIRE(server);
    CHECK_FALSE(server->take());
    CHECK_FALSE(Jobserver::offered(""));
    CHECK_FALSE(Jobserver::offered("-j2"));
    CHECK_FALSE(Jobserver::offered("--jobserver-auth=-2,-2"));
    CHECK_FALSE(Jobserver::offered("--jobserver-auth=fifo:/nowhere/at/all"));
    CHECK_FALSE(Jobserver::offered("--jobserver-auth=997,998"));
}

TEST_CASE("without a token there is one job at a time", "[batch]") {
    int ends[2];
    REQUIRE(::pipe(ends) == 0);
    const auto server = Jobserver::offered(fmt::format("--jobserver-auth={},{}", ends[0], ends[1]));
    REQUIRE(server);
    std::atomic<int> running{0}, most{0}, done{0}, wanted{1}; // a job waits for others, for some seconds
    const auto work = [&](const Job&, const std::function<bool()>&) {
        const int now = ++running;
        int known = most;
        while (known < now && !most.compare_exchange_weak(known, now)) {
        }
        for (int tick = 0; tick < 1 || (tick < 2000 && most < wanted); ++tick)
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        --running;
        ++done;
        return Next::go_on;
    };
    std::vector<Job> jobs(6);
    Pool({4, 100, server.get()}, jobs, work).run();
    CHECK(done == 6);
    CHECK(most == 1);
    REQUIRE(::write(ends[1], "x", 1) == 1);
    wanted = 2;
    Pool({4, 100, server.get()}, jobs, work).run();
    CHECK(done == 12);
    CHECK(most == 2);
    ::close(ends[0]);
    ::close(ends[1]);
}
