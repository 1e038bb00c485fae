// facetmill info: the properties of mesh files.

#include "base/parallel.hpp"
#include "base/words.hpp"
#include "cli/command.hpp"
#include "geometry/triangulate/face_kinds_fields.hpp"
#include "io/codec.hpp"
#include "io/gltf/looks.hpp"
#include "io/outputs.hpp"
#include "io/png.hpp"
#include "report/render.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::cli {

namespace {

constexpr const char* info_examples =
    R"(The names are those of validate, ensure, when and the report. A property that does not apply (the volume of an
open mesh) is null. With several files --json prints a list.

Examples
  facetmill info scan.ply
  facetmill info --json part.stl | jq .closed
  facetmill info --self-intersections part.stl
  facetmill info --picture part.png part.stl
  zcat scan.ply.gz | facetmill info -
)";

constexpr std::size_t max_components = 100, max_components_in_text = 10;

struct InfoOptions {
    std::vector<std::string> meshes;
    std::string format, picture;
    bool json = false, self_intersections = false;
    int threads = 0;
};

std::string text_of(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_null()) return "-";
    if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
    return value.dump();
}

/// "NORMAL (wedge, float32)" for an attribute, the name of a part or material.
std::string entry_text(const Json& entry) {
    if (!entry.is_object()) return text_of(entry);
    std::string text = entry.contains("name") ? text_of(entry["name"]) : "", more;
    if (text.empty()) text = "(unnamed)";
    for (const auto& [key, value] : entry.items())
        if (key != "name" && value.is_primitive())
            more += (more.empty() ? "" : ", ") + (key == "domain" || key == "type" ? "" : key + " ") +
                    text_of(value);
    return more.empty() ? text : fmt::format("{} ({})", text, more);
}

/// "'body': 1240 faces, euler 2, closed, genus 0"
std::string component_text(const Json& component) {
    const auto count = [&](const char* key, const char* noun) {
        return counted(component[key].get<std::size_t>(), noun);
    };
    std::string text = fmt::format("'{}': {}, euler {}, ", text_of(component["part"]), count("faces", "face"),
                                   text_of(component["euler"]));
    if (component["closed"].get<bool>())
        text += "closed";
    else
        text += "open, " + count("boundary_loops", "boundary loop");
    return component["genus"].is_null() ? text : text + ", genus " + text_of(component["genus"]);
}

/// "1240 triangle, 12 degenerate": what there is of each kind.
std::string kinds_text(const Json& kinds) {
    std::string text;
    for (const auto& [kind, value] : kinds.items()) {
        if (value == 0) continue;
        const std::string words =
            kind == "deviation" ? "deviation " + text_of(value) : text_of(value) + " " + kind;
        text += (text.empty() ? "" : ", ") + words;
    }
    return text.empty() ? "none" : text;
}

/// A line for each of the largest components, where there are several.
std::string components_text(const Json& components, std::int64_t omitted) {
    if (components.size() < 2) return {};
    std::string text = fmt::format("  {:<20}{}\n", "components_detail", "the largest first");
    const std::size_t shown = std::min(components.size(), max_components_in_text);
    for (std::size_t i = 0; i < shown; ++i) text += fmt::format("    {}\n", component_text(components[i]));
    const auto more = static_cast<std::int64_t>(components.size() - shown) + omitted;
    return more > 0 ? text + fmt::format("    and {} more\n", more) : text;
}

std::string as_text(const std::string& name, const Json& info) {
    std::string text = name + "\n";
    for (const auto& [key, value] : info.items()) {
        if (key == "components_omitted") continue; // told with those that are listed
        if (key == "components_detail")
            text += components_text(value, info["components_omitted"].get<std::int64_t>());
        else if (value.is_array()) {
            text += fmt::format("  {:<20}{}\n", key, value.empty() ? "none" : std::to_string(value.size()));
            for (const auto& entry : value) text += fmt::format("    {}\n", entry_text(entry));
        } else if (key == "bounds" && value.is_object())
            text += fmt::format("  {:<20}{} to {}\n", key, value["min"].dump(), value["max"].dump());
        else if (key == "face_kinds")
            text += fmt::format("  {:<20}{}\n", key, kinds_text(value));
        else
            text += fmt::format("  {:<20}{}\n", key, text_of(value));
    }
    return text;
}

