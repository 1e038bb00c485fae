#include "support/catch.hpp"

#include "base/hash.hpp"
#include "support/temporary.hpp"

using namespace facetmill;

TEST_CASE("bytes that come in pieces have the digest of all", "[base]") {
    // FIPS 180-4's example.
    CHECK(sha256(test::bytes_of("abc")) ==
          "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    const std::string text(100'000, 'x');
    for (const std::size_t piece : {1, 63, 64, 65, 70'000}) {
        Sha256 sum;
        for (std::size_t at = 0; at < text.size(); at += piece)
            sum.add(test::bytes_of(text.substr(at, piece)));
        CHECK(sum.digest() == sha256(test::bytes_of(text)));
    }
    CHECK(Sha256().digest() == sha256({}));
}
