#include "io/gltf/draco/dequantise.hpp"

#include "base/error.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>

#include <draco/attributes/attribute_octahedron_transform.h>
#include <draco/attributes/attribute_quantization_transform.h>
#include <draco/compression/attributes/normal_compression_utils.h>
#include <iterator>

namespace facetmill::io {

namespace {

constexpr ::draco::GeometryAttribute::Type kept_quantised[] = {::draco::GeometryAttribute::POSITION,
                                                               ::draco::GeometryAttribute::NORMAL,
                                                               ::draco::GeometryAttribute::TEX_COORD};

[[noreturn]] void fail() {
    throw Error(ErrorKind::malformed, "E-DRACO",
                "the Draco data cannot be decoded: its quantization parameters are invalid");
}

std::int32_t whole_number(const ::draco::PointAttribute& attribute, std::size_t value, int component) {
    const auto* numbers = reinterpret_cast<const std::int32_t*>(
        attribute.GetAddress(::draco::AttributeValueIndex(static_cast<std::uint32_t>(value))));
    return numbers[component];
}

Dequantised off_the_grid(const ::draco::PointAttribute& attribute) {
    ::draco::AttributeQuantizationTransform grid;
    const int components = attribute.num_components();
    if (!grid.InitFromAttribute(attribute) || grid.quantization_bits() < 1 || grid.quantization_bits() > 30 ||
        grid.min_values().size() < static_cast<std::size_t>(components))
        fail();
    const float step = grid.range() / static_cast<float>((1 << grid.quantization_bits()) - 1);
    const auto width = static_cast<std::size_t>(components);
    Dequantised out{components, std::vector<float>(attribute.size() * width)};
    parallel_for(attribute.size(), [&](std::size_t i) {
        for (int c = 0; c < components; ++c)
            out.numbers[width * i + static_cast<std::size_t>(c)] =
                static_cast<float>(whole_number(attribute, i, c)) * step + grid.min_value(c);
    });
    return out;
}

Dequantised off_the_octahedron(const ::draco::PointAttribute& attribute) {
    ::draco::AttributeOctahedronTransform transform;
    ::draco::OctahedronToolBox octahedron;
    if (!transform.InitFromAttribute(attribute) || attribute.num_components() != 2 ||
        !octahedron.SetQuantizationBits(transform.quantization_bits()))
        fail();
    Dequantised out{3, std::vector<float>(attribute.size() * 3)};
    for (std::size_t i = 0; i < attribute.size(); ++i)
        octahedron.QuantizedOctahedralCoordsToUnitVector(whole_number(attribute, i, 0),
                                                         whole_number(attribute, i, 1), &out.numbers[3 * i]);
    return out;
}

} // namespace

void keep_quantised(::draco::Decoder& decoder) {
    for (const auto type : kept_quantised) decoder.SetSkipAttributeTransform(type);
}

bool has_lost_types(const ::draco::PointCloud& mesh) {
    for (int a = 0; a < mesh.num_attributes(); ++a) {
        const ::draco::PointAttribute& attribute = *mesh.attribute(a);
        const bool is_kept = std::find(std::begin(kept_quantised), std::end(kept_quantised),
                                       attribute.attribute_type()) != std::end(kept_quantised);
        const bool is_whole =
            attribute.data_type() == ::draco::DT_INT32 || attribute.data_type() == ::draco::DT_UINT32;
        if (is_kept && is_whole && !attribute.GetAttributeTransformData()) return true;
    }
    return false;
}

std::optional<Dequantised> dequantised(const ::draco::PointAttribute& attribute) {
    const ::draco::AttributeTransformData* data = attribute.GetAttributeTransformData();
    if (!data) return {};
    if (attribute.data_type() != ::draco::DT_INT32 && attribute.data_type() != ::draco::DT_UINT32)
        fail(); // points in a tree have at most 30 bits
    if (data->transform_type() == ::draco::ATTRIBUTE_QUANTIZATION_TRANSFORM) return off_the_grid(attribute);
    if (data->transform_type() == ::draco::ATTRIBUTE_OCTAHEDRON_TRANSFORM)
        return off_the_octahedron(attribute);
    fail();
}

} // namespace facetmill::io
