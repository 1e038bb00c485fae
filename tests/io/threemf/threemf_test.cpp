#include "support/catch.hpp"

#include "io/codec.hpp"
#include "io/packing.hpp"
#include "io/read_back.hpp"
#include "io/threemf/xml.hpp"
#include "io/threemf/zip.hpp"
#include "mesh/shapes.hpp"
#include "support/colours.hpp"
#include "support/failure.hpp"
#include "support/mutations.hpp"
#include "support/temporary.hpp"

#include <fmt/format.h>

namespace threemf_test {

using namespace facetmill;
using namespace facetmill::test;
using io::threemf::ArchiveFile;

namespace {

const std::string core = R"(xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02")";
const std::string colours = R"(xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02")";
const std::string production = R"(xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06")";
const std::string one_triangle = R"(<mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/>
<vertex x="0" y="1" z="0"/></vertices><triangles><triangle v1="0" v2="1" v3="2"/></triangles></mesh>)";

ArchiveFile file(std::string path, std::string_view text) {
    const auto bytes = bytes_of(text);
    return {std::move(path), {bytes.begin(), bytes.end()}};
}

/// An archive with the model where all writers put it.
io::Bytes archive(const std::string& model) {
    return io::threemf::make_archive({file("3D/3dmodel.model", model)});
}

struct Loaded {
    Scene scene;
    io::ReadLog log;
};

Loaded load(const io::Bytes& bytes, const io::ReadSettings& settings = {}) {
    Loaded loaded;
    loaded.scene = io::read_scene(io::Input::of("a.3mf", bytes), settings, loaded.log);
    CHECK(broken_invariants(loaded.scene).empty());
    return loaded;
}

std::string refused(const io::Bytes& bytes, const io::ReadSettings& settings = {}) {
    return failure([&] { load(bytes, settings); });
}

/// A model with these resources and items.
std::string model(const std::string& resources, const std::string& items, const std::string& more = "") {
    return fmt::format(
        "<?xml version=\"1.0\"?>\n<model {} {} {}><resources>{}</resources><build>{}</build></model>", core,
        colours, more, resources, items);
}

Loaded trip(const Scene& scene, io::WriteSettings settings = {}) {
    const io::Codec& codec = *io::codec_named("3mf");
    settings.title = "a";
    const io::Written written = codec.write(scene, settings);
    CHECK(codec.write(scene, settings).files[0].bytes == written.files[0].bytes);
    const io::ReadBack back =
        io::read_back(io::Input::of("a.3mf", written.files[0].bytes), codec, scene, settings, written);
    CHECK(back.losses.empty());
    Loaded loaded = load(written.files[0].bytes);
    for (const auto& warning : written.warnings) loaded.log.warnings.push_back({warning, true});
    return loaded;
}

/// The face's colour at a corner, as bytes of sRGB.
std::array<int, 4> colour_at(const Mesh& mesh, Index corner) {
    const Attribute* a = mesh.find("COLOR_0", Domain::wedge);
    REQUIRE(a);
    std::array<int, 4> c{};
    for (int k = 0; k < 4; ++k) c.at(static_cast<std::size_t>(k)) = srgb_byte(*a, mesh.corners[corner], k);
    return c;
}

} // namespace