/// The picture that reports show, larger; of several files beside each other.
void write_picture(const std::vector<Picture>& pictures, const std::string& path) {
    constexpr std::size_t max_in_a_row = 4;
    const Picture sheet = sheet_of(pictures, std::min(pictures.size(), max_in_a_row));
    io::write_now(path, io::png(sheet));
}

Picture info_picture(const Scene& scene, const Console& console) {
    PictureSettings settings;
    settings.width = 800;
    settings.height = 600;
    std::vector<Diagnostic> warnings;
    io::LookReader reader;
    settings.looks = reader.looks(scene, warnings);
    for (const auto& warning : warnings) console.diagnostic(warning);
    return picture_of(scene, settings);
}

Json info_of(const std::string& mesh, const InfoOptions& options, const Console& console,
             std::vector<Picture>& pictures) {
    const auto* codec = options.format.empty() ? nullptr : io::codec_named(options.format);
    io::ReadLog log;
    const Scene scene = io::read_scene(io::Input::open(mesh), {}, log, codec);
    for (const auto& warning : log.warnings) console.diagnostic(warning);
    if (!options.picture.empty()) pictures.push_back(info_picture(scene, console));
    const Properties properties = inspect(scene, {options.self_intersections});
    Json info = report::scene_json(scene, properties);
    Json& components = info["components_detail"] = report::components_json(scene, properties, max_components);
    const auto listed = static_cast<std::int64_t>(components.size());
    info["components_omitted"] = properties.components - listed;
    const FaceKinds kinds = face_kinds(scene);
    info["face_kinds"] = face_kinds_fields().json(&kinds);
    return info;
}

int info(const InfoOptions& options, const Console& console, const CommandLine& line) {
    if (!options.picture.empty() && !options.picture.ends_with(".png"))
        throw Error(ErrorKind::usage, "E-PICTURE",
                    fmt::format("images are PNG, and '{}' does not end in .png", options.picture),
                    "for example --picture part.png", line.value(options.picture));
    set_threads(options.threads);
    Json all = Json::array();
    std::string text;
    std::vector<Picture> pictures;
    for (const auto& mesh : options.meshes) {
        all.push_back(info_of(mesh, options, console, pictures));
        if (!options.json) text += as_text(mesh, all.back());
    }
    if (options.json)
        text = (all.size() == 1 ? all[0] : all).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    if (!options.picture.empty()) write_picture(pictures, options.picture);
    print(text);
    return 0;
}

} // namespace

Command info_command() {
    return {"info", "Shows the properties of mesh files.", info_examples, false,
            [](Arguments& arguments, Console& console) {
                auto options = std::make_shared<InfoOptions>();
                arguments.add("MESH", &options->meshes, "Mesh files, or - for standard input.").required();
                arguments.add("--json", &options->json, "As JSON (facetmill schema info).");
                arguments.add("--self-intersections", &options->self_intersections,
                              "Also counts self-intersections, which takes time.");
                arguments.add("--picture", &options->picture,
                              "Also writes a PNG image; several files are shown side by side.");
                arguments
                    .add("--format", &options->format,
                         "Reads the files as this format, whatever their content.")
                    .one_of(io::names_of_readers());
                arguments.add("-j,--threads", &options->threads, "The number of threads. Default: all cores.")
                    .between(1, 4096);
                add_message_options(arguments, console);
                return [=, &console](const Invocation& invocation) {
                    return info(*options, console, invocation.line);
                };
            }};
}

} // namespace facetmill::cli
