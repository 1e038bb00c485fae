#include "support/catch.hpp"

#include "parallel/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

using namespace facetmill;

TEST_CASE("items are sorted by their keys, equal ones in their order, however many there are", "[base]") {
    struct Item {
        std::uint64_t key;
        std::size_t number;
        bool operator==(const Item&) const = default;
    };
    for (const std::size_t count : {0, 1, 2, 255, 256, 257, 5000, 70000})
        for (const int bits : {3, 11, 33, 64}) {
            std::vector<Item> items(count);
            std::uint64_t state = 1; // Knuth's MMIX generator; its high bits are the good ones
            for (std::size_t i = 0; i < count; ++i) {
                state = state * 6364136223846793005ULL + 1442695040888963407ULL;
                items[i] = {state >> (64 - bits), i};
            }
            std::vector<Item> expected = items;
            std::stable_sort(expected.begin(), expected.end(),
                             [](const Item& a, const Item& b) { return a.key < b.key; });
            radix_sort(
                items, [](const Item& i) { return i.key; }, bits);
            CHECK(items == expected);
        }
}

TEST_CASE("an error ends its loop, and no loop inside of another chunk", "[base]") {
    constexpr std::size_t chunks = 4, inner = 200;
    for (int attempt = 0; attempt < 20; ++attempt) {
        std::atomic<std::size_t> begun{0}, cut_short{0};
        std::atomic<bool> thrown{false};
        const auto body = [&](std::size_t i) {
            if (begun++ == 0) { // after another chunk has begun, if a thread is free
                for (int wait = 0; wait < 1000 && begun < 2; ++wait) std::this_thread::yield();
                thrown = true;
                throw std::runtime_error(std::to_string(i));
            }
            std::atomic<std::size_t> done{0};
            parallel_for(
                inner,
                [&](std::size_t) {
                    for (int wait = 0; wait < 1000 && !thrown; ++wait) std::this_thread::yield();
                    ++done;
                },
                1);
            cut_short += done != inner;
        };
        CHECK_THROWS_AS(parallel_for(chunks, body, 1), std::runtime_error);
        CHECK(cut_short == 0);
    }
}

TEST_CASE("a loop has as many threads as are wanted, also on fewer cores, and inside of another", "[base]") {
    constexpr std::size_t wanted = 5;
    set_threads(wanted);
    for (const bool nested : {false, true}) {
        std::atomic<std::size_t> together{0};
        const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        const auto meet = [&] {
            ++together;
            while (together < wanted && std::chrono::steady_clock::now() < until) std::this_thread::yield();
        };
        const auto all = [&] {
            parallel_for(
                wanted, [&](std::size_t) { meet(); }, 1);
        };
        if (nested)
            parallel_for(
                2,
                [&](std::size_t outer) {
                    if (outer == 1) all();
                },
                1);
        else
            all();
        CHECK(std::chrono::steady_clock::now() < until);
    }
    set_threads(0);
}
