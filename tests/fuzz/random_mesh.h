// Small meshes from a fuzzer's bytes: a plausible shape, then damage.
#pragma once

#include <fuzzer/FuzzedDataProvider.h>

#include <utility>

#include "api/input.h"

namespace fairing::fuzz {

// With its vertices, which the input refers to.
struct RandomMesh {
    RandomMesh(Points vertices, Triangles triangles)
        : points(std::move(vertices)), input{points, std::move(triangles), {}, {}} {}
    RandomMesh(const RandomMesh&) = delete;
    RandomMesh(RandomMesh&&) = default;  // the vertices stay where they are in memory

    Points points;
    MeshInput input;
};

// Vertices and triangles of a grid, fan, tube, Möbius strip, closed surface, two islands or a heap of triangles, with
// some triangles turned, doubled, left out or led elsewhere and some coordinates moved, merged or made special (NaN,
// infinity, extremes). With `valid_indices` every index names a vertex. Without bytes left: a flat quad.
RandomMesh random_mesh(FuzzedDataProvider& bytes, bool valid_indices);

// Fixed vertices (none given, the border, any subset, any list with repetitions and strangers), and their normals.
void random_boundary(FuzzedDataProvider& bytes, MeshInput& mesh);

// Some vertices moved a little, to anywhere or to no number; now and then one more vertex, or the last one gone.
void move(FuzzedDataProvider& bytes, RandomMesh& mesh);

// One of the coordinates that no mesh should have, or an ordinary one.
double special_number(FuzzedDataProvider& bytes);

}  // namespace fairing::fuzz
