// A stored scene is restored with all its members.

#include "support/catch.hpp"

#include "base/hash.hpp"
#include "cache/archive.hpp"
#include "cache/state.hpp"
#include "mesh/cut_memory.hpp"
#include "mesh/shapes.hpp"

using namespace facetmill;

namespace {

Attribute attribute(const char* name, Domain domain, Role role, int components, bool normalised,
                    AttributeData data) {
    return {name, domain, role, components, normalised, std::move(data)};
}

Mesh full_mesh() {
    Mesh mesh;
    mesh.positions = {{0, -0.0, 1e-300}, {1, 0.1, -3.4e38}, {1e300, 2, 0.5}};
    mesh.wedge_vertex = {0, 1, 2, 2};
    mesh.corners = {0, 1, 2, 3, 1, 0, 2};
    mesh.face_offsets = {0, 3, 7};
    mesh.attributes = {
        attribute("NORMAL", Domain::wedge, Role::normal, 3, false, std::vector<float>(12, 0.5f)),
        attribute("quality", Domain::vertex, Role::generic, 1, false, std::vector<double>{0.1, -0.0, 3}),
        attribute("COLOR_0", Domain::wedge, Role::colour, 4, true, std::vector<std::uint8_t>(16, 200)),
        attribute("a", Domain::vertex, Role::tangent, 1, true, std::vector<std::int8_t>{-1, 2, 3}),
        attribute("JOINTS_0", Domain::wedge, Role::joints, 4, false, std::vector<std::uint16_t>(16, 777)),
        attribute("b", Domain::face, Role::morph_vector, 1, false, std::vector<std::int16_t>{-5, 5}),
        attribute("primitive", Domain::face, Role::index, 1, false, std::vector<std::uint32_t>{0, none}),
        attribute("c", Domain::face, Role::weights, 1, false, std::vector<std::int32_t>{-70000, 70000}),
    };
    mesh.primitives = {{3, {"NORMAL", "COLOR_0"}, R"({"extras": {"a": 1}})"}, {none, {}, ""}};
    return mesh;
}

/// Every member differs from its default.
Scene full_scene() {
    Scene scene;
    Part part;
    part.name = "hull";
    part.mesh = full_mesh();
    part.transform.m[0][3] = 0.1;
    part.document = 0;
    part.node = 4;
    part.source_mesh = 5;
    part.skinned = true;
    part.changed = true;
    CutMemory cuts;
    cuts.entries.push_back({{{1, 2, 3}, {0.1, 0.2, 0.3}, -7}, 1e-17, {{1, 1, 1}, {2, 0.3, 2}}});
    part.cuts = std::make_shared<const CutMemory>(std::move(cuts));
    scene.parts = {std::move(part), Part{}};
    scene.materials = {{"steel", {0.1, 0.2, 0.3, 0.4}, true, 0, 2}, {}};
    scene.unit = Unit::foot;
    scene.up = UpAxis::z;
    Document document;
    document.json = R"({"asset": {"version": "2.0"}})";
    document.buffers = {{std::byte{1}, std::byte{255}}, {}};
    document.files = {{"a.png", {std::byte{7}}}, {"b.png", {}}};
    document.name = "hull.glb";
    scene.documents = {std::make_shared<const Document>(std::move(document))};
    return scene;
}

void check_same(const Mesh& a, const Mesh& b) {
    CHECK(a.positions == b.positions);
    CHECK(std::signbit(a.positions[0].y));
    CHECK(a.wedge_vertex == b.wedge_vertex);
    CHECK(a.corners == b.corners);
    CHECK(a.face_offsets == b.face_offsets);
    CHECK(a.primitives == b.primitives);
    REQUIRE(a.attributes.size() == b.attributes.size());
    for (std::size_t i = 0; i < a.attributes.size(); ++i) {
        const Attribute &mine = a.attributes[i], &other = b.attributes[i];
        CAPTURE(other.name);
        CHECK(mine.name == other.name);
        CHECK(mine.domain == other.domain);
        CHECK(mine.role == other.role);
        CHECK(mine.components == other.components);
        CHECK(mine.normalised == other.normalised);
        CHECK(mine.data == other.data);
    }
}

void check_same(const Part& a, const Part& b) {
    CHECK(a.name == b.name);
    check_same(a.mesh, b.mesh);
    CHECK(a.transform == b.transform);
    CHECK(a.document == b.document);
    CHECK(a.node == b.node);
    CHECK(a.source_mesh == b.source_mesh);
    CHECK(a.skinned == b.skinned);
    CHECK(a.changed == b.changed);
    REQUIRE(a.cuts);
    REQUIRE(a.cuts->entries.size() == b.cuts->entries.size());
    CHECK(a.cuts->entries[0].plane == b.cuts->entries[0].plane);
    CHECK(a.cuts->entries[0].reach == b.cuts->entries[0].reach);
    CHECK(a.cuts->entries[0].points == b.cuts->entries[0].points);
}

report::StageRecord full_record() {
    report::StageRecord record;
    record.after = report::Brief{.parts = 1, .vertices = 5, .faces = 3, .bounds = {{0, -0.0, 1}, {2, 3, 4}}};
    record.attribute_changes = {
        {"hull", {"NORMAL", Domain::vertex, AttributeChange::Kind::dropped, "no reason"}}};
    record.warnings = {{Severity::note, "W-X", "message", line_mark("p.yaml", 3), "hint"}};
    record.result["found"] = 18446744073709551615u;
    record.resolved = {{"depth", "1%", 0.1}};
    record.said = {"one", "two"};
    return record;
}

} // namespace

