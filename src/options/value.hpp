#pragma once
// User input with its locations: the common tree of YAML files, one-liners, -D and --set, from which options
// are read.

#include "base/error.hpp"
#include "base/mark.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace facetmill {

/// A null, a scalar, a list or a map. Maps keep their order and have no duplicate keys.
struct Value {
    enum class Kind { null, scalar, list, map };
    struct Entry;

    Kind kind = Kind::null;
    std::string text;      ///< the text of a scalar
    bool quoted = false;   ///< a quoted scalar is always text
    bool deferred = false; ///< known only when the pipeline runs (foreach over parts); checks accept any type
    Mark mark;
    Mark anchor; ///< where an alias's content was written; unknown if this is not an alias
    std::vector<Value> items;
    std::vector<Entry> entries;

    static Value scalar(std::string text, Mark mark = {}, bool quoted = false);
    static Value list(std::vector<Value> items, Mark mark = {});
    static Value map(std::vector<Entry> entries, Mark mark = {});

    bool is_null() const { return kind == Kind::null; }
    bool is_scalar() const { return kind == Kind::scalar; }
    bool is_list() const { return kind == Kind::list; }
    bool is_map() const { return kind == Kind::map; }

    const Value* find(std::string_view key) const;
    Value* find(std::string_view key);
    const Entry* find_entry(std::string_view key) const;
    /// Sets or replaces a key of a map. A null becomes a map.
    Value& set(std::string key, Value value, Mark key_mark = {});

    // The scalar by the YAML 1.2 core schema; none for other values. Quoted scalars are only text.
    std::optional<bool> as_bool() const;            ///< true, false
    std::optional<std::int64_t> as_integer() const; ///< decimal, 0x, 0o
    std::optional<double> as_real() const;          ///< finite numbers, including integers

    /// A description for messages: "the text "abc"", "a list of 3", "a map", "nothing".
    std::string described() const;
};

struct Value::Entry {
    std::string key;
    Mark key_mark;
    Value value;
};

/// Whether the trees are equal, ignoring locations and quotes.
bool same_content(const Value& a, const Value& b);

} // namespace facetmill
