#include "io/threemf/xml.hpp"

#include "base/error.hpp"
#include "io/text.hpp"

#include <algorithm>
#include <cstring>
#include <exception>
#include <expat.h>
#include <fmt/format.h>
#include <memory>

namespace facetmill::io::threemf {

namespace {

constexpr int deepest = 64;

struct Session {
    XML_Parser parser;
    const std::string& name;
    const XmlHandler& handler;
    int depth = 0;
    std::exception_ptr failure; ///< exceptions must not pass through Expat, which is C

    std::size_t line() const {
#if XML_MAJOR_VERSION > 2 || (XML_MAJOR_VERSION == 2 && XML_MINOR_VERSION >= 9)
        return XML_GetCurrentLineNumber64(parser); // the variant without 64 is deprecated
#else
        return XML_GetCurrentLineNumber(parser);
#endif
    }
    [[noreturn]] void fail(const std::string& message) const {
        malformed(name, static_cast<std::int64_t>(line()), "E-3MF", message, hint_for_rules);
    }
    template <class Body>
    void guarded(Body&& body) {
        if (failure) return;
        try {
            body();
        } catch (...) {
            failure = std::current_exception();
            XML_StopParser(parser, XML_FALSE);
        }
    }
};

Session& session_of(void* data) { return *static_cast<Session*>(data); }

void XMLCALL on_start(void* data, const char* name, const char** attributes) {
    Session& session = session_of(data);
    session.guarded([&] {
        if (++session.depth > deepest)
            session.fail(fmt::format("elements are nested deeper than {} levels", deepest));
        const std::string_view whole(name);
        const auto bar = whole.rfind('|');
        Element element;
        element.space = bar == std::string_view::npos ? std::string_view() : whole.substr(0, bar);
        element.name = bar == std::string_view::npos ? whole : whole.substr(bar + 1);
        element.line = session.line();
        element.attributes = attributes;
        session.handler.start(element);
    });
}

void XMLCALL on_end(void* data, const char*) {
    Session& session = session_of(data);
    session.guarded([&] {
        --session.depth;
        session.handler.end();
    });
}

void XMLCALL on_space(void* data, const char* prefix, const char* space) {
    Session& session = session_of(data);
    session.guarded([&] {
        if (session.handler.space) session.handler.space(prefix ? prefix : "", space ? space : "");
    });
}

void XMLCALL on_text(void* data, const char* text, int length) {
    Session& session = session_of(data);
    session.guarded([&] { session.handler.text({text, static_cast<std::size_t>(length)}); });
}

void XMLCALL on_document_type(void* data, const char*, const char*, const char*, int) {
    Session& session = session_of(data);
    session.guarded([&] { session.fail("a document type (<!DOCTYPE>) is not allowed in 3MF"); });
}

} // namespace

std::optional<std::string_view> Element::find(std::string_view attribute) const {
    for (const char** at = attributes; *at; at += 2)
        if (attribute == *at) return at[1];
    return {};
}

void read_xml(Span text, const std::string& name, const XmlHandler& handler) {
    const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(
        XML_ParserCreateNS(nullptr, '|'), &XML_ParserFree);
    if (!parser) throw out_of_memory("no memory to read XML");
    Session session{parser.get(), name, handler, 0, nullptr};
    XML_SetUserData(parser.get(), &session);
    XML_SetElementHandler(parser.get(), on_start, on_end);
    if (handler.text) XML_SetCharacterDataHandler(parser.get(), on_text);
    XML_SetStartNamespaceDeclHandler(parser.get(), on_space);
    XML_SetStartDoctypeDeclHandler(parser.get(), on_document_type);
    // Passes the text in pieces, because Expat's lengths are int.
    constexpr std::size_t piece = std::size_t{1} << 26;
    for (std::size_t at = 0;; at += piece) {
        const std::size_t size = std::min(piece, text.size() - at);
        const bool last = at + size == text.size();
        const auto status = XML_Parse(parser.get(), reinterpret_cast<const char*>(text.data()) + at,
                                      static_cast<int>(size), last);
        if (session.failure) std::rethrow_exception(session.failure);
        if (status != XML_STATUS_OK) {
            if (XML_GetErrorCode(parser.get()) == XML_ERROR_NO_MEMORY)
                throw out_of_memory("no memory to read XML");
            session.fail(fmt::format("not valid XML: {}", XML_ErrorString(XML_GetErrorCode(parser.get()))));
        }
        if (last) return;
    }
}

std::string xml_escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
        case '&':
            out += "&amp;";
            break;
        case '<':
            out += "&lt;";
            break;
        case '>':
            out += "&gt;";
            break;
        case '"':
            out += "&quot;";
            break;
        default:
            if (static_cast<unsigned char>(c) < ' ')
                out += "\xEF\xBF\xBD";
            else
                out += c;
        }
    }
    return out;
}

} // namespace facetmill::io::threemf
