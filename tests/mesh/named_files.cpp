// SPDX-License-Identifier: MIT
#include "gltf_files.hpp"

#include <doctest/doctest.h>

/// Files that others name: those in the document's folder are read, others only where that is allowed.

using namespace goffer::mesh;
using namespace goffer::test;

namespace fs = std::filesystem;

namespace {

/// A folder with a document's folder "in" and private files around it.
struct Place {
    Folder folder;

    Place() {
        fs::create_directories(folder / "in/sub");
        fs::create_directory(folder / "inside");  // begins with the same letters
        for (const char* name : {"secret.bin", "inside/secret.bin", "in/sub/own.bin"})
            folder.write(name, tetra().buffer);
        fs::create_symlink("../secret.bin", folder / "in/link.bin");
        fs::create_symlink("sub/own.bin", folder / "in/own.bin");
        fs::create_symlink("..", folder / "in/up");
    }

    /// What loading a glTF with a buffer, or an image, of this URI says: the error that a buffer is, or the
    /// warning that an image is, which is then not taken into a GLB.
    [[nodiscard]] std::string gltf(const std::string& uri, bool image,
                                   const LoadOptions& options = {}) const {
        Document document = tetra();
        if (image) {
            document.json["images"].push_back({{"uri", uri}});
        } else {
            document.json["buffers"].push_back({{"byteLength", document.buffer.size()}, {"uri", uri}});
        }
        for (const char* name : {"secret.bin", "inside/secret.bin"})
            folder.write(name, image ? "\x89PNG private" : tetra().buffer);
        const fs::path file = folder.write("in/d.gltf", document.gltf());
        if (!image) return error_of([&] { (void)load(file, options); });
        const Mesh mesh = load(file, options);
        save(mesh, folder / "out.glb");
        const bool taken = bytes_of(folder / "out.glb").find("private") != std::string::npos;
        CHECK(taken == options.allow_outside);
        return mesh.warnings.empty() ? "" : mesh.warnings[0];
    }

    [[nodiscard]] Mesh obj(const std::string& library, const LoadOptions& options = {}) const {
        const fs::path file = folder.write(
            "in/d.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nmtllib " + library + "\nusemtl red\nf 1 2 3\n");
        return load(file, options);
    }
};

bool says(const std::string& message, const std::string& what) {
    return message.find(what) != message.npos;
}

/// An absolute path as a URI of slashes, or with all of them escaped.
std::string uri_to(const fs::path& file, const char* slash) {
    return replaced(file.string(), "/", slash);
}

}  // namespace

TEST_CASE("files: the buffers that a glTF names are told, there or not, without those outside") {
    const Place place;
    Document document = tetra();
    const auto name = [&](const Json& buffer) { document.json["buffers"].push_back(buffer); };
    const auto named = [&](const LoadOptions& options = {}) {
        std::vector<std::string> names;
        const fs::path file = place.folder.write("in/d.gltf", document.gltf());
        for (const fs::path& buffer : named_buffers(file, options)) {
            names.push_back(fs::weakly_canonical(buffer)
                                .lexically_relative(fs::weakly_canonical(place.folder / "in"))
                                .string());
        }
        return names;
    };
    CHECK(named().empty());  // a data URI
    name({{"byteLength", 4}});
    name({{"byteLength", 4}, {"uri", 5}});
    name({{"byteLength", 4}, {"uri", ""}});
    name({{"byteLength", 4}, {"uri", "https://example.com/a.bin"}});
    name({{"byteLength", 4}, {"uri", "sub/own.bin"}});
    name({{"byteLength", 4}, {"uri", "none.bin"}});
    name({{"byteLength", 4}, {"uri", "../secret.bin"}});
    CHECK(named() == std::vector<std::string>{"sub/own.bin", "none.bin"});
    CHECK(named({.allow_outside = true}) ==
          std::vector<std::string>{"sub/own.bin", "none.bin", "../secret.bin"});
    CHECK(named_buffers(place.folder.write("in/a.obj", "v 0 0 0\n")).empty());
    CHECK(named_buffers(place.folder.write("in/broken.gltf", "{")).empty());
}

TEST_CASE("files: the images of a glTF, the materials of an OBJ and their textures are told, too") {
    const Place place;
    const auto names = [&](const fs::path& file, const LoadOptions& options = {}) {
        std::vector<std::string> found;
        for (const fs::path& named : named_files(file, options)) found.push_back(named.filename().string());
        return found;
    };
    using Names = std::vector<std::string>;
    Document document = tetra();
    document.json["buffers"].push_back({{"byteLength", 4}, {"uri", "own.bin"}});
    document.json["images"] =
        Json::parse(R"([{"uri": "a%20b.png"}, {"bufferView": 0}, {"uri": "../c.png"}])");
    const fs::path gltf = place.folder.write("in/d.gltf", document.gltf());
    CHECK(names(gltf) == Names{"own.bin", "a b.png"});
    CHECK(names(gltf, {.allow_outside = true}) == Names{"own.bin", "a b.png", "c.png"});
    place.folder.write("in/m.mtl", "newmtl a\nmap_Kd t.png\nmap_bump b.png\n");
    const fs::path obj = place.folder.write("in/a.obj", "mtllib m.mtl\nmtllib none.mtl\nv 0 0 0\n");
    CHECK(names(obj) == Names{"m.mtl", "t.png", "b.png", "none.mtl"});
    CHECK(names(place.folder.write("in/a.stl", "solid\n")).empty());
}

