#include "docs/messages.hpp"

#include "docs/describe.hpp"
#include "facetmill_version.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace facetmill::docs {

namespace {

/// "A warning; --strict=W-UP makes it fail", or "An error; exit code 2 (the command line ...)".
std::string severity_text(const MessageId& message) {
    if (message.is_warning()) return fmt::format("A warning. --strict={} turns it into an error", message.id);
    std::vector<std::string> codes;
    for (const auto kind : message.kinds) codes.push_back(to_string(kind));
    return fmt::format("An error with exit code {}", fmt::join(codes, " or "));
}

} // namespace

std::string id_of(std::string text) {
    for (char& c : text) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
    return text;
}

std::string message_list() {
    std::size_t widest = 0;
    for (const auto& m : message_ids()) widest = std::max(widest, m.id.size());
    std::string text;
    for (const auto& m : message_ids()) text += fmt::format("{:<{}}  {}\n", m.id, widest, m.meaning);
    return text;
}

std::string message_page(const MessageId& message) {
    return fmt::format("{}\n{}\nWhat to do\n{}\n{}.\n", message.id, wrapped(message.meaning, 2),
                       wrapped(message.hint, 2), severity_text(message));
}

std::string messages_markdown() {
    std::string text = "# The messages of facetmill\n\nEach error and warning has a stable id. "
                       "`facetmill explain ID` prints its entry on this page.\n";
    for (const auto& m : message_ids())
        text += fmt::format("\n## {}\n\n{}\n\n{} {}.\n", m.id, m.meaning, m.hint, severity_text(m));
    return text;
}

std::string messages_man() {
    std::string text = fmt::format(
        ".TH FACETMILL\\-MESSAGES 7 \"2026-11-22\" \"facetmill {}\" \"facetmill\"\n", FACETMILL_VERSION);
    text += ".SH NAME\nfacetmill\\-messages \\- the errors and warnings of facetmill by their ids\n"
            ".SH DESCRIPTION\nEach error and warning has a stable id, which\n.B facetmill explain\nexplains, "
            "too.\n";
    for (const bool warnings : {false, true}) {
        text += warnings ? ".SH WARNINGS\nEach makes the run fail when\n.B \\-\\-strict=ID\nnames it.\n"
                         : ".SH ERRORS\nThe exit code gives the kind of an error.\n";
        for (const auto& m : message_ids())
            if (m.is_warning() == warnings)
                text += fmt::format(".TP\n.B {}\n{}\n{}\n{}.\n", roff(m.id), roff(m.meaning), roff(m.hint),
                                    roff(severity_text(m)));
    }
    return text + ".SH SEE ALSO\n.BR facetmill (1),\n.BR facetmill\\-pipeline (5),\n"
                  ".BR facetmill\\-stages (7)\n";
}

Json messages_json() {
    Json all = Json::array();
    for (const auto& m : message_ids()) {
        Json codes = Json::array();
        for (const auto kind : m.kinds) codes.push_back(static_cast<int>(kind));
        all.push_back({{"id", m.id},
                       {"severity", m.is_warning() ? "warning" : "error"},
                       {"exit_codes", codes},
                       {"meaning", m.meaning},
                       {"hint", m.hint}});
    }
    return all;
}

} // namespace facetmill::docs
