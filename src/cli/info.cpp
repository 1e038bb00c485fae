// facetmill info: the properties of mesh files.

#include "base/text/markup.hpp"
#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "batch/batch.hpp"
#include "cli/command.hpp"
#include "cli/command_steps.hpp"
#include "cli/confine.hpp"
#include "geometry/triangulate/face_kinds_fields.hpp"
#include "io/codec.hpp"
#include "io/gltf/contents/resolved_materials.hpp"
#include "io/gltf/read/skinned_pose.hpp"
#include "io/images/png.hpp"
#include "io/outputs/outputs.hpp"
#include "mesh/face.hpp"
#include "parallel/parallel.hpp"
#include "report/contents.hpp"
#include "report/render.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::cli {

namespace {

constexpr const char* info_examples =
    R"(Property names are the same as in validate, ensure, when and reports. A property that does not apply (the volume
of an open mesh) is null. With several files, --json prints a list with an entry for each file. The key error
of an entry is null, or gives the reason why the file cannot be read. The other keys are then missing. The
exit code is the most severe one.

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
    std::vector<std::string> asset_roots;
    SandboxOptions sandbox;
};

/// The information about a file.
struct FileInfo {
    Scene scene;
    Properties properties;
    Box drawn;                                 ///< the bounding box of the drawn contents
    std::optional<double> drawn_area;          ///< if a skin or morph targets move vertices
    std::vector<report::Component> components; ///< the largest components
    FaceKinds kinds;

    std::int64_t omitted() const {
        return properties.components - static_cast<std::int64_t>(components.size());
    }
};

/// The number in JSON notation.
std::string number_text(double number) { return Json(number).dump(); }

std::string value_text(const Property& property, const Properties& properties) {
    const auto value = property.get(properties);
    if (!value) return "-";
    if (property.truth()) return *value != 0 ? "yes" : "no";
    if (property.kind == PropertyKind::count) return std::to_string(static_cast<std::int64_t>(*value));
    return number_text(*value);
}

std::string row(std::string_view name, std::string_view value) {
    return fmt::format("  {:<20}{}\n", name, value);
}

/// A row with the number of entries, and a line for each.
std::string list_text(std::string_view name, const std::vector<std::string>& entries) {
    std::string text = row(name, entries.empty() ? "none" : std::to_string(entries.size()));
    for (const auto& entry : entries) text += fmt::format("    {}\n", entry);
    return text;
}

std::string named(const std::string& name) { return name.empty() ? "(unnamed)" : name; }

std::vector<std::string> attribute_texts(const Scene& scene) {
    std::vector<std::string> texts;
    for (const auto& a : report::attributes_of(scene))
        texts.push_back(fmt::format("{} ({}, {}, components {})", named(a.name), to_string(a.domain), a.type,
                                    a.components));
    return texts;
}

std::vector<std::string> part_texts(const Scene& scene) {
    std::vector<std::string> texts;
    for (const auto& p : report::parts_of(scene))
        texts.push_back(fmt::format("{} (vertices {}, wedges {}, faces {})", named(p.name), p.vertices,
                                    p.wedges, p.faces));
    return texts;
}

std::vector<std::string> material_texts(const Scene& scene) {
    std::vector<std::string> texts;
    for (const auto& m : scene.materials) texts.push_back(m.name);
    return texts;
}

/// "'body': 1240 faces, euler 2, closed, genus 0"
std::string component_text(const report::Component& component) {
    const Properties& p = component.properties;
    const auto count = [](std::int64_t n, const char* noun) {
        return counted(static_cast<std::size_t>(n), noun);
    };
    std::string text = fmt::format("'{}': {}, euler {}, {}", component.part, count(p.faces, "face"), p.euler,
                                   p.closed ? "closed" : "open, " + count(p.boundary_loops, "boundary loop"));
    if (p.genus) append_item(text, fmt::format("genus {}", *p.genus));
    return text;
}

/// A line for each of the largest components, if the mesh has several.
std::string components_text(const FileInfo& info) {
    if (info.components.size() < 2) return {};
    std::string text = row("components_detail", "the largest first");
    const std::size_t shown = std::min(info.components.size(), max_components_in_text);
    for (std::size_t i = 0; i < shown; ++i)
        text += fmt::format("    {}\n", component_text(info.components[i]));
    const auto more = static_cast<std::int64_t>(info.components.size() - shown) + info.omitted();
    return more > 0 ? text + fmt::format("    and {} more\n", more) : text;
}

