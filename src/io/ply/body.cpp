#include "io/ply/ply.hpp"

#include "base/progress.hpp"
#include "io/text.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstring>
#include <fmt/format.h>
#include <limits>

namespace facetmill::io::ply {

namespace {

template <class T>
T load(const std::byte* at, bool swap) {
    std::array<std::byte, sizeof(T)> raw;
    std::memcpy(raw.data(), at, sizeof(T));
    if (swap) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<T>(raw);
}

std::int64_t load_count(const std::byte* at, Type type, bool swap) {
    switch (type) {
    case Type::uint8:
        return load<std::uint8_t>(at, swap);
    case Type::int8:
        return load<std::int8_t>(at, swap);
    case Type::uint16:
        return load<std::uint16_t>(at, swap);
    case Type::int16:
        return load<std::int16_t>(at, swap);
    case Type::uint32:
        return load<std::uint32_t>(at, swap);
    case Type::int32:
    case Type::float32: // the header refuses counts of these types
    case Type::float64:
        break;
    }
    return load<std::int32_t>(at, swap);
}

/// The value as T; false when it does not fit.
template <class T>
bool convert(double value, T& out) {
    if constexpr (std::is_integral_v<T>) {
        if (!(value >= static_cast<double>(std::numeric_limits<T>::min()) &&
              value <= static_cast<double>(std::numeric_limits<T>::max())))
            return false;
    }
    out = static_cast<T>(value);
    return true;
}

} // namespace

struct Body::Reader {
    const Input& input;
    Encoding encoding;
    std::size_t at;
    bool swap;
    Text text;

    [[noreturn]] void truncated(const Element& e, std::size_t record) const {
        malformed(input.name(), 0, "E-PLY",
                  fmt::format("the file ends in element '{}', {} of {}, at byte {}", e.name, record, e.count,
                              input.bytes().size()));
    }

    std::size_t left() const { return encoding == Encoding::ascii ? text.left() : input.bytes().size() - at; }

    /// Refuses a count that the rest of the file cannot hold.
    void check_count(const Element& e) const {
        std::size_t least = 0;
        for (const auto& p : e.properties)
            least += encoding == Encoding::ascii ? 2 : size_of(p.list ? p.count_type : p.type);
        // The last word of a text file may lack a space after it.
        if (least > 0 && e.count > (left() + 1) / least)
            malformed(
                input.name(), e.line, "E-PLY",
                fmt::format("element '{}' should have {} items, but the remaining {} bytes hold at most {}",
                            e.name, e.count, left(), (left() + 1) / least));
    }

    std::vector<Column> read_ascii(const Element& e);
    std::vector<Column> read_binary(const Element& e);
    bool read_equal(const Element& e, std::vector<Column>& columns);
    void read_unequal(const Element& e, std::vector<Column>& columns);
};

std::vector<Column> Body::Reader::read_ascii(const Element& e) {
    std::vector<Column> columns(e.properties.size());
    for (std::size_t p = 0; p < columns.size(); ++p) {
        columns[p].values = array_of(e.properties[p].type);
        if (e.properties[p].list) {
            columns[p].offsets.reserve(e.count + 1);
            columns[p].offsets.push_back(0);
        } else
            std::visit([&](auto& v) { v.reserve(e.count); }, columns[p].values);
    }
    for (std::size_t i = 0; i < e.count; ++i, ProgressScope::report_item(i, e.count))
        for (std::size_t p = 0; p < columns.size(); ++p) {
            const Property& property = e.properties[p];
            const char* const name = property.name.c_str();
            std::int64_t n = 1;
            if (property.list) {
                n = text.integer("the length of a list");
                if (n < 0 || static_cast<std::size_t>(n) > text.left() / 2 + 1)
                    text.fail(fmt::format("a list of {} values, which the rest of the file cannot hold", n));
            }
            std::visit(
                [&](auto& values) {
                    for (; n > 0; --n) {
                        const double value = text.real(name);
                        if (!convert(value, values.emplace_back()))
                            text.fail(fmt::format("{} does not fit the type of '{}'", value, name));
                    }
                    if (property.list) columns[p].offsets.push_back(values.size());
                },
                columns[p].values);
        }
    return columns;
}

/// Reads elements whose records all have the same length as the first, in parallel. False if they differ.
bool Body::Reader::read_equal(const Element& e, std::vector<Column>& columns) {
    const std::byte* const base = input.bytes().data() + at;
    const std::size_t room = input.bytes().size() - at;
    struct Place {
        std::size_t offset, each;
    };
    std::vector<Place> places;
    std::size_t stride = 0;
    for (const auto& p : e.properties) {
        std::int64_t n = 1;
        if (p.list) {
            if (stride + size_of(p.count_type) > room) return false;
            n = load_count(base + stride, p.count_type, swap);
            if (n < 0) return false;
            stride += size_of(p.count_type);
        }
        places.push_back({stride, static_cast<std::size_t>(n)});
        if (static_cast<std::size_t>(n) > room) return false;
        stride += static_cast<std::size_t>(n) * size_of(p.type);
    }
    if (stride > 0 && e.count > room / stride) return false;

    ProgressSteps steps({1, 3});
    std::atomic<bool> equal{true};
    parallel_chunks(e.count, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = 0; p < places.size(); ++p) {
            const Property& property = e.properties[p];
            if (!property.list) continue;
            const std::byte* count = base + places[p].offset - size_of(property.count_type);
            for (std::size_t i = begin; i < end; ++i)
                if (load_count(count + i * stride, property.count_type, swap) !=
                    static_cast<std::int64_t>(places[p].each))
                    equal = false;
        }
    });
    if (!equal) return false;
    steps.next();

    for (std::size_t p = 0; p < places.size(); ++p) {
        columns[p].each = places[p].each;
        std::visit([&](auto& v) { v.resize(e.count * places[p].each); }, columns[p].values);
    }
    ProgressScope::report_next_loop();
    parallel_chunks(e.count, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = 0; p < places.size(); ++p)
            std::visit(
                [&](auto& values) {
                    using T = typename std::decay_t<decltype(values)>::value_type;
                    T* to = values.data() + begin * places[p].each;
                    for (std::size_t i = begin; i < end; ++i)
                        for (std::size_t k = 0; k < places[p].each; ++k)
                            *to++ = load<T>(base + i * stride + places[p].offset + k * sizeof(T), swap);
                },
                columns[p].values);
    });
    at += e.count * stride;
    return true;
}

