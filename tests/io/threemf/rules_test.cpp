#include "support/catch.hpp"

#include "io/codec.hpp"
#include "io/threemf/zip.hpp"
#include "support/failure.hpp"
#include "support/temporary.hpp"

#include <fmt/format.h>

namespace threemf_rules_test {

using namespace facetmill;
using namespace facetmill::test;

namespace {

using io::threemf::ArchiveFile;

ArchiveFile stored(std::string path, std::string_view text) {
    const auto bytes = bytes_of(text);
    return {std::move(path), {bytes.begin(), bytes.end()}};
}

const std::string tetrahedron = R"(<mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/>
<vertex x="0" y="1" z="0"/><vertex x="0" y="0" z="1"/></vertices><triangles><triangle v1="0" v2="2" v3="1"/>
<triangle v1="0" v2="1" v3="3"/><triangle v1="1" v2="2" v3="3"/><triangle v1="0" v2="3" v3="2"/></triangles>)";

std::string model(const std::string& resources, const std::string& object = " id=\"50\"",
                  const std::string& more = "", const std::string& attributes = "") {
    return fmt::format(
        R"(<model xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02"
xmlns:b="http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02"
xmlns:s="http://schemas.microsoft.com/3dmanufacturing/slice/2015/07" {}><resources>{}
<object{}>{}{}</mesh></object></resources>
<build><item objectid="50"/></build></model>)",
        attributes, resources, object, tetrahedron, more);
}

std::string relations(const std::string& items) {
    std::string text = "<Relationships>";
    text += items;
    return text + "</Relationships>";
}

std::string relation(const std::string& type, const std::string& target) {
    return fmt::format(R"(<Relationship Id="a" Type="http://schemas.example.com/2013/01/{}" Target="{}"/>)",
                       type, target);
}

const std::string to_model = relation("3dmodel", "/3D/3dmodel.model");

io::Bytes packed(const std::string& text, const std::string& root = relations(to_model),
                 const std::string& of_model = relations("")) {
    return io::threemf::make_archive({stored("3D/3dmodel.model", text), stored("_rels/.rels", root),
                                      stored("3D/_rels/3dmodel.model.rels", of_model)});
}

Scene read_archive(const io::Bytes& bytes, io::ReadLog& log, bool lines = false) {
    io::ReadSettings settings;
    settings.lines = lines;
    return io::read_scene(io::Input::of("a.3mf", bytes), settings, log);
}

/// The message, without the hint, which is the same for all.
std::string refusal(const io::Bytes& bytes) {
    const std::string told = failure([&] {
        io::ReadLog log;
        read_archive(bytes, log);
    });
    const std::string hint = " | export the file again, or unzip it, correct this place, and zip it again";
    CHECK(told.ends_with(hint));
    return told.substr(0, told.size() - std::min(told.size(), hint.size()));
}

} // namespace

TEST_CASE("models that break a rule of 3MF about resources are refused", "[io]") {
    const std::string base =
                          R"(<basematerials id="1"><base name="a" displaycolor="#FF0000"/></basematerials>)",
                      second =
                          R"(<basematerials id="2"><base name="b" displaycolor="#00FF00"/></basematerials>)",
                      colours = R"(<m:colorgroup id="3"><m:color color="#00FF00"/></m:colorgroup>)",
                      others = R"(<m:colorgroup id="4"><m:color color="#00FF00"/></m:colorgroup>)",
                      mixed = R"(<m:compositematerials id="5" matid="1" matindices="0"/>)";
    const auto layers = [](const std::string& pids, int id = 9) {
        return fmt::format("\n<m:multiproperties id=\"{}\" pids=\"{}\"/>", id, pids);
    };
    const std::pair<std::string, std::string> cases[] = {
        {base + base, ":4: two resources have the id 1, which must be unique"},
        {base + mixed + mixed, ":4: two resources have the id 5, which must be unique"},
        {mixed, ":4: compositematerials 5 mix the resource 1, which is no <basematerials>"},
        {"<m:compositematerials id=\"5\" matindices=\"0\"/>",
         ":4: <compositematerials> has no attribute 'matid'"},
        {"<m:compositematerials id=\"5\" matid=\"1\"/>",
         ":4: <compositematerials> has no attribute 'matindices'"},
        {base + second + layers("1 2"), ":5: multiproperties refer to more than one group of materials"},
        {base + mixed + layers("1 5"), ":5: multiproperties refer to more than one group of materials"},
        {base + colours + layers("3 1"), ":5: the material of multiproperties must be their first layer"},
        {colours + others + layers("3 4"), ":5: multiproperties refer to more than one group of colours"},
        {colours + layers("3") + layers("9", 10), ":6: multiproperties refer to the multiproperties 9"},
        {R"(<m:texture2d id="6" path="/a.png" contenttype=""/>)",
         ":4: texture2d 6 has the content type '', expected image/png or image/jpeg"}};
    for (const auto& [resources, message] : cases)
        CHECK(refusal(packed(model(resources))) == "malformed [E-3MF] a.3mf/3D/3dmodel.model" + message);
    CHECK(refusal(packed(model("", R"( id="50" type="cushion")"))) ==
          "malformed [E-3MF] a.3mf/3D/3dmodel.model:5: object 50 has the type 'cushion', expected model, "
          "solidsupport, support, surface or other");
    CHECK(refusal(packed(model("", R"( id="50" pindex="1")"))) ==
          "malformed [E-3MF] a.3mf/3D/3dmodel.model:5: object 50 has a pindex without a pid");
    CHECK(refusal(packed(model("", R"( id="50" type="other")"))) ==
          "malformed [E-3MF] a.3mf/3D/3dmodel.model:8: <item> builds object 50, whose type is 'other', which "
          "3MF "
          "does not allow");
    io::ReadLog log;
    CHECK(read_archive(packed(model(base + colours + mixed + layers("1 3"))), log).parts.size() == 1);
    CHECK(log.warnings.at(0).message == "elements that cannot be kept are skipped: compositematerials (1)");
    std::string twice = model("");
    twice.insert(twice.find("<resources>"),
                 R"(<metadata name="Title">a</metadata><metadata name="Title">b</metadata>)");
    io::ReadLog named;
    read_archive(packed(twice), named);
    CHECK(named.warnings.at(0).message == "line 4: there are two metadata 'Title': the last counts");
}

