// The formats that helper programs read.

#include "base/lazy.hpp"
#include "io/flatten.hpp"
#include "io/images/image_files.hpp"
#include "io/import/door.hpp"
#include "io/import/stated_unit.hpp"
#include "io/packing.hpp"
#include "platform/worker_process.hpp"

#include <fmt/format.h>

namespace facetmill::io::import {

namespace {

namespace fs = std::filesystem;

struct Format {
    const char* name;
    const char* about;
    std::vector<std::string> extensions;
    const char* helper;
    Unit unit;
    UpAxis up;
    int (*sniff)(std::string_view begin);
    Unit (*stated)(std::string_view file) = nullptr;
};

bool is_cad(const Format& format) { return format.helper == cad_helper; }

/// The unit of the scene: what the file states, otherwise that of the format.
Unit unit_of(const Input& input, const Format& format) {
    const Unit stated = format.stated ? format.stated(as_text(input.bytes())) : Unit::unknown;
    return stated == Unit::unknown ? format.unit : stated;
}

DoorOrder order_for(const Input& input, const ReadSettings& settings, const Format& format) {
    DoorOrder order{format.helper, {"--format", format.name}};
    const auto add = [&](const char* option, std::string value) {
        order.arguments.emplace_back(option);
        order.arguments.push_back(std::move(value));
    };
    std::error_code failed;
    if (!input.path().empty()) {
        const fs::path file = fs::absolute(input.path(), failed);
        add("--name", without_packing(file.filename()).string());
        order.read.push_back(file.parent_path());
        order.read.insert(order.read.end(), input.asset_roots().begin(), input.asset_roots().end());
        for (const fs::path& folder : order.read) add("--folder", folder.string());
    }
    // A given unit or axis states what the numbers of the file mean, so they stay as they are. Numbers of
    // solids stay always, because the result has the unit of the file.
    if (settings.unit) order.arguments.emplace_back("--keep-unit");
    if (settings.up) order.arguments.emplace_back("--keep-up");
    if (!is_cad(format)) return order;
    if (settings.curves.deviation > 0)
        add("--deviation", fmt::format("{}", settings.curves.deviation));
    else
        add("--ratio", fmt::format("{}", settings.curves.ratio));
    add("--angle", fmt::format("{}", settings.curves.degrees));
    add("--unit", fmt::format("{}", metres(unit_of(input, format))));
    return order;
}

/// The texts of a list in the notes, which are untrusted.
std::vector<std::string> texts(const Json& notes, const char* list) {
    constexpr std::size_t most = 1000;
    std::vector<std::string> all;
    if (!notes.contains(list) || !notes[list].is_array()) return all;
    for (const Json& text : notes[list])
        if (text.is_string() && all.size() < most) all.push_back(one_line(text.get<std::string>()));
    return all;
}

void take_notes(const Json& notes, const Input& input, ReadLog& log) {
    for (const std::string& text : texts(notes, "warnings"))
        log.warnings.push_back({Severity::warning, "W-IMPORT", text, file_mark(input.name()), "", true});
    for (const std::string& name : texts(notes, "files"))
        if (const auto path = path_below(input, name)) log.files.push_back({*path});
    for (const std::string& name : texts(notes, "absent"))
        if (const auto path = path_below(input, name)) log.absent.push_back(*path);
    // Another release of the helper's library may read the same file differently.
    log.unrepeatable = true;
}

/// The answer as an input whose neighbours are those of the file.
Input converted(const Input& input, const ReadSettings& settings, const Format& format, ReadLog& log) {
    Answer answer = ask_helper(input, order_for(input, settings, format));
    take_notes(answer.notes, input, log);
    return input.with(std::move(answer.glb));
}

/// Calls body, which reads the answer. Errors in it are errors of the helper.
template <class Body>
auto as_import(const Input& input, Body&& body) {
    try {
        return body();
    } catch (const Error& e) {
        if (e.kind() != ErrorKind::malformed) throw;
        throw Error(ErrorKind::malformed, "E-IMPORT",
                    fmt::format("'{}' cannot be read: its conversion is not valid glTF: {}", input.name(),
                                e.diagnostics().front().message),
                    "open it in the program that made it, and export it as glTF (.glb) or STL",
                    file_mark(input.name()));
    }
}

/// Each vertex belongs to one face of the solid, so its number becomes an attribute of the triangles.
void take_cad_faces(Mesh& mesh) {
    constexpr std::string_view sent = "_CAD_FACE", kept = "cad_face";
    const Attribute* numbers = mesh.find(sent, Domain::wedge);
    const auto* values = numbers ? std::get_if<std::vector<float>>(&numbers->data) : nullptr;
    if (!values) return;
    std::vector<Index> faces;
    faces.reserve(mesh.face_count());
    constexpr float most = 1 << 24; // whole numbers of float
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const float number = (*values)[mesh.face_wedges(f).front()];
        faces.push_back(number >= 0 && number <= most ? static_cast<Index>(number) : 0);
    }
    mesh.drop(sent, Domain::wedge);
    for (Primitive& primitive : mesh.primitives) std::erase(primitive.attributes, sent);
    mesh.attributes.push_back({std::string(kept), Domain::face, Role::index, 1, false, std::move(faces)});
}

Scene read(const Input& input, const ReadSettings& settings, ReadLog& log, const Format& format) {
    const Input glb = converted(input, settings, format, log);
    return as_import(input, [&] {
        Scene scene = codec_named("glb")->read(glb, settings, log);
        log.has_solids = is_cad(format);
        for (Part& part : scene.parts) take_cad_faces(part.mesh);
        scene.unit = settings.unit.value_or(unit_of(input, format));
        scene.up = settings.up.value_or(format.up);
        return scene;
    });
}

/// The header is short, but materials and images are known only after the conversion.
void peek(const Input& input, FileHeader& header, const Format& format) {
    const Lazy<FileHeader> of_answer([input, format] {
        ReadLog ignored;
        const Input glb = converted(input, {}, format, ignored);
        FileHeader inner;
        as_import(input, [&] { codec_named("glb")->peek(glb, inner); });
        return inner;
    });
    header.has_materials = [of_answer] { return of_answer->has_materials && of_answer->has_materials(); };
    if (format.stated) header.unit = unit_of(input, format);
    if (is_cad(format)) return; // its helper sends no images
    header.images = [of_answer] {
        return of_answer->images ? of_answer->images() : std::vector<NamedImage>();
    };
}

std::string missing(const Format& format) {
    if (helper_program(format.helper)) return {};
    if (!has_workers())
        return fmt::format("convert the file on Linux, where facetmill can read {} files", format.name);
    return fmt::format("install {} beside facetmill to read {} files: build facetmill where {} is installed "
                       "(tools/deps.sh --imports)",
                       format.helper, format.name, is_cad(format) ? "Open CASCADE" : "assimp");
}

// --- contents

bool has(std::string_view begin, std::string_view text) { return begin.find(text) != begin.npos; }
int certain(bool is) { return is ? 2 : 0; }

int sniff_fbx(std::string_view begin) {
    return certain(begin.starts_with("Kaydara FBX Binary") || begin.starts_with("; FBX "));
}
int sniff_lwo(std::string_view begin) {
    constexpr std::size_t kind = 8;
    return certain(begin.starts_with("FORM") && begin.size() > kind && begin.substr(kind).starts_with("LW"));
}
int sniff_step(std::string_view begin) {
    return certain(begin.starts_with("ISO-10303-21") && !has(begin, "'IFC") && !has(begin, "\"IFC"));
}
int sniff_ifc(std::string_view begin) {
    return certain(begin.starts_with("ISO-10303-21") && (has(begin, "'IFC") || has(begin, "\"IFC")));
}
int sniff_iges(std::string_view begin) {
    constexpr std::size_t column = 72;
    return begin.size() > column && begin.substr(column).starts_with("S      1") ? 2 : 0;
}
int sniff_brep(std::string_view begin) {
    return certain(has(begin.substr(0, 200), "DBRep_DrawableShape") || // the Draw program adds this line
                   has(begin.substr(0, 200), "CASCADE Topology V"));
}

std::vector<Format> formats() {
    const auto scenes = [](const char* name, const char* about, std::vector<std::string> extensions,
                           int (*sniff)(std::string_view), Unit unit = Unit::m, UpAxis up = UpAxis::y) {
        return Format{name, about, std::move(extensions), scenes_helper, unit, up, sniff};
    };
    const auto cad = [](const char* name, const char* about, std::vector<std::string> extensions,
                        int (*sniff)(std::string_view), Unit (*stated)(std::string_view) = nullptr) {
        return Format{name, about, std::move(extensions), cad_helper, Unit::mm, UpAxis::z, sniff, stated};
    };
    return {
        scenes("fbx", "Autodesk FBX", {"fbx"}, sniff_fbx),
        scenes("dae", "COLLADA", {"dae"}, [](std::string_view b) { return certain(has(b, "<COLLADA")); }),
        scenes(
            "3ds", "Autodesk 3D Studio", {"3ds"}, [](std::string_view) { return 0; }, Unit::unknown),
        scenes("amf", "Additive Manufacturing File, as XML", {"amf"},
               [](std::string_view b) { return certain(has(b, "<amf")); }),
        scenes("x3d", "X3D as XML, and VRML where the library reads it", {"x3d", "wrl"},
               [](std::string_view b) { return certain(has(b, "<X3D") || b.starts_with("#VRML")); }),
        scenes("lwo", "LightWave object", {"lwo"}, sniff_lwo),
        scenes("blend", "Blender, old releases", {"blend"},
               [](std::string_view b) { return certain(b.starts_with("BLENDER")); }),
        scenes("ifc", "Industry Foundation Classes", {"ifc"}, sniff_ifc),
        scenes(
            "md5", "id Tech 4 model", {"md5mesh"},
            [](std::string_view b) { return certain(b.starts_with("MD5Version")); }, Unit::unknown),
        scenes(
            "x", "DirectX model", {"x"}, [](std::string_view b) { return certain(b.starts_with("xof 03")); },
            Unit::unknown),
        cad("step", "STEP, solids become triangles", {"step", "stp"}, sniff_step, unit_of_step),
        cad("iges", "IGES, surfaces become triangles", {"iges", "igs"}, sniff_iges, unit_of_iges),
        cad("brep", "Open CASCADE shapes, become triangles", {"brep"}, sniff_brep),
    };
}

Codec codec_of(const Format& format) {
    Codec codec;
    codec.name = format.name;
    codec.about = format.about;
    codec.extensions = format.extensions;
    codec.unit = format.unit;
    codec.up = format.up;
    codec.can = {.transforms = true, .skins = !is_cad(format), .points = !is_cad(format)};
    codec.can.lines = codec.can.points_and_faces = codec.can.documents = !is_cad(format);
    codec.can.curves = is_cad(format);
    codec.can.attributes = is_cad(format) ? "normals, colours, cad_face" : "all that glTF has";
    codec.sniff = [sniff = format.sniff](Span bytes) {
        constexpr std::size_t near = 4096;
        return sniff(as_text(bytes.first(std::min(near, bytes.size()))));
    };
    codec.read = [format](const Input& input, const ReadSettings& settings, ReadLog& log) {
        return read(input, settings, log, format);
    };
    codec.peek = [format](const Input& input, FileHeader& header) { peek(input, header, format); };
    codec.missing = [format] { return missing(format); };
    return codec;
}

/// Registers all at the start of the program.
[[maybe_unused]] const bool registered = [] {
    for (const Format& format : formats()) (void)RegisterCodec(codec_of(format));
    return true;
}();

} // namespace

} // namespace facetmill::io::import
