#include "base/text/spelling.hpp"
#include "base/text/words.hpp"
#include "io/ply/ply.hpp"
#include "io/stated.hpp"
#include "io/text.hpp"

#include <fmt/format.h>

namespace facetmill::io::ply {

namespace {

std::optional<Type> type_named(std::string_view name) {
    static constexpr std::pair<std::string_view, Type> names[] = {
        {"float", Type::float32},   {"float32", Type::float32}, {"double", Type::float64},
        {"float64", Type::float64}, {"uchar", Type::uint8},     {"uint8", Type::uint8},
        {"char", Type::int8},       {"int8", Type::int8},       {"ushort", Type::uint16},
        {"uint16", Type::uint16},   {"short", Type::int16},     {"int16", Type::int16},
        {"uint", Type::uint32},     {"uint32", Type::uint32},   {"int", Type::int32},
        {"int32", Type::int32}};
    for (const auto& [known, type] : names)
        if (known == name) return type;
    return {};
}

Type read_type(Text& text) {
    const std::string_view word = text.word_on_line();
    if (const auto type = type_named(word)) return *type;
    text.fail(fmt::format("expected a type (char, uchar, short, ushort, int, uint, float, double), found {}",
                          in_quotes(word)));
}

Property read_property(Text& text) {
    Property p;
    Text ahead = text;
    if (ahead.word_on_line() == "list") {
        text = ahead;
        p.list = true;
        p.count_type = read_type(text);
        if (p.count_type == Type::float32 || p.count_type == Type::float64)
            text.fail("expected an integer type for the length of a list");
    }
    p.type = read_type(text);
    p.name = text.rest_of_line();
    if (p.name.empty()) text.fail("expected the name of a property");
    return p;
}

Element read_element(Text& text) {
    Element e;
    e.name = text.word_on_line();
    e.line = text.line();
    if (text.at_line_end()) text.fail("expected the name and the count of an element");
    const std::int64_t count = text.integer("a count");
    if (count < 0) text.fail(fmt::format("expected a count, found {}", count));
    e.count = static_cast<std::size_t>(count);
    return e;
}

Encoding read_encoding(Text& text) {
    const std::string_view word = text.word_on_line();
    if (word == "ascii") return Encoding::ascii;
    if (word == "binary_little_endian") return Encoding::little_endian;
    if (word == "binary_big_endian") return Encoding::big_endian;
    text.fail(
        fmt::format("expected ascii, binary_little_endian or binary_big_endian, found {}", in_quotes(word)));
}

} // namespace

std::size_t size_of(Type type) {
    static constexpr std::size_t sizes[] = {4, 8, 1, 1, 2, 2, 4, 4};
    return sizes[static_cast<std::size_t>(type)];
}

AttributeData array_of(Type type) {
    switch (type) {
    case Type::float32:
        return std::vector<float>{};
    case Type::float64:
        return std::vector<double>{};
    case Type::uint8:
        return std::vector<std::uint8_t>{};
    case Type::int8:
        return std::vector<std::int8_t>{};
    case Type::uint16:
        return std::vector<std::uint16_t>{};
    case Type::int16:
        return std::vector<std::int16_t>{};
    case Type::uint32:
        return std::vector<std::uint32_t>{};
    case Type::int32:
        break;
    }
    return std::vector<std::int32_t>{};
}

/// Takes a comment that is no texture: a statement of facetmill, or text to keep. Names of programs do not
/// hold for another file.
void take_comment_of(Header& header, std::string_view comment) {
    take_comment(comment, header.stated);
    header.own = header.own || trimmed(comment) == "written by facetmill";
    if (states(comment)) return;
    const std::string text = lower_case(std::string(comment));
    for (const char* of_program : {"generated", "written by", "created by", "exported", "made by"})
        if (text.find(of_program) != text.npos) return;
    if (!trimmed(comment).empty()) header.comments.emplace_back(trimmed(comment));
}

Header read_header(const Input& input) {
    Text text(as_text(input.bytes()), input.name(), "E-PLY");
    Header header;
    if (text.word_on_line() != "ply") text.fail("expected 'ply' as the first word");
    bool format = false;
    while (text.next_line()) {
        const std::string_view word = text.word_on_line();
        if (word == "format") {
            header.encoding = read_encoding(text);
            format = true;
        } else if (word == "element") {
            header.elements.push_back(read_element(text));
        } else if (word == "property") {
            if (header.elements.empty()) text.fail("a property without an element");
            header.elements.back().properties.push_back(read_property(text));
        } else if (word == "end_header") {
            if (!format) text.fail("the header has no 'format' line");
            header.lines = text.line();
            text.next_line();
            header.size = text.offset();
            return header;
        } else if (word == "comment") {
            Text ahead = text;
            if (ahead.word_on_line() == "TextureFile")
                header.textures.emplace_back(ahead.rest_of_line());
            else
                take_comment_of(header, text.rest_of_line());
        } else if (word == "obj_info") {
            header.comments.push_back(fmt::format("obj_info {}", trimmed(text.rest_of_line())));
        } else if (!word.empty()) {
            text.fail(
                fmt::format("expected element, property, comment or end_header, found {}", in_quotes(word)));
        }
    }
    text.fail("the header does not end: there is no 'end_header'");
}

} // namespace facetmill::io::ply
