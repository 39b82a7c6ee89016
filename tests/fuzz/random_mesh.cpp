#include "random_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace fairing::fuzz {

namespace {

struct Draft {
    std::vector<Vector3> points;
    std::vector<std::array<int, 3>> triangles;

    void quad(int a, int b, int c, int d) {
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, d});
    }
};

Vector3 on_circle(double turn, double height) {
    const double angle = 2.0 * std::numbers::pi * turn;
    return {std::cos(angle), std::sin(angle), height};
}

// rows × columns quads; wrapped round a cylinder, or joined after half a turn, on request.
Draft strip(int rows, int columns, bool wrapped, bool twisted) {
    Draft draft;
    const int width = wrapped ? columns : columns + 1;
    for (int r = 0; r <= rows; ++r) {
        for (int c = 0; c < width; ++c) {
            const double height = static_cast<double>(r) / rows;
            draft.points.push_back(wrapped ? on_circle(static_cast<double>(c) / columns, 2.0 * height)
                                           : Vector3(static_cast<double>(c) / columns, height, 0.1 * r * c));
        }
    }
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < columns; ++c) {
            const bool last = wrapped && c == columns - 1;
            const int next = last ? 0 : c + 1;
            const int low = last && twisted ? rows - r : r;
            const int high = last && twisted ? rows - r - 1 : r + 1;
            draft.quad(r * width + c, low * width + next, high * width + next, (r + 1) * width + c);
        }
    }
    return draft;
}

Draft fan(int valence, bool closed) {
    Draft draft;
    draft.points.push_back({0.0, 0.0, 0.3});
    for (int k = 0; k < valence; ++k) draft.points.push_back(on_circle(static_cast<double>(k) / valence, 0.0));
    for (int k = 0; k < (closed ? valence : valence - 1); ++k)
        draft.triangles.push_back({0, k + 1, (k + 1) % valence + 1});
    return draft;
}

// A double cone: closed, all vertices on the unit sphere.
Draft closed_surface(int valence) {
    Draft draft = fan(valence, true);
    draft.points[0] = {0.0, 0.0, 1.0};
    draft.points.push_back({0.0, 0.0, -1.0});
    for (int k = 0; k < valence; ++k) draft.triangles.push_back({valence + 1, (k + 1) % valence + 1, k + 1});
    return draft;
}

Draft heap(FuzzedDataProvider& bytes) {
    Draft draft;
    const int count = bytes.ConsumeIntegralInRange(3, 12);
    for (int k = 0; k < count; ++k) draft.points.push_back(on_circle(0.618 * k, 0.1 * k));
    const int triangles = bytes.ConsumeIntegralInRange(0, 24);
    for (int t = 0; t < triangles; ++t) {
        const auto corner = [&] { return bytes.ConsumeIntegralInRange(0, count - 1); };
        draft.triangles.push_back({corner(), corner(), corner()});
    }
    return draft;
}

Draft base_shape(FuzzedDataProvider& bytes) {
    const int kind = bytes.ConsumeIntegralInRange(0, 6);
    const int rows = bytes.ConsumeIntegralInRange(1, 6);
    const int columns = bytes.ConsumeIntegralInRange(1, 8);
    switch (kind) {
        case 1: return fan(bytes.ConsumeIntegralInRange(3, 40), rows % 2 == 0);
        case 2: return strip(rows, columns + 2, true, false);
        case 3: return strip(rows, columns + 2, true, true);
        case 4: return closed_surface(columns + 2);
        case 5: return heap(bytes);
        default: return strip(rows, columns, false, false);
    }
}

void append(Draft& draft, const Draft& other, const Vector3& offset) {
    const auto first = static_cast<int>(draft.points.size());
    for (const Vector3& point : other.points) draft.points.push_back(point + offset);
    for (const auto& [a, b, c] : other.triangles) draft.triangles.push_back({first + a, first + b, first + c});
}

void damage_triangles(FuzzedDataProvider& bytes, Draft& draft, bool valid_indices) {
    const int damages = bytes.ConsumeIntegralInRange(0, 6);
    for (int k = 0; k < damages && !draft.triangles.empty(); ++k) {
        const auto count = static_cast<int>(draft.points.size());
        auto& triangle = draft.triangles[bytes.ConsumeIntegralInRange<std::size_t>(0, draft.triangles.size() - 1)];
        const std::size_t corner = bytes.ConsumeIntegralInRange<std::size_t>(0, 2);
        switch (bytes.ConsumeIntegralInRange(0, 5)) {
            case 0: std::swap(triangle[0], triangle[1]); break;
            case 1: draft.triangles.push_back(triangle); break;
            case 2: std::swap(triangle, draft.triangles.back()), draft.triangles.pop_back(); break;
            case 3: triangle[corner] = bytes.ConsumeIntegralInRange(0, count - 1); break;
            case 4: draft.triangles.push_back({triangle[corner], triangle[(corner + 1) % 3], count - 1}); break;
            default:
                if (!valid_indices) triangle[corner] = bytes.ConsumeIntegral<int>();
        }
    }
}

