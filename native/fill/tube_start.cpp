#include "fill/tube_start.h"

#include "base/columns.h"

namespace fairing {

namespace {

// A closed row of vertices with their shares of the length around; the first one has 0.
struct Row {
    Indices vertices;
    std::vector<double> shares;
};

void join(const Row& below, const Row& above, std::vector<Eigen::Vector3i>& triangles) {
    std::size_t a = 0;
    std::size_t b = 0;
    const auto next = [](const Row& row, std::size_t k) { return k + 1 < row.shares.size() ? row.shares[k + 1] : 1.0; };
    const auto vertex = [](const Row& row, std::size_t k) { return row.vertices[k % row.vertices.size()]; };
    while (a < below.vertices.size() || b < above.vertices.size()) {
        const bool advances_below =
            b == above.vertices.size() || (a < below.vertices.size() && next(below, a) <= next(above, b));
        if (advances_below) {
            triangles.emplace_back(vertex(below, a), vertex(below, a + 1), vertex(above, b));
            ++a;
        } else {
            triangles.emplace_back(vertex(below, a), vertex(above, b + 1), vertex(above, b));
            ++b;
        }
    }
}

Row row_of(const TubeSection& section, int added) {
    Row row;
    for (std::size_t k = 0; k < section.vertices().size(); ++k) {
        row.vertices.push_back(added + section.vertices()[k]);
        row.shares.push_back(section.share(k));
    }
    return row;
}

struct Resolution {
    int around;
    int along;
};

// About as long as wide.
Resolution resolution(const SweptTube& tube) {
    const std::size_t most = std::max(tube.first().vertices().size(), tube.last().vertices().size());
    const auto around = static_cast<int>(std::clamp<std::size_t>(most, 16, 48));
    const double girth = 0.5 * (tube.first().girth() + tube.last().girth());
    const int along = static_cast<int>(std::lround(std::min(tube.length() * around / girth, 200.0)));
    return {around, std::max(along, 2)};
}

Row row_between(const SweptTube& tube, const Resolution& size, int j, Points& points) {
    Row row;
    for (int k = 0; k < size.around; ++k) {
        const double u = static_cast<double>(k) / size.around;
        const int v = size.around * (j - 1) + k;
        points.col(v) = tube.place(static_cast<double>(j) / size.along, u);
        row.vertices.push_back(v);
        row.shares.push_back(u);
    }
    return row;
}

}  // namespace

TubeMesh tube_start(const SweptTube& tube) {
    const Resolution size = resolution(tube);
    const int added = size.around * (size.along - 1);
    TubeMesh result{Points(3, added), {}};
    std::vector<Eigen::Vector3i> triangles;
    Row last = row_of(tube.first(), added);
    for (int j = 1; j < size.along; ++j) {
        Row row = row_between(tube, size, j, result.points);
        join(last, row, triangles);
        last = std::move(row);
    }
    join(last, row_of(tube.last(), added), triangles);
    result.triangles = as_columns(triangles);
    return result;
}

}  // namespace fairing