TEST_CASE("3MF keeps units, parts, their places, materials and colours", "[io]") {
    Scene scene;
    scene.unit = Unit::inch;
    scene.up = UpAxis::z;
    scene.materials = {{.name = "red & <hot>", .base_colour = {1, 0, 0, 1}},
                       {.name = "glass", .base_colour = {0, 0, 1, 0.5}}};
    Part& boxes = scene.parts.emplace_back();
    boxes.name = "two \"colours\"";
    boxes.mesh = shapes::cube();
    boxes.mesh.primitives = {{0, {}, {}}, {1, {}, {}}};
    std::vector<std::uint32_t> of_face(12, 0);
    of_face[3] = of_face[7] = 1;
    boxes.mesh.attributes.push_back(
        {std::string(primitive_attribute), Domain::face, Role::index, 1, false, of_face});
    Part moved = boxes;
    moved.transform = {{{0, -2, 0, 1}, {2, 0, 0, 2}, {0, 0, 2, 3}}};
    Part& cone = scene.parts.emplace_back();
    cone.name = "painted";
    cone.mesh = shapes::tetrahedron();
    cone.mesh.attributes.push_back({"COLOR_0", Domain::wedge, Role::colour, 3, true,
                                    linear_words({255, 0, 0, 0, 255, 0, 0, 0, 255, 7, 8, 9}, 3)});
    scene.parts.push_back(moved);
    const auto [back, log] = trip(scene);
    CHECK(log.warnings.empty());
    CHECK(back.unit == Unit::inch);
    CHECK(back.up == UpAxis::z);
    REQUIRE(back.parts.size() == 3);
    CHECK(back.parts[0].name == "two \"colours\"");
    CHECK(back.parts[0].transform.identity());
    CHECK(back.parts[2].transform == moved.transform);
    CHECK(back.parts[2].mesh.positions == moved.mesh.positions);
    REQUIRE(back.materials.size() == 2);
    CHECK(back.materials[0].name == "red & <hot>");
    CHECK(back.materials[0].base_colour[0] == 1);
    CHECK(back.materials[1].base_colour[2] == 1);
    CHECK(std::abs(back.materials[1].base_colour[3] - 0.5) < 0.5 / 255);
    const Mesh& mesh = back.parts[0].mesh;
    for (Index f = 0; f < 12; ++f) CHECK(mesh.primitives[mesh.primitive_of(f)].material == of_face[f]);
    const Mesh& painted = back.parts[1].mesh;
    CHECK(painted.vertex_count() == 4);
    for (Index c = 0; c < painted.corners.size(); ++c) {
        const std::array<int, 4> expected[] = {
            {255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {7, 8, 9, 255}};
        CHECK(colour_at(painted, c) == expected[painted.vertex(c)]);
    }
}

TEST_CASE("3MF writes instances once, triangles only, and says what it leaves out", "[io]") {
    Scene scene;
    scene.unit = Unit::mm;
    for (int i = 0; i < 3; ++i) {
        Part& part = scene.parts.emplace_back();
        part.name = "sphere";
        part.mesh = shapes::icosphere(4);
        part.transform.m[0][3] = 10 * i;
    }
    const io::Codec& codec = *io::codec_named("3mf");
    const std::size_t three = codec.write(scene, {.title = "a"}).files[0].bytes.size();
    Scene one = scene;
    one.parts.resize(1);
    CHECK(three < codec.write(one, {.title = "a"}).files[0].bytes.size() + 200);
    CHECK(trip(scene).scene.parts.size() == 3);
    scene.parts[2].name = "moon";
    const Scene named = trip(scene).scene;
    CHECK(named.parts[1].name == "sphere");
    CHECK(named.parts[2].name == "moon");
    CHECK(named.parts[2].transform == scene.parts[2].transform);
    CHECK(codec.write(scene, {.title = "a"}).files[0].bytes.size() < three + 200);
    // A mirrored part keeps its position, and its faces look outwards.
    scene.parts[1].transform.m[0][0] = -1;
    const Loaded mirrored = trip(scene);
    CHECK(mirrored.scene.parts[1].transform.identity());
    CHECK(mirrored.scene.parts[1].mesh.bounds().max.x <= 11);

    Scene both; // a triangle has colours or a material
    both.unit = Unit::mm;
    both.materials.push_back({.name = "red"});
    Mesh& coloured = both.parts.emplace_back().mesh;
    coloured = shapes::cube();
    coloured.primitives.emplace_back().material = 0;
    coloured.attributes.push_back({"COLOR_0", Domain::wedge, Role::colour, 3, false,
                                   std::vector<float>(3 * coloured.wedge_count(), 0.25F)});
    const Loaded hidden = trip(both);
    REQUIRE(hidden.log.warnings.size() == 1);
    CHECK(hidden.log.warnings[0].id == "W-MATERIAL");

    Scene quads;
    quads.parts.emplace_back().mesh = shapes::quad_cube();
    CHECK(trip(quads).scene.parts[0].mesh.face_count() == 12);
    Scene flat;
    flat.unit = Unit::mm;
    Mesh& mesh = flat.parts.emplace_back().mesh;
    mesh = shapes::cube();
    mesh.corners.insert(mesh.corners.end(), {0, 0, 1});
    flat.parts.emplace_back().mesh.positions = {{0, 0, 0}};
    const Loaded less = trip(flat);
    CHECK(less.scene.parts.size() == 1);
    CHECK(less.scene.parts[0].mesh.face_count() == 12);
    REQUIRE(less.log.warnings.size() == 2);
    CHECK(less.log.warnings[0].id == "W-SKIPPED");
    CHECK(less.log.warnings[1].id == "W-FACES");
    // An instance lacks the same faces once more.
    flat.parts[1] = flat.parts[0];
    flat.parts[1].transform.m[0][3] = 2;
    CHECK(trip(flat).scene.parts.size() == 2);
    flat.unit = Unit::km;
    CHECK(failure([&] { codec.write(flat, {.title = "a"}); }) ==
          "stage [E-UNIT] 3MF has no unit km | write: {unit: m}");
}

TEST_CASE("components of 3MF are placed through all levels, also of other models", "[io]") {
    const std::string resources =
        "<object id=\"1\" name=\"leaf\">" + one_triangle +
        "</object><object id=\"2\"><components><component objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 5 0 "
        "0\"/>"
        "<component objectid=\"1\" transform=\"0 1 0 -1 0 0 0 0 1 0 0 0\"/></components></object>"
        "<object id=\"3\" name=\"tree\"><components><component objectid=\"2\" transform=\"2 0 0 0 2 0 0 0 2 "
        "0 0 1\"/>"
        "</components></object>";
    const Loaded nested = load(archive(model(resources, "<item objectid=\"3\"/>")));
    REQUIRE(nested.scene.parts.size() == 2);
    CHECK(nested.scene.unit == Unit::mm);
    CHECK(nested.scene.parts[0].name == "leaf");
    CHECK(nested.scene.parts[0].transform.point({1, 0, 0}) == Vec3{12, 0, 1});
    CHECK(nested.scene.parts[1].transform.point({1, 0, 0}) ==
          Vec3{0, 2, 1}); // rows from the left: x becomes y
    // Without build items, objects that no other object uses are read.
    CHECK(load(archive(model(resources, ""))).scene.parts.size() == 2);

    const std::string item = "<item objectid=\"7\" p:path=\"/3D/Objects/a.model\"/>";
    const io::Bytes bytes = io::threemf::make_archive(
        {file("_rels/.rels", R"(<Relationships><Relationship Target="/3D/main.model" Id="r"
          Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>)"),
         file("3D/main.model", model("", item, production + " requiredextensions=\"p\" unit=\"meter\"")),
         file("3D/Objects/a.model",
              model("<object id=\"7\" name=\"far\">" + one_triangle + "</object>", ""))});
    const Loaded apart = load(bytes);
    REQUIRE(apart.scene.parts.size() == 1);
    CHECK(apart.scene.parts[0].name == "far");
    CHECK(apart.scene.unit == Unit::m);
    CHECK(io::file_header(io::Input::of("a.3mf", bytes), {}).unit == Unit::m);
    io::ReadSettings in_cm;
    in_cm.unit = Unit::cm;
    CHECK(io::file_header(io::Input::of("a.3mf", bytes), in_cm).unit == Unit::cm);
    CHECK(load(bytes, in_cm).scene.unit == Unit::cm);
}

TEST_CASE("properties of 3MF triangles come from the triangle, else from the object", "[io]") {
    std::string mesh = one_triangle;
    mesh.insert(mesh.find("</triangles>"), R"(<triangle v1="0" v2="2" v3="1" pid="5" p1="1"/>
      <triangle v1="0" v2="2" v3="1" pid="6" p1="0" p2="1" p3="1"/><triangle v1="0" v2="1" v3="2" pid="9" p1="0"/>)");
    const std::string resources =
        R"(<basematerials id="5"><base name="grey" displaycolor="#808080"/><base name="clear" displaycolor="#FF000080"/>
</basematerials><m:colorgroup id="6"><m:color color="#010203"/><m:color color="#04050607"/></m:colorgroup>
<m:texture2dgroup id="9" texid="1"><m:tex2coord u="0" v="0"/></m:texture2dgroup>
<object id="1" pid="5" pindex="0">)" +
        mesh + "</object>";
    const auto [scene, log] = load(archive(model(resources, "<item objectid=\"1\"/>")));
    REQUIRE(log.warnings.size() == 1);
    CHECK(log.warnings[0].message == "the texture 1 of group 9 does not exist");
    REQUIRE(scene.materials.size() == 2);
    CHECK(scene.materials[0].name == "grey");
    CHECK(std::abs(scene.materials[0].base_colour[0] - 0.2158605) < 1e-6); // 128 of sRGB in linear light
    CHECK(std::abs(scene.materials[1].base_colour[3] - 128 / 255.0) < 1e-12);
    const Mesh& m = scene.parts.at(0).mesh;
    const auto material = [&](Index f) { return m.primitives[m.primitive_of(f)].material; };
    CHECK(material(0) == 0);
    CHECK(material(1) == 1);
    CHECK(material(2) == none);
    CHECK(material(3) == none);
    CHECK(colour_at(m, 6) == std::array{1, 2, 3, 255});
    CHECK(colour_at(m, 7) == std::array{4, 5, 6, 7});
    CHECK(colour_at(m, 0) == std::array{255, 255, 255, 255});
    CHECK(m.vertex_count() == 3);
}

