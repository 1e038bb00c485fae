#include "options/value.hpp"

#include "base/math/numbers.hpp"

#include <charconv>
#include <fmt/format.h>
#include <utility>

namespace facetmill {

Value Value::scalar(std::string text, Mark mark, bool quoted) {
    Value v;
    v.kind = Kind::scalar;
    v.text = std::move(text);
    v.quoted = quoted;
    v.mark = std::move(mark);
    return v;
}

Value Value::list(std::vector<Value> items, Mark mark) {
    Value v;
    v.kind = Kind::list;
    v.items = std::move(items);
    v.mark = std::move(mark);
    return v;
}

Value Value::map(std::vector<Entry> entries, Mark mark) {
    Value v;
    v.kind = Kind::map;
    v.entries = std::move(entries);
    v.mark = std::move(mark);
    return v;
}

const Value::Entry* Value::find_entry(std::string_view key) const {
    for (const auto& e : entries)
        if (e.key == key) return &e;
    return nullptr;
}

const Value* Value::find(std::string_view key) const {
    const Entry* e = find_entry(key);
    return e ? &e->value : nullptr;
}

Value* Value::find(std::string_view key) { return const_cast<Value*>(std::as_const(*this).find(key)); }

Value& Value::set(std::string key, Value value, Mark key_mark) {
    if (kind == Kind::null) kind = Kind::map;
    if (Value* old = find(key)) return *old = std::move(value);
    entries.push_back({std::move(key), std::move(key_mark), std::move(value)});
    return entries.back().value;
}

std::optional<bool> Value::as_bool() const {
    if (!is_scalar() || quoted) return {};
    if (text == "true" || text == "True" || text == "TRUE") return true;
    if (text == "false" || text == "False" || text == "FALSE") return false;
    return {};
}

std::optional<std::int64_t> Value::as_integer() const {
    if (!is_scalar() || quoted) return {};
    const int base = text.starts_with("0x") ? 16 : text.starts_with("0o") ? 8 : 10;
    if (base == 10) return parse_integer(text);
    std::int64_t value = 0;
    const char* end = text.data() + text.size();
    const auto result = std::from_chars(text.data() + 2, end, value, base);
    if (result.ec != std::errc{} || result.ptr != end || text.size() == 2) return {};
    return value;
}

std::optional<double> Value::as_real() const {
    if (!is_scalar() || quoted) return {};
    if (const auto integer = as_integer()) return static_cast<double>(*integer);
    return parse_real(text);
}

namespace {

/// The beginning of a text on a single line, short enough for a message.
std::string shortened(const std::string& text) {
    constexpr std::size_t longest = 60;
    std::string out;
    for (const char c : text) {
        const bool continues = (static_cast<unsigned char>(c) & 0xC0) == 0x80; // inside a UTF-8 character
        if (out.size() >= longest && !continues) return out + "...";
        if (c == '\n')
            out += "\\n";
        else if (static_cast<unsigned char>(c) < 0x20)
            out += '?';
        else
            out += c;
    }
    return out;
}

} // namespace

std::string Value::described() const {
    switch (kind) {
    case Kind::null:
        return "nothing";
    case Kind::list:
        return fmt::format("a list of {}", items.size());
    case Kind::map:
        return "a map";
    case Kind::scalar:
        break;
    }
    return quoted ? fmt::format("the text \"{}\"", shortened(text)) : fmt::format("'{}'", shortened(text));
}

bool same_content(const Value& a, const Value& b) {
    if (a.kind != b.kind || a.text != b.text || a.items.size() != b.items.size() ||
        a.entries.size() != b.entries.size())
        return false;
    for (std::size_t i = 0; i < a.items.size(); ++i)
        if (!same_content(a.items[i], b.items[i])) return false;
    for (std::size_t i = 0; i < a.entries.size(); ++i)
        if (a.entries[i].key != b.entries[i].key || !same_content(a.entries[i].value, b.entries[i].value))
            return false;
    return true;
}

} // namespace facetmill
