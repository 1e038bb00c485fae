#include "base/text/words.hpp"
#include "pipeline/document.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::pipeline {

namespace {

constexpr std::size_t widest_flow = 90;

bool is_word(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }

/// True if the text needs no quotes anywhere, and reads back as the same plain scalar.
bool plain(const std::string& text) {
    for (const char* null_word : {"", "~", "null", "Null", "NULL"})
        if (text == null_word) return false;
    const char first = text.front(), second = text.size() > 1 ? text[1] : ' ';
    if (!(is_word(first) || first == '/' ||
          ((first == '.' || first == '-' || first == '+') &&
           (is_word(second) || second == '.' || second == '/'))))
        return false;
    if (text.starts_with("...") || text.back() == ' ') return false;
    for (std::size_t i = 0; i < text.size(); ++i)
        if (!is_word(text[i]) && std::string_view("._/%+-@=^~ ").find(text[i]) == std::string_view::npos)
            return false;
    return true;
}

std::string in_quotes(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            out += {'\\', c};
        else if (c == '\n')
            out += "\\n";
        else if (c == '\t')
            out += "\\t";
        else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
            out += fmt::format("\\x{:02x}", static_cast<unsigned>(c));
        else
            out += c;
    }
    out += '"';
    return out;
}

std::string scalar(const std::string& text, bool quoted) {
    return quoted || !plain(text) ? in_quotes(text) : text;
}

/// The value in braces, on a single line.
std::string flow(const Value& value) {
    std::string out;
    switch (value.kind) {
    case Value::Kind::null:
        return "null";
    case Value::Kind::scalar:
        return scalar(value.text, value.quoted);
    case Value::Kind::list:
        for (const auto& item : value.items) append_item(out, flow(item));
        return fmt::format("[{}]", out);
    case Value::Kind::map:
        for (const auto& e : value.entries) append_item(out, scalar(e.key, false) + ": " + flow(e.value));
        return fmt::format("{{{}}}", out);
    }
    return out;
}

bool holds_list_of_maps(const Value& value) {
    for (const auto& item : value.items)
        if (item.is_map() || holds_list_of_maps(item)) return true;
    for (const auto& entry : value.entries)
        if (holds_list_of_maps(entry.value)) return true;
    return false;
}

bool holds_map(const Value& value) {
    return std::any_of(value.entries.begin(), value.entries.end(),
                       [](const auto& e) { return e.value.is_map(); });
}

bool is_small(const Value& value) {
    return (!value.is_list() && !value.is_map()) ||
           (!holds_list_of_maps(value) && flow(value).size() <= widest_flow);
}

void block(const Value& value, std::size_t indent, bool first_in_place, std::string& out);

/// Appends the value after "key:" or "-".
void after_mark(const Value& value, std::size_t indent, bool in_list, std::string& out) {
    const bool item_map = in_list && value.is_map() && !value.entries.empty();
    const bool section = indent == 0 && !in_list && holds_map(value); // params: one line each
    if (is_small(value) && !item_map && !section) {
        out += fmt::format(" {}\n", flow(value));
    } else if (in_list) {
        out += " ";
        block(value, indent + 2, true, out);
    } else {
        out += "\n";
        block(value, indent + 2, false, out);
    }
}

void block(const Value& value, std::size_t indent, bool first_in_place, std::string& out) {
    bool placed = first_in_place; // the first line continues the line of "- "
    const auto lead = [&] {
        if (!placed) out += std::string(indent, ' ');
        placed = false;
    };
    for (const auto& item : value.items) {
        lead();
        out += "-";
        after_mark(item, indent, true, out);
    }
    for (const auto& entry : value.entries) {
        lead();
        out += scalar(entry.key, false) + ":";
        after_mark(entry.value, indent, false, out);
    }
}

} // namespace

std::string emit_flow(const Value& value) { return flow(value); }

std::string emit_yaml(const Value& value) {
    if ((!value.is_map() && !value.is_list()) || (value.items.empty() && value.entries.empty()))
        return flow(value) + "\n";
    std::string out;
    block(value, 0, false, out);
    return out;
}

} // namespace facetmill::pipeline