TEST_CASE("a scene comes back from its bytes with all that it had", "[cache]") {
    const Scene scene = full_scene();
    const io::Bytes bytes = cache::encoded(scene);
    const auto back = cache::decoded_scene(bytes);
    REQUIRE(back);
    REQUIRE(back->parts.size() == 2);
    check_same(back->parts[0], scene.parts[0]);
    CHECK(back->parts[1].cuts == nullptr);
    REQUIRE(back->materials.size() == 2);
    const Material &mine = back->materials[0], &other = scene.materials[0];
    CHECK(mine.name == other.name);
    CHECK(std::equal(std::begin(mine.base_colour), std::end(mine.base_colour), other.base_colour));
    CHECK(mine.double_sided);
    CHECK(mine.document == 0);
    CHECK(mine.index == 2);
    CHECK(back->unit == Unit::foot);
    CHECK(back->up == UpAxis::z);
    REQUIRE(back->documents.size() == 1);
    CHECK(back->documents[0]->json == scene.documents[0]->json);
    CHECK(back->documents[0]->buffers == scene.documents[0]->buffers);
    CHECK(back->documents[0]->files == scene.documents[0]->files);
    CHECK(back->documents[0]->name == "hull.glb");
    CHECK(cache::encoded(*back) == bytes);
}

TEST_CASE("bytes of a scene that are cut or changed give another scene or none, and nothing worse",
          "[cache]") {
    const io::Bytes bytes = cache::encoded(full_scene());
    std::size_t refused = 0;
    for (std::size_t n = 0; n < bytes.size(); ++n) {
        CHECK_FALSE(cache::decoded_scene(io::Span(bytes).first(n)));
        for (const unsigned change : {1u, 0x80u, 0xffu}) {
            io::Bytes changed = bytes;
            changed[n] ^= static_cast<std::byte>(change);
            refused += !cache::decoded_scene(changed);
        }
    }
    CHECK(refused > 0);
    io::Bytes longer = bytes;
    longer.push_back({});
    CHECK_FALSE(cache::decoded_scene(longer));
}

TEST_CASE("points that are floats take half the bytes, and indices as many as they need", "[cache]") {
    constexpr std::size_t n = 1000;
    const auto size = [](double x, Index last) {
        Scene scene;
        Mesh& mesh = scene.parts.emplace_back().mesh;
        mesh.positions.assign(n, {x, x, x});
        mesh.corners.assign(n, last);
        return cache::encoded(scene).size();
    };
    CHECK(size(0.1, 0) - size(0.5, 0) == 12 * n);
    CHECK(size(1e39, 0) - size(0.5, 0) == 12 * n);
    CHECK(size(0, 256) - size(0, 255) == n);
    CHECK(size(0, 65536) - size(0, 255) == 2 * n);
    CHECK(size(0, none) - size(0, 255) == 3 * n);
}

