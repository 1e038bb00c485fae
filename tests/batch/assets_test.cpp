#include "support/catch.hpp"

#include "batch/batch.hpp"
#include "batch/table.hpp"
#include "support/failure.hpp"
#include "support/temporary.hpp"

#include <filesystem>

using namespace facetmill;
using namespace facetmill::test;
namespace fs = std::filesystem;

namespace {

batch::Sources sources_of(std::vector<std::string> patterns) {
    batch::Sources sources;
    sources.patterns = std::move(patterns);
    sources.place = [](const std::string&) { return Mark{}; };
    return sources;
}

std::vector<std::string> folders_of(const std::vector<batch::Asset>& assets) {
    std::vector<std::string> folders;
    for (const auto& asset : assets) folders.push_back((asset.folder / asset.input.filename()).string());
    return folders;
}

using Texts = std::vector<std::string>;

} // namespace

TEST_CASE("assets mirror the folders below what a pattern fixes", "[batch]") {
    const TemporaryDirectory dir;
    for (const char* name : {"in/x/a.ply", "in/x/y/b.ply", "in/c.ply", "in/c.obj"}) {
        fs::create_directories((dir / name).parent_path());
        put(dir / name, "");
    }
    const auto find = [&](const std::string& pattern) {
        return folders_of(batch::find_assets(sources_of({(dir / pattern).string()})));
    };
    CHECK(find("in/**/*.ply") == Texts{"c.ply", "x/a.ply", "x/y/b.ply"});
    CHECK(find("in/x/**/*.ply") == Texts{"a.ply", "y/b.ply"});
    CHECK(find("in/*/*.ply") == Texts{"x/a.ply"});
    CHECK(find("in/x/a.ply") == Texts{"a.ply"});

    auto two = sources_of({(dir / "in/*.ply").string(), (dir / "in/c.*").string()});
    CHECK(folders_of(batch::find_assets(two)) == Texts{"c.ply", "c.obj"});
    two.base = dir.path().string();
    CHECK(folders_of(batch::find_assets(two)) == Texts{"in/c.ply", "in/c.obj"});
    two.base = (dir / "in/x").string();
    CHECK(folders_of(batch::find_assets(two)) == Texts{"c.ply", "c.obj"});
}

TEST_CASE("a pattern without a match is an error, each of them", "[batch]") {
    const TemporaryDirectory dir;
    std::size_t told = 0;
    try {
        batch::find_assets(sources_of({(dir / "*.ply").string(), (dir / "none.ply").string()}));
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::missing);
        told = error.diagnostics().size();
    }
    CHECK(told == 2);
}

TEST_CASE("nothing is left of a pattern only where its folder can be seen", "[batch]") {
    const TemporaryDirectory dir;
    const std::string file = (dir / "in/a.ply").string();
    auto sources = sources_of({(dir / "in/**/*.ply").string()});
    sources.former = {file};
    const std::string refused = "missing [E-FILE] no file matches";
    CHECK(failure([&] { batch::find_assets(sources); }).starts_with(refused));
    fs::create_directories(dir / "in");
    CHECK(failure([&] { batch::find_assets(sources); }).starts_with(refused));
    put(dir / "in/other.txt", "");
    CHECK(batch::find_assets(sources).empty());
    sources.patterns = {file};
    CHECK(batch::find_assets(sources).empty());
    put(dir / "list", "\n");
    sources.lists = {(dir / "list").string()};
    CHECK(failure([&] { batch::find_assets(sources); }).starts_with("missing [E-FILE]"));
}

TEST_CASE("lists hold a name on each line, or each ended by a NUL", "[batch]") {
    const TemporaryDirectory dir;
    auto sources = sources_of({});
    const auto names = [&](const std::string& text) {
        put(dir / "list", text);
        sources.lists = {(dir / "list").string()};
        Texts found;
        for (const auto& asset : batch::find_assets(sources)) found.push_back(asset.name);
        return found;
    };
    CHECK(names("a.ply\r\n\nb c.ply") == Texts{"a.ply", "b c.ply"});
    CHECK(names(std::string("a\nb.ply\0c.ply\0", 14)) == Texts{"a\nb.ply", "c.ply"});
    CHECK(names("a.ply\n./a.ply\n") == Texts{"a.ply"});
    CHECK(failure([&] { names("\n"); }).starts_with("missing [E-FILE]"));
}

