#include "support/catch.hpp"

#include "base/error.hpp"
#include "io/gltf/draco/draco.hpp"
#include "io/read_back.hpp"
#include "mesh/shapes.hpp"
#include "support/run_stage.hpp"

#include <draco/compression/decode.h>
#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
#include <random>

using namespace facetmill;

namespace {

constexpr std::uint32_t points = 60;

template <class Number>
void add(::draco::Mesh& mesh, ::draco::GeometryAttribute::Type type, std::uint8_t components,
         ::draco::DataType data, const std::vector<Number>& numbers) {
    ::draco::GeometryAttribute attribute;
    const std::size_t stride = components * sizeof(Number);
    attribute.Init(type, nullptr, components, data, data != ::draco::DT_FLOAT32,
                   static_cast<std::int64_t>(stride), 0);
    const int id = mesh.AddAttribute(attribute, true, points);
    mesh.attribute(id)->buffer()->Write(0, numbers.data(), numbers.size() * sizeof(Number));
}

/// A strip with all that is left quantised, and texture coordinates as floats or as whole numbers.
std::vector<char> encoded(bool whole_uvs, bool named = false) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> number(-3, 5);
    const auto floats = [&](std::size_t count) {
        std::vector<float> all(count);
        for (float& x : all) x = number(random);
        return all;
    };
    ::draco::Mesh mesh;
    mesh.set_num_points(points);
    for (std::uint32_t f = 0; f + 2 < points; ++f)
        mesh.AddFace(
            {::draco::PointIndex(f), ::draco::PointIndex(f + 1 + f % 2), ::draco::PointIndex(f + 2 - f % 2)});
    using Attribute = ::draco::GeometryAttribute;
    add(mesh, Attribute::POSITION, 3, ::draco::DT_FLOAT32, floats(points * 3));
    add(mesh, Attribute::NORMAL, 3, ::draco::DT_FLOAT32, floats(points * 3));
    if (whole_uvs) {
        std::vector<std::uint16_t> uvs(points * 2);
        for (auto& uv : uvs) uv = static_cast<std::uint16_t>(random() % 65536);
        add(mesh, Attribute::TEX_COORD, 2, ::draco::DT_UINT16, uvs);
    } else {
        add(mesh, Attribute::TEX_COORD, 2, ::draco::DT_FLOAT32, floats(points * 2));
    }
    add(mesh, Attribute::GENERIC, 1, ::draco::DT_FLOAT32, floats(points));
    if (named) {
        auto all = std::make_unique<::draco::GeometryMetadata>();
        all->AddEntryString("author", "somebody");
        mesh.AddMetadata(std::move(all));
        auto own = std::make_unique<::draco::AttributeMetadata>();
        own->AddEntryString("name", "heat");
        own->AddEntryInt("first_object", 1);
        mesh.AddAttributeMetadata(3, std::move(own));
    }
    ::draco::Encoder encoder;
    for (const auto type : {Attribute::POSITION, Attribute::TEX_COORD, Attribute::GENERIC})
        encoder.SetAttributeQuantization(type, 11);
    encoder.SetAttributeQuantization(Attribute::NORMAL, 8);
    ::draco::EncoderBuffer buffer;
    REQUIRE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
    return {buffer.data(), buffer.data() + buffer.size()};
}

} // namespace

