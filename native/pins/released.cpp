#include "pins/released.h"

#include <numeric>

namespace fairing {

namespace {

// Pins first among the fixed vertices.
Indices order_of(const Patch& given, const Indices& pins) {
    Indices from(given.free_count);
    std::iota(from.begin(), from.end(), 0);
    std::vector<char> is_pin(given.vertex_count(), 0);
    for (int place : pins) {
        is_pin[given.free_count + place] = 1;
        from.push_back(given.free_count + place);
    }
    for (int v = given.free_count; v < given.vertex_count(); ++v) {
        if (!is_pin[v]) from.push_back(v);
    }
    return from;
}

}  // namespace

Released released(const Patch& given, const Indices& pins) {
    Indices from = order_of(given, pins);
    Indices to(from.size());
    for (int v = 0; v < static_cast<int>(from.size()); ++v) to[from[v]] = v;
    PatchMembers members;
    members.free_count = given.free_count + static_cast<int>(pins.size());
    for (int v : from) {
        members.to_input.push_back(given.to_input[v]);
        members.pin.push_back(given.pin[v]);
    }
    for (int v = 0; v < members.free_count; ++v) members.pin[v] = 0;
    members.input_triangle = given.input_triangle;
    members.triangles = given.triangles.unaryExpr([&](int v) { return to[v]; });
    return {Patch(std::move(members)), std::move(from), std::move(to)};
}

Problem on_released(const Problem& problem, const Released& free) {
    Indices places;
    for (int v = free.patch.free_count; v < free.patch.vertex_count(); ++v)
        places.push_back(free.from[v] - problem.patch.free_count);
    return {free.patch, problem.fixed_points(Eigen::all, places), problem.fixed_normals(Eigen::all, places),
            uniform_weights(free.patch), problem.options};
}

}  // namespace fairing
