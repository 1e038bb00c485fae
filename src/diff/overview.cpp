#include "diff/overview.hpp"

#include "base/text/markup.hpp"
#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "report/check_text.hpp"
#include "report/html_parts.hpp"
#include "report/markdown_parts.hpp"
#include "report/render.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::report {

namespace {

/// A value of each file; whether it is good, if that can be decided.
struct SideRow {
    std::string name, a, b;
    std::optional<bool> good_a, good_b;
};

std::string value_text(const Property& p, const Properties& of) {
    const Found found = property_value(p, of);
    if (const auto* truth = std::get_if<bool>(&found)) return *truth ? "yes" : "no";
    if (const auto* count = std::get_if<std::int64_t>(&found); count && *count >= 0)
        return grouped(static_cast<std::uint64_t>(*count));
    return "-";
}

bool is_sound(const Property& p, const Properties& of) {
    const double value = p.get(of).value_or(p.truth() ? 1 : 0);
    return p.truth() ? value != 0 : value == 0;
}

std::vector<SideRow> rows_of(const Comparison& c) {
    std::vector<SideRow> rows;
    if (c.size_a && c.size_b) {
        const auto add = [&](const char* name, std::uint64_t a, std::uint64_t b) {
            rows.push_back({name, sized(a), sized(b), {}, {}});
        };
        add("bytes", c.size_a->bytes, c.size_b->bytes);
        add("bytes of geometry", c.size_a->kinds.geometry, c.size_b->kinds.geometry);
        add("bytes of textures", c.size_a->kinds.textures, c.size_b->kinds.textures);
        add("bytes of JSON", c.size_a->kinds.json, c.size_b->kinds.json);
    }
    for (const char* name : {"parts", "materials", "faces", "triangles", "vertices", "components"})
        if (const Property* p = property_named(name))
            rows.push_back({name, value_text(*p, c.properties_a), value_text(*p, c.properties_b), {}, {}});
    for (const Property& p : property_table())
        if (p.soundness != Soundness::none)
            rows.push_back({std::string(p.name), value_text(p, c.properties_a), value_text(p, c.properties_b),
                            is_sound(p, c.properties_a), is_sound(p, c.properties_b)});
    return rows;
}

std::string side_cell(const std::string& text, std::optional<bool> good) {
    if (!good) return number_cell(escaped(text));
    return number_cell(fmt::format("<span class=\"{}\">{}</span>", *good ? "good" : "bad", escaped(text)));
}

const char* kind_of_change(ItemChange::Change change) {
    return change == ItemChange::Change::same      ? "good"
           : change == ItemChange::Change::removed ? "bad"
                                                   : "warn";
}

/// "3 changed, 1 added, 12 the same".
std::string tally(const std::vector<const ItemChange*>& items) {
    using Change = ItemChange::Change;
    std::string text;
    for (const Change change : {Change::removed, Change::added, Change::changed, Change::same}) {
        const auto count =
            std::count_if(items.begin(), items.end(), [&](auto* i) { return i->change == change; });
        if (count > 0) append_item(text, fmt::format("{} {}", count, to_string(change)));
    }
    return text;
}

std::vector<const ItemChange*> items_of(const Comparison& c, bool parts) {
    std::vector<const ItemChange*> all;
    for (const ItemChange& item : c.items)
        if (item.is_part == parts) all.push_back(&item);
    return all;
}

/// The number of materials whose faces or lines moved, although the materials may be equal; follows the
/// tally. Empty for zero.
std::string elsewhere(const Comparison& c) {
    const auto count = std::count_if(c.lines.begin(), c.lines.end(), [](const Difference& d) {
        return d.section == "materials" && !d.same && d.compared && d.of_places;
    });
    return count == 0
               ? ""
               : fmt::format("; {} of them cover different areas (see the section materials below)", count);
}

/// The items that are not equal, up to a limit.
std::vector<const ItemChange*> told_items(const std::vector<const ItemChange*>& all) {
    constexpr std::size_t most = 100;
    std::vector<const ItemChange*> told;
    for (const auto* item : all)
        if (item->change != ItemChange::Change::same && told.size() < most) told.push_back(item);
    return told;
}

std::string item_table(const Comparison& c, bool parts) {
    const auto all = items_of(c, parts);
    if (all.empty()) return {};
    std::string rows;
    for (const auto* item : told_items(all))
        rows += fmt::format("<tr>{}{}{}{}{}</tr>\n",
                            cell(fmt::format("<span class=\"{}\">{}</span>", kind_of_change(item->change),
                                             to_string(item->change))),
                            cell(code(item->name)), cell(escaped(item->before)), cell(escaped(item->after)),
                            cell(escaped(item->note)));
    const char* title = parts ? "Parts by name" : "Materials by name";
    const std::string counts = tally(all) + (parts ? std::string() : elsewhere(c));
    if (rows.empty()) return fmt::format("<h2>{}</h2>\n<p>{}</p>\n", title, counts);
    return table(title, heads({"change", "name", "first", "second", "difference"}), rows) +
           fmt::format("<p class=\"soft\">{}</p>\n", counts);
}

void add_markdown_items(const Comparison& c, bool parts, std::string& out) {
    std::vector<std::vector<std::string>> rows;
    for (const auto* item : told_items(items_of(c, parts)))
        rows.push_back({to_string(item->change), markdown_escaped(item->name), markdown_escaped(item->before),
                        markdown_escaped(item->after), markdown_escaped(item->note)});
    out += markdown_table(parts ? "Parts by name" : "Materials by name",
                          {"change", "name", "first", "second", "difference"}, rows);
}

} // namespace

std::string soundness_text(const Properties& properties) {
    std::string missing;
    std::size_t all = 0, good = 0;
    for (const Property& p : property_table()) {
        if (p.soundness == Soundness::none) continue;
        ++all;
        if (is_sound(p, properties))
            ++good;
        else
            append_item(missing, p.truth() ? fmt::format("not {}", p.name)
                                           : fmt::format("{} {}", value_text(p, properties), p.name));
    }
    return good == all ? "sound" : fmt::format("{} of {} checks passed: {}", good, all, missing);
}

std::string overview_html(const Comparison& c) {
    std::string rows = fmt::format("<tr><th scope=\"row\">soundness</th>{}{}</tr>\n",
                                   number_cell(escaped(soundness_text(c.properties_a))),
                                   number_cell(escaped(soundness_text(c.properties_b))));
    for (const SideRow& row : rows_of(c))
        rows += fmt::format("<tr><th scope=\"row\">{}</th>{}{}</tr>\n", escaped(row.name),
                            side_cell(row.a, row.good_a), side_cell(row.b, row.good_b));
    return table("Side by side", heads({"", "#first", "#second"}), rows) + item_table(c, true) +
           item_table(c, false);
}

std::string overview_markdown(const Comparison& c) {
    std::vector<std::vector<std::string>> rows{{"soundness", markdown_escaped(soundness_text(c.properties_a)),
                                                markdown_escaped(soundness_text(c.properties_b))}};
    for (const SideRow& row : rows_of(c)) rows.push_back({markdown_escaped(row.name), row.a, row.b});
    std::string out = markdown_table("Side by side", {"", "first", "second"}, rows);
    add_markdown_items(c, true, out);
    add_markdown_items(c, false, out);
    return out;
}

} // namespace facetmill::report
