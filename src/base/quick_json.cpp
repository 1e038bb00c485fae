#include "base/quick_json.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <system_error>
#include <type_traits>
#include <utility>

namespace facetmill {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A reader by recursive descent. Each of its functions is false where it gives up.
///
/// The library makes an object by adding members one by one. Its members have constant keys, so a vector of
/// them that grows copies all that is below them. Here members wait on a stack until their number is known.
class QuickReader {
  public:
    QuickReader(std::string_view text, int deepest, std::span<const std::string_view> unread)
        : at_(text.data()), end_(at_ + text.size()), deepest_(deepest), unread_(unread) {}

    bool document(Json& out) {
        if (!value(out, 0)) return false;
        skip_space();
        return at_ == end_;
    }

  private:
    void skip_space() {
        while (at_ != end_ && (*at_ == ' ' || *at_ == '\n' || *at_ == '\r' || *at_ == '\t')) ++at_;
    }

    /// Whether this character comes next, after space; it is passed over then.
    bool takes(char c) {
        skip_space();
        if (at_ == end_ || *at_ != c) return false;
        ++at_;
        return true;
    }

    bool value(Json& out, int depth) {
        skip_space();
        if (at_ == end_) return false;
        switch (*at_) {
        case '{':
            return depth < deepest_ && object(out, depth + 1);
        case '[':
            return depth < deepest_ && array(out, depth + 1);
        case '"': {
            std::string text;
            if (!string(text)) return false;
            out = std::move(text);
            return true;
        }
        case 't':
            out = true;
            return word("true");
        case 'f':
            out = false;
            return word("false");
        case 'n':
            out = nullptr;
            return word("null");
        default:
            return number(out);
        }
    }

    bool word(std::string_view wanted) {
        if (!std::string_view(at_, static_cast<std::size_t>(end_ - at_)).starts_with(wanted)) return false;
        at_ += wanted.size();
        return true;
    }

    bool object(Json& out, int depth) {
        ++at_;
        const std::size_t first = members_.size();
        if (!takes('}')) {
            do {
                std::string key;
                Json item;
                skip_space();
                if (at_ == end_ || *at_ != '"' || !string(key) || !takes(':') ||
                    !(is_unread(key, depth) ? emptied(item, depth) : value(item, depth)))
                    return false;
                members_.emplace_back(std::move(key), std::move(item));
            } while (takes(','));
            if (!takes('}')) return false;
        }
        constexpr std::size_t some = 8; // documents get further lists: without room, they would be copied
        out = members_from(first, depth == 1 ? some : 0);
        return true;
    }

    bool is_unread(std::string_view key, int depth) const {
        return depth == 1 && std::find(unread_.begin(), unread_.end(), key) != unread_.end();
    }

    /// As value, but that arrays and objects come out empty.
    bool emptied(Json& out, int depth) {
        skip_space();
        if (at_ == end_ || (*at_ != '{' && *at_ != '[')) return value(out, depth);
        out = *at_ == '{' ? Json::object() : Json::array();
        return passes(depth);
    }

    /// Passes over what `value` would read.
    bool passes(int depth) {
        skip_space();
        if (at_ == end_) return false;
        switch (*at_) {
        case '{':
            return depth < deepest_ && passes_items('}', depth + 1);
        case '[':
            return depth < deepest_ && passes_items(']', depth + 1);
        case '"':
            return string(passed_string_);
        default:
            return value(passed_, depth);
        }
    }

    /// The members of an object or the items of an array.
    bool passes_items(char end, int depth) {
        ++at_;
        if (takes(end)) return true;
        do {
            if (end == '}') {
                skip_space();
                if (at_ == end_ || *at_ != '"' || !string(passed_string_) || !takes(':')) return false;
            }
            if (!passes(depth)) return false;
        } while (takes(','));
        return takes(end);
    }

