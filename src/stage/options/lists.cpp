#include "stage/options/lists.hpp"

#include <algorithm>

namespace facetmill {

namespace {

/// Reads the text from left to right; blanks do not count.
class ListReader {
  public:
    ListReader(std::string text, const Mark& mark) : text_(std::move(text)), mark_(mark) {
        std::erase(text_, ' ');
    }

    std::optional<Value> read() {
        Value rows = Value::list({}, mark_);
        while (true) {
            auto row = items();
            if (!row) return {};
            rows.items.push_back(std::move(*row));
            if (!skip(';')) break;
        }
        if (at_ < text_.size()) return {}; // a bracket that was not opened
        if (rows.items.size() > 1) return rows;
        Value only = std::move(rows.items[0]);
        // "[1, 2]" is the list itself, not a list of it.
        return only.items.size() == 1 && only.items[0].is_list() ? std::move(only.items[0]) : std::move(only);
    }

  private:
    /// Up to the end, a semicolon or a closing bracket.
    std::optional<Value> items() {
        Value list = Value::list({}, mark_);
        do {
            if (skip('[')) {
                auto inner = items();
                if (!inner || !skip(']')) return {};
                list.items.push_back(std::move(*inner));
                continue;
            }
            const auto end = std::min(text_.find_first_of("[],;", at_), text_.size());
            list.items.push_back(Value::scalar(text_.substr(at_, end - at_), mark_));
            at_ = end;
        } while (skip(','));
        return list;
    }

    bool skip(char c) {
        const bool here = at_ < text_.size() && text_[at_] == c;
        at_ += here;
        return here;
    }

    std::string text_;
    Mark mark_;
    std::size_t at_ = 0;
};

} // namespace

std::optional<Value> list_in_text(const Value& text) { return ListReader(text.text, text.mark).read(); }

Value listed(const Value& value) {
    if (!value.is_scalar() || value.deferred) return value;
    return list_in_text(value).value_or(value);
}

} // namespace facetmill
