#include "base/error.hpp"

#include "base/text/markup.hpp"

#include <algorithm>
#include <fmt/format.h>

template class std::vector<facetmill::Diagnostic>;

namespace facetmill {

Error::Error(const Error&) = default;
Error::Error(Error&&) noexcept = default;
Error& Error::operator=(const Error&) = default;
Error& Error::operator=(Error&&) noexcept = default;
Error::~Error() = default;

Error::Error(ErrorKind kind, std::string id, std::string message, std::string hint, Mark where)
    : Error(kind, std::vector<Diagnostic>{{Severity::error, std::move(id), std::move(message),
                                           std::move(where), std::move(hint)}}) {}

Error::Error(ErrorKind kind, std::vector<Diagnostic> diagnostics)
    : kind_(kind), diagnostics_(std::move(diagnostics)) {
    for (const auto& d : diagnostics_) text_ += fmt::format("[{}] {}\n", d.id, d.message);
    if (!text_.empty()) text_.pop_back();
}

Error& Error::at(const Mark& where) {
    for (auto& d : diagnostics_)
        if (!d.where.known()) d.where = where;
    return *this;
}

std::string to_string(ErrorKind kind) {
    const char* word = "";
    switch (kind) {
    case ErrorKind::check:
        word = "a check did not hold";
        break;
    case ErrorKind::usage:
        word = "the command line or the pipeline is wrong";
        break;
    case ErrorKind::missing:
        word = "an input is missing or not permitted";
        break;
    case ErrorKind::output:
        word = "an output cannot be written";
        break;
    case ErrorKind::stage:
        word = "a stage cannot process its input";
        break;
    case ErrorKind::malformed:
        word = "an input is malformed";
        break;
    case ErrorKind::limit:
        word = "a limit or lack of memory";
        break;
    case ErrorKind::bug:
        word = "a bug in facetmill";
        break;
    }
    return fmt::format("{} ({})", static_cast<int>(kind), word);
}

Error out_of_memory(std::string message, std::string hint, Mark where) {
    Diagnostic why{Severity::error, "E-MEMORY", std::move(message), std::move(where), std::move(hint)};
    why.out_of_memory = true;
    return {ErrorKind::limit, std::vector{std::move(why)}};
}

bool is_allowed(const Diagnostic& warning, const std::vector<std::string>& ids) {
    return std::find(ids.begin(), ids.end(), warning.id) != ids.end();
}

void Problems::add_once(Diagnostic one) {
    const std::string text = fmt::format("{}\n{}\n{}\n{}", static_cast<int>(one.severity), one.id,
                                         to_string(one.where), one.message);
    if (known_.insert(text).second) all_.push_back(std::move(one));
}

void Problems::add(Mark where, std::string id, std::string message, std::string hint) {
    add_once({Severity::error, std::move(id), std::move(message), std::move(where), std::move(hint)});
}

void Problems::warn(Mark where, std::string id, std::string message, std::string hint) {
    add_once({Severity::warning, std::move(id), std::move(message), std::move(where), std::move(hint)});
}

void Problems::add(const Error& error) {
    for (const auto& diagnostic : error.diagnostics()) add_once(diagnostic);
}

bool Problems::any_errors() const {
    return std::any_of(all_.begin(), all_.end(), [](const auto& d) { return d.severity == Severity::error; });
}

void Problems::throw_if_any(ErrorKind kind) const {
    if (any_errors()) throw Error(kind, all_);
}

namespace {

constexpr std::size_t widest_line = 160;

/// The source line that contains the mark, without its line end.
std::string source_line(const Mark& mark) {
    const std::string& text = mark.source->text;
    std::size_t begin = 0;
    for (int line = 1; line < mark.line; ++line) {
        begin = text.find('\n', begin);
        if (begin == std::string::npos) return {};
        ++begin;
    }
    std::string line = text.substr(begin, text.find('\n', begin) - begin);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return line;
}

/// The number of UTF-8 characters in the text.
std::size_t characters(std::string_view text) {
    return std::count_if(text.begin(), text.end(), [](unsigned char c) { return (c & 0xC0) != 0x80; });
}

/// The source line and a caret under the mark; long lines are cut around it.
std::string excerpt(const Mark& mark) {
    const std::string line = source_line(mark);
    if (line.empty() || mark.column == 0) return {};
    const auto column = static_cast<std::size_t>(mark.column - 1);
    if (line.size() > widest_line) {
        const std::size_t from = column > widest_line / 2 ? column - widest_line / 2 : 0;
        std::string cut = line.substr(std::min(from, line.size()), widest_line);
        return fmt::format("\n  {}\n  {}^", cut, std::string(std::min(column - from, cut.size()), ' '));
    }
    const std::size_t room =
        std::max<std::size_t>(1, characters(line) > column ? characters(line) - column : 1);
    const std::size_t wide = std::clamp<std::size_t>(mark.length, 1, room);
    std::string lead;
    for (std::size_t i = 0; i < column; ++i) lead += i < line.size() && line[i] == '\t' ? '\t' : ' ';
    return fmt::format("\n  {}\n  {}^{}", line, lead, std::string(wide - 1, '~'));
}

} // namespace

std::string render(const Diagnostic& d, bool colour) {
    const char* word = d.severity == Severity::error     ? "error"
                       : d.severity == Severity::warning ? "warning"
                                                         : "note";
    const char* paint = !colour ? "" : d.severity == Severity::error ? "\033[1;31m" : "\033[1;35m";
    std::string text = d.where.known() ? for_terminal(to_string(d.where)) + ": " : "facetmill: ";
    text +=
        fmt::format("{}{}[{}]{}: {}", paint, word, d.id, colour ? "\033[0m" : "", for_terminal(d.message));
    if (d.where.known() && d.where.line > 0) text += for_terminal(excerpt(d.where));
    if (!d.hint.empty()) text += for_terminal(fmt::format("\n  hint: {}", d.hint));
    return text;
}

} // namespace facetmill
