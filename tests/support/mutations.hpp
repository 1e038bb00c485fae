#pragma once
// Damages small valid mesh files: cuts, flips, duplicates and splices bytes. The result depends only on the
// seed.

#include "base/error.hpp"
#include "base/math/random.hpp"
#include "io/codec.hpp"
#include "mesh/invariants.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace facetmill::test {

/// Damages the bytes one to four times, chosen by the seed.
inline io::Bytes mutated(io::Bytes bytes, std::uint64_t seed) {
    std::uint64_t draws = 0;
    const auto draw = [&](std::size_t below) {
        return below == 0 ? std::size_t{0} : static_cast<std::size_t>(hashed(seed, draws++) % below);
    };
    const auto at = [&](std::size_t i) { return bytes.begin() + static_cast<std::ptrdiff_t>(i); };
    static constexpr unsigned char nasty[] = {0,   0xff, 0x7f, 0x80, '-', '9',  '0',
                                              ' ', '\n', '/',  '.',  'e', '\\', '"'};
    for (std::size_t damages = 1 + draw(4); damages > 0 && !bytes.empty(); --damages) {
        const std::size_t i = draw(bytes.size()), n = std::min(bytes.size() - i, 1 + draw(16));
        switch (draw(7)) {
        case 0:
            bytes.resize(i);
            break;
        case 1:
            bytes[i] ^= static_cast<std::byte>(1U << draw(8));
            break;
        case 2:
            bytes[i] = static_cast<std::byte>(nasty[draw(sizeof nasty)]);
            break;
        case 3:
            bytes.erase(at(i), at(i + n));
            break;
        case 4: {
            const io::Bytes copy(at(i), at(i + n));
            bytes.insert(at(draw(bytes.size())), copy.begin(), copy.end());
            break;
        }
        case 5:
            std::fill(at(i), at(i + n), static_cast<std::byte>(nasty[draw(sizeof nasty)]));
            break;
        default:
            std::swap(bytes[i], bytes[draw(bytes.size())]);
        }
    }
    return bytes;
}

/// Reads the bytes as that file. Returns the fault, or an empty text for a sound scene or an allowed error.
inline std::string trouble_reading(const std::string& name, io::Bytes bytes) {
    try {
        io::ReadLog log;
        const Scene scene =
            io::read_scene(io::Input::of(name, std::move(bytes)), {}, log, io::codec_for(name));
        const auto broken = broken_invariants(scene);
        return broken.empty() ? "" : broken.front();
    } catch (const Error& error) {
        const bool fair = error.kind() == ErrorKind::malformed || error.kind() == ErrorKind::limit ||
                          error.kind() == ErrorKind::missing;
        return fair ? "" : std::string("refused as the wrong kind: ") + error.what();
    } catch (const std::exception& error) {
        return std::string("escaped: ") + error.what();
    }
}

} // namespace facetmill::test