void damage_points(FuzzedDataProvider& bytes, Draft& draft) {
    const double noise = bytes.PickValueInArray({0.0, 1e-9, 0.05, 0.3, 2.0});
    if (noise > 0.0) {
        for (Vector3& point : draft.points) {
            for (double& x : point) x += noise * (bytes.ConsumeIntegral<std::uint8_t>() - 128) / 128.0;
        }
    }
    const int damages = bytes.ConsumeIntegralInRange(0, 6);
    for (int k = 0; k < damages; ++k) {
        Vector3& point = draft.points[bytes.ConsumeIntegralInRange<std::size_t>(0, draft.points.size() - 1)];
        if (bytes.ConsumeBool()) {
            point = draft.points[bytes.ConsumeIntegralInRange<std::size_t>(0, draft.points.size() - 1)];
        } else {
            point[bytes.ConsumeIntegralInRange(0, 2)] = special_number(bytes);
        }
    }
}

// Scale and offset of the whole.
void place(FuzzedDataProvider& bytes, Draft& draft) {
    const double scale = bytes.PickValueInArray({1.0, 1.0, 1.0, 1e-9, 1e9, 1e-140, 1e140, 0.0});
    const double offset = bytes.PickValueInArray({0.0, 0.0, 0.0, 1e3, 1e6, 1e12});
    for (Vector3& point : draft.points) point = (point * scale).array() + offset;
}

Indices border(const Triangles& triangles) {
    std::map<std::pair<int, int>, int> count;
    for (const auto t : triangles.colwise()) {
        for (int k = 0; k < 3; ++k) ++count[std::minmax({t[k], t[(k + 1) % 3]})];
    }
    std::map<int, bool> on_border;
    for (const auto& [edge, sides] : count) {
        if (sides == 1) on_border[edge.first] = on_border[edge.second] = true;
    }
    Indices result;
    for (const auto& [vertex, is_on] : on_border) result.push_back(vertex);
    return result;
}

Indices random_list(FuzzedDataProvider& bytes, int count) {
    Indices result;
    const int length = bytes.ConsumeIntegralInRange(0, 10);
    for (int k = 0; k < length; ++k) result.push_back(bytes.ConsumeIntegralInRange(-1, count));
    return result;
}

Indices random_subset(FuzzedDataProvider& bytes, int count) {
    Indices result;
    for (int v = 0; v < count; ++v) {
        if (bytes.ConsumeBool()) result.push_back(v);
    }
    return result;
}

}  // namespace

double special_number(FuzzedDataProvider& bytes) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return bytes.PickValueInArray({0.0, -0.0, 1.0, -1.0, 0.5, 1e-6, -1e6, 1e-13, 1e16, 1e-160, 1e160, 1e-308, 1e308,
                                   5e-324, nan, infinity, -infinity});
}

RandomMesh random_mesh(FuzzedDataProvider& bytes, bool valid_indices) {
    Draft draft = base_shape(bytes);
    if (bytes.ConsumeBool()) append(draft, base_shape(bytes), Vector3(bytes.ConsumeBool() ? 0.0 : 3.0, 0.0, 0.0));
    damage_triangles(bytes, draft, valid_indices);
    damage_points(bytes, draft);
    place(bytes, draft);
    Points points(3, static_cast<Eigen::Index>(draft.points.size()));
    for (std::size_t v = 0; v < draft.points.size(); ++v) points.col(static_cast<Eigen::Index>(v)) = draft.points[v];
    Triangles triangles(3, static_cast<Eigen::Index>(draft.triangles.size()));
    for (std::size_t t = 0; t < draft.triangles.size(); ++t) {
        const auto& [a, b, c] = draft.triangles[t];
        triangles.col(static_cast<Eigen::Index>(t)) << a, b, c;
    }
    return {std::move(points), std::move(triangles)};
}

void random_boundary(FuzzedDataProvider& bytes, MeshInput& mesh) {
    const auto count = static_cast<int>(mesh.vertices.cols());
    switch (bytes.ConsumeIntegralInRange(0, 3)) {
        case 0: return;
        case 1: mesh.fixed = border(mesh.triangles); break;
        case 2: mesh.fixed = random_subset(bytes, count); break;
        default: mesh.fixed = random_list(bytes, count);
    }
    if (!bytes.ConsumeBool()) return;
    Points& normals = mesh.fixed_normals.emplace(3, static_cast<Eigen::Index>(mesh.fixed->size()));
    for (auto normal : normals.colwise()) {
        normal = Vector3(0.0, 0.0, 1.0);
        if (bytes.ConsumeBool()) {
            for (double& x : normal) x = bytes.ConsumeIntegralInRange(-8, 8) / 4.0;
        }
    }
    if (normals.cols() > 0 && bytes.ConsumeIntegralInRange(0, 7) == 7) {
        normals(bytes.ConsumeIntegralInRange(0, 2), 0) = special_number(bytes);
    }
}

void move(FuzzedDataProvider& bytes, RandomMesh& mesh) {
    Points& points = mesh.points;
    const Eigen::Index count = points.cols();
    const double reach = bytes.PickValueInArray({0.0, 1e-12, 1e-3, 0.03, 0.5}) * points(0, count - 1);
    const int moves = bytes.ConsumeIntegralInRange(0, 8);
    for (int k = 0; k < moves; ++k) {
        const auto v = bytes.ConsumeIntegralInRange<Eigen::Index>(0, count - 1);
        double& x = points(bytes.ConsumeIntegralInRange(0, 2), v);
        x = bytes.ConsumeIntegralInRange(0, 15) == 15 ? special_number(bytes) : x + reach;
    }
    switch (bytes.ConsumeIntegralInRange(0, 15)) {
        case 14: points.conservativeResize(3, count + 1), points.col(count).setOnes(); break;
        case 15: points.conservativeResize(3, std::max<Eigen::Index>(count - 1, 1)); break;
        default: break;
    }
    mesh.input.vertices = points;
}

}  // namespace fairing::fuzz
