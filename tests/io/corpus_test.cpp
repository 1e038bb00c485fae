#include "support/catch.hpp"
#include "support/corpus.hpp"

#include "io/codec.hpp"
#include "mesh/invariants.hpp"
#include "support/failure.hpp"
#include "support/temporary.hpp"

#include <cstdlib>
#include <iostream>
#include <sstream>

using namespace facetmill;
using namespace facetmill::test;
namespace fs = std::filesystem;

namespace {

struct Row {
    std::string path, format;
    long vertices = -1, faces = -1;
};

std::vector<Row> manifest(const fs::path& corpus) {
    std::vector<Row> rows;
    std::istringstream lines(get(corpus / "MANIFEST.tsv"));
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
        std::vector<std::string> cells;
        std::istringstream in(line);
        for (std::string cell; std::getline(in, cell, '\t');) cells.push_back(cell);
        if (cells.size() < 6) continue;
        const auto number = [](const std::string& text) {
            return text.empty() ? -1L : std::atol(text.c_str());
        };
        rows.push_back({cells[0], cells[3], number(cells[4]), number(cells[5])});
    }
    return rows;
}

} // namespace

TEST_CASE("every text mesh of the corpus is read with its counts, or refused when it is malformed", "[io]") {
    const auto corpus = test::corpus();
    if (!corpus) return;
    for (const Row& row : manifest(*corpus)) {
        const std::string suffix = fs::path(row.path).extension();
        if (suffix != ".ply" && suffix != ".stl" && suffix != ".obj" && suffix != ".off") continue;
        INFO(row.path);
        io::ReadLog log;
        Scene scene;
        const std::string failed =
            failure([&] { scene = io::read_scene(io::Input::open(*corpus / row.path), {}, log); });
        const bool verbose = std::getenv("FACETMILL_CORPUS_VERBOSE") != nullptr;
        if (verbose) {
            std::cout << row.path << ": " << failed;
            for (const auto& p : scene.parts) {
                std::cout << " | " << p.name << " v " << p.mesh.vertex_count() << " w "
                          << p.mesh.wedge_count() << " f " << p.mesh.face_count();
                for (const auto& a : p.mesh.attributes)
                    std::cout << " " << a.name << ":" << to_string(a.domain) << ":" << a.type()
                              << a.components;
            }
            std::cout << "\n";
            for (const auto& w : log.warnings) std::cout << "    " << render(w) << "\n";
        }
        if (failed != "nothing") {
            CHECK(row.path.starts_with("malformed/"));
            CHECK((failed.starts_with("malformed") || failed.starts_with("limit")));
            continue;
        }
        CHECK(broken_invariants(scene).empty());
        if (row.path.starts_with("malformed/")) continue;
        std::size_t vertices = 0;
        for (const auto& part : scene.parts) vertices += part.mesh.vertex_count();
        if (row.path == "off/whitespace.off")
            continue; // the manifest's reader misreads "OFF8 6 12" as counts
        if (row.faces >= 0) CHECK(scene.face_count() == static_cast<std::size_t>(row.faces));
        // The manifest counts three vertices per triangle for STL, and for some other files only the used
        // vertices.
        if (suffix != ".stl" && row.vertices >= 0) CHECK(vertices >= static_cast<std::size_t>(row.vertices));
    }
}
