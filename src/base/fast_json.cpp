#include "base/fast_json.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <deque>
#include <map>
#include <system_error>
#include <type_traits>
#include <utility>

namespace facetmill {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A reader by recursive descent. Each function returns false if it fails. The library builds an object
/// member by member. Its members have constant keys, so a growing vector copies everything below them. Here
/// members wait in a list until their number is known. Each level has a single list, because a level reads
/// only one object or array at a time.
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
    /// The members or items read so far of an unfinished object or array.
    struct Level {
        std::vector<std::pair<std::string, Json>> members;
        std::vector<Json> items;
    };

    Level& level_at(int depth) {
        const auto number = static_cast<std::size_t>(depth);
        while (levels_.size() <= number) levels_.emplace_back();
        return levels_[number];
    }

    void skip_space() {
        while (at_ != end_ && (*at_ == ' ' || *at_ == '\n' || *at_ == '\r' || *at_ == '\t')) ++at_;
    }

    /// True if this character comes next, after white space; skips it.
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
        Level& level = level_at(depth);
        level.members.clear();
        if (!takes('}')) {
            do {
                auto& [key, item] = level.members.emplace_back();
                skip_space();
                if (at_ == end_ || *at_ != '"' || !string(key) || !takes(':') ||
                    !(is_unread(key, depth) ? emptied(item, depth) : value(item, depth)))
                    return false;
            } while (takes(','));
            if (!takes('}')) return false;
        }
        constexpr std::size_t some = 8; // documents get further lists: without room, they would be copied
        out = Json::object();
        gather(level.members, depth == 1 ? some : 0, out.get_ref<Json::object_t&>());
        return true;
    }

    bool is_unread(std::string_view key, int depth) const {
        return depth == 1 && std::find(unread_.begin(), unread_.end(), key) != unread_.end();
    }

    /// Like value, but returns arrays and objects empty.
    bool emptied(Json& out, int depth) {
        skip_space();
        if (at_ == end_ || (*at_ != '{' && *at_ != '[')) return value(out, depth);
        out = *at_ == '{' ? Json::object() : Json::array();
        return passes(depth);
    }

    /// Skips a value.
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

    /// Moves members to an object. A repeated key overwrites the value of its first occurrence, as in the
    /// library.
    static void gather(std::vector<std::pair<std::string, Json>>& members, std::size_t more,
                       Json::object_t& all) {
        constexpr std::size_t few = 32; // up to this many keys are compared linearly; more are kept in order
        const std::size_t count = members.size();
        all.reserve(count + more); // names below refers to its keys
        std::map<std::string_view, Json*> names;
        for (auto& [key, item] : members) {
            Json* there = nullptr;
            if (count <= few) {
                for (auto& member : all)
                    if (member.first == key) there = &member.second;
            } else if (const auto found = names.find(key); found != names.end()) {
                there = found->second;
            }
            if (there) {
                *there = std::move(item);
                continue;
            }
            auto& added = all.emplace_back(std::move(key), std::move(item));
            if (count > few) names.emplace(added.first, &added.second);
        }
    }

    bool array(Json& out, int depth) {
        ++at_;
        std::vector<Json>& items = level_at(depth).items;
        items.clear();
        if (!takes(']')) {
            do {
                if (!value(items.emplace_back(), depth)) return false;
            } while (takes(','));
            if (!takes(']')) return false;
        }
        out = Json::array();
        out.get_ref<Json::array_t&>().assign(std::make_move_iterator(items.begin()),
                                             std::make_move_iterator(items.end()));
        return true;
    }

    /// A string with its quotes. Strings with escapes or non-ASCII characters are left to the library.
    bool string(std::string& out) {
        const char* const first = ++at_;
        bool plain = true;
        for (; at_ != end_ && *at_ != '"'; ++at_) {
            plain &= *at_ >= ' ' && *at_ != '\\'; // bytes beyond ASCII are negative if char is signed
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

    /// Reads at least one digit.
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
        // An integer beyond 64 bits becomes a real number.
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
    std::string passed_string_; // skipped strings
    Json passed_;
    std::deque<Level> levels_; // addresses stay valid when the deque grows
};

/// True if a string needs no escapes: ASCII without special characters.
bool is_plain(const std::string& text) {
    return std::all_of(text.begin(), text.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte >= 0x20 && byte < 0x80 && byte != '"' && byte != '\\';
    });
}

void write_string(std::string& out, const std::string& text) {
    if (is_plain(text)) {
        out += '"';
        out += text;
        out += '"';
    } else {
        out += Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
    }
}

template <class T>
void write_integer(std::string& out, T value) {
    std::array<char, 24> digits;
    out.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
}

/// Real numbers in the library's format, by its own function.
void write_real(std::string& out, double value) {
    if (!std::isfinite(value)) {
        out += "null";
        return;
    }
    std::array<char, 64> digits;
    out.append(digits.data(),
               nlohmann::detail::to_chars(digits.data(), digits.data() + digits.size(), value));
}

void write_value(std::string& out, const Json& json) {
    char before = 0;
    switch (json.type()) {
    case Json::value_t::object:
        out += '{';
        for (const auto& [key, item] : json.get_ref<const Json::object_t&>()) {
            if (before) out += before;
            before = ',';
            write_string(out, key);
            out += ':';
            write_value(out, item);
        }
        out += '}';
        return;
    case Json::value_t::array:
        out += '[';
        for (const Json& item : json.get_ref<const Json::array_t&>()) {
            if (before) out += before;
            before = ',';
            write_value(out, item);
        }
        out += ']';
        return;
    case Json::value_t::string:
        return write_string(out, json.get_ref<const std::string&>());
    case Json::value_t::number_unsigned:
        return write_integer(out, json.get_ref<const Json::number_unsigned_t&>());
    case Json::value_t::number_integer:
        return write_integer(out, json.get_ref<const Json::number_integer_t&>());
    case Json::value_t::number_float:
        return write_real(out, json.get_ref<const Json::number_float_t&>());
    case Json::value_t::boolean:
        out += json.get_ref<const Json::boolean_t&>() ? "true" : "false";
        return;
    default: // null, and values without a text form
        out += json.dump(-1, ' ', false, Json::error_handler_t::replace);
    }
}

} // namespace

std::string fast_text(const Json& json) {
    std::string text;
    write_value(text, json);
    return text;
}

void destroy(Json& json) {
    if (json.is_array()) {
        auto& items = json.get_ref<Json::array_t&>();
        for (Json& item : items)
            if (item.is_structured()) destroy(item);
        items.clear();
    } else if (json.is_object()) {
        auto& members = json.get_ref<Json::object_t&>();
        for (auto& member : members)
            if (member.second.is_structured()) destroy(member.second);
        members.clear();
    }
    json = nullptr;
}

std::optional<Json> fast_json(std::string_view text, int deepest, std::span<const std::string_view> unread) {
    std::optional<Json> read(std::in_place);
    if (!QuickReader(text, deepest, unread).document(*read)) read.reset();
    return read;
}

} // namespace facetmill
