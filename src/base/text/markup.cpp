#include "base/text/markup.hpp"

#include "base/text/words.hpp"

namespace facetmill {

std::string escaped(std::string_view text) {
    constexpr const char* replacement = "\xEF\xBF\xBD"; // U+FFFD
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        const char c = text[at];
        const std::size_t length = utf8_length(text, at);
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else if (c == '\'')
            out += "&#39;";
        else if (length == 0 || (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t'))
            out += replacement;
        else
            out += text.substr(at, length);
        at += length == 0 ? 1 : length;
    }
    return out;
}

std::string escaped_path(std::string_view path) {
    std::string out;
    for (const char c : escaped(path)) {
        out += c;
        if (c == '/' || c == '\\' || c == '_') out += "<wbr>";
    }
    return out;
}

std::string markdown_escaped(std::string_view text) {
    std::string out;
    for (const char c : escaped(text)) {
        if (std::string_view("\\`*_[]|~").find(c) != std::string_view::npos) out += '\\';
        out += c == '\n' || c == '\t' ? ' ' : c;
    }
    return out;
}

std::string for_terminal(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (std::size_t at = 0; at < text.size();) {
        const auto c = static_cast<unsigned char>(text[at]);
        const std::size_t length = utf8_length(text, at);
        const bool c1 = length == 2 && c == 0xC2 && static_cast<unsigned char>(text[at + 1]) < 0xA0;
        if (length == 0 || c1 || (c < 0x20 && c != '\n' && c != '\t') || c == 0x7F)
            out += '?';
        else
            out += text.substr(at, length);
        at += length == 0 ? 1 : length;
    }
    return out;
}

Painted& Painted::operator+=(std::string_view text) {
    text_ += for_terminal(text);
    return *this;
}

Painted& Painted::paint(std::string_view code, std::string_view text) {
    if (!colour_) return *this += text;
    text_.append("\033[").append(code).append("m");
    *this += text;
    text_ += "\033[0m";
    return *this;
}

std::string for_shell(std::string_view text) {
    static constexpr std::string_view plain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._/=:,%+@";
    if (!text.empty() && text.find_first_not_of(plain) == text.npos) return std::string(text);
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

} // namespace facetmill
