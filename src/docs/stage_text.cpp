#include "base/text/words.hpp"
#include "docs/describe.hpp"
#include "docs/stages.hpp"
#include "stage/common_keys.hpp"

#include <fmt/format.h>

namespace facetmill::docs {

std::string stage_list() {
    std::size_t widest = 0;
    for (const auto& s : stages()) widest = std::max(widest, s.name.size());
    std::string text;
    for (const auto& s : stages()) text += fmt::format("{:<{}}  {}\n", s.name, widest, s.about);
    return text;
}

namespace {

std::string option_text(const OptionRow& row) {
    std::string head = fmt::format("  {} ({}", row.name, row.type);
    if (row.required) head += ", needed";
    if (!row.default_text.empty()) head += ", default " + row.default_text;
    head += row.primary ? "; a bare value sets it)\n" : ")\n";
    std::string text = head + wrapped(row.help, 6);
    for (const auto& c : row.choices)
        if (!c.help.empty()) text += wrapped(fmt::format("{}: {}", c.name, c.help), 8);
    return text;
}

std::string common_names() {
    std::string names;
    for (const auto& key : common_keys()) append_item(names, key.name);
    return names;
}

std::string field_text(const FieldRow& row) {
    std::string text = fmt::format("  {} ({})\n", row.name, row.type) + wrapped(row.help, 6);
    for (const auto& c : row.choices)
        if (!c.help.empty()) text += wrapped(fmt::format("{}: {}", c.name, c.help), 8);
    return text;
}

} // namespace

std::string details_of(const StageInfo& stage) {
    std::string text = joined_lines(stage.details);
    const auto add = [&](const char* sentences) {
        text += text.empty() ? sentences : std::string("\n\n") + sentences;
    };
    if (stage.crossing_faces == CrossingFacePolicy::fill)
        add(stage.chooses_crossing_faces
                ? "Before faces are cut or moved, planar faces that intersect themselves become triangles, "
                  "as in triangulate. W-FANS lists other faces that intersect themselves."
                : "Planar faces that intersect themselves become triangles first, as in triangulate. W-FANS "
                  "lists other faces that intersect themselves.");
    if (stage.crossing_faces == CrossingFacePolicy::name)
        add("Planar faces that intersect themselves count as the triangles that triangulate makes of them. "
            "W-FANS lists other faces that intersect themselves.");
    return text;
}

std::string stage_page(const StageInfo& stage) {
    std::string text = fmt::format("{}: {}\n", stage.name, stage.about);
    if (const std::string details = details_of(stage); !details.empty()) text += "\n" + wrapped(details, 2);
    const auto options = rows(*stage.options);
    if (!stage.options->shorthand_help.empty())
        text += "\n" + wrapped("A bare value: " + stage.options->shorthand_help, 2);
    text += options.empty() ? "\nOptions: none\n" : "\nOptions\n";
    for (const auto& row : options) text += option_text(row);
    for (const auto& rule : rules(*stage.options)) text += fmt::format("  Given: {}.\n", rule);
    text += fmt::format("\nAlso, as for every stage: {} (see facetmill-pipeline(5)).\n", common_names());
    if (const auto helps = spelling_helps(options); !helps.empty()) {
        text += "\n";
        for (const auto& help : helps) text += wrapped(help, 0);
    }
    if (!stage.result->all.empty()) text += "\nResult, in the report\n";
    for (const auto& row : rows(*stage.result)) text += field_text(row);
    if (!stage.examples.empty()) text += "\nExamples\n";
    for (const auto& example : stage.examples) text += fmt::format("  - {}\n", example);
    return text;
}

Json stages_json() {
    Json all = Json::array();
    for (const auto& s : stages()) {
        Json options = Json::array();
        for (const auto& row : rows(*s.options)) {
            Json option = {{"name", row.name}, {"type", row.type}, {"help", row.help}};
            if (!row.default_text.empty()) option["default"] = row.default_text;
            if (row.required) option["required"] = true;
            if (row.primary) option["primary"] = true;
            if (row.repeatable) option["repeatable"] = true;
            for (const auto& c : row.choices) option["choices"][c.name] = c.help;
            options.push_back(std::move(option));
        }
        Json result = Json::array();
        for (const auto& row : rows(*s.result))
            result.push_back({{"name", row.name}, {"type", row.type}, {"help", row.help}});
        all.push_back({{"name", s.name},
                       {"about", s.about},
                       {"details", details_of(s)},
                       {"options", options},
                       {"rules", rules(*s.options)},
                       {"result", result},
                       {"examples", s.examples}});
    }
    return all;
}

} // namespace facetmill::docs