TEST_CASE("what a run tells of a stage comes back, but for its places", "[cache]") {
    cache::Memory memory;
    memory.record = full_record();
    memory.inputs = {{"a.ply", 12, "abc", {{"faces", 1}}}};
    memory.absent = {"b.png"};
    memory.scene = "key";
    memory.told_name = "smooth";
    memory.bounds = {{0, 0, 0}, {1, 2, 3}};
    const auto back = cache::decoded_memory(cache::encoded(memory));
    REQUIRE(back);
    CHECK(back->told_name == "smooth");
    const auto &mine = back->record, &other = memory.record;
    CHECK_FALSE(mine.before);
    REQUIRE(mine.after);
    CHECK(mine.after->parts == other.after->parts);
    CHECK(mine.after->vertices == other.after->vertices);
    CHECK(mine.after->faces == other.after->faces);
    CHECK(mine.after->bounds.min == other.after->bounds.min);
    CHECK(mine.after->bounds.max == other.after->bounds.max);
    REQUIRE(mine.attribute_changes.size() == 1);
    CHECK(mine.attribute_changes[0].part == "hull");
    CHECK(mine.attribute_changes[0].change == other.attribute_changes[0].change);
    REQUIRE(mine.warnings.size() == 1);
    CHECK(mine.warnings[0].severity == Severity::note);
    CHECK(mine.warnings[0].id == "W-X");
    CHECK(mine.warnings[0].message == "message");
    CHECK(mine.warnings[0].hint == "hint");
    CHECK_FALSE(mine.warnings[0].where.known());
    CHECK(mine.result.dump() == other.result.dump());
    REQUIRE(mine.resolved.size() == 1);
    CHECK(mine.resolved[0].option == "depth");
    CHECK(mine.resolved[0].given == "1%");
    CHECK(mine.resolved[0].is == 0.1);
    CHECK(mine.said == other.said);
    REQUIRE(back->inputs.size() == 1);
    CHECK(back->inputs[0].path == "a.ply");
    CHECK(back->inputs[0].bytes == 12);
    CHECK(back->inputs[0].sha256 == "abc");
    CHECK(back->inputs[0].read_back == memory.inputs[0].read_back);
    CHECK(back->absent == memory.absent);
    CHECK(back->scene == "key");
    CHECK(back->bounds.max == memory.bounds.max);
}

TEST_CASE("JSON of every kind and size comes back", "[cache]") {
    Json list = Json::array({nullptr, true, false, 0.1, -0.0, 1e308, 5e-324});
    for (const std::uint64_t power : {0, 4, 5, 8, 16, 32, 63})
        for (const std::uint64_t n :
             {(std::uint64_t{1} << power) - 1, std::uint64_t{1} << power, 3 * (std::uint64_t{1} << power)}) {
            list.push_back(n);
            list.push_back(-1 - static_cast<std::int64_t>(n / 2));
        }
    list.push_back(UINT64_MAX);
    list.push_back(INT64_MIN);
    for (const std::size_t size : {0, 23, 24, 255, 256, 70'000}) {
        list.push_back(std::string(size, '\xff')); // file names may contain any bytes
        Json object = Json::object();
        for (std::size_t i = 0; i < size % 1000; ++i) object[std::to_string(i)] = Json::array({i});
        list.push_back(object);
    }
    cache::Memory memory;
    report::StageRecord other;
    other.result = {{"list", list}};
    const auto back = cache::decoded_memory(cache::encoded(memory, other));
    REQUIRE(back);
    CHECK(back->record.result == other.result);
    const Json& found = back->record.result["list"];
    for (std::size_t i = 0; i < list.size(); ++i) CHECK(found[i].type() == list[i].type());
    CHECK(std::signbit(found[4].get<double>()));
}

TEST_CASE("values that are nested deeper than any that is stored are corrupt, and nothing worse", "[cache]") {
    const auto nested = [](std::size_t depth) {
        io::Bytes cbor(depth, std::byte{0x81}); // arrays of one
        cbor.push_back(std::byte{0x01});
        return cbor;
    };
    CHECK(cache::json_of_cbor(nested(200)).is_array());
    CHECK_THROWS_AS(cache::json_of_cbor(nested(201)), cache::Corrupt);
    CHECK_THROWS_AS(cache::json_of_cbor(nested(10'000'000)), cache::Corrupt);
    CHECK_THROWS_AS(cache::json_of_cbor(io::Bytes(1'000'000, std::byte{0x9f})),
                    cache::Corrupt); // never closed
}

TEST_CASE("keys tell texts apart however they are divided", "[cache]") {
    CHECK(cache::key_of({"a", "bc"}) == cache::key_of({"a", "bc"}));
    CHECK(cache::key_of({"a", "bc"}) != cache::key_of({"ab", "c"}));
    CHECK(cache::key_of({"abc"}) != cache::key_of({"abc", ""}));
}

TEST_CASE("the digest of a scene is that of its bytes", "[cache]") {
    Scene scene = full_scene();
    CHECK(cache::digest_of(scene) == sha256(cache::encoded(scene)));
    // More than one block: numbers that fit and do not fit into float32, indices of each width.
    Mesh& mesh = scene.parts[1].mesh;
    constexpr Index n = 400'000;
    for (Index i = 0; i < n; ++i) mesh.positions.push_back({i * 0.5, i * 1.0, 0});
    for (const Index largest : {200u, 60'000u, 10'000'000u, 4'000'000'000u}) {
        mesh.corners.assign(n, 1);
        mesh.corners.back() = largest;
        CHECK(cache::digest_of(scene) == sha256(cache::encoded(scene)));
        mesh.positions.back().z += 0.1;
    }
    mesh.attributes.push_back(attribute("large", Domain::face, Role::generic, 1, false,
                                        AttributeData(std::vector<std::uint8_t>(3 << 20, 7))));
    CHECK(cache::digest_of(scene) == sha256(cache::encoded(scene)));
}