TEST_CASE("objects of a 3MF that are not models are left out and named", "[io]") {
    const auto object = [](int id, const char* type) {
        return fmt::format("<object id=\"{}\" type=\"{}\">{}</object>", id, type, one_triangle);
    };
    const std::string all = object(1, "model") + object(2, "support") + object(3, "other") +
                            object(4, "surface") + object(5, "solidsupport");
    const Loaded some = load(archive(model(all, R"(<item objectid="1"/><item objectid="2"/>
<item objectid="4"/><item objectid="5"/>)")));
    CHECK(some.scene.parts.size() == 1);
    REQUIRE(some.log.warnings.size() == 1);
    CHECK(some.log.warnings[0].id == "W-SKIPPED");
    CHECK(some.log.warnings[0].message ==
          "objects that are not models are skipped: 1 'solidsupport', 1 'support', 1 'surface'");
    const Loaded surface = load(archive(model(object(4, "surface"), R"(<item objectid="4"/>)")));
    CHECK(surface.scene.parts.size() == 1);
    CHECK(surface.log.warnings.at(0).message ==
          "the file has no object of type 'model': others are read as such (1 'surface')");
}

TEST_CASE("what slicers paint on triangles is named", "[io]") {
    const Loaded painted = load(archive(model(
        R"(<object id="1"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/>
<vertex x="0" y="1" z="0"/></vertices><triangles><triangle v1="0" v2="1" v3="2" s:custom_seam="4"/>
<triangle v1="0" v2="2" v3="1" paint_color="8"/></triangles></mesh></object>)",
        R"(<item objectid="1"/>)", R"(xmlns:s="http://schemas.slic3r.org/3mf/2017/06")")));
    CHECK(painted.scene.parts.size() == 1);
    REQUIRE(painted.log.warnings.size() == 1);
    CHECK(painted.log.warnings[0].id == "W-SKIPPED");
    CHECK(painted.log.warnings[0].message == "elements that cannot be kept are skipped: custom_seam of "
                                             "triangle (1), paint_color of triangle (1)");
}

TEST_CASE("volumes of slicers that are not printed are left out and named", "[io]") {
    const auto box = [](double x) { // two triangles at x
        return fmt::format("<vertex x=\"{0}\" y=\"0\" z=\"0\"/><vertex x=\"{0}\" y=\"1\" z=\"0\"/>"
                           "<vertex x=\"{0}\" y=\"0\" z=\"1\"/><vertex x=\"{0}\" y=\"1\" z=\"1\"/>",
                           x);
    };
    const std::string two = "<object id=\"1\"><mesh><vertices>" + box(0) + box(5) + R"(</vertices><triangles>
<triangle v1="0" v2="1" v3="2"/><triangle v1="1" v2="3" v3="2"/>
<triangle v1="4" v2="5" v3="6"/><triangle v1="5" v2="7" v3="6"/></triangles></mesh></object>)";
    const auto settings = [](const char* type) {
        return fmt::format(R"(<?xml version="1.0"?><config><object id="1">
<volume firstid="0" lastid="1"><metadata type="volume" key="volume_type" value="ModelPart"/></volume>
<volume firstid="2" lastid="3"><metadata type="volume" key="volume_type" value="{}"/></volume>
</object></config>)",
                           type);
    };
    for (const char* type : {"NegativeVolume", "ParameterModifier", "SupportEnforcer"}) {
        const Loaded some =
            load(io::threemf::make_archive({file("3D/3dmodel.model", model(two, R"(<item objectid="1"/>)")),
                                            file("Metadata/Slic3r_PE_model.config", settings(type))}));
        REQUIRE(some.scene.parts.size() == 1);
        CHECK(some.scene.parts[0].mesh.face_count() == 2);
        CHECK(some.scene.parts[0].mesh.vertex_count() == 4);
        CHECK(some.scene.bounds().max.x == 0);
        CHECK(some.log.warnings.at(0).message ==
              fmt::format("objects that are not models are skipped: 1 '{}'", type));
    }
    const Loaded all =
        load(io::threemf::make_archive({file("3D/3dmodel.model", model(two, R"(<item objectid="1"/>)")),
                                        file("Metadata/Slic3r_PE_model.config", settings("ModelPart"))}));
    CHECK(all.scene.face_count() == 4);
    REQUIRE(all.log.warnings.size() == 1); // about the settings, which no format keeps
    CHECK(all.log.warnings[0].message ==
          "elements that cannot be kept are skipped: the files metadata/slic3r_pe_model.config");
    const Loaded broken =
        load(io::threemf::make_archive({file("3D/3dmodel.model", model(two, R"(<item objectid="1"/>)")),
                                        file("Metadata/Slic3r_PE_model.config", "<config><object")}));
    CHECK(broken.scene.face_count() == 4); // its geometry is sound
    CHECK(broken.log.warnings.at(0).id == "W-3MF");
    CHECK(broken.log.warnings.at(0).message.find(
              "the slicer's settings in '/Metadata/Slic3r_PE_model.config' cannot be read") == 0);
    const std::string more = R"(<?xml version="1.0"?><config><object id="1">
<volume firstid="2" lastid="3"><metadata type="volume" key="volume_type" value="NegativeVolume"/></volume></object>
<object id="2"><metadata type="object" key="modifier" value="1"/></object></config>)";
    CHECK(load(io::threemf::make_archive({file("3D/3dmodel.model", model(two, R"(<item objectid="1"/>)")),
                                          file("Metadata/Slic3r_PE_model.config", more)}))
              .scene.face_count() == 2);
    const std::string parts =
        fmt::format("<object id=\"1\">{0}</object><object id=\"2\">{0}</object><object id=\"3\"><components>"
                    "<component objectid=\"1\"/><component objectid=\"2\"/></components></object>",
                    one_triangle);
    const Loaded bambu = load(io::threemf::make_archive(
        {file("3D/3dmodel.model", model(parts, R"(<item objectid="3"/>)")),
         file("Metadata/model_settings.config", R"(<?xml version="1.0"?><config><object id="3">
<part id="1" subtype="normal_part"/><part id="2" subtype="negative_part"/></object></config>)")}));
    CHECK(bambu.scene.parts.size() == 1);
    CHECK(bambu.log.warnings.at(0).message == "objects that are not models are skipped: 1 'negative_part'");
    CHECK(bambu.log.warnings.at(0).hint.find("combine") != std::string::npos);
    const std::string object = fmt::format("<object id=\"1\">{}</object>", one_triangle);
    const Loaded items = load(
        archive(model(object, R"(<item objectid="1" printable="1"/><item objectid="1" printable="0"/>)")));
    CHECK(items.scene.parts.size() == 1);
    CHECK(items.log.warnings.at(0).message == "objects that are not models are skipped: 1 'printable=0'");
    CHECK(load(archive(model(object, R"(<item objectid="1" printable="0"/>)"))).scene.parts.size() == 1);
}

TEST_CASE("multiproperties of 3MF show their layers together", "[io]") {
    const std::string resources =
        R"(<basematerials id="1"><base name="red" displaycolor="#FF0000"/></basematerials>
<m:colorgroup id="2"><m:color color="#00FF00"/><m:color color="#0000FF80"/></m:colorgroup>
<m:multiproperties id="3" pids="1 2"><m:multi pindices="0 0"/><m:multi pindices="0 1"/></m:multiproperties>
<m:multiproperties id="4" pids="1 2" blendmethods="multiply"><m:multi pindices="0"/></m:multiproperties>
<object id="9"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/>
</vertices><triangles><triangle v1="0" v2="1" v3="2" pid="3" p1="0"/><triangle v1="0" v2="1" v3="2" pid="3" p1="1"/>
<triangle v1="0" v2="1" v3="2" pid="4" p1="0"/></triangles></mesh></object>)";
    const Loaded loaded = load(archive(model(resources, R"(<item objectid="9"/>)")));
    CHECK(loaded.log.warnings.empty());
    const Mesh& m = loaded.scene.parts.at(0).mesh;
    CHECK(colour_at(m, 0) == std::array{0, 255, 0, 255});
    const std::array<int, 4> mixed = colour_at(m, 3); // half red and half blue in linear light
    CHECK(std::abs(mixed[0] - 188) <= 1);
    CHECK(std::abs(mixed[2] - 188) <= 1);
    CHECK(mixed[3] == 255);
    CHECK(colour_at(m, 6) == std::array{0, 0, 0, 255}); // red times green
    const std::string wrong = R"(<m:colorgroup id="2"><m:color color="#00FF00"/></m:colorgroup>
<m:multiproperties id="3" pids="2"><m:multi pindices="7"/></m:multiproperties><object id="9"%>)" +
                              one_triangle + "</object>";
    const auto using_it = [&](const std::string& attribute) {
        std::string text = wrong;
        return archive(model(text.replace(text.find('%'), 1, attribute), R"(<item objectid="9"/>)"));
    };
    CHECK(load(using_it(R"( pid="3" pindex="0")")).log.warnings.at(0).message ==
          "line 3: multiproperties name property 7 of group 2, which has 1: the layer is left out there");
    CHECK(load(using_it("")).log.warnings.empty()); // nothing uses them
}

TEST_CASE("3MF keeps its metadata and part numbers, and glTF gets them", "[io]") {
    std::string text =
        model(R"(<object id="1" partnumber="A-17">)" + one_triangle + "</object>", R"(<item objectid="1"/>)");
    text.insert(text.find("<resources>"), R"(<metadata name="Title">Bust &amp; base</metadata>
<metadata name="Copyright">Museum X</metadata><metadata name="LicenseTerms">CC BY 4.0</metadata>
<metadata name="Application">another</metadata>)");
    const Loaded loaded = load(archive(text));
    CHECK(loaded.log.warnings.empty());
    const Scene scenes[] = {loaded.scene, trip(loaded.scene).scene};
    for (const Scene& scene : scenes) {
        const auto files = io::codec_named("glb")->write(scene, {}).files;
        const std::string_view glb(reinterpret_cast<const char*>(files.at(0).bytes.data()),
                                   files.at(0).bytes.size());
        for (const char* kept : {R"("copyright":"Museum X")", R"("Title":"Bust & base")",
                                 R"("LicenseTerms":"CC BY 4.0")", R"("extras":{"partnumber":"A-17"})"}) {
            INFO(kept);
            CHECK(glb.find(kept) != std::string_view::npos);
        }
    }
    text.insert(text.find("<resources>"), R"(<metadata name="slic3rpe:Version3mf">1</metadata>)");
    CHECK(load(archive(text)).log.warnings.at(0).message ==
          "elements that cannot be kept are skipped: metadata 'slic3rpe:Version3mf' (1)");
    const Loaded other = load(archive(
        model(R"(<object id="1">)" + one_triangle + "</object>", R"(<item objectid="1" partnumber="B"/>)")));
    CHECK(other.log.warnings.at(0).message ==
          "elements that cannot be kept are skipped: partnumber of item (1)");
}

TEST_CASE("materials of 3MF keep their colours beside triangles with colours of their own", "[io]") {
    const std::string mesh = R"(<mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/>
<vertex x="0" y="1" z="0"/><vertex x="0" y="0" z="1"/></vertices><triangles>
<triangle v1="0" v2="2" v3="1" pid="5" p1="0"/><triangle v1="0" v2="1" v3="3" pid="6" p1="0"/>
<triangle v1="1" v2="2" v3="3"/></triangles></mesh>)";
    const Loaded loaded = load(archive(model(
        R"(<basematerials id="5"><base name="r" displaycolor="#CC0000"/></basematerials><m:colorgroup id="6">
<m:color color="#00FF00"/></m:colorgroup><object id="1">)" +
            mesh + "</object>",
        R"(<item objectid="1"/>)")));
    CHECK(loaded.log.warnings.empty());
    const Loaded again = trip(loaded.scene);
    CHECK(again.log.warnings.empty());
    const Scene* const scenes[] = {&loaded.scene, &again.scene};
    for (const Scene* scene : scenes) {
        const Mesh& m = scene->parts.at(0).mesh;
        REQUIRE(m.primitives.size() == 3);
        const auto of = [&](Index f) { return m.primitives[m.primitive_of(f)]; };
        CHECK(of(0).material == 0);
        CHECK_FALSE(of(0).has("COLOR_0"));
        CHECK(of(1).material == none);
        CHECK(of(1).lists("COLOR_0"));
        CHECK(colour_at(m, 3) == std::array<int, 4>{0, 255, 0, 255});
        CHECK(of(2).material == none); // it has no colour, also not that of the first triangle
        CHECK_FALSE(of(2).has("COLOR_0"));
    }
}

