#include "pipeline/yaml_text.hpp"

#include "base/text/words.hpp"
#include "io/codec.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::pipeline {

namespace {

constexpr std::size_t max_text = std::size_t{4} << 20;

bool is_forbidden_control(char c) {
    const auto u = static_cast<unsigned char>(c);
    return (u < 0x20 && c != '\t' && c != '\n' && c != '\r') || u == 0x7F;
}

} // namespace

SourceIndex::SourceIndex(std::shared_ptr<const SourceText> source)
    : source_(std::move(source)), line_begins_{0} {
    for (std::size_t i = 0; i < text().size(); ++i)
        if (text()[i] == '\n') line_begins_.push_back(i + 1);
}

int SourceIndex::characters(std::size_t begin, std::size_t end) const {
    const auto from = text().begin() + static_cast<std::ptrdiff_t>(begin);
    const auto to = text().begin() + static_cast<std::ptrdiff_t>(end);
    return static_cast<int>(std::count_if(from, to, [](unsigned char c) { return (c & 0xC0) != 0x80; }));
}

Mark SourceIndex::mark(std::size_t offset, int length) const {
    offset = std::min(offset, text().size());
    const auto next = std::upper_bound(line_begins_.begin(), line_begins_.end(), offset);
    const auto line = static_cast<int>(next - line_begins_.begin());
    return {source_, line, characters(*(next - 1), offset) + 1, std::max(1, length)};
}

std::string hint_for_no_pipeline(const std::string& name) {
    if (!io::codec_for(name)) return {};
    return fmt::format(
        "is this a mesh? facetmill info {0} shows its contents, facetmill pipe load {0} ! ... works on it",
        name);
}

bool check_text(const SourceIndex& source, Problems& problems) {
    const std::string& text = source.text();
    const auto hint = [&](std::string of_text) {
        std::string mesh = hint_for_no_pipeline(source.name());
        return mesh.empty() ? std::move(of_text) : std::move(mesh);
    };
    if (text.size() > max_text) {
        problems.add(source.mark(0), "E-YAML",
                     fmt::format("a pipeline of {} bytes is too large", text.size()),
                     hint(fmt::format("the limit is {} bytes; is this a pipeline?", max_text)));
        return false;
    }
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = utf8_length(text, i);
        if (length == 0 || is_forbidden_control(text[i])) {
            const auto byte = static_cast<unsigned>(static_cast<unsigned char>(text[i]));
            Mark where = source.mark(i);
            if (text.find('\0') != text.npos) // a binary file: its text is not shown
                where.source = std::make_shared<const SourceText>(SourceText{source.name(), {}});
            problems.add(where, "E-YAML",
                         length == 0
                             ? fmt::format("the byte 0x{:02x} is not UTF-8", byte)
                             : fmt::format("a pipeline cannot contain the control character 0x{:02x}", byte),
                         hint("a pipeline is a text in UTF-8"));
            return false;
        }
        i += length;
    }
    return true;
}

// --- yaml text

std::size_t content_at(const std::string& text, std::size_t at) {
    while (at < text.size() && (text[at] == '&' || text[at] == '!')) {
        at = std::min(text.size(), text.find_first_of(" \t\r\n,[]{}", at));
        at = std::min(text.size(), text.find_first_not_of(" \t\r\n", at));
    }
    return at;
}

Mark empty_item_mark(const SourceIndex& source, std::size_t at) {
    const std::string& text = source.text();
    const std::size_t dash = text.find_last_of("-[,", std::min(at, text.size() - 1));
    return source.mark(dash == std::string::npos ? at : dash);
}

Mark alias_mark(const SourceIndex& source, std::size_t at) {
    const std::string& text = source.text();
    const std::size_t end = std::min(text.size(), text.find_first_of(" \t\r\n,[]{}", at));
    return source.mark(at, source.characters(at, end));
}

Mark scalar_mark(const SourceIndex& source, std::size_t at, const std::string& text, bool plain) {
    const std::string& all = source.text();
    if (plain) {
        const std::size_t line_end = std::min(all.size(), all.find('\n', at));
        return source.mark(at, source.characters(at, std::min(at + text.size(), line_end)));
    }
    const char quote = at < all.size() ? all[at] : ' ';
    if (quote != '"' && quote != '\'') return source.mark(at);
    for (std::size_t i = at + 1; i < all.size() && all[i] != '\n'; ++i) {
        if (all[i] == '\\' && quote == '"')
            ++i;
        else if (all[i] == quote)
            return source.mark(at, source.characters(at, i + 1));
    }
    return source.mark(at);
}

std::optional<std::size_t> end_of_unquoted(const std::string& all, std::size_t at, const std::string& text) {
    const std::size_t brace = at + text.size();
    if (!text.ends_with('$') || brace >= all.size() || all[brace] != '{') return {};
    const std::size_t closed = all.find_first_of("},]\n", brace);
    return std::min(all.size(), all.find_first_of(" ,]}\r\n", std::min(closed, all.size() - 1) + 1));
}

} // namespace facetmill::pipeline