/// The nonzero counts: "1240 triangle, 12 degenerate".
std::string kinds_text(const FaceKinds& kinds) {
    std::string text;
    for (const Field& field : face_kinds_fields().all) {
        const auto value = field.value(&kinds);
        if (field.count && field.count(&kinds) > 0)
            append_item(text, fmt::format("{} {}", field.count(&kinds), field.name));
        else if (const double* number = value ? std::get_if<double>(&*value) : nullptr;
                 number && *number != 0)
            append_item(text, fmt::format("{} {}", field.name, number_text(*number)));
    }
    return text.empty() ? "none" : text;
}

std::string point_text(const Vec3& p) {
    return fmt::format("[{},{},{}]", number_text(p.x), number_text(p.y), number_text(p.z));
}

std::string box_text(const Box& box) {
    return box.empty() ? "-" : point_text(box.min) + " to " + point_text(box.max);
}

/// Without faces (point clouds, lines), closedness and similar properties need no line, nor do zeros except
/// the number of faces.
bool applies(const Property& property, const Properties& properties) {
    if (properties.faces > 0 || property.name == "faces") return true;
    const auto value = property.get(properties);
    return value && *value != 0 && !property.truth();
}

std::string as_text(const std::string& name, const FileInfo& info) {
    const Box& bounds = info.properties.bounds;
    std::string text = name + "\n";
    for (const Property* p : report::told_properties(info.properties))
        if (applies(*p, info.properties)) text += row(p->name, value_text(*p, info.properties));
    text += row("bounds", box_text(bounds));
    if (info.drawn.min != bounds.min || info.drawn.max != bounds.max)
        text += row("drawn_bounds", box_text(info.drawn));
    if (info.drawn_area) text += row("drawn_area", number_text(*info.drawn_area));
    text += row("unit", to_string(info.scene.unit));
    text += row("up", to_string(info.scene.up));
    text += list_text("attributes", attribute_texts(info.scene));
    text += list_text("materials", material_texts(info.scene));
    text += list_text("parts", part_texts(info.scene));
    if (info.properties.faces == 0) return text;
    text += components_text(info);
    return text + row("face_kinds", kinds_text(info.kinds));
}

Json json_of(const std::string& mesh, const FileInfo& info) {
    Json json = {{"file", mesh}, {"error", nullptr}};
    json.update(report::scene_json(info.scene, info.properties));
    json["drawn_bounds"] = report::box_json(info.drawn);
    json["drawn_area"] = info.drawn_area.value_or(info.properties.area);
    json["components_detail"] = report::list_json(info.components, report::component_fields());
    json["components_omitted"] = info.omitted();
    json["face_kinds"] = face_kinds_fields().json(&info.kinds);
    return json;
}

/// The entry of a file that cannot be read.
Json json_of(const std::string& mesh, const Error& error) {
    const Diagnostic& first = error.diagnostics().front();
    return {{"file", mesh},
            {"error",
             {{"id", first.id}, {"message", first.message}, {"exit_code", static_cast<int>(error.kind())}}}};
}

/// Writes a larger version of the report's picture; several files appear side by side.
void write_picture(const std::vector<Picture>& pictures, const std::string& path) {
    constexpr std::size_t max_in_a_row = 4;
    const Picture sheet = sheet_of(pictures, std::min(pictures.size(), max_in_a_row));
    io::write_now(path, io::png(sheet));
}

Picture info_picture(const std::string& mesh, const Scene& scene, const Console& console) {
    PictureSettings settings;
    settings.width = 800;
    settings.height = 600;
    settings.point = 3; // the default of the stage
    std::vector<Diagnostic> warnings;
    io::MaterialResolver reader;
    settings.materials = reader.materials(scene, warnings);
    for (const auto& warning : warnings) console.diagnostic(warning);
    const auto posed = io::posed(scene);
    const Scene& seen = posed ? *posed : scene;
    if (const auto crowd = crowd_of(seen, settings))
        console.diagnostic({Severity::warning,
                            "W-FAR",
                            mesh + ": " + crowd_in_words(*crowd),
                            {},
                            fmt::format("use facetmill render {} -o part.png --at {} --zoom {} to see it",
                                        mesh, readable(crowd->middle, ","), crowd->zoom)});
    return picture_of(seen, settings);
}