TEST_CASE("named files: a glTF reads and copies nothing from outside its folder, however it is spelled") {
    const Place place;
    const LoadOptions allowed{.allow_outside = true};
    for (const std::string& uri :
         {std::string("../secret.bin"), std::string("..%2Fsecret.bin"), std::string("%2e%2e%2fsecret.bin"),
          std::string("sub/../../secret.bin"), std::string("./%2E./secret.bin"), std::string("link.bin"),
          std::string("up/secret.bin"), std::string("../inside/secret.bin"),
          uri_to(place.folder / "secret.bin", "/"), uri_to(place.folder / "secret.bin", "%2F")}) {
        CAPTURE(uri);
        for (const bool image : {false, true}) {
            const std::string message = place.gltf(uri, image);
            CHECK(says(message, image ? "images[0].uri names '" : "buffers[0].uri: names '"));
            CHECK(says(message, uri.substr(0, 40)));
            CHECK(says(message, "--allow-outside"));
            CHECK(place.gltf(uri, image, allowed).empty());
        }
    }
}

TEST_CASE("named files: what lies in the document's folder or below it is read") {
    const Place place;
    for (const char* uri :
         {"sub/own.bin", "own.bin", "sub%2Fown.bin", "../in/sub/own.bin", "up/in/own.bin"}) {
        CAPTURE(uri);
        CHECK(place.gltf(uri, false).empty());
        CHECK(place.gltf(uri, true).empty());
    }
    CHECK(tells(place.gltf("none/../gone.bin", false), "is not there"));
    CHECK(tells(place.gltf("own.bin%00/../../secret.bin", false), "lies outside"));
    CHECK(tells(place.gltf("http://a/b.bin", false), "only paths are read"));
}

TEST_CASE("named files: a document is found by a way with links and dots, and by its bare name") {
    const Place place;
    CHECK(place.gltf("sub/own.bin", false).empty());
    CHECK(load(place.folder / "in/up/in/sub/../d.gltf").positions.size() == 4);
    fs::create_directory_symlink("in", place.folder / "way");
    CHECK(load(place.folder / "way/d.gltf").positions.size() == 4);
    const fs::path before = fs::current_path();
    fs::current_path(place.folder / "in");
    CHECK(load("d.gltf").positions.size() == 4);
    fs::current_path(before);
}

TEST_CASE("named files: an OBJ reads no material file from outside its folder") {
    const Place place;
    place.folder.write("secret.mtl", "newmtl red\nKd 1 0 0\n");
    place.folder.write("in/own.mtl", "newmtl red\nKd 1 0 0\n");
    fs::create_symlink("../secret.mtl", place.folder / "in/link.mtl");
    for (const std::string& name : {std::string("../secret.mtl"), std::string("link.mtl"),
                                    std::string("up/secret.mtl"), (place.folder / "secret.mtl").string()}) {
        CAPTURE(name);
        const Mesh refused = place.obj(name);
        REQUIRE(refused.warnings.size() == 1);
        CHECK(says(refused.warnings[0], "line 4: mtllib names '" + name.substr(0, 40)));
        CHECK(says(refused.warnings[0], "--allow-outside"));
        CHECK(refused.materials[0].base_color.y != 0);
        const Mesh allowed = place.obj(name, {.allow_outside = true});
        CHECK(allowed.warnings.empty());
        CHECK(allowed.materials[0].base_color.y == 0);
    }
    CHECK(place.obj("own.mtl").materials[0].base_color.y == 0);
}

TEST_CASE("named files: what is written elsewhere, with names that lead back, can be read again") {
    const Place place;
    Document document = tetra();
    document.json["images"].push_back({{"uri", "sub/own.bin"}});
    const Mesh mesh = load(place.folder.write("in/d.gltf", document.gltf()));
    fs::create_directory(place.folder / "out");
    save(mesh, place.folder / "out/d.gltf");
    CHECK(bytes_of(place.folder / "out/d.gltf").find("../in/sub/own.bin") != std::string::npos);
    const std::vector<std::string> said = load(place.folder / "out/d.gltf").warnings;
    REQUIRE(said.size() == 1);
    CHECK(says(said[0], "images[0].uri names '../in/sub/own.bin', which lies outside"));
    save(load(place.folder / "out/d.gltf"), place.folder / "d.gltf");
    CHECK(bytes_of(place.folder / "d.gltf").find("in/sub/own.bin") != std::string::npos);
}

TEST_CASE("named files: textures that are not there are warned of") {
    const Place place;
    place.folder.write("in/here.png", "\x89PNG");
    place.folder.write("in/a.mtl",
                       "newmtl red\nmap_Kd gone.png\nmap_Ks -s 1 1 1 gone.png\nmap_d here.png\n"
                       "bump ../not/looked/for.png\nnewmtl blue\nmap_Kd sub\\lost.png\n");
    const std::vector<std::string> said = place.obj("a.mtl").warnings;
    REQUIRE(said.size() == 2);
    CHECK(says(said[0], "a.mtl: names 'gone.png', which is not there"));
    CHECK(says(said[1], "a.mtl: names 'sub/lost.png', which is not there"));
}
