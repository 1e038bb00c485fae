#include "io/gltf/document/accessor.hpp"

#include "parallel/memory.hpp"
#include "parallel/parallel.hpp"

#include <cstring>
#include <fmt/format.h>

namespace facetmill::io::gltf {

namespace {

constexpr std::size_t max_zeros = std::size_t{256} << 20;

/// Reads count elements of `components` numbers, `stride` bytes apart.
template <class T>
void gather(const std::byte* from, std::size_t count, std::size_t stride, int components,
            std::vector<T>& to) {
    const std::size_t width = static_cast<std::size_t>(components), bytes = width * sizeof(T);
    if (stride == bytes && reinterpret_cast<std::uintptr_t>(from) % alignof(T) == 0) {
        const auto* const numbers = reinterpret_cast<const T*>(from); // avoids initialising with zeros first
        to.assign(numbers, numbers + count * width);
        return;
    }
    to.resize(count * width);
    parallel_chunks(count, [&](std::size_t begin, std::size_t end) {
        if (stride == bytes)
            std::memcpy(to.data() + begin * width, from + begin * bytes, (end - begin) * bytes);
        else
            for (std::size_t i = begin; i < end; ++i)
                std::memcpy(to.data() + i * width, from + i * stride, bytes);
    });
}

/// Checks that count elements of `size` bytes, `stride` apart, fit into the view from `offset`.
const std::byte* elements(const JsonCursor& place, Span view, std::size_t offset, std::size_t count,
                          std::size_t stride, std::size_t size) {
    const bool fits = count == 0 || (offset <= view.size() && size <= view.size() - offset &&
                                     count - 1 <= (view.size() - offset - size) / stride);
    if (!fits)
        place.fail(fmt::format("{} elements of {} bytes do not fit into its buffer view of {} bytes", count,
                               size, view.size()),
                   "E-BUFFER");
    return view.data() + offset;
}

std::size_t stride_of(const Source& source, const JsonCursor& accessor, std::size_t element) {
    const std::size_t view =
        accessor.at("bufferView").index(count_of(source.json(), "bufferViews"), "buffer view");
    const auto stride = item(source.json(), "bufferViews", view).find("byteStride");
    if (!stride) return element;
    const std::size_t bytes = stride->natural(65536);
    if (bytes < element)
        stride->fail(fmt::format("{} bytes are fewer than the {} bytes of an element", bytes, element));
    return bytes;
}

template <class T>
void apply_sparse(Source& source, const Accessor& a, std::vector<T>& data) {
    const auto sparse = a.place.find("sparse");
    if (!sparse) return;
    const std::size_t count = sparse->at("count").natural(a.count);
    const JsonCursor indices = sparse->at("indices"), values = sparse->at("values");
    const int type = static_cast<int>(indices.at("componentType").natural(65535));
    if (type != uint8 && type != uint16 && type != uint32)
        indices.fail("componentType is not an unsigned integer");
    const std::size_t width = size_of(type), size = sizeof(T) * static_cast<std::size_t>(a.components);
    const std::byte* where = elements(indices, source.view(indices.at("bufferView")),
                                      indices.natural_or("byteOffset", 0), count, width, width);
    const std::byte* what = elements(values, source.view(values.at("bufferView")),
                                     values.natural_or("byteOffset", 0), count, size, size);
    for (std::size_t i = 0; i < count; ++i) {
        std::uint32_t at = 0;
        for (std::size_t b = 0; b < width; ++b)
            at |= std::to_integer<std::uint32_t>(where[i * width + b]) << (8 * b);
        if (at >= a.count)
            indices.fail(fmt::format("index {} is beyond the {} elements", at, a.count), "E-INDEX");
        std::memcpy(data.data() + std::size_t{at} * static_cast<std::size_t>(a.components), what + i * size,
                    size);
    }
}

} // namespace

std::size_t size_of(int component_type) {
    switch (component_type) {
    case int8:
    case uint8:
        return 1;
    case int16:
    case uint16:
        return 2;
    case uint32:
    case float32:
        return 4;
    default:
        return 0;
    }
}

int components_of(std::string_view type) {
    if (type == "SCALAR") return 1;
    if (type == "VEC2") return 2;
    if (type == "VEC3") return 3;
    if (type == "VEC4" || type == "MAT2") return 4;
    if (type == "MAT3") return 9;
    return type == "MAT4" ? 16 : 0;
}

AttributeData empty_data(int component_type) {
    switch (component_type) {
    case int8:
        return std::vector<std::int8_t>{};
    case uint8:
        return std::vector<std::uint8_t>{};
    case int16:
        return std::vector<std::int16_t>{};
    case uint16:
        return std::vector<std::uint16_t>{};
    case uint32:
        return std::vector<std::uint32_t>{};
    default:
        return std::vector<float>{};
    }
}

int component_type_of(const AttributeData& data) {
    static constexpr int types[] = {float32, 0, uint8, int8, uint16, int16, uint32, 0};
    return types[data.index()];
}

Span Source::range(const JsonCursor& owner) const {
    const std::size_t buffer = owner.at("buffer").index(buffers_->size(), "buffer");
    const std::uint64_t offset = owner.natural_or("byteOffset", 0), length = owner.at("byteLength").natural();
    const Bytes& bytes = (*buffers_)[buffer];
    if (offset > bytes.size() || length > bytes.size() - offset)
        owner.fail(fmt::format("bytes {} to {} are beyond the {} bytes of buffers[{}]", offset,
                               offset + length, bytes.size(), buffer),
                   "E-BUFFER");
    return Span(bytes).subspan(offset, length);
}

void Source::need(double bytes) {
    needed_ += bytes;
    if (is_much_memory(needed_))
        require_memory(needed_, "the data decoded from the document's buffers",
                       "use a machine with more memory");
}

bool Source::without_bytes(std::size_t index) const {
    if (added_ && added_->contains(index)) return false;
    const JsonCursor view = item(*json_, "bufferViews", index);
    return !meshopt_extension(view) &&
           (*buffers_)[view.at("buffer").index(buffers_->size(), "buffer")].empty();
}

Span Source::view(const JsonCursor& reference) {
    return view(reference.index(count_of(*json_, "bufferViews"), "buffer view"));
}

Span Source::view(std::size_t index) {
    if (added_)
        if (const auto added = added_->find(index); added != added_->end()) return added->second;
    const JsonCursor place = item(*json_, "bufferViews", index);
    const auto meshopt = meshopt_extension(place);
    if (!meshopt) return range(place);
    auto found = decompressed_.find(index);
    if (found == decompressed_.end())
        found = decompressed_.emplace(index, decode_meshopt(*this, *meshopt)).first;
    return found->second;
}

Accessor accessor(const Source& source, const JsonCursor& reference) {
    const std::size_t index = reference.index(count_of(source.json(), "accessors"), "accessor");
    const JsonCursor place = item(source.json(), "accessors", index);
    const std::string type = place.at("type").text();
    Accessor a{place, place.at("count").natural(), static_cast<int>(place.at("componentType").natural(65535)),
               components_of(type), place.boolean_or("normalized", false)};
    if (size_of(a.component_type) == 0)
        place.at("componentType").fail(fmt::format("{} is not a component type", a.component_type));
    if (a.components == 0) place.at("type").fail(fmt::format("\"{}\" is not an element type", type));
    return a;
}

AttributeData decode(Source& source, const Accessor& a) {
    AttributeData data = empty_data(a.component_type);
    const std::size_t size = size_of(a.component_type) * static_cast<std::size_t>(a.components);
    const auto view = a.place.find("bufferView");
    const std::byte* from = nullptr;
    std::size_t stride = size;
    if (view) {
        stride = stride_of(source, a.place, size);
        from =
            elements(a.place, source.view(*view), a.place.natural_or("byteOffset", 0), a.count, stride, size);
    } else if (a.count > max_zeros / size) {
        throw Error(
            ErrorKind::limit, "E-LIMIT",
            fmt::format("{}: {} elements without bytes in the file are too many", a.place.path(), a.count));
    }
    std::visit(
        [&](auto& numbers) {
            if (from)
                gather(from, a.count, stride, a.components, numbers);
            else
                numbers.resize(a.count * static_cast<std::size_t>(a.components));
            apply_sparse(source, a, numbers);
        },
        data);
    return data;
}

Attribute decode_numbers(Source& source, const Accessor& a) {
    return {"", Domain::wedge, Role::generic, a.components, a.normalised, decode(source, a)};
}

Attribute decode_numbers(Source& source, std::size_t index) {
    const Json reference = index;
    return decode_numbers(source,
                          accessor(source, JsonCursor(reference, fmt::format("accessors[{}]", index))));
}

std::vector<Index> decode_indices(Source& source, const JsonCursor& reference, std::size_t count) {
    const Accessor a = accessor(source, reference);
    const bool unsigned_type =
        a.component_type == uint8 || a.component_type == uint16 || a.component_type == uint32;
    if (a.components != 1 || !unsigned_type) a.place.fail("indices must be unsigned scalars");
    AttributeData data = decode(source, a);
    std::vector<Index> indices;
    if (auto* whole = std::get_if<std::vector<Index>>(&data))
        indices = std::move(*whole);
    else
        std::visit(
            [&](const auto& numbers) {
                indices.resize(a.count);
                parallel_for(a.count, [&](std::size_t i) { indices[i] = static_cast<Index>(numbers[i]); });
            },
            data);
    const std::size_t bad = parallel_reduce(
        a.count, a.count,
        [&](std::size_t begin, std::size_t end) {
            while (begin < end && indices[begin] < count) ++begin;
            return begin < end ? begin : a.count;
        },
        [](std::size_t x, std::size_t y) { return std::min(x, y); });
    if (bad < a.count)
        reference.fail(fmt::format("index {} at {} is beyond the {} vertices", indices[bad], bad, count),
                       "E-INDEX");
    return indices;
}

} // namespace facetmill::io::gltf