    /// The members from `first` on, which leave the stack. A key that is there again gives its value to the
    /// first of its name, as in the library.
    Json::object_t members_from(std::size_t first, std::size_t more) {
        constexpr std::size_t few = 32; // so many keys are compared one by one; more are kept in order
        const std::size_t count = members_.size() - first;
        Json::object_t all;
        all.reserve(count + more); // names below refers to its keys
        std::map<std::string_view, Json*> names;
        for (std::size_t i = first; i < members_.size(); ++i) {
            std::string& key = members_[i].first;
            Json* there = nullptr;
            if (count <= few) {
                for (auto& member : all)
                    if (member.first == key) there = &member.second;
            } else if (const auto found = names.find(key); found != names.end()) {
                there = found->second;
            }
            if (there) {
                *there = std::move(members_[i].second);
                continue;
            }
            auto& added = all.emplace_back(std::move(key), std::move(members_[i].second));
            if (count > few) names.emplace(added.first, &added.second);
        }
        members_.resize(first);
        return all;
    }

    bool array(Json& out, int depth) {
        ++at_;
        const std::size_t first = items_.size();
        if (!takes(']')) {
            do {
                Json item;
                if (!value(item, depth)) return false;
                items_.push_back(std::move(item));
            } while (takes(','));
            if (!takes(']')) return false;
        }
        const auto begin = items_.begin() + static_cast<std::ptrdiff_t>(first);
        out = Json::array_t(std::make_move_iterator(begin), std::make_move_iterator(items_.end()));
        items_.erase(begin, items_.end());
        return true;
    }

    /// A string with its quotes. What is not plain ASCII, or has escapes, is left to the library.
    bool string(std::string& out) {
        const char* const first = ++at_;
        bool plain = true;
        for (; at_ != end_ && *at_ != '"'; ++at_) {
            plain &= *at_ >= ' ' && *at_ != '\\'; // bytes beyond ASCII are below zero where char has a sign
            plain &= static_cast<unsigned char>(*at_) < 0x80;
            if (*at_ == '\\' && ++at_ == end_) return false;
        }
        if (at_ == end_) return false;
        ++at_;
        if (plain) {
            out.assign(first, at_ - 1);
            return true;
        }
        Json read = Json::parse(first - 1, at_, nullptr, false);
        if (!read.is_string()) return false;
        out = std::move(read.get_ref<std::string&>());
        return true;
    }

    void skip_digits() {
        while (at_ != end_ && is_digit(*at_)) ++at_;
    }

    /// Digits of which there has to be one.
    bool digits() {
        const char* const first = at_;
        skip_digits();
        return at_ != first;
    }

    bool number(Json& out) {
        const char* const first = at_;
        const bool negative = *at_ == '-';
        if (negative) ++at_;
        const char* const leading = at_;
        if (!digits() || (*leading == '0' && at_ - leading > 1)) return false;
        bool whole = true;
        if (at_ != end_ && *at_ == '.') {
            ++at_;
            whole = false;
            if (!digits()) return false;
        }
        if (at_ != end_ && (*at_ == 'e' || *at_ == 'E')) {
            ++at_;
            whole = false;
            if (at_ != end_ && (*at_ == '+' || *at_ == '-')) ++at_;
            if (!digits()) return false;
        }
        // An integer that 64 bits do not hold becomes a real number.
        return (whole && (negative ? of_type<Json::number_integer_t>(first, out)
                                   : of_type<Json::number_unsigned_t>(first, out))) ||
               of_type<Json::number_float_t>(first, out);
    }

    /// The characters from `first` to here as a number of this type.
    template <class T>
    bool of_type(const char* first, Json& out) const {
        T read{};
        const auto [end, error] = std::from_chars(first, at_, read);
        if (error != std::errc{} || end != at_) return false;
        if constexpr (std::is_floating_point_v<T>)
            if (!std::isfinite(read)) return false;
        out = read;
        return true;
    }

    const char* at_;
    const char* const end_;
    const int deepest_;
    const std::span<const std::string_view> unread_;
    std::string passed_string_; // that nobody asks for
    Json passed_;
    std::vector<std::pair<std::string, Json>> members_; // of the objects that are not yet at their end
    std::vector<Json> items_;                           // of such arrays
};

} // namespace

std::optional<Json> quick_json(std::string_view text, int deepest, std::span<const std::string_view> unread) {
    std::optional<Json> read(std::in_place);
    if (!QuickReader(text, deepest, unread).document(*read)) read.reset();
    return read;
}

} // namespace facetmill
