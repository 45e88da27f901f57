// SPDX-License-Identifier: MIT
#include "goffer/paper/base.hpp"

#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace goffer::paper {
namespace {

void require(double length, double radius, std::uint32_t columns, std::uint32_t rows) {
    std::ostringstream text;
    if (!(length > 0 && std::isfinite(length))) {
        text << "length is " << length << ": it must be a positive number";
    } else if (!(radius > 0 && std::isfinite(radius))) {
        text << "radius is " << radius << ": it must be a positive number";
    } else if (columns < 3) {
        text << "columns is " << columns << ": a ring needs 3 or more";
    } else if (rows < 2) {
        text << "rows is " << rows << ": a cylinder needs 2 or more";
    } else if ((std::uint64_t{rows} * columns + 2) >> 32) {
        text << "columns x rows is " << columns << " x " << rows
             << ": that is more than 32-bit indices can number";
    } else {
        return;
    }
    throw std::invalid_argument(text.str());
}

void add_side(BaseMesh& mesh, std::uint32_t columns, std::uint32_t rows) {
    for (std::uint32_t row = 0; row + 1 < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t a = row * columns + column;
            const std::uint32_t b = row * columns + (column + 1) % columns;
            const std::uint32_t c = b + columns, d = a + columns;
            mesh.triangles.insert(mesh.triangles.end(), {a, b, c, a, c, d});
        }
    }
}

void add_caps(BaseMesh& mesh, double length, std::uint32_t columns) {
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    const std::uint32_t tip = base + 1, last_ring = base - columns;
    mesh.positions.emplace_back(0, 0, 0);
    mesh.positions.emplace_back(0, 0, length);
    for (std::uint32_t column = 0; column < columns; ++column) {
        const std::uint32_t next = (column + 1) % columns;
        mesh.triangles.insert(mesh.triangles.end(), {base, next, column});
        mesh.triangles.insert(mesh.triangles.end(), {tip, last_ring + column, last_ring + next});
    }
}

}  // namespace

BaseMesh base_mesh(double length, double radius, std::uint32_t columns, std::uint32_t rows, bool caps) {
    require(length, radius, columns, rows);
    BaseMesh mesh;
    for (std::uint32_t row = 0; row < rows; ++row) {
        const double z = length * row / (rows - 1);
        for (std::uint32_t column = 0; column < columns; ++column) {
            const double beta = 2 * std::numbers::pi * column / columns;
            mesh.positions.emplace_back(radius * std::cos(beta), radius * std::sin(beta), z);
        }
    }
    add_side(mesh, columns, rows);
    if (caps) add_caps(mesh, length, columns);
    return mesh;
}

}  // namespace goffer::paper
