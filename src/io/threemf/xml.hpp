#pragma once
// Reads XML element by element with Expat. Refuses document types, and so custom entities, and bounds the
// depth.

#include "io/bytes.hpp"

#include <functional>

namespace facetmill::io::threemf {

/// The hint of errors with a place in the XML.
inline constexpr const char* hint_for_rules =
    "export the file again, or unzip it, correct this place, and zip it again";

/// The start of an element. It is valid until the next element.
struct Element {
    std::string_view space; ///< the namespace URI: "http://..."
    std::string_view name;  ///< the local name, without prefix
    std::size_t line = 0;

    /// The value of an attribute, named without a namespace or as "namespace|name"; none if absent.
    std::optional<std::string_view> find(std::string_view attribute) const;

    const char** attributes = nullptr; ///< alternating names and values from Expat, up to a null
};

struct XmlHandler {
    std::function<void(const Element&)> start;
    std::function<void()> end;
    /// Called when a prefix is bound to a namespace.
    std::function<void(std::string_view prefix, std::string_view space)> space;
    /// Called with text between elements, in pieces. Not set: text is not needed.
    std::function<void(std::string_view)> text = {};
};

/// Reads a document. name: the document's name in messages. Throws a malformed-input error (E-3MF) with the
/// line, and passes on the handler's errors.
void read_xml(Span text, const std::string& name, const XmlHandler& handler);

/// The text escaped for an XML attribute; characters that XML cannot hold become U+FFFD.
[[nodiscard]] std::string xml_escaped(std::string_view text);

} // namespace facetmill::io::threemf
