// Every glTF and Draco file of a folder of real and malformed files: read and written again, or refused in
// words.
#include "io/codec.hpp"
#include "support/catch.hpp"
#include "support/corpus.hpp"
#include "support/gltf.hpp"

#include <cstdlib>
#include <iostream>

using namespace facetmill;

namespace {

void check_written_again(const Scene& scene, bool draco) {
    io::WriteSettings settings;
    settings.draco.on = draco;
    const Scene again = test::again(scene, settings);
    REQUIRE(again.face_count() == scene.face_count());
    for (const auto& part : again.parts) CHECK(broken_invariants(part.mesh).empty());
}

} // namespace

TEST_CASE("every file of the corpus is read, or refused in words", "[io]") {
    const auto folder = test::corpus();
    if (!folder) return;
    for (const auto& file : test::meshes_below(*folder)) {
        const auto suffix = file.extension();
        if (suffix != ".gltf" && suffix != ".glb" && suffix != ".drc") continue;
        INFO(file.string());
        io::ReadLog log;
        Scene scene;
        try {
            scene = io::read_scene(io::Input::open(file), {}, log);
        } catch (const Error& e) {
            const std::string message = render(e.diagnostics().front());
            CHECK(message.find(file.filename().string()) != std::string::npos);
            if (std::getenv("FACETMILL_CORPUS_LIST")) std::cout << message << "\n";
            continue;
        }
        for (const auto& part : scene.parts) CHECK(broken_invariants(part.mesh).empty());
        if (std::getenv("FACETMILL_CORPUS_LIST"))
            std::cout << file.string() << ": " << scene.parts.size() << " parts, " << scene.face_count()
                      << " faces, " << (scene.parts.empty() ? 0 : scene.parts[0].mesh.vertex_count())
                      << " vertices, " << (scene.parts.empty() ? 0 : scene.parts[0].mesh.wedge_count())
                      << " wedges in the first\n";
        if (log.warnings.size() > 1000) continue;
        try {
            check_written_again(scene, false);
            check_written_again(scene, true);
            for (auto& part : scene.parts) part.changed = true;
            check_written_again(scene, false);
        } catch (const Error& e) { // unused data is only checked when it must be copied
            CHECK(e.kind() == ErrorKind::malformed);
            CHECK(file.string().find("malformed") != std::string::npos);
            if (std::getenv("FACETMILL_CORPUS_LIST")) std::cout << "not written: " << e.what() << "\n";
        }
    }
}