double area_of(const Scene& scene) {
    double twice = 0;
    for (const Part& part : scene.parts)
        for (Index f = 0; f < part.mesh.face_count(); ++f)
            twice += length(area_vector(part.mesh, f, part.transform));
    return twice / 2;
}

FileInfo info_of(const std::string& mesh, const InfoOptions& options, const Console& console,
                 std::vector<Picture>& pictures) {
    ProgressSteps steps({3, options.picture.empty() ? 0.0 : 6.0, options.self_intersections ? 24.0 : 6.0, 2});
    const auto* codec = options.format.empty() ? nullptr : io::codec_named(options.format);
    io::ReadLog log;
    FileInfo info;
    info.scene = io::read_scene(io::Input::open(mesh), read_settings(options.asset_roots), log, codec);
    for (const auto& warning : log.warnings) console.diagnostic(warning);
    steps.next();
    if (!options.picture.empty()) pictures.push_back(info_picture(mesh, info.scene, console));
    steps.next();
    info.properties = inspect(info.scene, {options.self_intersections});
    info.drawn = io::posed_bounds(info.scene);
    if (const auto posed = io::posed(info.scene)) info.drawn_area = area_of(*posed);
    steps.next();
    info.components = report::largest_components(info.scene, info.properties, max_components);
    info.kinds = face_kinds(info.scene);
    return info;
}

int info(const InfoOptions& options, const Console& console) {
    if (std::count(options.meshes.begin(), options.meshes.end(), "-") > 1)
        throw Error(ErrorKind::usage, "E-DUPLICATE-INPUT", "standard input can be read only once",
                    "give - only once");
    AllowedFiles allowed;
    for (const auto& mesh : options.meshes) allow_input(allowed, mesh);
    allowed.read.insert(allowed.read.end(), options.asset_roots.begin(), options.asset_roots.end());
    if (!options.picture.empty()) allow_output(allowed, options.picture);
    confine(allowed, options.sandbox, console);
    set_threads(options.threads);
    Json all = Json::array();
    std::string text;
    std::vector<Picture> pictures;
    CommandSteps steps(console, options.meshes.size());
    int code = 0;
    for (const auto& mesh : options.meshes) {
        steps.next(mesh);
        try {
            const FileInfo info = info_of(mesh, options, console, pictures);
            if (options.json)
                all.push_back(json_of(mesh, info));
            else
                text += as_text(mesh, info);
        } catch (const Error& e) { // the other files are still shown
            if (options.meshes.size() == 1 && !options.json) throw;
            console.diagnostics(e);
            if (options.json) all.push_back(json_of(mesh, e));
            code = batch::worse_exit_code(code, static_cast<int>(e.kind()));
        }
    }
    if (options.json)
        text =
            (options.meshes.size() == 1 ? all[0] : all).dump(2, ' ', false, Json::error_handler_t::replace) +
            "\n";
    if (!pictures.empty()) write_picture(pictures, options.picture);
    steps.done();
    options.json ? print(text) : show(text);
    return code;
}

} // namespace

Command info_command() {
    return {"info",
            "Shows the properties of mesh files.",
            info_examples,
            {},
            [](Arguments& arguments, Console& console) {
                auto options = std::make_shared<InfoOptions>();
                arguments.add("MESH", &options->meshes, "Mesh files, or - for standard input.").required();
                arguments.add("--json", &options->json, "Prints JSON (facetmill schema info).");
                arguments.add("--self-intersections", &options->self_intersections,
                              "Also counts self-intersections, which takes time.");
                arguments
                    .add("--picture",
                         written_file("--picture", ".png", "E-PICTURE",
                                      "facetmill info --picture picture.png part.stl",
                                      [=](const std::string& path) { options->picture = path; }),
                         "Also writes a PNG image. Several files are shown next to each other.")
                    .followed_by("FILE.png");
                arguments
                    .add("--format", &options->format,
                         "Reads the files in this format, regardless of their content.")
                    .one_of(io::names_of_readers());
                add_threads_option(arguments, options->threads, "The number of threads. Default: all cores.");
                add_asset_root_option(arguments, options->asset_roots);
                add_sandbox_option(arguments, options->sandbox);
                add_message_options(arguments, console);
                return [=, &console](const Invocation&) { return info(*options, console); };
            }};
}

} // namespace facetmill::cli
