#include "support/catch.hpp"

#include "base/progress.hpp"
#include "parallel/parallel.hpp"
#include "support/heard.hpp"

#include <thread>

using namespace facetmill;

TEST_CASE("shares are told to whoever listens on this thread, parts within their part", "[base]") {
    test::Heard heard;
    ProgressScope::report(0.5);
    CHECK(heard.shares.empty());
    {
        const ProgressScope whole(&heard);
        ProgressScope::report(0.5);
        CHECK(heard.last() == 0.5);
        {
            const ProgressScope second(0.5, 1);
            ProgressScope::report(0);
            CHECK(heard.last() == 0.5);
            const ProgressScope half_of_it(0, 0.5);
            ProgressScope::report(1);
            CHECK(heard.last() == 0.75);
        }
        std::thread([] { ProgressScope::report(0.1); }).join();
        CHECK(heard.last() == 0.75);
        ProgressScope::report(1);
        CHECK(heard.last() == 1);
        ProgressScope::report(0.25);
    }
    ProgressScope::report(0.5);
    CHECK(heard.last() == 0.25);
}

TEST_CASE("steps have parts of a share by their lengths, rounds half of what is left", "[base]") {
    test::Heard heard;
    const ProgressScope whole(&heard);
    {
        ProgressSteps steps({1, 2, 0, 1});
        ProgressScope::report(0.5);
        CHECK(heard.last() == 0.125);
        steps.next();
        CHECK(heard.last() == 0.25);
        {
            ProgressRounds rounds;
            ProgressScope::report(1);
            CHECK(heard.last() == 0.5);
            rounds.next();
            ProgressScope::report(1);
            CHECK(heard.last() == 0.625);
        }
        steps.next();
        steps.next();
        ProgressScope::report(0);
        CHECK(heard.last() == 0.75);
        steps.next();
        steps.next(); // no further step exists
        CHECK(heard.last() == 1);
    }
    {
        ProgressSteps none({});
        none.next();
        ProgressScope::report(0.5);
    }
    CHECK(heard.last() == 0.5);
}

TEST_CASE("a parallel loop tells how far it is when it was asked to", "[base]") {
    test::Heard heard;
    const ProgressScope whole(&heard);
    const auto loop = [] {
        parallel_for(
            100,
            [](std::size_t) {
                parallel_for(
                    10, [](std::size_t) { ProgressScope::report(0.123); }, 1);
            },
            1);
    };
    ProgressScope::report_next_loop();
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
