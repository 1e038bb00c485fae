#include "io/text.hpp"

#include "io/not_finite.hpp"

#include <algorithm>
#include <charconv>
#include <climits>
#include <cmath>
#include <fmt/format.h>

namespace facetmill::io {

void malformed(const std::string& name, std::int64_t line, const char* id, std::string message,
               std::string hint) {
    if (line > INT_MAX) { // more lines than a mark can hold
        message += fmt::format(", in line {}", line);
        line = 0;
    }
    throw Error(ErrorKind::malformed, id, std::move(message), std::move(hint),
                line > 0 ? line_mark(name, static_cast<int>(line)) : file_mark(name));
}

void beyond_limit(const std::string& name, std::string message) {
    throw Error(ErrorKind::limit, "E-SIZE", std::move(message), {}, file_mark(name));
}

namespace {

constexpr double powers_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

constexpr std::uint64_t integer_powers_of_ten[] = {1,      10,      100,      1000,     10000,
                                                   100000, 1000000, 10000000, 100000000};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Handles the cases that the fast path does not: many digits, large exponents, nan, inf, and "3.1+e2".
bool scan_real_slowly(const char*& at, const char* end, double& value) {
    const char* p = at;
    if (p < end && *p == '+') ++p;
    auto [stop, error] = std::from_chars(p, end, value);
    if (error == std::errc::invalid_argument) return false;
    if (error == std::errc::result_out_of_range) {
        // Underflow gives zero, as in other readers; overflow gives infinity, which positions refuse.
        const std::string_view text(p, static_cast<std::size_t>(stop - p));
        const auto e = text.find_first_of("eE");
        const bool tiny = e == std::string_view::npos
                              ? text.find('.') < 300
                              : text.substr(e).starts_with("e-") || text.substr(e).starts_with("E-");
        value = tiny ? 0.0 : (*p == '-' ? -HUGE_VAL : HUGE_VAL);
    }
    // Some writers put the exponent's sign before its letter: 3.1+e2 means 3.1e+2.
    if (end - stop > 2 && (*stop == '+' || *stop == '-') && (stop[1] == 'e' || stop[1] == 'E') &&
        is_digit(stop[2])) {
        std::string standard(p, static_cast<std::size_t>(stop - p));
        standard += {'e', *stop};
        if (standard[standard.size() - 1] == '+') standard.pop_back();
        const char* q = stop + 2;
        while (q < end && is_digit(*q)) standard += *q++;
        if (std::from_chars(standard.data(), standard.data() + standard.size(), value).ec != std::errc{})
            return false;
        stop = q;
    }
    at = stop;
    return true;
}

} // namespace

bool scan_real(const char*& at, const char* end, double& value) {
    // The fast path: up to 19 digits with a value below 2^53, and a power of ten that is exact in a double.
    // A single multiplication or division then rounds once, so the result is the nearest double.
    const char* p = at;
    const bool minus = p < end && *p == '-';
    if (p < end && (*p == '-' || *p == '+')) ++p;
    std::uint64_t digits = 0;
    int count = 0, exponent = 0;
    const auto take = [&] {
        int many = 8;
        for (std::uint64_t eight = 0; many == 8; count += many) {
            many = take_digits(p, end, eight);
            digits = digits * integer_powers_of_ten[many] + eight;
        }
    };
    take();
    if (p < end && *p == '.') {
        const char* const point = ++p;
        take();
        exponent = static_cast<int>(point - p);
    }
    if (count == 0 || count > 19 || digits >= (std::uint64_t{1} << 53))
        return scan_real_slowly(at, end, value);
    if (p < end && (*p == 'e' || *p == 'E')) {
        const char* q = p + 1;
        const bool down = q < end && *q == '-';
        if (q < end && (*q == '-' || *q == '+')) ++q;
        int power = 0;
        const char* const first = q;
        for (; q < end && is_digit(*q) && q - first < 5; ++q) power = power * 10 + (*q - '0');
        if (q > first) {
            exponent += down ? -power : power;
            p = q;
        }
    }
    const bool more = p < end && (is_digit(*p) || *p == '+' || *p == '-');
    if (more || exponent < -22 || exponent > 22) return scan_real_slowly(at, end, value);
    const double whole = static_cast<double>(digits);
    const double size = exponent < 0 ? whole / powers_of_ten[-exponent] : whole * powers_of_ten[exponent];
    value = minus ? -size : size;
    at = p;
    return true;
}

bool scan_signed_integer(const char*& at, const char* end, std::int64_t& value) {
    const char* p = at;
    if (p < end && *p == '+') ++p;
    const auto [stop, error] = std::from_chars(p, end, value);
    if (error != std::errc{}) return false;
    at = stop;
    return true;
}

void Text::pass_line_end() {
    if (*at_ == '\r' && at_ + 1 < end_ && at_[1] == '\n') ++at_;
    ++at_;
    ++line_;
}

void Text::skip_other_blanks() {
    while (at_ < end_) {
        if (is_blank(*at_)) {
            ++at_;
        } else if (*at_ == '\\' && at_ + 1 < end_ && is_line_end(at_[1])) {
            ++at_; // a continued line
            pass_line_end();
        } else if (comment_ && *at_ == comment_) {
            while (at_ < end_ && !is_line_end(*at_)) ++at_;
        } else {
            break;
        }
    }
}

void Text::skip_space() {
    for (skip_blanks(); at_ < end_ && is_line_end(*at_); skip_blanks()) pass_line_end();
}

bool Text::next_line() {
    while (at_ < end_ && !is_line_end(*at_)) ++at_;
    if (at_ < end_) pass_line_end();
    return at_ < end_;
}

std::string_view Text::take_word() {
    const char* const first = at_;
    while (!ends_word()) ++at_;
    return {first, static_cast<std::size_t>(at_ - first)};
}

std::string_view Text::rest_of_line() {
    skip_blanks();
    const char* const first = at_;
    while (at_ < end_ && !is_line_end(*at_)) ++at_;
    const char* last = at_;
    while (last > first && is_blank(last[-1])) --last;
    return {first, static_cast<std::size_t>(last - first)};
}

double Text::real(const char* what) {
    skip_space();
    double value = 0;
    const char* const first = at_;
    if (!scan_real(at_, end_, value) || !ends_word()) {
        at_ = first;
        expected(what);
    }
    return value;
}

double Text::coordinate(const char* what) {
    const double value = real(what);
    if (!std::isfinite(value))
        malformed(*name_, line_, "E-NAN",
                  fmt::format("expected {} as a finite number, found {}", what, value), drop_not_finite_hint);
    return value;
}

std::int64_t Text::integer(const char* what) {
    skip_space();
    std::int64_t value = 0;
    const char* const first = at_;
    if (!scan_integer(at_, end_, value) || !ends_word()) {
        at_ = first;
        expected(what);
    }
    return value;
}

void Text::expected(const char* what) {
    const std::int64_t line = line_;
    const std::string_view found = word();
    if (!found.empty()) fail(fmt::format("expected {}, found {}", what, in_quotes(found)));
    line_ = line;
    fail(fmt::format("expected {}, found the end of the file", what));
}

std::string in_quotes(std::string_view word) {
    constexpr std::size_t longest = 40;
    std::string text = "'";
    for (const char c : word.substr(0, longest))
        text += static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f ? '.' : c;
    text += word.size() > longest ? "...'" : "'";
    return text;
}

} // namespace facetmill::io
