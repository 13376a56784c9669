#pragma once

#include "mesh/surface_mesh.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace isoglass {

/// The corner tetrahedron of the unit cube, outward winding, volume 1/6, away from the origin.
inline SurfaceMesh makeTetrahedron() {
    SurfaceMesh mesh;
    mesh.origin = {500000.125, -1.0 / 3, 0};
    mesh.positions = {{0.1f, 0, 0}, {1.1f, 0, 0}, {0.1f, 1, 0}, {0.1f, 0, 1}};
    mesh.normals = {{-1, -1, -1}, {2, 0, 0}, {0, 3e-20f, 0}, {0, 0, 4e20f}};
    mesh.triangles = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    return mesh;
}

/// Unit cube, 12 triangles.
inline SurfaceMesh makeCube() {
    SurfaceMesh mesh;
    for (int corner = 0; corner < 8; ++corner)
        mesh.positions.emplace_back(corner & 1, corner >> 1 & 1, corner >> 2);
    mesh.normals.assign(8, {0, 0, 1});
    const std::uint32_t quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& q : quads)
        mesh.triangles.insert(mesh.triangles.end(), {q[0], q[1], q[2], q[0], q[2], q[3]});
    return mesh;
}

/// A `columns` x `rows` grid of quads that closes on itself in both directions.
inline SurfaceMesh makeTorus(std::uint32_t columns, std::uint32_t rows) {
    SurfaceMesh mesh;
    for (std::uint32_t j = 0; j < rows; ++j) {
        for (std::uint32_t i = 0; i < columns; ++i) {
            const double u = 2 * std::numbers::pi * i / columns, v = 2 * std::numbers::pi * j / rows;
            const double r = 3 + std::cos(v);
            mesh.positions.emplace_back(r * std::cos(u), r * std::sin(u), std::sin(v));
            mesh.normals.emplace_back(std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v));
            const std::uint32_t right = (i + 1) % columns, up = (j + 1) % rows;
            const std::uint32_t a = j * columns + i, b = j * columns + right, c = up * columns + right,
                                d = up * columns + i;
            mesh.triangles.insert(mesh.triangles.end(), {a, b, c, a, c, d});
        }
    }
    return mesh;
}

/// Adds a copy of `part`, moved by `shift`.
inline void append(SurfaceMesh& mesh, const SurfaceMesh& part, glm::vec3 shift) {
    const auto first = static_cast<std::uint32_t>(mesh.vertexCount());
    for (const glm::vec3& position : part.positions) mesh.positions.push_back(position + shift);
    mesh.normals.insert(mesh.normals.end(), part.normals.begin(), part.normals.end());
    for (const std::uint32_t index : part.triangles) mesh.triangles.push_back(first + index);
}

}  // namespace isoglass
