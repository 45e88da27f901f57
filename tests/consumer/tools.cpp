// SPDX-License-Identifier: MIT

// What a tool does: writes a mesh, reads it back and makes a picture of it.

#include <goffer/mesh/mesh.hpp>
#include <goffer/view/picture.hpp>

#include <cstdio>

int main() {
    goffer::mesh::Mesh made;
    made.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    made.corners = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    made.faces = {3, 3, 3, 3};
    made.parts = {{.face_count = 4}};
    save(made, "tetrahedron.obj");
    const goffer::mesh::Mesh mesh = goffer::mesh::load("tetrahedron.obj");

    const goffer::view::Model model{.positions = mesh.positions, .triangles = mesh.corners};
    const goffer::view::Picture picture =
        goffer::view::render({&model, 1}, {}, {.width = 64, .height = 48, .samples = 1});
    save_png(picture, "tetrahedron.png");
    std::printf("%zu vertices, %d x %d pixels\n", mesh.positions.size(), picture.width, picture.height);
    return mesh.positions.size() == 4 && picture.rgb.size() == 64 * 48 * 3 ? 0 : 1;
}
