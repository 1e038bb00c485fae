#include "support/catch.hpp"

#include "base/hash.hpp"
#include "batch/journal.hpp"
#include "support/failure.hpp"
#include "support/temporary.hpp"

#include <filesystem>

using namespace facetmill;
using namespace facetmill::test;
using batch::Done;
using batch::Journal;
namespace fs = std::filesystem;

namespace {

batch::Stamp stamp_now(const fs::path& file, const std::string& name) {
    const std::string text = get(file);
    return {name, text.size(), 0, sha256(std::as_bytes(std::span(text)))};
}

/// in.ply became out/o.ply.
struct Folder {
    TemporaryDirectory dir;
    Folder() {
        put(dir / "in.ply", "input");
        fs::create_directories(dir / "out/sub");
        put(dir / "out/sub/o.ply", "output");
    }
    Done done() const {
        Done done;
        done.asset = "in.ply";
        done.digest = "options";
        done.source = (dir / "in.ply").string();
        done.inputs = {stamp_now(dir / "in.ply", (dir / "in.ply").string())};
        done.outputs = {stamp_now(dir / "out/sub/o.ply", "sub/o.ply")};
        done.absent = {(dir / "texture.png").string()};
        return done;
    }
    fs::path state() const { return Journal::path_in(dir / "out", "p.yaml"); }
};

} // namespace

TEST_CASE("a journal knows what was done, and what has changed since", "[batch]") {
    const Folder folder;
    const auto is_unchanged = [&](const std::string& digest = "options") {
        return Journal(folder.dir / "out", "p.yaml").unchanged("in.ply", digest) != nullptr;
    };
    CHECK_FALSE(is_unchanged());
    CHECK_FALSE(Journal(folder.dir / "out", "p.yaml").add(folder.done()));
    CHECK(is_unchanged());
    CHECK_FALSE(is_unchanged("others"));
    put(folder.dir / "in.ply", "INPUT");
    CHECK_FALSE(is_unchanged());
    put(folder.dir / "in.ply", "input");
    CHECK(is_unchanged());
    put(folder.dir / "texture.png", "");
    CHECK_FALSE(is_unchanged());
    fs::remove(folder.dir / "texture.png");
    fs::remove(folder.dir / "out/sub/o.ply");
    CHECK_FALSE(is_unchanged());
}

TEST_CASE("what a kill has cut short is left out of a journal", "[batch]") {
    const Folder folder;
    Journal(folder.dir / "out", "p.yaml").add(folder.done());
    const std::string whole = get(folder.state());
    put(folder.state(), whole + whole.substr(0, whole.size() / 2));
    {
        Journal journal(folder.dir / "out", "p.yaml");
        CHECK(journal.all().size() == 1);
        auto second = folder.done();
        second.asset = "second";
        journal.add(second);
    }
    Journal journal(folder.dir / "out", "p.yaml");
    CHECK(journal.all().size() == 2);
    CHECK_FALSE(journal.compact());
    CHECK(get(folder.state()).starts_with(whole));
}

TEST_CASE("one batch at a time holds a journal", "[batch]") {
    const Folder folder;
    Journal first(folder.dir / "out", "p.yaml");
    CHECK(
        failure([&] { const Journal second(folder.dir / "out", "p.yaml"); }).starts_with("output [E-BUSY]"));
    first.compact();
    CHECK(
        failure([&] { const Journal second(folder.dir / "out", "p.yaml"); }).starts_with("output [E-BUSY]"));
    CHECK(failure([&] { const Journal other(folder.dir / "out", "q.yaml"); }) == "nothing");
}

TEST_CASE("a journal without a folder says where it could be", "[batch]") {
    const Folder folder;
    CHECK(failure([&] {
              const Journal journal(folder.dir / "in.ply/out", "p.yaml");
          }).ends_with("with another --output-dir"));
}

TEST_CASE("a journal removes only what is as it was written", "[batch]") {
    const Folder folder;
    Journal journal(folder.dir / "out", "p.yaml");
    journal.add(folder.done());
    CHECK(journal.remove_all("in.ply", {"sub/o.ply"}).empty());
    CHECK(fs::exists(folder.dir / "out/sub/o.ply"));
    journal.add(folder.done());
    put(folder.dir / "out/sub/o.ply", "by hand");
    CHECK(journal.remove_all("in.ply", {}).empty());
    CHECK(get(folder.dir / "out/sub/o.ply") == "by hand");
    put(folder.dir / "out/sub/o.ply", "output");
    journal.add(folder.done());
    CHECK(journal.remove_all("in.ply", {}) == std::vector<std::string>{"sub/o.ply"});
    CHECK_FALSE(fs::exists(folder.dir / "out/sub"));
    CHECK(journal.all().empty());
}

TEST_CASE("outputs that an asset had before are known until they are removed", "[batch]") {
    const Folder folder;
    Journal journal(folder.dir / "out", "p.yaml");
    journal.add(folder.done());
    put(folder.dir / "out/new.ply", "new");
    auto later = folder.done();
    later.outputs = {stamp_now(folder.dir / "out/new.ply", "new.ply")};
    journal.add(later);
    CHECK(journal.remove_former("in.ply", {"new.ply"}) == std::vector<std::string>{"sub/o.ply"});
    CHECK(fs::exists(folder.dir / "out/new.ply"));
}
