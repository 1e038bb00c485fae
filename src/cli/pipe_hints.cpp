#include "cli/pipe_hints.hpp"

#include "stage/stage.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <vector>

namespace facetmill::cli {

namespace {

bool is_word_character(char c) { return (c >= 'a' && c <= 'z') || c == '_' || c == '-'; }

/// Whether a schema lists the word among its values.
bool lists(const Json& schema, const std::string& word) {
    if (schema.is_array())
        return std::any_of(schema.begin(), schema.end(), [&](const Json& one) { return lists(one, word); });
    if (!schema.is_object()) return false;
    if (schema.value("type", Json()) == "boolean" && (word == "true" || word == "false")) return true;
    if (const auto values = schema.find("enum"); values != schema.end())
        if (std::find(values->begin(), values->end(), Json(word)) != values->end()) return true;
    return schema.contains("anyOf") && lists(schema["anyOf"], word);
}

/// Whether a stage has an option of that name with that word among its values, so that the pair is not
/// prose.
bool is_option_with(const std::string& name, const std::string& word) {
    return std::any_of(stages().begin(), stages().end(), [&](const StageInfo& stage) {
        const Option* option = stage.options->find(name);
        return option && lists(option->schema, word);
    });
}

bool is_stage_option(const std::string& name) {
    return std::any_of(stages().begin(), stages().end(),
                       [&](const StageInfo& stage) { return stage.options->find(name) != nullptr; });
}

/// Whether a stage has an option of that name, and the text is a number or a percentage.
bool is_option_with_number(const std::string& name, std::string_view text) {
    return !text.empty() && (text[0] == '-' || (text[0] >= '0' && text[0] <= '9')) && is_stage_option(name);
}

/// Rewrites a hint from left to right.
class Rewriter {
  public:
    explicit Rewriter(std::string_view hint) : hint_(hint) {}

    std::string run() {
        while (at_ < hint_.size()) {
            const bool begins =
                is_word_character(hint_[at_]) && (at_ == 0 || !is_word_character(hint_[at_ - 1]));
            if (rewrite_expression()) continue;
            if (!begins || !rewrite_pair()) out_ += hint_[at_++];
        }
        return std::move(out_);
    }

  private:
    struct Argument {
        std::string name, value; ///< dotted
    };

    /// Rewrites "${" or "$${" at the current position, because a shell would expand it.
    bool rewrite_expression() {
        std::size_t brace = at_;
        while (brace < hint_.size() && hint_[brace] == '$') ++brace;
        if (brace == at_ || brace == hint_.size() || hint_[brace] != '{') return false;
        out_.append(brace - at_, '@');
        out_ += '{';
        at_ = brace + 1;
        return true;
    }

    /// Rewrites "word: value" at the current position; false if pipe has no other notation for it.
    bool rewrite_pair() {
        std::size_t end = at_;
        while (end < hint_.size() && is_word_character(hint_[end])) ++end;
        if (hint_.substr(end, 2) != ": ") return false;
        const std::string word(hint_.substr(at_, end - at_));
        const StageInfo* stage = stage_named(word);
        const std::size_t value = end + 2;
        if (value < hint_.size() && hint_[value] == '{') {
            std::vector<Argument> arguments;
            std::size_t p = value;
            if (!take_map(p, stage ? "" : word, arguments)) return false;
            at_ = p;
            out_ += stage ? word : "";
            for (const Argument& a : arguments) write(a, stage);
            if (!stage && out_.ends_with(' ')) out_.pop_back();
            return true;
        }
        if (value < hint_.size() && hint_[value] == '[' && !stage && is_stage_option(word)) {
            const std::size_t end_of_list = value_end(value);
            if (end_of_list == std::string_view::npos) return false;
            write({word, std::string(hint_.substr(value, end_of_list - value))}, nullptr);
            at_ = end_of_list;
            return true;
        }
        const bool in_parentheses = at_ > 0 && hint_[at_ - 1] == '(';
        const std::size_t stop = std::min(hint_.size(), hint_.find_first_of(" ,;)", value));
        if (stop == value || hint_[stop - 1] == ':') return false;
        const std::string text(hint_.substr(value, stop - value));
        if (!stage && !in_parentheses && !is_option_with(word, text) && !is_option_with_number(word, text))
            return false;
        out_ += stage ? word : "--" + word;
        if (stage || text != "true") out_ += " " + text;
        at_ = stop;
        return true;
    }

    /// Reads a map in braces at p and moves p past it; names are dotted below the prefix.
    bool take_map(std::size_t& p, const std::string& prefix, std::vector<Argument>& arguments) const {
        ++p; // {
        while (p < hint_.size()) {
            while (p < hint_.size() && (hint_[p] == ' ' || hint_[p] == ',')) ++p;
            if (p < hint_.size() && hint_[p] == '}') {
                ++p;
                return true;
            }
            const std::size_t colon = hint_.find(": ", p);
            if (colon == std::string_view::npos) return false;
            const std::string key(hint_.substr(p, colon - p));
            if (!std::all_of(key.begin(), key.end(), is_word_character)) return false;
            const std::string name = prefix.empty() ? key : fmt::format("{}.{}", prefix, key);
            p = colon + 2;
            if (p < hint_.size() && hint_[p] == '{') {
                if (!take_map(p, name, arguments)) return false;
                continue;
            }
            const std::size_t end = value_end(p);
            if (end == std::string_view::npos) return false;
            arguments.push_back({name, std::string(hint_.substr(p, end - p))});
            p = end;
        }
        return false;
    }

    /// The end of a value in a map: a list extends to its bracket.
    std::size_t value_end(std::size_t p) const {
        if (hint_[p] != '[') return hint_.find_first_of(",}", p);
        const std::size_t bracket = hint_.find(']', p);
        return bracket == std::string_view::npos ? bracket : bracket + 1;
    }

    void write(const Argument& a, const StageInfo* stage) {
        const Option* primary = stage ? stage->options->primary() : nullptr;
        const bool needs_quotes =
            a.value.find_first_of(" *?[]$!") != std::string::npos && a.value.front() != '"';
        const std::string value = needs_quotes ? fmt::format("'{}'", a.value) : a.value;
        if (!out_.empty() && out_.back() != ' ' && out_.back() != '(') out_ += ' ';
        if (primary && primary->name == a.name)
            out_ += value;
        else if (a.value == "true")
            out_ += "--" + a.name;
        else
            out_ += fmt::format("--{} {}", a.name, value);
    }

    std::string_view hint_;
    std::size_t at_ = 0;
    std::string out_;
};

} // namespace

std::string in_pipe_syntax(std::string_view hint) { return Rewriter(hint).run(); }

} // namespace facetmill::cli
