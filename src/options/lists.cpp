#include "options/lists.hpp"

#include "base/text/words.hpp"

#include <algorithm>

namespace facetmill {

namespace {

/// Reads the text from left to right; ignores blanks around signs.
class ListReader {
  public:
    ListReader(std::string_view text, const Mark& mark) : text_(trimmed(text)), mark_(mark) {}

    std::optional<Value> read() {
        Value rows = Value::list({}, mark_);
        while (true) {
            auto row = items();
            if (!row) return {};
            rows.items.push_back(std::move(*row));
            if (!skip(';')) break;
        }
        if (at_ < text_.size()) return {}; // a closing bracket without an opening bracket
        if (rows.items.size() > 1) return rows;
        Value only = std::move(rows.items[0]);
        // "[1, 2]" is the list itself, not a list that contains it.
        return only.items.size() == 1 && only.items[0].is_list() ? std::move(only.items[0]) : std::move(only);
    }

  private:
    /// Reads items up to the end, a semicolon or a closing bracket.
    std::optional<Value> items() {
        Value list = Value::list({}, mark_);
        do {
            if (skip('[')) {
                if (skip(']')) {
                    list.items.push_back(Value::list({}, mark_));
                    continue;
                }
                auto inner = items();
                if (!inner || !skip(']')) return {};
                list.items.push_back(std::move(*inner));
                continue;
            }
            const auto end = std::min(text_.find_first_of("[],;", at_), text_.size());
            list.items.push_back(Value::scalar(std::string(trimmed(text_.substr(at_, end - at_))), mark_));
            at_ = end;
        } while (skip(','));
        return list;
    }

    bool skip(char c) {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
        const bool here = at_ < text_.size() && text_[at_] == c;
        at_ += here;
        return here;
    }

    std::string_view text_;
    Mark mark_;
    std::size_t at_ = 0;
};

/// Whether the last character closes the text's first bracket; false for "[a],[b]".
bool is_in_brackets(std::string_view text) {
    if (!text.starts_with('[')) return false;
    std::size_t depth = 0;
    for (std::size_t at = 0; at < text.size(); ++at) {
        depth += text[at] == '[';
        if (text[at] == ']' && --depth == 0) return at + 1 == text.size();
    }
    return false;
}

} // namespace

std::optional<Value> list_in_text(const Value& text) { return ListReader(text.text, text.mark).read(); }

Value list_of_words(std::string_view text, const Mark& mark) {
    text = trimmed(text);
    if (is_in_brackets(text)) text = text.substr(1, text.size() - 2);
    Value list = Value::list({}, mark);
    for (const auto word : split_at_commas(text))
        list.items.push_back(Value::scalar(std::string(word), mark));
    return list;
}

Value listed(const Value& value) {
    if (!value.is_scalar() || value.deferred) return value;
    return list_in_text(value).value_or(value);
}

} // namespace facetmill
