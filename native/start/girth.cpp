#include "start/girth.h"

#include <algorithm>

#include "operators/laplace_operator.h"
#include "start/clamped_fill.h"

namespace fairing {

namespace {

// By length; the origin where there is none.
Vector3 middle_of(const std::vector<LevelPiece>& pieces) {
    Vector3 sum = Vector3::Zero();
    double length = 0.0;
    for (const LevelPiece& piece : pieces) {
        sum += piece.length * piece.middle;
        length += piece.length;
    }
    return length > 0.0 ? Vector3(sum / length) : sum;
}

Vector3 farthest(const std::vector<LevelPiece>& pieces, const Vector3& from) {
    const auto nearer = [&](const LevelPiece& a, const LevelPiece& b) {
        return (a.middle - from).squaredNorm() < (b.middle - from).squaredNorm();
    };
    return std::max_element(pieces.begin(), pieces.end(), nearer)->middle;
}

}  // namespace

std::optional<CrossSections> CrossSections::of(const Patch& patch, const Progress& progress) {
    CrossSections result(patch);
    const std::vector<Indices> loops = patch.loops();
    const Stiffness even = uniform_stiffness(patch);
    LaplaceOperator laplace(patch);
    if (loops.size() < 2 || !laplace.update(even, progress)) return std::nullopt;
    for (const Indices& loop : loops) {
        Eigen::RowVectorXd field = Eigen::RowVectorXd::Zero(patch.vertex_count());
        for (const int v : loop) field[v] = 1.0;
        const Eigen::RowVectorXd pull = even.apply(patch, field, patch.free_count);
        field.head(patch.free_count) = -laplace.solve(pull.transpose()).transpose();
        result.levels_.emplace_back(field.transpose());
    }
    return result;
}

std::vector<LevelPiece> CrossSections::pieces(int outline, int line, const Points& points) const {
    std::vector<LevelPiece> found;
    for (const auto triangle : patch_.triangles.colwise()) {
        const LevelPiece piece = level_within(triangle, levels_[outline], level_of(line), points);
        if (piece.length > 0.0) found.push_back(piece);
    }
    return found;
}

VectorX CrossSections::lengths(int outline, const Points& points) const {
    VectorX result = VectorX::Zero(line_count);
    for (int line = 0; line < line_count; ++line) {
        for (const LevelPiece& piece : pieces(outline, line, points)) result[line] += piece.length;
    }
    return result;
}

VectorX CrossSections::widths(int outline, const Points& points) const {
    VectorX result = VectorX::Zero(line_count);
    for (int line = 0; line < line_count; ++line) {
        const auto line_pieces = pieces(outline, line, points);
        if (line_pieces.empty()) continue;
        const Vector3 one_end = farthest(line_pieces, middle_of(line_pieces));
        result[line] = (farthest(line_pieces, one_end) - one_end).norm();
    }
    return result;
}

Indices CrossSections::triangles(int outline, int line) const {
    Indices found;
    for (int t = 0; t < patch_.triangle_count(); ++t) {
        const Vector3 values = levels_[outline](patch_.triangles.col(t));
        if (values.minCoeff() < level_of(line) && values.maxCoeff() >= level_of(line)) found.push_back(t);
    }
    return found;
}

}  // namespace fairing
