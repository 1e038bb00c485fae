#pragma once
// XML, element by element, by Expat: without document types, so without entities of their own, and nested to
// a bounded depth.

#include "io/bytes.hpp"

#include <functional>

namespace facetmill::io::threemf {

/// The start of an element. Valid until the next one.
struct Element {
    std::string_view space; ///< the namespace's name: "http://..."
    std::string_view name;  ///< without prefix
    std::size_t line = 0;

    /// The value of an attribute, which is named without namespace or as "namespace|name"; none when absent.
    std::optional<std::string_view> find(std::string_view attribute) const;

    const char** attributes = nullptr; ///< Expat's: names and values in turn, up to a null
};

struct XmlHandler {
    std::function<void(const Element&)> start;
    std::function<void()> end;
    /// A prefix stands for a namespace from here on.
    std::function<void(std::string_view prefix, std::string_view space)> space;
};

/// Reads a document. name: for messages. Throws malformed (E-3MF) with the line, and whatever the handler
/// throws.
void read_xml(Span text, const std::string& name, const XmlHandler& handler);

/// The text with what XML needs escaped in an attribute; characters that it cannot hold become U+FFFD.
std::string xml_escaped(std::string_view text);

} // namespace facetmill::io::threemf