void Body::Reader::read_unequal(const Element& e, std::vector<Column>& columns) {
    const Span bytes = input.bytes();
    for (std::size_t p = 0; p < columns.size(); ++p)
        if (e.properties[p].list) columns[p].offsets.assign(1, 0);
    for (std::size_t i = 0; i < e.count; ++i, ProgressScope::report_item(i, e.count))
        for (std::size_t p = 0; p < columns.size(); ++p) {
            const Property& property = e.properties[p];
            std::int64_t n = 1;
            if (property.list) {
                if (bytes.size() - at < size_of(property.count_type)) truncated(e, i);
                n = load_count(bytes.data() + at, property.count_type, swap);
                if (n < 0)
                    malformed(input.name(), 0, "E-PLY",
                              fmt::format("a list of {} values in element '{}', {} of {}, at byte {}", n,
                                          e.name, i, e.count, at));
                at += size_of(property.count_type);
            }
            if (static_cast<std::size_t>(n) > (bytes.size() - at) / size_of(property.type)) truncated(e, i);
            std::visit(
                [&](auto& values) {
                    using T = typename std::decay_t<decltype(values)>::value_type;
                    for (; n > 0; --n, at += sizeof(T)) values.push_back(load<T>(bytes.data() + at, swap));
                    if (property.list) columns[p].offsets.push_back(values.size());
                },
                columns[p].values);
        }
}

std::vector<Column> Body::Reader::read_binary(const Element& e) {
    std::vector<Column> columns(e.properties.size());
    for (std::size_t p = 0; p < columns.size(); ++p) columns[p].values = array_of(e.properties[p].type);
    if (e.count > 0 && !read_equal(e, columns)) read_unequal(e, columns);
    return columns;
}

Body::Body(const Input& input, const Header& header)
    : reader_(new Reader{input, header.encoding, header.size,
                         (header.encoding == Encoding::big_endian) ==
                             (std::endian::native == std::endian::little),
                         Text(as_text(input.bytes()), input.name(), "E-PLY")}) {
    for (std::int64_t line = 0; line < header.lines; ++line) reader_->text.next_line();
}

Body::~Body() = default;

std::vector<Column> Body::read(const Element& element) {
    if (element.properties.empty()) return {};
    reader_->check_count(element);
    return reader_->encoding == Encoding::ascii ? reader_->read_ascii(element)
                                                : reader_->read_binary(element);
}

std::size_t Body::left() const {
    if (reader_->encoding != Encoding::ascii) {
        const Span rest = reader_->input.bytes().subspan(reader_->at);
        const bool is_line_end = std::all_of(rest.begin(), rest.end(), [](std::byte b) {
            return b == std::byte{'\n'} || b == std::byte{'\r'};
        });
        return is_line_end ? 0 : rest.size();
    }
    Text ahead = reader_->text;
    return ahead.at_end() ? 0 : ahead.left();
}

} // namespace facetmill::io::ply