TEST_CASE("broken rules of 3MF that leave a mesh are named", "[io]") {
    const std::string plain = R"(<object id="1">)" + one_triangle + "</object>",
                      item = R"(<item objectid="1"/>)";
    const auto fault = [](const io::Bytes& bytes) {
        const Loaded loaded = load(bytes);
        CHECK(loaded.scene.parts.size() == 1);
        REQUIRE(loaded.log.warnings.size() == 1);
        CHECK(loaded.log.warnings[0].id == "W-3MF");
        return loaded.log.warnings[0].message;
    };
    CHECK(fault(archive(model(R"(<object id="1" pid="9" pindex="0">)" + one_triangle + "</object>", item))) ==
          "object 1 refers to the properties 9, which do not exist, so these faces have no colour");
    CHECK(fault(archive(model(plain, ""))) ==
          "it builds no objects, so all objects that no other object uses are read");
    CHECK(fault(archive(model(plain, item, "xml:space=\"default\""))) ==
          "line 2: <model> has xml:space, which 3MF does not allow");
}

TEST_CASE("a broken 3MF is refused with its place", "[io]") {
    const std::string object = "<object id=\"1\">" + one_triangle + "</object>";
    const std::string item = "<item objectid=\"1\"/>";
    const auto with = [&](std::string_view old, std::string_view changed) {
        std::string text = model(object, item);
        const auto at = text.find(old);
        REQUIRE(at != std::string::npos);
        return refused(archive(text.replace(at, old.size(), changed)));
    };
    const std::string place = "a.3mf/3D/3dmodel.model";
    const std::pair<std::string, std::string> cases[] = {
        {with("x=\"1\"", "x=\"one\""), place + ":2: <vertex> has x='one', expected a number"},
        {with("x=\"1\"", ""), place + ":2: <vertex> has no attribute 'x'"},
        {with("v2=\"1\"", "v2=\"3\""),
         place + ": triangle 0 of object 1 refers to vertex 3, but the object has 3"},
        {with("v2=\"1\"", "v2=\"-1\""),
         place + ":3: <triangle> has v2='-1', expected a whole number from 0 on"},
        {with("objectid=\"1\"", "objectid=\"2\""), "a.3mf: there is no object 2 in '/3D/3dmodel.model'"},
        {with("objectid=\"1\"", "objectid=\"1\" transform=\"1 0 0\""),
         place + ":3: a transform has 12 numbers, found 3"},
        {with("</build>", "</bild>"), place + ":3: not valid XML: mismatched tag"},
        {with("<resources>", "<!-- "), place + ":2: not valid XML: unclosed token"},
        {refused(archive("<thing/>")), place + ": expected <model> as the outermost element"},
        {with("<resources>", "<resources>" + object), place + ":3: there are two objects 1"},
        {with("<build><item objectid=\"1\"/></build>", ""), place + ": <model> has no <build>"}};
    for (const auto& [told, expected] : cases) CHECK(told.starts_with("malformed [E-3MF] " + expected));
    CHECK(with("x=\"1\"", "x=\"nan\"").starts_with("malformed [E-NAN]"));
    const std::string entities = "<!DOCTYPE a [<!ENTITY b \"bbbb\"><!ENTITY c \"&b;&b;&b;\">]>";
    CHECK(refused(archive("<?xml version=\"1.0\"?>\n" + entities + "<model/>"))
              .starts_with("malformed [E-3MF] " + place +
                           ":2: a document type (<!DOCTYPE>) is not allowed in 3MF"));
    std::string deep;
    for (int i = 0; i < 100000; ++i) deep += "<a>";
    CHECK(refused(archive(deep))
              .starts_with("malformed [E-3MF] " + place + ":1: elements are nested deeper than 64 levels"));
    CHECK(refused(archive(model(object, item, "xmlns:v=\"urn:volumes\" requiredextensions=\"v\"")))
              .starts_with("malformed [E-EXTENSION] " + place +
                           ":2: the extension 'v' (urn:volumes) is required but not supported"));
    CHECK(
        refused(archive(model(
                    "<object id=\"1\"><components><component objectid=\"1\"/></components></object>", item)))
            .starts_with("malformed [E-3MF] a.3mf: object 1 is a component of itself, or nested deeper than "
                         "32 levels"));
    io::ReadSettings few;
    few.max_vertices = 2;
    CHECK(refused(archive(model(object, item)), few) == "limit [E-SIZE] " + place + ": too many vertices");
}

