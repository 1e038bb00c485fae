// Writes the text of an .mtl file.

#include "io/flatten.hpp"
#include "io/obj/materials.hpp"

#include <fmt/format.h>
#include <initializer_list>

namespace facetmill::io::obj {

namespace {

void put_numbers(std::string& text, std::initializer_list<double> numbers) {
    for (const double n : numbers) {
        text += ' ';
        put_number(text, n);
    }
}

void put_colour(std::string& text, const char* word, const std::optional<Colour>& c) {
    if (!c) return;
    text += word;
    put_numbers(text, {(*c)[0], (*c)[1], (*c)[2]});
    text += '\n';
}

void put_value(std::string& text, const char* word, const std::optional<double>& value) {
    if (!value) return;
    text += word;
    put_numbers(text, {*value});
    text += '\n';
}

/// Three numbers for -s and -o, because some readers require three.
void put_map(std::string& text, const char* word, const Map& map) {
    text += word;
    if (map.strength != 1) {
        text += " -bm";
        put_numbers(text, {map.strength});
    }
    if (map.scale != std::array<double, 2>{1, 1}) {
        text += " -s";
        put_numbers(text, {map.scale[0], map.scale[1], 1});
    }
    if (map.offset != std::array<double, 2>{0, 0}) {
        text += " -o";
        put_numbers(text, {map.offset[0], map.offset[1], 0});
    }
    if (map.clamp) text += " -clamp on";
    text += ' ' + map.file + '\n';
}

} // namespace

std::string material_library(const std::vector<std::pair<std::string, Description>>& materials) {
    static constexpr std::pair<const char*, const char*> words[] = {
        {"kd", "map_Kd"}, {"d", "map_d"},   {"ke", "map_Ke"},   {"ks", "map_Ks"},
        {"pr", "map_Pr"}, {"pm", "map_Pm"}, {"orm", "map_ORM"}, {"norm", "norm"}};
    std::string text = "# written by facetmill\n";
    for (const auto& [name, d] : materials) {
        text += "newmtl " + name + '\n';
        if (d.name) text += fmt::format("# {} {}\n", name_comment, *d.name);
        put_colour(text, "Kd", d.diffuse);
        put_value(text, "d", d.opacity);
        put_colour(text, "Ks", d.specular);
        put_value(text, "Ns", d.shininess);
        put_colour(text, "Ke", d.emission);
        put_value(text, "Pr", d.roughness);
        put_value(text, "Pm", d.metalness);
        if (d.double_sided) text += fmt::format("# {}\n", double_sided_comment);
        if (d.illumination) text += "illum " + std::to_string(*d.illumination) + '\n';
        for (const auto& [key, word] : words)
            if (const auto map = d.maps.find(key); map != d.maps.end()) put_map(text, word, map->second);
    }
    return text;
}

} // namespace facetmill::io::obj
