#pragma once
// What a call took, on the clock and of all processors.

#include <chrono>
#include <ctime>

namespace facetmill::bench {

struct Clock {
    std::chrono::steady_clock::time_point wall;
    std::clock_t cpu;
    double wall_seconds = 0, cpu_seconds = 0;
    void start() {
        wall = std::chrono::steady_clock::now();
        cpu = std::clock();
    }
    void stop() {
        cpu_seconds = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
        wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
    }
};

} // namespace facetmill::bench