TEST_CASE("relations of a 3MF that break a rule are refused", "[io]") {
    const auto with = [](const std::string& root, const std::string& of_model = "") {
        return refusal(packed(model(""), relations(root), relations(of_model)));
    };
    const std::string place = "malformed [E-3MF] a.3mf/_rels/.rels",
                      of_model = "malformed [E-3MF] a.3mf/3D/_rels/3dmodel.model.rels";
    CHECK(with(relation("thumbnail", "/3D/3dmodel.model")) == place + ": no relation names the 3D model");
    CHECK(with(to_model + relation("3dmodel", "/3D/b.model")) ==
          place + ":1: the relations name 2 models, but must name one");
    CHECK(with(to_model + relation("thumbnail", "/a.png")) ==
          place + ":1: the thumbnail '/a.png' is not in the archive");
    CHECK(with(to_model, relation("3dtexture", "C:/a.png")) ==
          of_model + ":1: a relation names 'C:/a.png', which is outside the archive");
    CHECK(with(to_model, relation("printticket", "/a.xml") + relation("printticket", "/b.xml")) ==
          of_model + ":1: the relations name more than one print ticket");
}

TEST_CASE("beams of a 3MF are lines, and slices leave the mesh", "[io]") {
    const std::string beams =
        R"(<b:beamlattice radius="0.1"><b:beams><b:beam v1="0" v2="3"/><b:beam v1="3" v2="1"/>
</b:beams></b:beamlattice>)";
    const io::Bytes bytes = packed(
        model("<s:slicestack id=\"7\"/>", R"( id="50" name="pin")", beams, R"(requiredextensions="b s")"));
    io::ReadLog log;
    const Scene scene = read_archive(bytes, log);
    REQUIRE(scene.parts.size() == 2);
    CHECK(scene.parts[0].mesh.face_count() == 4);
    CHECK(scene.parts[1].name == "pin_lines");
    CHECK(scene.parts[1].mesh.line_count() == 2);
    CHECK(scene.parts[1].mesh.vertex_count() == 3);
    REQUIRE(log.warnings.size() == 1);
    CHECK(log.warnings[0].message ==
          "elements that cannot be kept are skipped: radii of beams (1), slicestack (1)");
    io::ReadLog tubes;
    CHECK(read_archive(bytes, tubes, true).parts.size() == 1);
    CHECK(tubes.lines.at(0).segments.size() == 2);
    std::string only = model("", " id=\"50\"", beams);
    only.erase(only.find("<triangles>"), only.find("</triangles>") + 12 - only.find("<triangles>"));
    io::ReadLog alone;
    CHECK(read_archive(packed(only), alone).parts.at(0).mesh.line_count() == 2);
    CHECK(refusal(packed(
              model("", " id=\"50\"",
                    R"(<b:beamlattice><b:beams><b:beam v1="0" v2="9"/></b:beams></b:beamlattice>)"))) ==
          "malformed [E-3MF] a.3mf/3D/3dmodel.model: a beam of object 50 refers to vertex 9, but the object "
          "has 4");
}

} // namespace threemf_rules_test
