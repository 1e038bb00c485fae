#include "support/catch.hpp"

#include "io/text.hpp"

#include <charconv>
#include <cstdlib>
#include <random>

using namespace facetmill;
using io::scan_integer, io::scan_real, io::take_digits;

namespace {

/// Up to 24 digits, at the end of the memory or before other text.
struct DrawnDigits {
    std::string digits, text;
};
DrawnDigits drawn_digits(std::mt19937& random) {
    DrawnDigits d;
    for (auto n = random() % 25; n > 0; --n) d.digits += static_cast<char>('0' + random() % 10);
    d.text = d.digits;
    if (random() % 2) {
        char next = static_cast<char>(random() % 256);
        if (next >= '0' && next <= '9') next = ':';
        d.text += next;
        d.text.append(random() % 12, static_cast<char>('0' + random() % 10));
    }
    d.text.shrink_to_fit();
    return d;
}

} // namespace

TEST_CASE("Up to eight digits are read at once, whatever follows them", "[text][io]") {
    std::mt19937 random(1);
    for (int i = 0; i < 20000; ++i) {
        const auto [digits, text] = drawn_digits(random);
        const std::string first = digits.substr(0, 8);
        const char* at = text.data();
        std::uint64_t value = 77;
        REQUIRE(take_digits(at, text.data() + text.size(), value) == static_cast<int>(first.size()));
        REQUIRE(at == text.data() + first.size());
        REQUIRE(value == (first.empty() ? 0 : std::strtoull(first.c_str(), nullptr, 10)));
    }
    for (int c = -128; c < 128; ++c) { // each byte at each place
        for (std::size_t place = 0; place < 8; ++place) {
            std::string text = "12345678";
            text[place] = static_cast<char>(c);
            const bool digit = c >= '0' && c <= '9';
            const char* at = text.data();
            std::uint64_t value = 0;
            REQUIRE(take_digits(at, text.data() + 8, value) == (digit ? 8 : static_cast<int>(place)));
        }
    }
}

TEST_CASE("Integers are those of from_chars", "[text][io]") {
    std::mt19937 random(2);
    for (int i = 0; i < 20000; ++i) {
        std::string text = drawn_digits(random).text;
        if (random() % 4 == 0) text.insert(text.begin(), "+-"[random() % 2]);
        const char* const begin = text.data() + (text.starts_with('+') ? 1 : 0);
        std::int64_t wanted = 0, value = 0;
        const auto [stop, error] = std::from_chars(begin, text.data() + text.size(), wanted);
        const char* at = text.data();
        const bool read = scan_integer(at, text.data() + text.size(), value);
        REQUIRE(read == (error == std::errc{}));
        if (!read) continue;
        REQUIRE(value == wanted);
        REQUIRE(at == stop);
    }
}

TEST_CASE("Reals are the nearest doubles, as from_chars has them", "[text][io]") {
    std::mt19937 random(3);
    for (int i = 0; i < 20000; ++i) {
        std::string text = random() % 3 ? "" : "-";
        for (auto n = random() % 12 + 1; n > 0; --n) text += static_cast<char>('0' + random() % 10);
        if (random() % 4) text += '.';
        if (text.back() == '.')
            for (auto n = random() % 22; n > 0; --n) text += static_cast<char>('0' + random() % 10);
        if (random() % 4 == 0) text += "e" + std::to_string(static_cast<int>(random() % 60) - 30);
        if (random() % 2) text += " 123456789";
        double wanted = 0, value = 0;
        const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), wanted);
        REQUIRE(error == std::errc{});
        const char* at = text.data();
        REQUIRE(scan_real(at, text.data() + text.size(), value));
        REQUIRE(value == wanted);
        REQUIRE(at == stop);
    }
}

TEST_CASE("lines are counted beyond what 32 bits hold", "[text][io]") {
    const std::string name = "long.obj";
    io::Text text("\nx\n", name, "E-OBJ", '#', INT32_MAX);
    text.word();
    try {
        text.fail("no");
    } catch (const Error& error) {
        CHECK(error.diagnostics().front().message == "no, in line 2147483648");
        CHECK(to_string(error.diagnostics().front().where) == "long.obj");
    }
    CHECK(text.line() == std::int64_t{INT32_MAX} + 1);
}
