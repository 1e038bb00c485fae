#pragma once
// Reading text mesh files: words, numbers, and line numbers for messages. Fast, and independent of the
// locale.

#include "io/bytes.hpp"

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace facetmill::io {

/// Throws a malformed-input error with the file and line (0: the file as a whole).
[[noreturn]] void malformed(const std::string& name, std::int64_t line, const char* id, std::string message,
                            std::string hint = {});
/// Throws a limit error with the file.
[[noreturn]] void beyond_limit(const std::string& name, std::string message);

/// Reads a number at `at` and moves past it; false, without moving, if there is no number. Numbers are
/// decimal with optional sign, point and exponent, and are correctly rounded. nan and inf are accepted. Does
/// not check the following character.
bool scan_real(const char*& at, const char* end, double& value);
/// Reads up to eight digits at `at`, moves past them, and returns their count.
[[nodiscard]] inline int take_digits(const char*& at, const char* end, std::uint64_t& value) {
    constexpr std::uint64_t ones = 0x0101010101010101;
    if (std::endian::native != std::endian::little || end - at < 8) {
        int many = 0;
        for (value = 0; many < 8 && at < end && *at >= '0' && *at <= '9'; ++at, ++many)
            value = value * 10 + static_cast<std::uint64_t>(*at - '0');
        return many;
    }
    std::uint64_t bytes;
    std::memcpy(&bytes, at, 8);
    bytes ^= ones * '0'; // digits become their values; adding 0x76 keeps these below 0x80, but no other byte
    const std::uint64_t others = ((bytes + ones * 0x76) | bytes) & (ones * 0x80);
    const int many = std::countr_zero(others) / 8;
    if (many == 0) {
        value = 0;
        return 0;
    }
    bytes <<= 64 - 8 * many; // zeros before the first digit, which is the lowest byte
    bytes = (bytes * 10 + (bytes >> 8)) & 0x00ff00ff00ff00ff; // joins pairs of digits
    bytes = (bytes * 100 + (bytes >> 16)) & 0x0000ffff0000ffff;
    value = (bytes * 10000 + (bytes >> 32)) & 0xffffffff;
    at += many;
    return many;
}
/// Reads an integer, with or without a sign.
bool scan_signed_integer(const char*& at, const char* end, std::int64_t& value);
inline bool scan_integer(const char*& at, const char* end, std::int64_t& value) {
    const char* p = at;
    std::uint64_t digits = 0;
    const int many = take_digits(p, end, digits);
    if (many == 0 || many == 8) return scan_signed_integer(at, end, value);
    at = p;
    value = static_cast<std::int64_t>(digits);
    return true;
}

/// A text file, read word by word. Lines end in LF, CR LF or CR.
class Text {
  public:
    /// id: the error id, for example "E-PLY". comment: the character that starts a comment, or 0. line: the
    /// number of the first line.
    Text(std::string_view text, const std::string& name, const char* id, char comment = 0,
         std::int64_t line = 1)
        : begin_(text.data()), at_(text.data()), end_(text.data() + text.size()), name_(&name), id_(id),
          comment_(comment), line_(line) {}

    bool at_end() {
        skip_space();
        return at_ == end_;
    }
    /// Whether the rest of this line is blank.
    bool at_line_end() {
        skip_blanks();
        return at_ == end_ || is_line_end(*at_);
    }
    /// Moves to the next line and drops the rest of this line; false at the end of the text.
    bool next_line();
    /// The next word, on this or a later line; empty at the end.
    std::string_view word() {
        skip_space();
        return take_word();
    }
    /// The next word on this line; empty at its end.
    std::string_view word_on_line() {
        skip_blanks();
        return take_word();
    }
    /// The rest of this line without blanks at both ends.
    std::string_view rest_of_line();

    /// The next number, on this or a later line; `what` names it in the message.
    double real(const char* what);
    /// A finite number; throws E-NAN otherwise.
    double coordinate(const char* what);
    std::int64_t integer(const char* what);

    /// Reads a part of a word in place: an integer, or a single character; false if it is not next.
    bool take(std::int64_t& value) { return scan_integer(at_, end_, value); }
    /// A number from 1 to 9999999 that is a whole word; false, without moving, if it is not next.
    bool take_natural(std::int32_t& value) {
        const char* p = at_;
        std::uint64_t digits = 0;
        if (take_digits(p, end_, digits) == 8 || digits == 0 || p == end_ ||
            (*p != ' ' && *p != '\n' && *p != '\r'))
            return false;
        at_ = p;
        value = static_cast<std::int32_t>(digits);
        return true;
    }
    bool take(char c) {
        const bool there = at_ < end_ && *at_ == c;
        if (there) ++at_;
        return there;
    }
    bool at_word_end() const { return ends_word(); }

    std::int64_t line() const { return line_; }
    std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }
    std::size_t offset() const { return static_cast<std::size_t>(at_ - begin_); }
    const std::string& name() const { return *name_; }
    [[noreturn]] void fail(std::string message, std::string hint = {}) const {
        malformed(*name_, line_, id_, std::move(message), std::move(hint));
    }
    [[noreturn]] void expected(const char* what);

  private:
    static bool is_line_end(char c) { return c == '\n' || c == '\r'; }
    static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
    /// True only for characters of words. Also false for some of these, so false needs a closer look.
    bool is_in_word(char c) const { return c > ' ' && c != '\\' && c != comment_; }
    void skip_blanks() {
        if (at_ < end_ && *at_ == ' ') ++at_;
        if (at_ == end_ || !is_in_word(*at_)) skip_other_blanks();
    }
    void skip_other_blanks();
    void skip_space();
    void pass_line_end();
    std::string_view take_word();
    bool ends_word() const {
        if (at_ < end_ && is_in_word(*at_)) return false;
        if (at_ == end_ || is_blank(*at_) || is_line_end(*at_) || (comment_ && *at_ == comment_)) return true;
        return *at_ == '\\' && at_ + 1 < end_ && is_line_end(at_[1]);
    }

    const char* begin_;
    const char* at_;
    const char* end_;
    const std::string* name_;
    const char* id_;
    char comment_;
    std::int64_t line_;
};

/// A word for a message: in quotes, shortened if long, with control characters as dots.
[[nodiscard]] std::string in_quotes(std::string_view word);

} // namespace facetmill::io
