#include "support/catch.hpp"

#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "support/heard.hpp"

#include <thread>

using namespace facetmill;

TEST_CASE("shares are told to whoever listens on this thread, parts within their part", "[base]") {
    test::Heard heard;
    Share::tell(0.5);
    CHECK(heard.shares.empty());
    {
        const Share whole(&heard);
        Share::tell(0.5);
        CHECK(heard.last() == 0.5);
        {
            const Share second(0.5, 1);
            Share::tell(0);
            CHECK(heard.last() == 0.5);
            const Share half_of_it(0, 0.5);
            Share::tell(1);
            CHECK(heard.last() == 0.75);
        }
        std::thread([] { Share::tell(0.1); }).join();
        CHECK(heard.last() == 0.75);
        Share::tell(1);
        CHECK(heard.last() == 1);
        Share::tell(0.25);
    }
    Share::tell(0.5);
    CHECK(heard.last() == 0.25);
}

TEST_CASE("steps have parts of a share by their lengths, rounds half of what is left", "[base]") {
    test::Heard heard;
    const Share whole(&heard);
    {
        ShareOfSteps steps({1, 2, 0, 1});
        Share::tell(0.5);
        CHECK(heard.last() == 0.125);
        steps.next();
        CHECK(heard.last() == 0.25);
        {
            ShareOfRounds rounds;
            Share::tell(1);
            CHECK(heard.last() == 0.5);
            rounds.next();
            Share::tell(1);
            CHECK(heard.last() == 0.625);
        }
        steps.next();
        steps.next();
        Share::tell(0);
        CHECK(heard.last() == 0.75);
        steps.next();
        steps.next(); // there are no more
        CHECK(heard.last() == 1);
    }
    {
        ShareOfSteps none({});
        none.next();
        Share::tell(0.5);
    }
    CHECK(heard.last() == 0.5);
}

TEST_CASE("a parallel loop tells how far it is when it was asked to", "[base]") {
    test::Heard heard;
    const Share whole(&heard);
    const auto loop = [] {
        parallel_for(
            100,
            [](std::size_t) {
                parallel_for(
                    10, [](std::size_t) { Share::tell(0.123); }, 1);
            },
            1);
    };
    Share::loop_tells();
    loop();
    CHECK(heard.shares.size() >= 2);
    CHECK(heard.last() == 1);
    CHECK(heard.falls() == 0);
    CHECK(std::count(heard.shares.begin(), heard.shares.end(), 0.123) == 0);
    heard.shares.clear();
    parallel_for(
        100, [](std::size_t) {}, 1);
    CHECK(heard.shares.empty());
}
