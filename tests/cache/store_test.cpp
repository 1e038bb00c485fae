#include "support/catch.hpp"

#include "base/hash.hpp"
#include "cache/store.hpp"
#include "support/temporary.hpp"

#include <fmt/format.h>
#include <thread>

using namespace facetmill;
using cache::Kind;
using cache::Store;

namespace {

/// A store in its own folder, and its messages.
struct Shop {
    test::TemporaryDirectory folder;
    std::vector<std::string> told;

    cache::StoreSettings settings(std::uint64_t max_bytes = 1 << 20, std::string_view name = "cache") {
        cache::StoreSettings settings;
        settings.folder = folder / name;
        settings.max_bytes = max_bytes;
        settings.tell = [this](const Diagnostic& d) { told.push_back(d.id); };
        return settings;
    }
    std::filesystem::path file(const std::string& key, const char* suffix = ".scene") {
        return folder / "cache" / key.substr(0, 2) / (key + suffix);
    }
};

std::string key(int number) { return sha256(test::bytes_of(std::to_string(number))); }

std::string text_of(const std::optional<io::Bytes>& bytes) {
    return bytes ? std::string(io::as_text(*bytes)) : "nothing";
}

} // namespace

TEST_CASE("a store gives what was put, to other stores, too", "[cache]") {
    Shop shop;
    Store store(shop.settings());
    CHECK(text_of(store.get(key(1), Kind::scene)) == "nothing");
    CHECK(store.put(key(1), Kind::scene, test::bytes_of("a scene")));
    CHECK(store.put(key(1), Kind::memory, test::bytes_of("")));
    CHECK(text_of(store.get(key(1), Kind::scene)) == "a scene");
    CHECK(text_of(Store(shop.settings()).get(key(1), Kind::memory)).empty());
    CHECK(store.has(key(1), Kind::scene));
    CHECK_FALSE(store.has(key(2), Kind::scene));
    CHECK(store.contents().entries == 2);
    CHECK(store.contents().scenes == 1);
    CHECK(store.clear().entries == 2);
    CHECK(store.contents().bytes == 0);
    CHECK(shop.told.empty());
}

TEST_CASE("an entry with any bit of it changed, or cut anywhere, is found out and removed", "[cache]") {
    Shop shop;
    Store store(shop.settings());
    store.put(key(1), Kind::scene, test::bytes_of("a scene"));
    const std::string whole = test::get(shop.file(key(1)));
    for (std::size_t i = 0; i < whole.size(); ++i) {
        for (int bit = 0; bit < 8; ++bit) {
            std::string changed = whole;
            changed[i] = static_cast<char>(changed[i] ^ (1 << bit));
            test::put(shop.file(key(1)), changed);
            CHECK(text_of(store.get(key(1), Kind::scene)) == "nothing");
            CHECK_FALSE(std::filesystem::exists(shop.file(key(1))));
        }
        test::put(shop.file(key(1)), whole.substr(0, i));
        CHECK(text_of(store.get(key(1), Kind::scene)) == "nothing");
    }
    CHECK(shop.told.size() == 9 * whole.size());
    CHECK(shop.told.front() == "W-CACHE");
    test::put(shop.file(key(1)), whole + "x");
    CHECK(text_of(store.get(key(1), Kind::scene)) == "nothing");
    store.put(key(2), Kind::scene, test::bytes_of("another"));
    std::filesystem::create_directories(shop.file(key(1)).parent_path());
    std::filesystem::copy_file(shop.file(key(2)), shop.file(key(1)));
    CHECK(text_of(store.get(key(1), Kind::scene)) == "nothing");
    CHECK(text_of(store.get(key(2), Kind::scene)) == "another");
}

