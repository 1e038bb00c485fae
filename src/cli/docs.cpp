// facetmill docs: the manual, embedded in the executable.

#include "base/text/spelling.hpp"
#include "base/text/words.hpp"
#include "cli/command.hpp"
#include "cli/topics.hpp"
#include "docs/man_markdown.hpp"
#include "docs/manual.hpp"
#include "docs/messages.hpp"
#include "docs/ready.hpp"
#include "docs/stages.hpp"
#include "stage/stage.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <span>

namespace facetmill::cli {

namespace {

constexpr const char* docs_examples =
    R"(Guides and pages are printed in Markdown. A command is printed like its --help, a stage like facetmill stages, and
the id of a message like facetmill explain. For any other word, facetmill lists the topics that contain it.

Examples
  facetmill docs
  facetmill docs guides
  facetmill docs scan-to-web
  facetmill docs simplify | less
  facetmill docs W-UNITS
)";

void add_pages(Topic::Kind kind, const std::vector<docs::ManualPage>& pages, std::vector<Topic>& all) {
    for (const auto& page : pages)
        all.push_back({kind, std::string(page.name), docs::title_of(page), page.text});
}

struct TopicGroup {
    Topic::Kind kind;
    const char* title;
};
constexpr TopicGroup groups[] = {{Topic::Kind::guide, "Guides"},
                                 {Topic::Kind::page, "Pages"},
                                 {Topic::Kind::command, "Commands"},
                                 {Topic::Kind::stage, "Stages"}};

/// The topics of these groups.
std::string topic_list(std::span<const TopicGroup> some) {
    std::string text =
        "facetmill docs TOPIC prints one of these topics, or explains an id (E-KEY, W-UNITS).\n";
    const auto all = topics();
    for (const auto& [kind, title] : some) {
        text += fmt::format("\n{}\n", title);
        for (const Topic& topic : all)
            if (topic.kind == kind) text += fmt::format("  {:<16}  {}\n", topic.name, topic.about);
    }
    return text +
           "\nfacetmill explain lists the ids of errors and warnings, facetmill formats the formats.\n";
}

/// The guides, pages and stages that contain a word.
std::string topics_with(const std::string& word) {
    std::vector<std::string> names;
    for (const Topic& topic : topics()) {
        if (topic.kind == Topic::Kind::command) continue;
        const std::string text = topic.kind == Topic::Kind::stage ? docs::stage_page(*stage_named(topic.name))
                                                                  : std::string(topic.text);
        if (lower_case(text).find(lower_case(word)) != std::string::npos) names.push_back(topic.name);
    }
    if (names.empty()) return "facetmill docs lists the topics";
    return fmt::format("it occurs in: {}", fmt::join(names, ", "));
}

std::string names_near(const std::string& word) {
    if (docs::ready_pipeline(word))
        return fmt::format("facetmill new --from {} shows the purpose of this pipeline, and its params",
                           word);
    std::vector<std::string> names;
    for (const Topic& topic : topics()) names.push_back(topic.name);
    for (const auto& m : message_ids()) names.emplace_back(m.id);
    const std::string near = did_you_mean(word, names);
    return near.empty() ? topics_with(word) : near;
}

int print_docs(const std::string& name, const CommandLine& line, Console& console) {
    if (name.empty()) {
        print(topic_list(groups));
        return 0;
    }
    const auto all = topics();
    const auto topic =
        std::find_if(all.begin(), all.end(), [&](const Topic& t) { return same_word(t.name, name); });
    const auto* const group = std::find_if(std::begin(groups), std::end(groups),
                                           [&](const TopicGroup& g) { return lower_case(g.title) == name; });
    if (topic == all.end() && group != std::end(groups)) { // stages is a page
        print(topic_list({group, 1}));
        return 0;
    }
    if (topic == all.end()) {
        const MessageId* message = message_id(docs::id_of(name));
        if (!message)
            throw Error(ErrorKind::usage, "E-ARGUMENT", fmt::format("topic '{}' does not exist", name),
                        stage_called(name) ? hint_for_stage(name, {}) : names_near(name), line.find(name));
        print(docs::message_page(*message));
        return 0;
    }
    if (topic->kind == Topic::Kind::command) return program({topic->name, "--help"}, console);
    print(topic->kind == Topic::Kind::stage ? docs::stage_page(*stage_named(topic->name))
                                            : std::string(topic->text));
    return 0;
}

} // namespace

std::vector<Topic> topics() {
    std::vector<Topic> all;
    add_pages(Topic::Kind::guide, docs::guides(), all);
    add_pages(Topic::Kind::page, docs::manual_pages(), all);
    static const std::string of_files = docs::markdown_of_man(docs::pipeline_man_page().text);
    all.push_back({Topic::Kind::page, std::string(docs::pipeline_man_page().name),
                   "Pipeline files: keys, steps, expressions", of_files});
    for (const auto& command : commands()) all.push_back({Topic::Kind::command, command.name, command.about});
    for (const auto& stage : stages()) all.push_back({Topic::Kind::stage, stage.name, stage.about});
    return all;
}

Command docs_command() {
    return {"docs",
            "Prints the manual: guides, pages, commands, stages, messages.",
            docs_examples,
            {},
            [](Arguments& arguments, Console& console) {
                auto name = std::make_shared<std::string>();
                arguments.add("TOPIC", name.get(),
                              "A topic, or the id of a message. Default: lists all topics.");
                return [=, &console](const Invocation& i) { return print_docs(*name, i.line, console); };
            }};
}

} // namespace facetmill::cli