TEST_CASE("a row of a table is an asset with params of its own", "[batch]") {
    const TemporaryDirectory dir;
    put(dir / "t.csv", "input;keep\n\"a;\"\"1\"\".ply\";10%\nsub/b.ply;\nsub/b.ply;20%\n");
    auto sources = sources_of({});
    sources.table = (dir / "t.csv").string();
    const auto assets = batch::find_assets(sources);
    REQUIRE(assets.size() == 3);
    CHECK(assets[0].name == "a;\"1\".ply");
    CHECK(assets[0].defines ==
          std::vector<std::pair<std::string, std::string>>{{"input", "a;\"1\".ply"}, {"keep", "10%"}});
    CHECK(to_string(assets[0].defined_at.at("keep")) == (dir / "t.csv").string() + ":2:15");
    CHECK(assets[1].name == "sub/b.ply (row 2)");
    CHECK(assets[1].defines.size() == 1);
    CHECK(assets[2].folder.string() == "sub");
}

TEST_CASE("the most severe exit code", "[batch]") {
    CHECK(batch::worse_exit_code(0, 1) == 1);
    CHECK(batch::worse_exit_code(70, 2) == 70);
    CHECK(batch::worse_exit_code(1, 3) == 3);
    CHECK(batch::worse_exit_code(6, 3) == 6);
    CHECK(batch::worse_exit_code(4, 5) == 4);
    CHECK(batch::worse_exit_code(7, 4) == 4);
}

TEST_CASE("an empty table of params is refused by its name", "[batch]") {
    test::TemporaryDirectory directory;
    test::put(directory / "empty.csv", "\n");
    try {
        batch::read_params_table(directory / "empty.csv");
        FAIL("it was read");
    } catch (const Error& e) {
        REQUIRE(e.diagnostics().size() == 1);
        CHECK(e.diagnostics()[0].message == "the table is empty");
        CHECK(to_string(e.diagnostics()[0].where) == (directory / "empty.csv").string());
    }
}

TEST_CASE("each feature of a GeoJSON is an asset with its polygon and name", "[batch]") {
    const TemporaryDirectory dir;
    const auto feature = [](const std::string& more, const std::string& geometry) {
        return R"({"type": "Feature", )" + more + R"("geometry": )" + geometry + "}";
    };
    const std::string square =
        R"({"type": "Polygon", "coordinates": [[[0, 0], [2.5, 0], [2.5, 2, 9], [0, 0]]]})";
    const std::string two =
        R"({"type": "MultiPolygon", "coordinates": [[[[0, 0], [1, 0], [1, 1]]], [[[5, 5], [6, 5], [6, 6]]]]})";
    const auto table = [&](const std::string& features) {
        put(dir / "t.geojson", R"({"type": "FeatureCollection", "features": [)" + features + "]}");
        auto sources = sources_of({});
        sources.table = (dir / "t.geojson").string();
        return batch::find_assets(sources);
    };
    const auto assets = table(feature(R"("properties": {"name": "north/1", "size": 3}, )", square) + ", " +
                              feature(R"("id": 7, "properties": null, )", two) + ", " + feature("", square));
    REQUIRE(assets.size() == 3);
    CHECK(assets[0].name == "north_1");
    CHECK(assets[0].defines == std::vector<std::pair<std::string, std::string>>{
                                   {"name", "north_1"}, {"feature", "POLYGON ((0 0, 2.5 0, 2.5 2, 0 0))"}});
    CHECK(assets[1].name == "7");
    CHECK(assets[1].defines[1].second == "MULTIPOLYGON (((0 0, 1 0, 1 1)), ((5 5, 6 5, 6 6)))");
    CHECK(assets[2].name == "3");
    const auto refused = [&](const std::string& features) { return failure([&] { table(features); }); };
    CHECK(refused(feature("", square) + ", " + feature(R"("id": 1, )", square))
              .find("two features are named '1'") != std::string::npos);
    CHECK(refused(feature("", R"({"type": "Point", "coordinates": [1, 2]})")).find("is not a polygon") !=
          std::string::npos);
    CHECK(refused(feature("", R"({"type": "Polygon", "coordinates": [[[1], 2]]})")).find("malformed") !=
          std::string::npos);
    CHECK(refused(feature("", "null")).find("is not a polygon") != std::string::npos);
}