TEST_CASE("components of 3MF that multiply without end are refused", "[io]") {
    std::string resources = "<object id=\"1\">" + one_triangle + "</object>";
    for (int id = 2; id < 30; ++id) {
        resources += fmt::format("<object id=\"{}\"><components>", id);
        for (int k = 0; k < 10; ++k) resources += fmt::format("<component objectid=\"{}\"/>", id - 1);
        resources += "</components></object>";
    }
    CHECK(refused(archive(model(resources, "<item objectid=\"29\"/>"))) ==
          "limit [E-SIZE] a.3mf: its components place more than 1000000 objects");
}

TEST_CASE("a damaged archive is refused with its place", "[io]") {
    const std::string text =
        model("<object id=\"1\">" + one_triangle + "</object>", "<item objectid=\"1\"/>");
    const io::Bytes good = archive(text);
    CHECK(refused(good) == "nothing");
    const auto changed = [&](std::size_t at, int value) {
        io::Bytes bytes = good;
        bytes[at] = static_cast<std::byte>(value);
        return refused(bytes);
    };
    const std::string hint = " | export it again, or download it again";
    CHECK(changed(6, 1) == "nothing"); // only the directory counts
    const std::size_t directory = good.size() - 22 - 46 - 16;
    CHECK(changed(directory + 8, 1) ==
          "malformed [E-ZIP] a.3mf: at byte 0: the entry '/3D/3dmodel.model' is encrypted" + hint);
    CHECK(changed(directory + 10, 12) ==
          "malformed [E-ZIP] a.3mf: at byte 0: the entry '/3D/3dmodel.model' is "
          "compressed by method 12, expected deflate" +
              hint);
    CHECK(changed(directory + 16, 1)
              .starts_with("malformed [E-ZIP] a.3mf: at byte 0: the entry '/3D/3dmodel.model' "
                           "has a wrong size or checksum"));
    CHECK(changed(good.size() - 22, 0) ==
          fmt::format("malformed [E-ZIP] a.3mf: at byte {}: the archive has no directory at its end{}",
                      good.size(), hint));
    CHECK(changed(good.size() - 12, 9).starts_with("malformed [E-ZIP]"));
    // A megabyte of spaces for each of a thousand bytes.
    const io::Bytes bomb = archive(std::string(std::size_t{80} << 20, ' '));
    CHECK(refused(bomb).starts_with("limit [E-SIZE] 'a.3mf: /3D/3dmodel.model' "));
}

TEST_CASE("the XML of 3MF is refused or read as a sound mesh, however it is damaged", "[io]") {
    const std::string text = model(
        R"(<m:colorgroup id="6"><m:color color="#010203"/></m:colorgroup><object id="1" pid="6" pindex="0">)" +
            one_triangle +
            "</object><object id=\"2\"><components><component objectid=\"1\"/></components></object>",
        "<item objectid=\"2\" transform=\"1 0 0 0 1 0 0 0 1 5 0 0\"/>");
    const auto bytes = bytes_of(text);
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        const io::Bytes damaged = mutated({bytes.begin(), bytes.end()}, seed);
        const std::string trouble = trouble_reading("a.3mf", archive(std::string(io::as_text(damaged))));
        if (!trouble.empty()) FAIL_CHECK("seed " << seed << ": " << trouble);
    }
    SUCCEED("no damage got through");
}

} // namespace threemf_test
