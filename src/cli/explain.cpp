// facetmill explain: the meaning of an error or warning id, and the remedy.

#include "base/text/spelling.hpp"
#include "cli/command.hpp"
#include "docs/messages.hpp"

#include <fmt/format.h>

namespace facetmill::cli {

namespace {

constexpr const char* explain_examples = R"(Examples
  facetmill explain W-UNITS
  facetmill explain
  facetmill explain --markdown > messages.md
)";

struct ExplainOptions {
    std::string id;
    bool markdown = false, man = false, json = false;
};

const MessageId& message_asked_for(const std::string& text, const CommandLine& line) {
    const std::string id = docs::id_of(text);
    if (const auto* known = message_id(id)) return *known;
    std::vector<std::string> ids; // only ids with the same letter, if given
    for (const auto& m : message_ids())
        if (!id.starts_with("W-") || m.is_warning()) ids.emplace_back(m.id);
    throw Error(ErrorKind::usage, "E-ARGUMENT",
                fmt::format("'{}' is not the id of an error or warning", text),
                did_you_mean(id, ids, "facetmill explain lists all ids"), line.find(text));
}

int explain(const ExplainOptions& options, const CommandLine& line) {
    if (!options.id.empty())
        print(docs::message_page(message_asked_for(options.id, line)));
    else if (options.json)
        print(docs::messages_json().dump(2) + "\n");
    else if (options.markdown)
        print(docs::messages_markdown());
    else if (options.man)
        print(docs::messages_man());
    else
        print(docs::message_list());
    return 0;
}

} // namespace

Command explain_command() {
    return {"explain",
            "Explains the id of an error or warning.",
            explain_examples,
            {},
            [](Arguments& arguments, Console&) {
                auto options = std::make_shared<ExplainOptions>();
                arguments.add("ID", &options->id, "An id, such as E-KEY or W-UNITS. Default: all ids.");
                arguments.add("--json", &options->json, "Prints all ids as JSON.");
                arguments.add("--markdown", &options->markdown, "Prints all ids as a Markdown page.");
                arguments.add("--man", &options->man,
                              "Prints all ids as the manual page facetmill-messages(7).");
                return [=](const Invocation& invocation) { return explain(*options, invocation.line); };
            }};
}

} // namespace facetmill::cli
