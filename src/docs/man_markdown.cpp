#include "docs/man_markdown.hpp"

#include <algorithm>
#include <vector>

namespace facetmill::docs {

namespace {

/// The text without the escapes of roff: \- and \(dq become characters, \fB and \& are removed.
std::string unescaped(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '\\' || i + 1 == text.size()) {
            out += text[i];
            continue;
        }
        ++i;
        if (text[i] == '(') {
            out += text.substr(i + 1, 2) == "dq" ? "\"" : text.substr(i + 1, 2);
            i += 2;
        } else if (text[i] == 'f') {
            ++i;
        } else if (text[i] != '&') {
            out += text[i];
        }
    }
    return out;
}

/// The arguments of a macro: words, or texts in quotes.
std::vector<std::string> arguments(std::string_view text) {
    std::vector<std::string> all;
    for (std::size_t at = text.find_first_not_of(' '); at < text.size();
         at = text.find_first_not_of(' ', at)) {
        const bool quoted = text[at] == '"';
        const std::size_t begin = at + (quoted ? 1 : 0);
        const std::size_t end = std::min(text.size(), text.find(quoted ? '"' : ' ', begin));
        all.push_back(unescaped(text.substr(begin, end - begin)));
        at = std::min(text.size(), end + 1);
    }
    return all;
}

/// .B applies to all arguments. For .BR and similar macros, the letters are the fonts of successive
/// arguments.
std::string in_fonts(std::string_view fonts, const std::vector<std::string>& texts) {
    std::string out;
    if (fonts.size() == 1) {
        for (const auto& text : texts) out += (out.empty() ? "" : " ") + text;
        return "`" + out + "`";
    }
    for (std::size_t i = 0; i < texts.size(); ++i)
        out += fonts[i % 2] == 'R' ? texts[i] : "`" + texts[i] + "`";
    return out;
}

class Writer {
  public:
    std::string page(std::string_view text) {
        while (!text.empty()) {
            const std::size_t end = std::min(text.size(), text.find('\n'));
            line(text.substr(0, end));
            text.remove_prefix(std::min(text.size(), end + 1));
        }
        return std::move(out_);
    }

  private:
    void line(std::string_view text) {
        if (!text.starts_with('.')) return put(unescaped(text));
        const std::size_t end = std::min(text.size(), text.find(' '));
        const std::string_view macro = text.substr(1, end - 1), rest = text.substr(end);
        if (macro == "SH")
            heading(arguments(rest));
        else if (macro == "PP")
            out_ += "\n";
        else if (macro == "TP")
            is_term_ = true;
        else if (macro == "nf" || macro == "fi")
            fence(macro == "nf");
        else if (!macro.empty() && macro.find_first_not_of("BIR") == macro.npos && macro != "R")
            put(in_fonts(macro, arguments(rest)));
    }
    void heading(const std::vector<std::string>& words) {
        in_item_ = false;
        out_ += out_.empty() ? "## " : "\n## ";
        for (std::size_t i = 0; i < words.size(); ++i) out_ += (i ? " " : "") + words[i];
        out_ += "\n\n";
    }
    void fence(bool opens) {
        out_ += opens ? "\n```yaml\n" : "```\n\n";
        in_example_ = opens;
    }
    void put(const std::string& text) {
        if (is_term_)
            out_ += "\n- " + text + ":\n";
        else
            out_ += (in_item_ && !in_example_ ? "  " : "") + text + "\n";
        if (is_term_) in_item_ = true;
        is_term_ = false;
        if (text.empty()) in_item_ = false;
    }

    std::string out_;
    bool is_term_ = false, in_item_ = false, in_example_ = false;
};

} // namespace

std::string markdown_of_man(std::string_view page) { return Writer().page(page); }

} // namespace facetmill::docs
