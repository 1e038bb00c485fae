#include "support/catch.hpp"

#include "io/images/image_files.hpp"

using namespace facetmill;

TEST_CASE("images get file names that every system allows", "[io]") {
    CHECK(io::file_name_of_image("a/b:c?d\\e|f", 0, {}) == "a_b_c_d_e_f.png");
    CHECK(io::file_name_of_image("wood.png", 0, {}) == "wood.png");
    CHECK(io::file_name_of_image("", 3, {}) == "image3.png");
}

TEST_CASE("a reference to an image has no root", "[io]") {
    CHECK(io::relative_path_of("textures\\wood.png") == "textures/wood.png");
    CHECK(!io::relative_path_of("/etc/wood.png"));
    CHECK(!io::relative_path_of("\\\\server\\share\\wood.png"));
}
