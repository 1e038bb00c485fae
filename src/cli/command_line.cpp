#include "cli/command.hpp"

#include <algorithm>

namespace facetmill::cli {

namespace {

/// The argument in shell notation.
std::string typed(const std::string& argument) {
    const auto plain = [](unsigned char c) {
        return std::isalnum(c) || c >= 0x80 ||
               std::string_view("-_./=,:+@%!{}[]").find(static_cast<char>(c)) != std::string::npos;
    };
    if (!argument.empty() && std::all_of(argument.begin(), argument.end(), plain)) return argument;
    std::string text = "'";
    for (const char c : argument)
        if (c == '\'')
            text += "'\\''";
        else
            text += c == '\n' || c == '\t' ? ' ' : c;
    return text + "'";
}

int characters(const std::string& text) {
    return static_cast<int>(
        std::count_if(text.begin(), text.end(), [](unsigned char c) { return (c & 0xC0) != 0x80; }));
}

} // namespace

CommandLine::CommandLine(std::vector<std::string> arguments) : arguments_(std::move(arguments)) {
    auto source = std::make_shared<SourceText>(SourceText{command_line_name, "facetmill"});
    int column = 10;
    for (const auto& argument : arguments_) {
        const std::string text = typed(argument);
        source->text += " " + text;
        marks_.push_back({source, 1, ++column, characters(text)});
        column += characters(text);
    }
    whole_ = {source, 1, 1, 9};
    for (auto& mark : marks_) mark.source = source;
}

Mark CommandLine::mark(std::size_t argument) const {
    return argument < marks_.size() ? marks_[argument] : whole_;
}

Mark CommandLine::find(const std::string& start) const {
    for (std::size_t i = 0; i < arguments_.size(); ++i)
        if (arguments_[i].starts_with(start)) return marks_[i];
    return whole_;
}

Mark CommandLine::value(const std::string& text) const {
    for (std::size_t i = 0; i < arguments_.size(); ++i) {
        const std::string& argument = arguments_[i];
        if (argument == text) return marks_[i];
        if (!argument.starts_with("-") || !argument.ends_with("=" + text)) continue;
        Mark mark = marks_[i];
        const int before = static_cast<int>(argument.size() - text.size());
        if (mark.length != static_cast<int>(argument.size())) return mark; // quoted
        mark.column += before;
        mark.length -= before;
        return mark;
    }
    return whole_;
}

} // namespace facetmill::cli
