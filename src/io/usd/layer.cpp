#include "io/usd/layer.hpp"

#include <algorithm>

namespace facetmill::io::usd {

namespace {

bool is_word(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

std::string quoted(std::string_view text) {
    std::string all = "\"";
    for (const char c : one_line(std::string(text))) {
        if (c == '"' || c == '\\') all += '\\';
        all += c;
    }
    return all + "\"";
}

} // namespace

std::string identifier(std::string_view name, std::string_view otherwise) {
    constexpr std::size_t most = 200;
    std::string all(name.empty() ? otherwise : name.substr(0, most));
    std::replace_if(
        all.begin(), all.end(), [](char c) { return !is_word(c); }, '_');
    if (all.empty()) return "_";
    return all.front() >= '0' && all.front() <= '9' ? "_" + all : all;
}

std::string Layer::open(std::string_view type, std::string_view wanted, std::string_view otherwise,
                        std::vector<std::string> metadata) {
    const std::string name = names_.back().add(identifier(wanted, otherwise));
    if (!wanted.empty() && name != wanted)
        metadata.insert(metadata.begin(), "customData = { string name = " + quoted(wanted) + " }");
    line(fmt::format("{} \"{}\"{}", type, name, metadata.empty() ? "" : " ("));
    for (const std::string& item : metadata) line("    " + item);
    if (!metadata.empty()) line(")");
    line("{");
    names_.emplace_back();
    ++depth_;
    return name;
}

void Layer::close() {
    names_.pop_back();
    --depth_;
    line("}");
}

void Layer::line(std::string_view text) {
    indent();
    append(text_, text);
    append(text_, "\n");
}

void Layer::indent() {
    constexpr std::size_t most = 12, step = 4; // or deep hierarchies would be mostly blanks
    append(text_, std::string(step * std::min(depth_, most), ' '));
}

} // namespace facetmill::io::usd
