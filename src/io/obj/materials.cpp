#include "io/obj/obj.hpp"

#include "io/flatten.hpp"
#include "io/text.hpp"

#include <fmt/format.h>
#include <set>

namespace facetmill::io::obj {

namespace fs = std::filesystem;

namespace {

void warn(ReadLog& log, const std::string& name, std::string message) {
    log.warnings.push_back({Severity::warning, "W-MTL", std::move(message), file_mark(name), ""});
}

/// A library's path beside the input, when it stays in the directory of the input: a mesh file does not
/// choose what else is read.
std::optional<fs::path> inside(const Input& input, std::string name) {
    for (char& c : name)
        if (c == '\\') c = '/';
    const fs::path relative = fs::path(name).lexically_normal();
    if (input.path().empty() || relative.empty() || relative.is_absolute() || *relative.begin() == "..")
        return {};
    return relative;
}

double fraction(double x) { return std::clamp(x, 0.0, 1.0); }

void read_library(const Input& library, std::vector<Material>& materials, ReadLog& log) {
    Text text(as_text(library.bytes()), library.name(), "E-MTL", '#');
    Material* current = nullptr;
    std::set<std::string> textures;
    do {
        const std::string_view word = text.word_on_line();
        if (word == "newmtl") {
            const std::string_view name = text.rest_of_line();
            const auto found = std::find_if(materials.begin(), materials.end(),
                                            [&](const auto& m) { return m.name == name; });
            current = found == materials.end() ? nullptr : &*found;
        } else if (!current) {
            continue;
        } else if (word == "Kd") {
            Text ahead = text;
            const std::string_view kind = ahead.word_on_line();
            if (kind == "spectral" || kind == "xyz") continue;
            for (int c = 0; c < 3; ++c)
                current->base_colour[c] =
                    fraction(text.at_line_end() ? current->base_colour[0] : text.coordinate("a colour"));
        } else if (word == "d" && !text.at_line_end()) {
            Text ahead = text;
            if (ahead.word_on_line() != "-halo")
                current->base_colour[3] = fraction(text.coordinate("an opacity"));
        } else if (word == "Tr" && !text.at_line_end()) {
            current->base_colour[3] = 1 - fraction(text.coordinate("a transparency"));
        } else if (word.starts_with("map_") || word == "bump" || word == "disp" || word == "refl") {
            textures.insert(std::string(text.rest_of_line()));
        }
    } while (text.next_line());
    if (!textures.empty())
        warn(log, library.name(), fmt::format("textures are not kept: {}", fmt::join(textures, ", ")));
}

} // namespace

void read_materials(const Input& input, const std::vector<Event>& events, std::vector<Material>& materials,
                    ReadLog& log) {
    std::set<std::string> met;
    for (const auto& e : events) {
        if (e.kind != Event::Kind::library || materials.empty() || !met.insert(e.text).second) continue;
        const auto path = inside(input, e.text);
        if (!path) {
            warn(log, input.name(),
                 fmt::format("the material file {} is not beside the mesh and is not read",
                             in_quotes(e.text)));
            continue;
        }
        try {
            const Input library = input.beside(*path);
            log.files.push_back(library.path());
            read_library(library, materials, log);
        } catch (const Error& error) {
            warn(log, input.name(),
                 fmt::format("materials keep their names only: {}", error.diagnostics().front().message));
        }
    }
}

std::string material_library(const std::vector<Material>& materials) {
    std::string text = "# written by facetmill\n";
    for (const auto& m : materials) {
        text += fmt::format("newmtl {}\nKd", m.name);
        for (int c = 0; c < 3; ++c) text += ' ', put_number(text, static_cast<float>(m.base_colour[c]));
        text += "\nd ";
        put_number(text, static_cast<float>(m.base_colour[3]));
        text += '\n';
    }
    return text;
}

} // namespace facetmill::io::obj
