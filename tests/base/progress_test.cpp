#include "support/catch.hpp"

#include "base/progress.hpp"

#include <thread>

using namespace facetmill;

TEST_CASE("shares are told to whoever listens on this thread, parts within their part", "[base]") {
    std::atomic<double> heard{-1};
    Share::tell(0.5);
    CHECK(heard == -1);
    {
        const Share whole(&heard);
        Share::tell(0.5);
        CHECK(heard == 0.5);
        {
            const Share second(0.5, 1);
            Share::tell(0);
            CHECK(heard == 0.5);
            const Share half_of_it(0, 0.5);
            Share::tell(1);
            CHECK(heard == 0.75);
        }
        std::thread([] { Share::tell(0.1); }).join();
        CHECK(heard == 0.75);
        Share::tell(1);
        CHECK(heard == 1);
        Share::unknown();
        CHECK(heard == -1);
        Share::tell(0.25);
    }
    Share::tell(0.5);
    CHECK(heard == 0.25);
}
