#include "cache/archive.hpp"

#include "base/math/numbers.hpp"

#include <algorithm>

namespace facetmill::cache {

namespace {

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool are_floats(const double* from, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
        // Outside the range of floats, the conversion is undefined; a NaN may lose its payload.
        if (!(from[i] >= -3.4e38 && from[i] <= 3.4e38)) return false;
        if (!same_bits(as_float32(from[i]), from[i])) return false;
    }
    return true;
}

constexpr unsigned bits_of_byte = 8;
constexpr std::size_t at_a_time = std::size_t{1} << 16; ///< numbers per piece, when bytes are passed on

using Indices = std::span<const std::uint32_t>;

template <unsigned Width>
void pack(Indices all, std::byte* to) {
    for (const std::uint32_t index : all)
        for (unsigned b = 0; b < Width; ++b) *to++ = static_cast<std::byte>(index >> (bits_of_byte * b));
}

template <unsigned Width>
void unpack(const std::byte* from, std::vector<std::uint32_t>& all) {
    for (std::uint32_t& index : all) {
        index = 0;
        for (unsigned b = 0; b < Width; ++b)
            index |= static_cast<std::uint32_t>(*from++) << (bits_of_byte * b);
    }
}

} // namespace

namespace {

/// Stops at values nested deeper than any stored value, because reading and destroying them is recursive.
class DepthLimit : public nlohmann::json_sax<Json> {
  public:
    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t) override { return true; }
    bool number_unsigned(number_unsigned_t) override { return true; }
    bool number_float(number_float_t, const string_t&) override { return true; }
    bool string(string_t&) override { return true; }
    bool binary(binary_t&) override { return true; }
    bool key(string_t&) override { return true; }
    bool start_object(std::size_t) override { return ++depth_ <= deepest; }
    bool start_array(std::size_t) override { return ++depth_ <= deepest; }
    bool end_object() override { return --depth_ >= 0; }
    bool end_array() override { return --depth_ >= 0; }
    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
        return false;
    }

  private:
    static constexpr int deepest = 200;
    int depth_ = 0;
};

} // namespace

namespace {

/// Writes CBOR (RFC 8949) without the library's virtual call for each byte. Values that JSON lacks become
/// null.
class CborWriter {
  public:
    explicit CborWriter(io::Bytes& out) : out_(out) {}

    void write(const Json& json) {
        switch (json.type()) {
        case Json::value_t::boolean:
            return byte(json.get<bool>() ? yes : no);
        case Json::value_t::number_unsigned:
            return head(natural, json.get<std::uint64_t>());
        case Json::value_t::number_integer: {
            const auto value = json.get<std::int64_t>();
            return value < 0 ? head(negative, ~static_cast<std::uint64_t>(value))
                             : head(natural, static_cast<std::uint64_t>(value));
        }
        case Json::value_t::number_float:
            byte(float64);
            return most_significant_first(std::bit_cast<std::uint64_t>(json.get<double>()), 8);
        case Json::value_t::string:
            return write(json.get_ref<const std::string&>());
        case Json::value_t::array:
            head(list, json.size());
            for (const Json& item : json) write(item);
            return;
        case Json::value_t::object:
            head(object, json.size());
            for (const auto& [key, value] : json.get_ref<const Json::object_t&>()) {
                write(key);
                write(value);
            }
            return;
        default:
            return byte(null);
        }
    }

  private:
    enum Major : unsigned { natural = 0, negative = 1, text = 3, list = 4, object = 5 };
    enum Simple : unsigned { no = 0xF4, yes = 0xF5, null = 0xF6, float64 = 0xFB };

    void byte(unsigned value) { out_.push_back(static_cast<std::byte>(value)); }
    void most_significant_first(std::uint64_t value, unsigned bytes) {
        while (bytes-- > 0) byte(static_cast<unsigned>(value >> (bits_of_byte * bytes)) & 0xFF);
    }
    void head(Major major, std::uint64_t n) {
        constexpr unsigned in_one = 24; // smaller numbers fit into the first byte
        const unsigned power = n <= 0xFF ? 0 : n <= 0xFFFF ? 1 : n <= 0xFFFFFFFF ? 2 : 3;
        if (n < in_one) return byte(major << 5 | static_cast<unsigned>(n));
        byte(major << 5 | (in_one + power));
        most_significant_first(n, 1U << power);
    }
    void write(const std::string& string) {
        head(text, string.size());
        const auto* begin = reinterpret_cast<const std::byte*>(string.data());
        out_.insert(out_.end(), begin, begin + string.size());
    }

    io::Bytes& out_;
};

} // namespace

void ByteWriter::put(const Json& json) {
    io::Bytes cbor;
    CborWriter(cbor).write(json);
    count(cbor.size());
    raw(cbor.data(), cbor.size());
}

Json json_of_cbor(io::Span cbor) {
    const auto* begin = reinterpret_cast<const std::uint8_t*>(cbor.data());
    DepthLimit limit;
    if (!Json::sax_parse(begin, begin + cbor.size(), &limit, Json::input_format_t::cbor)) throw Corrupt();
    Json json = Json::from_cbor(begin, begin + cbor.size(), true, false);
    if (json.is_discarded()) throw Corrupt();
    return json;
}

void ByteWriter::doubles(const double* from, std::size_t n) {
    const bool small = are_floats(from, n);
    put(small);
    if (!small) return raw(from, n * sizeof(double));
    for (std::size_t begin = 0; begin < n; begin += at_a_time) {
        const std::size_t end = std::min(n, begin + at_a_time);
        std::byte* to = room((end - begin) * sizeof(float));
        for (std::size_t i = begin; i < end; ++i, to += sizeof(float)) {
            const auto value = static_cast<float>(from[i]);
            std::memcpy(to, &value, sizeof value);
        }
    }
}

void ByteReader::doubles(double* to, std::size_t n) {
    bool small = false;
    get(small);
    if (!small) return raw(to, n * sizeof(double));
    const io::Span from = take(n * sizeof(float));
    for (std::size_t i = 0; i < n; ++i) {
        float value = 0;
        std::memcpy(&value, from.data() + i * sizeof value, sizeof value);
        to[i] = static_cast<double>(value);
    }
}

void ByteWriter::indices(const std::vector<std::uint32_t>& all) {
    std::uint32_t largest = 0;
    for (const std::uint32_t index : all) largest = std::max(largest, index);
    const auto bits = static_cast<unsigned>(std::bit_width(std::max(largest, 1u)));
    const auto width = static_cast<std::uint8_t>((bits + bits_of_byte - 1) / bits_of_byte);
    put(width);
    constexpr auto packers = std::array{pack<1>, pack<2>, pack<3>, pack<4>};
    for (std::size_t begin = 0; begin < all.size(); begin += at_a_time) {
        const std::size_t n = std::min(at_a_time, all.size() - begin);
        packers[width - 1u](Indices(all).subspan(begin, n), room(n * width));
    }
}

void ByteReader::indices(std::vector<std::uint32_t>& all) {
    const std::size_t n = count(1);
    std::uint8_t width = 0;
    get(width);
    if (width < 1 || width > 4 || n > left_.size() / width) throw Corrupt();
    const std::byte* from = take(n * width).data();
    all.resize(n);
    if (width == 1) return unpack<1>(from, all);
    if (width == 2) return unpack<2>(from, all);
    if (width == 3) return unpack<3>(from, all);
    unpack<4>(from, all);
}

} // namespace facetmill::cache