TEST_CASE("what Draco has quantised is the same as its own decoder gives, types too", "[io]") {
    for (const bool whole_uvs : {false, true}) {
        const std::vector<char> bytes = encoded(whole_uvs);
        ::draco::DecoderBuffer buffer;
        buffer.Init(bytes.data(), bytes.size());
        const auto expected = ::draco::Decoder().DecodeMeshFromBuffer(&buffer);
        REQUIRE(expected.ok());
        const ::draco::Mesh& mesh = *expected.value();
        const io::DracoMesh found = io::decode_draco(std::as_bytes(std::span(bytes)));
        REQUIRE(found.points == mesh.num_points());
        REQUIRE(found.columns.size() == 4);
        for (int a = 0; a < mesh.num_attributes(); ++a) {
            const ::draco::PointAttribute& attribute = *mesh.attribute(a);
            const auto column =
                std::find_if(found.columns.begin(), found.columns.end(),
                             [&](const io::DracoColumn& c) { return c.id == attribute.unique_id(); });
            REQUIRE(column != found.columns.end());
            CHECK(column->components == attribute.num_components());
            const bool whole = whole_uvs && column->kind == io::DracoKind::uv;
            CHECK(std::holds_alternative<std::vector<std::uint16_t>>(column->data) == whole);
            CHECK(column->normalised == whole);
            std::visit(
                [&](const auto& numbers) {
                    using Number = typename std::decay_t<decltype(numbers)>::value_type;
                    std::vector<Number> values(numbers.size());
                    const auto width = static_cast<std::size_t>(attribute.num_components());
                    for (std::uint32_t p = 0; p < mesh.num_points(); ++p)
                        attribute.GetMappedValue(::draco::PointIndex(p), &values[p * width]);
                    for (std::size_t i = 0; i < values.size();
                         ++i) // of at most 5; some processors round once
                        CHECK(std::abs(double(numbers[i]) - double(values[i])) <= 1e-6);
                },
                column->data);
        }
    }
}

TEST_CASE("metadata of Draco other than names of attributes are counted", "[io]") {
    const auto entries = [](bool named) {
        const std::vector<char> bytes = encoded(false, named);
        return io::decode_draco(std::as_bytes(std::span(bytes))).metadata;
    };
    CHECK(entries(false) == 0);
    CHECK(entries(true) == 2);
}

TEST_CASE("Draco data that is known is not decoded again, other data is", "[io]") {
    const std::vector<char> one = encoded(false), other = encoded(true);
    const auto bytes_of = [](const std::vector<char>& chars) { return std::as_bytes(std::span(chars)); };
    const auto told = std::make_shared<io::DracoMesh>();
    told->points = 7;
    io::DracoDecodings known;
    known.add(bytes_of(one), told);
    CHECK(io::decode_draco(bytes_of(one), io::DracoContents::mesh, &known).points == 7);
    CHECK(io::decode_draco(bytes_of(one), io::DracoContents::mesh, nullptr).points ==
          io::decode_draco(bytes_of(one)).points);
    CHECK(io::decode_draco(bytes_of(other), io::DracoContents::mesh, &known).points ==
          io::decode_draco(bytes_of(other)).points);
    std::vector<char> changed = one;
    changed.back() = static_cast<char>(changed.back() + 1); // a fault of the disk is not hidden
    CHECK(io::DracoDecodings(known).decode(bytes_of(one), io::DracoContents::mesh).points == 7);
    std::size_t decoded = 0;
    try {
        decoded = known.decode(bytes_of(changed), io::DracoContents::mesh).points;
    } catch (const Error&) {
    }
    CHECK(decoded != 7);
}

TEST_CASE("a file is read back by what its Draco data was decoded to as it is without", "[io]") {
    const Scene scene = test::scene_of(shapes::icosphere(3));
    for (const char* name : {"glb", "drc"}) {
        const io::Codec& codec = *io::codec_named(name);
        io::WriteSettings settings;
        settings.draco.on = settings.draco.keep_decoded = true;
        const io::Written written = codec.write(scene, settings);
        REQUIRE(written.decoded);
        const auto input = io::Input::of("a", written.files[0].bytes);
        const io::ReadBack by_known = io::read_back(input, codec, scene, settings, written);
        const io::ReadBack anew = io::read_back(input, codec, scene, settings);
        CHECK(by_known.json() == anew.json());
        CHECK(by_known.scene.parts[0].mesh.positions == anew.scene.parts[0].mesh.positions);
        CHECK(by_known.scene.parts[0].mesh.corners == anew.scene.parts[0].mesh.corners);
        settings.draco.keep_decoded = false;
        CHECK(codec.write(scene, settings).files[0].bytes == written.files[0].bytes);
    }
}
