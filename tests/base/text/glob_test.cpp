#include "support/catch.hpp"

#include "base/text/glob.hpp"

#include <fstream>

using namespace facetmill;
namespace fs = std::filesystem;

TEST_CASE("patterns match whole texts", "[base]") {
    CHECK(glob_matches("*", ""));
    CHECK(glob_matches("wheel*", "wheel_left"));
    CHECK(glob_matches("*_left", "wheel_left"));
    CHECK(glob_matches("w*l*t", "wheel_left"));
    CHECK(glob_matches("lod[0-9]", "lod3"));
    CHECK(glob_matches("lod[!0-9]", "lodx"));
    CHECK(glob_matches("a?c", "abc"));
    CHECK(glob_matches("a\\*c", "a*c"));
    CHECK(glob_matches("a[", "a["));
    CHECK_FALSE(glob_matches("a\\*c", "abc"));
    CHECK_FALSE(glob_matches("wheel", "wheel_left"));
    CHECK_FALSE(glob_matches("lod[0-9]", "lodx"));
    CHECK_FALSE(glob_matches("?", ""));
}

TEST_CASE("a hostile pattern takes no exponential time", "[base]") {
    std::string pattern;
    for (int i = 0; i < 50; ++i) pattern += "a*";
    CHECK_FALSE(glob_matches(pattern + "b", std::string(2000, 'a')));
}

TEST_CASE("a path with patterns names files in the order of their bytes", "[base]") {
    const fs::path folder = fs::temp_directory_path() / "facetmill_glob_test";
    fs::remove_all(folder);
    fs::create_directories(folder / "deep" / "er");
    for (const char* name : {"b.ply", "a.ply", ".hidden.ply", "c.stl", "deep/d.ply", "deep/er/e.ply"})
        std::ofstream(folder / name) << "x";
    const auto names = [&](const char* pattern) {
        std::vector<std::string> all;
        for (const auto& path : expand_glob(folder / pattern))
            all.push_back(path.lexically_relative(folder).string());
        return all;
    };
    CHECK(names("*.ply") == std::vector<std::string>{"a.ply", "b.ply"});
    CHECK(names("**/*.ply") == std::vector<std::string>{"a.ply", "b.ply", "deep/d.ply", "deep/er/e.ply"});
    CHECK(names("deep/**") == std::vector<std::string>{"deep/d.ply", "deep/er/e.ply"});
    CHECK(names("**").size() == 5);
    CHECK(names("*.obj").empty());
    CHECK(names("missing.ply") == std::vector<std::string>{"missing.ply"});
    fs::remove_all(folder);
}

TEST_CASE("a file whose name looks like a pattern is itself", "[base]") {
    const auto folder = fs::temp_directory_path() / "facetmill-glob-literal";
    fs::create_directories(folder);
    for (const char* name : {"[a].ply", "a.ply"}) std::ofstream(folder / name) << "x";
    CHECK(expand_glob(folder / "[a].ply") == std::vector{folder / "[a].ply"});
    fs::remove(folder / "[a].ply");
    CHECK(expand_glob(folder / "[a].ply") == std::vector{folder / "a.ply"});
    fs::remove_all(folder);
}

TEST_CASE("a path is one that a pattern names, component by component", "[base]") {
    for (const char* path : {"in/a.ply", "in/deep/a.ply", "in/deep/er/a.ply"}) {
        CAPTURE(path);
        CHECK(glob_matches_path("in/**/*.ply", path));
        CHECK(glob_matches_path("**/a.ply", path));
        CHECK_FALSE(glob_matches_path("out/**/*.ply", path));
        CHECK_FALSE(glob_matches_path("in/**/*.obj", path));
        CHECK_FALSE(glob_matches_path("in", path));
    }
    CHECK(glob_matches_path("in/*/*.ply", "in/deep/a.ply"));
    CHECK_FALSE(glob_matches_path("in/*/*.ply", "in/a.ply"));
}

TEST_CASE("alternatives in braces are of paths only", "[base]") {
    CHECK(glob_matches_path("a/*.{obj,glb}", "a/x.glb"));
    CHECK(glob_matches_path("{a,b{1,2}}/*.obj", "b2/x.obj"));
    CHECK_FALSE(glob_matches_path("{a,b{1,2}}/*.obj", "b/x.obj"));
    CHECK(glob_matches_path("{a}", "{a}"));
    CHECK(glob_matches_path("${lod}.ply", "${lod}.ply"));
    CHECK(is_glob("{a,b}.ply"));
    CHECK_FALSE(is_glob("{a}.ply"));
    CHECK_FALSE(is_glob("{a/b,c}.ply"));
    CHECK_FALSE(glob_matches("{a,b}", "a")); // names of parts and materials
}
