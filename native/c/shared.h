// What the functions of the C library share.
#pragma once

#include <functional>
#include <string_view>

#include "api/fair.h"
#include "c/fairing.h"

namespace fairing::c {

// Runs the work and converts its exceptions to a status.
fairing_status guarded(fairing_error* error, const std::function<void()>& work);

// Throws std::invalid_argument with the message where it does not hold.
void require(bool holds, const char* message);

// The caller's options, or the usual ones where there are none.
template <typename Options>
Options given_or(const Options* given, const Options& usual) {
    require(!given || given->size == sizeof(Options), "options.size: sizeof its struct is needed");
    return given ? *given : usual;
}

// The caller's arrays, and how many triples there are.
template <typename Number>
struct Triples {
    const Number* numbers;
    std::size_t count;
};

View<Points> points_of(Triples<double> points);
// Throws INDEX_RANGE for vertices that do not exist.
Triangles triangles_of(Triples<int> triangles, std::size_t point_count);

// A part of a mesh, and what is around it.
struct SelectedMesh {
    Points points;
    Triangles inside;
    Triangles outside;

    // Throws INDEX_RANGE, and std::invalid_argument where nothing is selected.
    SelectedMesh(Triples<double> given, Triples<int> triangles, const unsigned char* selected);

    // With border vertices whose slope is known, on the side "outside", "inside" or "automatic". Others are left out:
    // they stay, with that of their own triangles. Refers to this mesh.
    [[nodiscard]] MeshInput input(std::string_view side) const;
};

FairOptions to_options(const fairing_options& given);

ProgressCallback calling(fairing_progress progress, void* user);

double largest(const VectorX& values);

}  // namespace fairing::c