TEST_CASE("a store that is full loses what was not used for longest, but nothing that this run used",
          "[cache]") {
    Shop shop;
    constexpr std::uint64_t limit = 100'000;
    const std::string bytes(9'000, 'x');
    const auto age = [&](int number, int minutes) {
        std::filesystem::last_write_time(shop.file(key(number)),
                                         std::filesystem::file_time_type::clock::now() -
                                             std::chrono::minutes(minutes));
    };
    {
        Store store(shop.settings(limit));
        for (int i = 0; i < 10; ++i) CHECK(store.put(key(i), Kind::scene, test::bytes_of(bytes)));
        CHECK_FALSE(store.put(key(10), Kind::scene, test::bytes_of(bytes + bytes)));
        CHECK_FALSE(store.put(key(11), Kind::scene, std::vector<std::byte>(limit)));
    }
    for (int i = 0; i < 10; ++i) age(i, 100 - i);
    age(0, 1);
    Store store(shop.settings(limit));
    CHECK(store.has(key(1), Kind::scene));
    for (int i = 20; i < 23; ++i) CHECK(store.put(key(i), Kind::scene, test::bytes_of(bytes)));
    CHECK(store.contents().bytes <= limit);
    for (const int there : {0, 1, 20, 21, 22}) CHECK(std::filesystem::exists(shop.file(key(there))));
    for (const int gone : {2, 3}) CHECK_FALSE(std::filesystem::exists(shop.file(key(gone))));
    Store small(shop.settings(1));
    CHECK(small.collect().entries > 0);
    CHECK(small.contents().entries == 0);
    CHECK(shop.told.empty());
}

TEST_CASE("what one of several runs has used may go when it is over", "[cache]") {
    Shop shop;
    constexpr std::uint64_t limit = 100'000;
    const std::string bytes(9'000, 'x');
    Store store(shop.settings(limit));
    {
        Store first(store), second(store);
        for (int i = 0; i < 9; ++i) CHECK(first.put(key(i), Kind::scene, test::bytes_of(bytes)));
        CHECK(second.has(key(0), Kind::scene));
        CHECK(second.put(key(9), Kind::scene, test::bytes_of(bytes)));
        CHECK_FALSE(second.put(key(10), Kind::scene, test::bytes_of(bytes + bytes)));
    }
    for (int i = 1; i < 10; ++i) {
        const auto path = shop.file(key(i));
        std::filesystem::last_write_time(path, std::filesystem::last_write_time(path) -
                                                   std::chrono::minutes(99 - i));
    }
    Store third(store);
    CHECK(third.has(key(0), Kind::scene));
    CHECK(third.put(key(10), Kind::scene, test::bytes_of(bytes + bytes)));
    CHECK(third.has(key(0), Kind::scene));
    CHECK_FALSE(third.has(key(1), Kind::scene));
}

TEST_CASE("stores of one process say once that they cannot be written", "[cache]") {
    Shop shop;
    test::put(shop.folder / "file", "");
    Store store(shop.settings(1 << 20, "file/cache"));
    for (int i = 0; i < 3; ++i) CHECK_FALSE(Store(store).put(key(i), Kind::scene, test::bytes_of("a")));
    CHECK(shop.told == std::vector<std::string>{"W-CACHE"});
}

TEST_CASE("a store that cannot be written says so once", "[cache]") {
    Shop shop;
    test::put(shop.folder / "file", "");
    Store store(shop.settings(1 << 20, "file/cache"));
    CHECK_FALSE(store.put(key(1), Kind::scene, test::bytes_of("a")));
    CHECK_FALSE(store.put(key(2), Kind::scene, test::bytes_of("b")));
    CHECK_FALSE(store.is_usable());
    CHECK(text_of(store.get(key(1), Kind::scene)) == "nothing");
    CHECK(shop.told == std::vector<std::string>{"W-CACHE"});
}

TEST_CASE("threads and stores share a folder", "[cache]") {
    Shop shop;
    Store shared(shop.settings());
    std::vector<std::thread> threads;
    std::atomic<int> wrong{0};
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&, t] {
            Store own(shop.settings());
            Store& store = t % 2 == 0 ? shared : own;
            for (int i = 0; i < 50; ++i) {
                const std::string text = fmt::format("scene {}", i);
                store.put(key(i), Kind::scene, test::bytes_of(text));
                wrong += text_of(store.get(key(i), Kind::scene)) != text;
            }
        });
    for (auto& thread : threads) thread.join();
    CHECK(wrong == 0);
    CHECK(shared.contents().entries == 50);
}

TEST_CASE("a store takes no more than its share of a disk", "[cache]") {
    Shop shop;
    auto settings = shop.settings(std::uint64_t{1} << 62);
    settings.max_share = 0.1;
    Store store(settings);
    const auto space = std::filesystem::space(shop.folder.path()).available;
    CHECK(store.limit(0) < settings.max_bytes);
    CHECK(static_cast<double>(store.limit(0)) < 0.11 * static_cast<double>(space));
    CHECK(store.limit(std::uint64_t{1} << 40) > store.limit(0));
    CHECK(store.put(key(1), Kind::scene, test::bytes_of("a scene")));
    settings.max_share = 1e-12;
    Store poor(settings);
    CHECK_FALSE(poor.put(key(2), Kind::scene, test::bytes_of("another")));
    CHECK(poor.collect().entries == 1);
    CHECK(shop.told.empty());
}

TEST_CASE("the first put of a store takes as long as counting what is there", "[cache]") {
    Shop shop;
    Store(shop.settings()).put(key(1), Kind::scene, test::bytes_of("a scene"));
    Store store(shop.settings());
    CHECK(store.seconds_to_begin() == 0);
    std::filesystem::create_directories(shop.folder / "cache/7f");
    for (int i = 0; i < 10; ++i) test::put(shop.folder / "cache/7f" / std::to_string(i), "");
    Store large(shop.settings());
    CHECK(large.seconds_to_begin() > 0.001);
    CHECK(large.put(key(2), Kind::last_run, test::bytes_of("a run"))); // whether it counts is left to chance
    CHECK(large.put(key(3), Kind::scene, test::bytes_of("another")));
    CHECK(large.seconds_to_begin() == 0);
    CHECK(large.contents().entries == 3);
}
