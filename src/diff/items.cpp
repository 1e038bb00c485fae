#include "diff/items.hpp"

#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "io/gltf/gltf.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace facetmill::report {

namespace {

std::string told_of(const Part& part) {
    return fmt::format("{} {}, {} {}", grouped(part.mesh.face_count()),
                       noun_for(part.mesh.face_count(), "face"), grouped(part.mesh.vertex_count()),
                       noun_for(part.mesh.vertex_count(), "vertex", "vertices"));
}

/// The largest movement of a vertex.
double farthest_move(const Part& a, const Part& b) {
    double most = 0;
    for (std::size_t v = 0; v < a.mesh.vertex_count(); ++v)
        most = std::max(
            most, length(a.transform.point(a.mesh.positions[v]) - b.transform.point(b.mesh.positions[v])));
    return most;
}

/// Empty if they are equal.
std::string part_note(const Part& a, const Part& b, double most) {
    if (a.mesh.face_count() != b.mesh.face_count() || a.mesh.vertex_count() != b.mesh.vertex_count())
        return "different counts";
    if (a.mesh.corners != b.mesh.corners || a.mesh.face_offsets != b.mesh.face_offsets)
        return "different faces";
    const double move = farthest_move(a, b);
    return move > most ? fmt::format("moved by up to {:.4g}", move) : "";
}

std::string colour_text(const Material& m) {
    const double* c = m.base_colour;
    return fmt::format("{:.3g} {:.3g} {:.3g} {:.3g}{}", c[0], c[1], c[2], c[3],
                       m.double_sided ? ", double-sided" : "");
}

Json contents_or_null(io::MaterialContents& contents, const Material& material) {
    try {
        return contents.of(material);
    } catch (const Error&) {
        return nullptr;
    }
}

/// "different emissiveTexture, roughnessFactor": the differences of two glTF materials; empty if equal.
std::string look_note(const Json& a, const Json& b) {
    if (a == b) return {};
    if (!a.is_object() || !b.is_object()) return "different properties";
    std::string keys;
    const auto add = [&](const Json& x, const Json& y) {
        for (const auto& [key, value] : x.items())
            if (!value.is_object() || key != "pbrMetallicRoughness")
                if (!y.contains(key) || y[key] != value) append_item(keys, key);
        for (const auto& [key, value] : y.items())
            if (key != "pbrMetallicRoughness" && !x.contains(key)) append_item(keys, key);
    };
    const Json none_told = Json::object();
    const auto pbr = [&](const Json& m) { return m.value("pbrMetallicRoughness", none_told); };
    add(a, b);
    add(pbr(a), pbr(b));
    return keys.empty() ? "different properties" : "different " + keys;
}

/// Pairs each item of the first list with an unused item of the same name in the second.
class Pairing {
  public:
    template <class List>
    explicit Pairing(const List& second) : taken_(second.size()) {
        for (std::size_t i = 0; i < second.size(); ++i) by_name_.emplace(second[i].name, i);
    }
    /// Its index; none if no item of that name is left.
    std::optional<std::size_t> take(const std::string& name) {
        const auto found = by_name_.find(name);
        if (found == by_name_.end()) return {};
        const std::size_t number = found->second;
        by_name_.erase(found);
        taken_[number] = true;
        return number;
    }
    bool is_taken(std::size_t i) const { return taken_[i]; }

  private:
    std::multimap<std::string, std::size_t> by_name_; // equal names in order of insertion
    std::vector<bool> taken_;
};

template <class List, class Tell, class Note>
void add_changes(const List& a, const List& b, bool are_parts, Tell&& tell, Note&& note,
                 std::vector<ItemChange>& out) {
    using Change = ItemChange::Change;
    Pairing pairs(b);
    for (const auto& item : a) {
        const auto other = pairs.take(item.name);
        if (!other) {
            out.push_back({are_parts, item.name, Change::removed, tell(item), "", ""});
            continue;
        }
        const std::string how = note(item, b[*other]);
        out.push_back({are_parts, item.name, how.empty() ? Change::same : Change::changed, tell(item),
                       tell(b[*other]), how});
    }
    for (std::size_t i = 0; i < b.size(); ++i)
        if (!pairs.is_taken(i)) out.push_back({are_parts, b[i].name, Change::added, "", tell(b[i]), ""});
}

} // namespace

const char* to_string(ItemChange::Change change) {
    switch (change) {
    case ItemChange::Change::added:
        return "added";
    case ItemChange::Change::removed:
        return "removed";
    case ItemChange::Change::changed:
        return "changed";
    case ItemChange::Change::same:
        break;
    }
    return "same";
}

std::vector<ItemChange> item_changes(const Scene& a, const Scene& b, double most) {
    std::vector<ItemChange> out;
    add_changes(
        a.parts, b.parts, true, told_of, [&](const Part& x, const Part& y) { return part_note(x, y, most); },
        out);
    io::MaterialContents of_a(a), of_b(b);
    const auto note = [&](const Material& x, const Material& y) -> std::string {
        if (!std::equal(std::begin(x.base_colour), std::end(x.base_colour), std::begin(y.base_colour)))
            return "different colour";
        if (x.double_sided != y.double_sided) return "only one is double-sided";
        return look_note(contents_or_null(of_a, x), contents_or_null(of_b, y));
    };
    add_changes(a.materials, b.materials, false, colour_text, note, out);
    return out;
}

} // namespace facetmill::report
